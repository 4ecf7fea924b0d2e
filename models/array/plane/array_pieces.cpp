#include "models/array/plane/array_pieces.h"

#include "models/array/plane/plane_system.h"
#include "models/pillar/system/krylov_modes.h"
#include "models/pillar/system/stiffness_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

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
  const PencilMap op = [&](const Eigen::VectorXd&, const Eigen::VectorXd& Mx) {
    return factor.solve(Mx);
  };
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

}  // namespace

CondensedPillar condensed_pillar(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                                 int modes) {
  const std::vector<double> x(mesh.cell.x.begin() + mesh.cell.first_pillar_column,
                              mesh.cell.x.begin() + mesh.cell.last_pillar_column + 1);
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

}  // namespace viscard
