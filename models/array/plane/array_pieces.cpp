#include "models/array/plane/array_pieces.h"

#include "models/array/plane/plane_system.h"
#include "models/maths/dense.h"
#include "models/pillar/system/krylov_modes.h"
#include "models/pillar/system/stiffness_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Inertia loads M phi of shapes phi on a fixed base, M-orthonormal, on the unknowns of the free
// pillar.
struct InertiaPorts {
  Eigen::MatrixXd loads, shapes;
  Eigen::VectorXd rad_s;
  std::vector<bool> is_lateral;
};

// The pillar on a fixed base beside the free one.
struct HeldStrip {
  HeldStrip(const Section& section, const DiscreteSystem& free_pillar, const PlaneForm& form,
            double rho_kg_m3)
      : free(free_pillar), system(section, whole_plane(), plane_dofs(section, true)) {
    const std::vector<Eigen::MatrixXd> density{rho_kg_m3 * Eigen::MatrixXd::Identity(3, 3)};
    mass = system.form(system.kinematics().displacement, density);
    free_mass = free.form(free.kinematics().displacement, density);
    stiffness = stiffness_of(system, form);
    factor.factor(stiffness);
    for (int node = 0; node < section.node_count(); ++node) {
      for (int field = 0; field < 2; ++field) {
        const int from = system.dofs().dof(field, node);
        if (from >= 0) in_free.emplace_back(from, free.dofs().dof(field, node));
      }
    }
    find_mirrored();
  }

  // The unknown at the mirrored place. The mesh of a pillar is symmetric about its axis.
  void find_mirrored() {
    const Section& section = free.section();
    mirrored_unknown.resize(static_cast<std::size_t>(system.size()));
    const int columns = section.x().node_count();
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < section.z().node_count(); ++row) {
        for (int field = 0; field < 2; ++field) {
          const int own = system.dofs().dof(field, section.node(column, row));
          if (own < 0) continue;
          mirrored_unknown[static_cast<std::size_t>(own)] = {
              system.dofs().dof(field, section.node(columns - 1 - column, row)),
              field == kAcross ? -1.0 : 1.0};
        }
      }
    }
  }
  // A motion or load mirrored across the axis.
  Eigen::VectorXd mirrored(const Eigen::VectorXd& v) const {
    Eigen::VectorXd other(v.size());
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      const auto& [at, sign] = mirrored_unknown[static_cast<std::size_t>(i)];
      other[i] = sign * v[at];
    }
    return other;
  }

  // Modes are symmetric or antisymmetric about the axis; only the latter have momentum along x.
  InertiaPorts ports_of(const Eigen::MatrixXd& shapes, const Eigen::VectorXd& rad_s) const {
    InertiaPorts ports{{}, Eigen::MatrixXd::Zero(free.size(), shapes.cols()), rad_s, {}};
    for (const auto& [from, to] : in_free) ports.shapes.row(to) = shapes.row(from);
    ports.loads = free_mass.selfadjointView<Eigen::Lower>() * ports.shapes;
    for (Eigen::Index shape = 0; shape < shapes.cols(); ++shape) {
      Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
      for (int node = 0; node < free.section().node_count(); ++node) {
        for (int field = 0; field < 2; ++field) {
          momentum[field] += ports.loads(free.dofs().dof(field, node), shape);
        }
      }
      ports.is_lateral.push_back(std::abs(momentum[kAcross]) > std::abs(momentum[kUp]));
    }
    return ports;
  }
  // A load on the free pillar without the forces on its base.
  Eigen::VectorXd held(const Eigen::VectorXd& load) const {
    Eigen::VectorXd rest(system.size());
    for (const auto& [to, from] : in_free) rest[to] = load[from];
    return rest;
  }

  const DiscreteSystem& free;
  DiscreteSystem system;
  SymmetricSparse stiffness, mass, free_mass;
  StiffnessFactor factor;
  std::vector<std::pair<int, int>> in_free;  // unknown of the held pillar, of the free one
  std::vector<std::pair<int, double>> mirrored_unknown;  // of the held pillar, with its sign
};

InertiaPorts mode_ports(const HeldStrip& pillar, int count) {
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(pillar.mass, x); };
  const PencilMap op = [&](const Eigen::VectorXd&, const Eigen::VectorXd& Mx) {
    return pillar.factor.solve(Mx);
  };
  const int size = pillar.system.size();
  const int wanted = std::min(count, size);
  const EigenPairs pairs =
      largest_eigenpairs(op, B, size, wanted, {.tolerance = 1e-7, .largest_space = 60 + 8 * count});
  if (!pairs.converged) {
    throw std::runtime_error("the modes of the pillar on a fixed base did not converge");
  }
  return pillar.ports_of(pairs.vectors, pairs.values.cwiseInverse().cwiseSqrt());
}

// Loads on the held pillar: the one on its top, and the inertia when its base moves along x, along
// z, or turns.
std::vector<Eigen::VectorXd> excitations(const HeldStrip& pillar, const Eigen::VectorXd& top_load) {
  const Section& section = pillar.free.section();
  std::vector<Eigen::VectorXd> loads = {pillar.held(top_load)};
  for (int motion = 0; motion < 3; ++motion) {
    Eigen::VectorXd rigid(pillar.free.size());
    for (int node = 0; node < section.node_count(); ++node) {
      const double across = motion == 0 ? 1.0 : motion == 1 ? 0.0 : section.node_z(node);
      const double up = motion == 0 ? 0.0 : motion == 1 ? 1.0 : -section.node_x(node);
      rigid[pillar.free.dofs().dof(kAcross, node)] = across;
      rigid[pillar.free.dofs().dof(kUp, node)] = up;
    }
    loads.push_back(pillar.held(times(pillar.free_mass, rigid)));
  }
  return loads;
}

// M-orthonormal vectors, each the answer K^-1 f to a load. The next load of the chain is M v. Every
// load is symmetric or antisymmetric about the axis, and so is its vector. Rounding errors of the
// other kind grow tenfold per vector, and after 30 vectors shear would shorten a pillar.
class InertiaChains {
 public:
  InertiaChains(const HeldStrip& pillar, int most)
      : pillar_(pillar), vectors_(pillar.system.size(), most), inertia_(vectors_) {}

  int found() const { return found_; }
  bool is_full() const { return found_ == vectors_.cols(); }
  Eigen::MatrixXd vectors() const { return vectors_.leftCols(found_); }
  // Solves for the load and replaces it by the next one; an empty load ends its chain.
  void add(Eigen::VectorXd& load) {
    if (is_full() || load.size() == 0) return;
    Eigen::VectorXd v = pillar_.factor.solve(load);
    const double before = std::sqrt(v.dot(times(pillar_.mass, v)));
    const double parity = load.dot(pillar_.mirrored(load)) > 0.0 ? 1.0 : -1.0;
    // Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 6.9).
    for (int pass = 0; pass < 2; ++pass) {
      v -= vectors_.leftCols(found_) * (inertia_.leftCols(found_).transpose() * v);
    }
    v = (0.5 * (v + parity * pillar_.mirrored(v))).eval();
    const Eigen::VectorXd Mv = times(pillar_.mass, v);
    const double after = std::sqrt(v.dot(Mv));
    load.resize(0);
    if (!(after > 1e-9 * before)) return;
    vectors_.col(found_) = v / after;
    inertia_.col(found_) = Mv / after;
    load = inertia_.col(found_++);
  }

 private:
  const HeldStrip& pillar_;
  Eigen::MatrixXd vectors_, inertia_;
  int found_ = 0;
};

// Modes that the load and motions of the base excite: the lowest Ritz pairs of chains (K^-1 M)^j
// K^-1 f twice as long as wanted; a chain of the base contributes one vector in four. Modes that
// nothing excites are never found. Lanczos' method, Parlett (above), ch. 13.
InertiaPorts wave_ports(const HeldStrip& pillar, const Eigen::VectorXd& top_load, int count) {
  constexpr int kVectorsPerWave = 2;
  constexpr int kStepsPerVectorOfBase = 4;
  std::vector<Eigen::VectorXd> next = excitations(pillar, top_load);
  InertiaChains chains(pillar, std::min(kVectorsPerWave * count, pillar.system.size()));
  bool goes_on = true;
  for (int step = 0; goes_on && !chains.is_full(); ++step) {
    goes_on = false;
    for (std::size_t k = 0; k < next.size(); ++k) {
      if (k == 0 || step % kStepsPerVectorOfBase == 0) chains.add(next[k]);
      goes_on = goes_on || next[k].size() > 0;
    }
  }
  const Eigen::MatrixXd vectors = chains.vectors();
  Eigen::MatrixXd image(vectors.rows(), vectors.cols());
  for (Eigen::Index k = 0; k < image.cols(); ++k) {
    image.col(k) = times(pillar.stiffness, vectors.col(k));
  }
  const EigenSystem ritz = symmetric_eigen(vectors.transpose() * image);
  const int used = std::min(count, chains.found());
  return pillar.ports_of(vectors * ritz.vectors.leftCols(used), ritz.values.head(used).cwiseSqrt());
}

// Of a traction P_degree(2 x/d) on the top, along a field.
Eigen::VectorXd traction_load(const DiscreteSystem& system, int field, int degree) {
  const Section& section = system.section();
  const LineMesh& x = section.x();
  const double from_m = x.breaks().front(), width_m = x.breaks().back() - from_m;
  const int top = section.z().node_count() - 1;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
  for (int column = 0; column < x.element_count(); ++column) {
    const LineMesh::ElementRule rule = x.rule(column);
    std::vector<double> at;
    for (const double x_m : rule.x) at.push_back((x_m - from_m) / width_m);
    const Eigen::VectorXd traction = legendre_values(degree, at).col(degree);
    const Eigen::VectorXd forces = rule.value.transpose() * rule.weight.cwiseProduct(traction);
    for (int i = 0; i < forces.size(); ++i) {
      const int node = section.node(column * x.degree() + i, top);
      load[system.dofs().dof(field, node)] += forces[i];
    }
  }
  return load;
}

void add_tractions(const DiscreteSystem& system, int top_degree, Eigen::MatrixXd& ports) {
  ports.conservativeResize(Eigen::NoChange, kFirstModePort + 2 * top_degree);
  for (int degree = 1; degree <= top_degree; ++degree) {
    ports.col(traction_port(kPressurePort, degree, top_degree)) =
        -traction_load(system, kUp, degree);
    ports.col(traction_port(kShearPort, degree, top_degree)) =
        traction_load(system, kAcross, degree);
  }
}

// From the left end of the base over the top to the right end.
std::vector<int> nodes_on_outline(const Section& section) {
  std::vector<int> nodes = nodes_on_end(section, false);
  const std::vector<int> top =
      nodes_on_break(section, section.z().element_count(), 0, section.x().element_count());
  const std::vector<int> right = nodes_on_end(section, true);
  nodes.insert(nodes.end(), top.begin() + 1, top.end());  // corners once
  nodes.insert(nodes.end(), right.rbegin() + 1, right.rend());
  return nodes;
}

void add_outline(const DiscreteSystem& system, const Eigen::MatrixXd& shapes,
                 CondensedPillar& pillar) {
  const std::vector<int> nodes = nodes_on_outline(system.section());
  for (const int node : nodes) {
    pillar.outline_m.emplace_back(system.section().node_x(node), system.section().node_z(node));
  }
  pillar.mode_on_outline = shapes(dofs_on(system, nodes, 2), Eigen::all);
}

}  // namespace

CondensedPillar condensed_pillar(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                                 const PillarPorts& extra) {
  const std::vector<double> x(mesh.cell.x.begin() + mesh.cell.first_pillar_column,
                              mesh.cell.x.begin() + mesh.cell.last_pillar_column + 1);
  const Section section(LineMesh(x, degree), LineMesh(mesh.pillar_z, degree),
                        [](double, double) { return 0; });
  const DiscreteSystem system(section, whole_plane(), plane_dofs(section, false));
  const PlaneForm form = plane_form(media.pillar, media.plane, false);
  const int columns = section.x().element_count();
  const int top = section.z().element_count();
  CondensedPillar pillar;
  Eigen::MatrixXd ports(system.size(), kFirstModePort);
  ports.col(kPressurePort) = -system.line_load(kUp, top, 0, columns);
  ports.col(kShearPort) = system.line_load(kAcross, top, 0, columns);
  if (extra.modes + extra.waves > 0) {
    const HeldStrip held(section, system, form, media.pillar.rho_kg_m3);
    const InertiaPorts more = extra.waves > 0
                                  ? wave_ports(held, ports.col(extra.load_port), extra.waves)
                                  : mode_ports(held, extra.modes);
    ports.conservativeResize(Eigen::NoChange, kFirstModePort + more.loads.cols());
    ports.rightCols(more.loads.cols()) = more.loads;
    pillar.mode_rad_s = more.rad_s;
    pillar.mode_is_lateral = more.is_lateral;
    pillar.shapes = static_cast<int>(more.loads.cols());
    add_outline(system, more.shapes, pillar);
  }
  if (extra.top_degree > 0) add_tractions(system, extra.top_degree, ports);
  const std::vector<int> base = dofs_on(system, nodes_on_break(section, 0, 0, columns), 2);
  pillar.base_size = static_cast<int>(base.size());
  pillar.unknowns = system.size();
  pillar.matrix = condensed(stiffness_of(system, form), base, ports,
                            Eigen::MatrixXd::Zero(ports.cols(), ports.cols()));
  return pillar;
}

}  // namespace viscard
