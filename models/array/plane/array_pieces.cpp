#include "models/array/plane/array_pieces.h"

#include "models/array/plane/condense.h"
#include "models/pillar/system/krylov_modes.h"
#include "models/pillar/system/stiffness_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr int kAcross = 0;  // fields of the plane motion
constexpr int kUp = 1;
constexpr int kPotential = 2;
constexpr double kBulkOverShear = 1e6;  // stands for nu = 0.5

// The plane motion without any symmetry: pieces reach to both sides of x = 0.
Kinematics whole_plane() {
  Kinematics kinematics = kinematics_of(Motion::kPlaneSymmetric);
  kinematics.measure = 1.0;
  kinematics.zero_on_axis.clear();
  return kinematics;
}

// Displacement form of a medium, and the bulk modulus whose pressures are condensed beside it.
struct PlaneForm {
  Eigen::MatrixXd form;
  double condensed_bulk_Pa = 0.0;
};

PlaneForm plane_form(const Medium& medium, PlaneState plane, bool is_electric) {
  if (plane == PlaneState::kStress) {
    if (is_electric) return {plane_stress_moduli(coupled_form(medium)), 0.0};
    if (medium.is_isotropic && medium.poisson_ratio == 0.5) {
      return {plane_stress_moduli(medium.shear_Pa * (deviatoric_form() + 1e12 * volumetric_form())),
              0.0};
    }
    return {plane_stress_moduli(medium.stiffness_Pa), 0.0};
  }
  if (is_electric) return {coupled_form(medium), 0.0};
  if (!medium.is_isotropic || medium.poisson_ratio < kNearlyIncompressible) {
    return {medium.stiffness_Pa, 0.0};
  }
  return {medium.shear_Pa * deviatoric_form(),
          std::min(medium.bulk_Pa, kBulkOverShear * medium.shear_Pa)};
}

SymmetricSparse stiffness_of(const DiscreteSystem& system, const PlaneForm& form) {
  std::vector<OperatorRow> rows = system.kinematics().strain;
  const std::vector<OperatorRow>& field = system.kinematics().electric_field;
  rows.insert(rows.end(), field.begin(), field.end());
  SymmetricSparse matrix = system.form(rows, {form.form});
  if (form.condensed_bulk_Pa > 0.0) {
    matrix.coeffs() += system.volume_form({form.condensed_bulk_Pa}, true).coeffs();
  }
  return matrix;
}

// Unknowns of the nodes on a line of the grid, node by node, without those held.
std::vector<int> dofs_on(const DiscreteSystem& system, const std::vector<int>& nodes,
                         int field_count) {
  std::vector<int> dofs;
  for (const int node : nodes) {
    for (int field = 0; field < field_count; ++field) {
      const int dof = system.dofs().dof(field, node);
      if (dof >= 0) dofs.push_back(dof);
    }
  }
  return dofs;
}

std::vector<int> nodes_on_end(const Section& section, bool right) {
  std::vector<int> nodes;
  const int ix = right ? section.x().node_count() - 1 : 0;
  for (int iz = 0; iz < section.z().node_count(); ++iz) nodes.push_back(section.node(ix, iz));
  return nodes;
}

DofMap free_dofs(const Section& section, bool fixed_base) {
  DofMap dofs(2, section.node_count());
  if (fixed_base) {
    for (const int node : nodes_on_break(section, 0, 0, section.x().element_count())) {
      dofs.fix(kAcross, node);
      dofs.fix(kUp, node);
    }
  }
  dofs.number();
  return dofs;
}

// Inertia loads M phi of the lowest modes on a fixed base, on the unknowns of the free pillar.
struct ModePorts {
  Eigen::MatrixXd loads;
  Eigen::VectorXd rad_s;
  std::vector<bool> is_lateral;
};

ModePorts mode_ports(const Section& section, const DiscreteSystem& free, const PlaneForm& form,
                     double rho_kg_m3, int count) {
  const DiscreteSystem held(section, whole_plane(), free_dofs(section, true));
  const std::vector<Eigen::MatrixXd> density{rho_kg_m3 * Eigen::MatrixXd::Identity(3, 3)};
  const SymmetricSparse mass = held.form(held.kinematics().displacement, density);
  StiffnessFactor factor;
  factor.factor(stiffness_of(held, form));
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(mass, x); };
  const LinearMap op = [&](const Eigen::VectorXd& x) { return factor.solve(times(mass, x)); };
  const int wanted = std::min(count, held.size());
  const EigenPairs pairs = largest_eigenpairs(op, B, held.size(), wanted,
                                              {.tolerance = 1e-7, .largest_space = 60 + 8 * count});
  if (!pairs.converged) {
    throw std::runtime_error("the modes of the pillar on a fixed base did not converge");
  }
  ModePorts ports{Eigen::MatrixXd::Zero(free.size(), wanted),
                  pairs.values.cwiseInverse().cwiseSqrt()};
  for (int node = 0; node < section.node_count(); ++node) {
    for (int field = 0; field < 2; ++field) {
      const int from = held.dofs().dof(field, node);
      if (from >= 0) ports.loads.row(free.dofs().dof(field, node)) = pairs.vectors.row(from);
    }
  }
  const SymmetricSparse free_mass = free.form(free.kinematics().displacement, density);
  ports.loads = (free_mass.selfadjointView<Eigen::Lower>() * ports.loads).eval();
  // Modes are symmetric or antisymmetric about the axis; only the latter have momentum along x.
  for (Eigen::Index mode = 0; mode < wanted; ++mode) {
    Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
    for (int node = 0; node < section.node_count(); ++node) {
      for (int field = 0; field < 2; ++field) {
        momentum[field] += ports.loads(free.dofs().dof(field, node), mode);
      }
    }
    ports.is_lateral.push_back(std::abs(momentum[kAcross]) > std::abs(momentum[kUp]));
  }
  return ports;
}

// Held and tied unknowns of a film whose bottom is clamped.
struct FilmDofs {
  DofMap dofs;
  int electrode = -1;  // handle
};

FilmDofs film_dofs(const Section& section, int field_count, FilmFace grounded,
                   double electrode_half_width_m) {
  FilmDofs film{DofMap(field_count, section.node_count()), -1};
  const int columns = section.x().element_count();
  const int top = section.z().element_count();
  const std::vector<int> bottom_nodes = nodes_on_break(section, 0, 0, columns);
  const std::vector<int> top_nodes = nodes_on_break(section, top, 0, columns);
  if (field_count > kPotential) {
    const bool is_top_grounded = grounded == FilmFace::kTop;
    std::vector<int> electrode;
    for (const int node : is_top_grounded ? bottom_nodes : top_nodes) {
      if (std::abs(section.node_x(node)) <= electrode_half_width_m * (1.0 + 1e-9)) {
        electrode.push_back(node);
      }
    }
    if (electrode_half_width_m > 0.0) film.electrode = film.dofs.tie(kPotential, electrode);
    for (const int node : is_top_grounded ? top_nodes : bottom_nodes) {
      film.dofs.fix(kPotential, node);
    }
  }
  for (const int node : bottom_nodes) {
    film.dofs.fix(kAcross, node);
    film.dofs.fix(kUp, node);
  }
  film.dofs.number();
  return film;
}

Eigen::VectorXd reading_column(const DiscreteSystem& system, const PotentialReading& reading,
                               int face_row, double scale_V) {
  const Section& section = system.section();
  const LineMesh& line = section.x();
  const int p = section.degree();
  Eigen::VectorXd column = Eigen::VectorXd::Zero(system.size());
  const int first = line.element_at(reading.from_m, false);
  if (reading.from_m == reading.to_m) {
    const BasisValues basis = line.basis_at(first, reading.from_m);
    for (int i = 0; i <= p; ++i) {
      const int dof = system.dofs().dof(kPotential, section.node(first * p + i, face_row * p));
      if (dof >= 0) column[dof] += scale_V * basis.value(0, i);
    }
    return column;
  }
  const double near_m = 1e-9 * (reading.to_m - reading.from_m);
  const int last = line.element_at(reading.to_m - near_m, false);
  return system.line_load(kPotential, face_row, line.element_at(reading.from_m + near_m, false),
                          last + 1) *
         (scale_V / (reading.to_m - reading.from_m));
}

// Adds the pillar's base to the film's top: a dense block on the unknowns `base`.
SymmetricSparse with_pillar(const SymmetricSparse& film, const CondensedPillar& pillar,
                            const std::vector<int>& base) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < base.size(); ++j) {
    for (std::size_t i = 0; i < base.size(); ++i) {
      if (base[i] < base[j]) continue;
      entries.emplace_back(
          base[i], base[j],
          pillar.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  SymmetricSparse block(film.rows(), film.cols());
  block.setFromTriplets(entries.begin(), entries.end());
  return film + block;
}

}  // namespace

CondensedPillar condensed_pillar(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                                 int modes) {
  const std::vector<double> x(mesh.cell_x.begin() + mesh.first_pillar_column,
                              mesh.cell_x.begin() + mesh.last_pillar_column + 1);
  const Section section(LineMesh(x, degree), LineMesh(mesh.pillar_z, degree),
                        [](double, double) { return 0; });
  const DiscreteSystem system(section, whole_plane(), free_dofs(section, false));
  const PlaneForm form = plane_form(media.pillar, media.plane, false);
  const int columns = section.x().element_count();
  const int top = section.z().element_count();
  CondensedPillar pillar;
  Eigen::MatrixXd ports(system.size(), kFirstModePort);
  ports.col(kPressurePort) = -system.line_load(kUp, top, 0, columns);
  ports.col(kShearPort) = system.line_load(kAcross, top, 0, columns);
  if (modes > 0) {
    const ModePorts more = mode_ports(section, system, form, media.pillar.rho_kg_m3, modes);
    ports.conservativeResize(Eigen::NoChange, kFirstModePort + more.loads.cols());
    ports.rightCols(more.loads.cols()) = more.loads;
    pillar.mode_rad_s = more.rad_s;
    pillar.mode_is_lateral = more.is_lateral;
  }
  const std::vector<int> base = dofs_on(system, nodes_on_break(section, 0, 0, columns), 2);
  pillar.base_size = static_cast<int>(base.size());
  pillar.unknowns = system.size();
  pillar.matrix = condensed(stiffness_of(system, form), base, ports,
                            Eigen::MatrixXd::Zero(ports.cols(), ports.cols()));
  return pillar;
}

CondensedPiece condensed_film(const FilmPiece& piece, const ArrayMesh& mesh,
                              const ArrayMedia& media, FilmFace grounded, int degree) {
  const Section section(LineMesh(piece.x_m, degree), LineMesh(mesh.film_z, degree),
                        [](double, double) { return 0; });
  const double permittivity_F_m = media.film.permittivity_F_m(2, 2);
  const bool is_electric = permittivity_F_m > 0.0;
  const double scale_V =
      is_electric ? std::sqrt(media.film.stiffness_Pa(2, 2) / permittivity_F_m) : 1.0;
  Kinematics kinematics = whole_plane();
  if (is_electric) kinematics = with_potential(std::move(kinematics), scale_V);
  const int fields = kinematics.field_count;
  FilmDofs film = film_dofs(section, fields, grounded, piece.electrode_half_width_m);
  const DiscreteSystem system(section, std::move(kinematics), std::move(film.dofs));
  SymmetricSparse matrix = stiffness_of(system, plane_form(media.film, media.plane, is_electric));

  const int of_pillar = piece.pillar == nullptr ? 0 : piece.pillar->port_count();
  const int readings = is_electric ? static_cast<int>(piece.readings.size()) : 0;
  const int ports = of_pillar + readings + (film.electrode >= 0 ? 1 : 0);
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(system.size(), ports);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(ports, ports);
  if (piece.pillar != nullptr) {
    const std::vector<int> base =
        dofs_on(system,
                nodes_on_break(section, section.z().element_count(), piece.first_pillar_column,
                               piece.last_pillar_column),
                2);
    const Eigen::MatrixXd& of = piece.pillar->matrix;
    for (std::size_t i = 0; i < base.size(); ++i) {
      F.row(base[i]).head(of_pillar) = of.row(static_cast<Eigen::Index>(i)).tail(of_pillar);
    }
    B.topLeftCorner(of_pillar, of_pillar) = of.bottomRightCorner(of_pillar, of_pillar);
    matrix = with_pillar(matrix, *piece.pillar, base);
  }
  const int face_row = grounded == FilmFace::kTop ? 0 : section.z().element_count();
  for (int r = 0; r < readings; ++r) {
    F.col(of_pillar + r) =
        reading_column(system, piece.readings[static_cast<std::size_t>(r)], face_row, scale_V);
  }
  if (film.electrode >= 0) F(system.dofs().tied_dof(film.electrode), ports - 1) = scale_V;

  CondensedPiece result;
  result.unknowns = system.size();
  std::vector<int> kept = dofs_on(system, nodes_on_end(section, false), fields);
  result.end_size = static_cast<int>(kept.size());
  for (const int node : nodes_on_end(section, false)) {
    for (int field = 0; field < fields; ++field) {
      if (system.dofs().dof(field, node) >= 0) result.end_is_across.push_back(field == kAcross);
    }
  }
  const std::vector<int> right = dofs_on(system, nodes_on_end(section, true), fields);
  kept.insert(kept.end(), right.begin(), right.end());
  result.matrix = condensed(matrix, kept, F, B);
  return result;
}

CondensedPiece mirrored(const CondensedPiece& piece) {
  CondensedPiece mirror = piece;
  const int n = piece.end_size;
  std::vector<int> from;
  Eigen::VectorXd sign = Eigen::VectorXd::Ones(piece.matrix.rows());
  for (int i = 0; i < piece.matrix.rows(); ++i) {
    from.push_back(i >= 2 * n ? i : (i + n) % (2 * n));
    if (i < 2 * n && piece.end_is_across[static_cast<std::size_t>(i % n)]) sign[i] = -1.0;
  }
  mirror.matrix = sign.asDiagonal() * piece.matrix(from, from) * sign.asDiagonal();
  return mirror;
}

}  // namespace viscard
