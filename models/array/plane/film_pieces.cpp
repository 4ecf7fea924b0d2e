#include "models/array/plane/array_pieces.h"
#include "models/array/plane/plane_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

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

CondensedPiece condensed_film(const FilmPiece& piece, const ArrayMesh& mesh,
                              const ArrayMedia& media, FilmFace grounded, int degree) {
  const Section section(LineMesh(piece.mesh.x, degree), LineMesh(mesh.film_z, degree),
                        [](double, double) { return 0; });
  const bool is_electric = media.film.has_permittivity();
  const double scale_V = is_electric ? potential_scale_V(media.film) : 1.0;
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
                nodes_on_break(section, section.z().element_count(), piece.mesh.first_pillar_column,
                               piece.mesh.last_pillar_column),
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
  const int of_electrode = film.electrode >= 0 ? system.dofs().tied_dof(film.electrode) : -1;
  for (int& dof : kept) {
    result.end_is_bare.push_back(dof == of_electrode);
    if (dof == of_electrode) dof = -1;
  }
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
  std::rotate(mirror.end_is_bare.begin(), mirror.end_is_bare.begin() + n, mirror.end_is_bare.end());
  return mirror;
}

// With readings S_pu u - S_pq q of loads q, r_e = 0 gives q_e = (S_eu u - S_eq q)/S_ee.
CondensedPiece with_port_held(const CondensedPiece& piece, int port) {
  CondensedPiece held = piece;
  const Eigen::Index e = 2 * piece.end_size + port;
  const Eigen::VectorXd column = piece.matrix.col(e) / piece.matrix(e, e);
  held.matrix -= column * piece.matrix.row(e);
  held.matrix.col(e) = column;
  held.matrix.row(e) = column.transpose();
  held.matrix(e, e) = -1.0 / piece.matrix(e, e);
  return held;
}

}  // namespace viscard
