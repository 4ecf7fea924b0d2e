#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/system/medium.h"
#include "models/pillar/system/stiffness_factor.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;

namespace {


// Longitudinal system of a pillar with its lowest line held (fixed foot) or only rolling.
DiscreteSystem longitudinal_system(const PillarMesh& mesh, bool rolling = false) {
  const Kinematics kinematics = kinematics_of(Motion::kLongitudinal);
  DofMap dofs(2, mesh.section.node_count());
  for (int node = 0; node < mesh.section.node_count(); ++node) {
    if (mesh.section.node_x(node) == 0.0) dofs.fix(0, node);
  }
  for (const int node : nodes_on_break(mesh.section, 0, 0, mesh.section.x().element_count())) {
    if (!rolling) dofs.fix(0, node);
    dofs.fix(1, node);
  }
  dofs.number();
  return {mesh.section, kinematics, std::move(dofs)};
}

double top_displacement_m(const PillarMesh& mesh, const DiscreteSystem& system,
                          const SymmetricSparse& stiffness, double pressure_Pa) {
  const Eigen::VectorXd load = system.line_load(1, mesh.top_row, 0, mesh.pillar_columns);
  StiffnessFactor factor;
  factor.factor(stiffness);
  const Eigen::VectorXd u = factor.solve(-pressure_Pa * load);
  const double area_m2 = load.sum();
  return load.dot(u) / area_m2;
}

}  // namespace

TEST_CASE("Lobatto points and Lagrange polynomials reproduce polynomials of their degree",
          "[pillar]") {
  const int p = GENERATE(1, 2, 3, 4, 7, 10, 16);
  const std::vector<double> nodes = lobatto_points(p);
  const std::vector<double> points = {0.0, 0.123, 0.5, 0.77, 1.0};
  const BasisValues basis = lagrange_basis(nodes, points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    double value = 0.0;
    double derivative = 0.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const double f = std::pow(nodes[j] - 0.3, p);
      value += f * basis.value(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
      derivative +=
          f * basis.derivative(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
    }
    // Exact but for rounding of p products.
    CHECK(value == Approx(std::pow(points[k] - 0.3, p)).margin(1e-13));
    CHECK(derivative == Approx(p * std::pow(points[k] - 0.3, p - 1)).margin(1e-11));
  }
}

TEST_CASE(
    "the patch test holds: a rolling pillar under pressure shortens by p L/E and widens by nu p "
    "R/E",
    "[pillar]") {
  const int degree = GENERATE(1, 2, 3, 4, 6, 8);
  const PillarMesh mesh = pillar_mesh({}, {.degree = degree});
  const DiscreteSystem system = longitudinal_system(mesh, /*rolling=*/true);
  const SymmetricSparse stiffness =
      system.form(system.kinematics().strain, {isotropic_moduli_Pa(1.8e6, 0.33)});
  const double u_m = top_displacement_m(mesh, system, stiffness, 1e4);
  CHECK(u_m == Approx(-1e4 * 120e-6 / 1.8e6).epsilon(1e-12));  // linear field: exact to rounding
  CHECK(u_m == test::printed("-.6666667e-6"));
  StiffnessFactor factor;
  factor.factor(stiffness);
  const Eigen::VectorXd u =
      factor.solve(-1e4 * system.line_load(1, mesh.top_row, 0, mesh.pillar_columns));
  for (int node = 0; node < mesh.section.node_count(); ++node) {
    if (std::abs(mesh.section.node_x(node) - 20e-6) > 1e-12) continue;
    const int dof = system.dofs().dof(0, node);
    CHECK(u[dof] == Approx(0.33 * 1e4 * 20e-6 / 1.8e6).epsilon(1e-11));
  }
}

TEST_CASE("a fixed pillar under 10 kPa shortens by the converged values", "[pillar]") {
  // Converged with two orders of an independent program, in nm.
  struct Case {
    double nu, u_nm;
  };
  const auto c = GENERATE(Case{0.33, 659.692}, Case{0.45, 652.632}, Case{0.49, 649.454});
  const PillarMesh mesh = pillar_mesh({}, {.degree = 8, .layers = 4});
  const DiscreteSystem system = longitudinal_system(mesh);
  const SymmetricSparse stiffness =
      system.form(system.kinematics().strain, {isotropic_moduli_Pa(1.8e6, c.nu)});
  CHECK(top_displacement_m(mesh, system, stiffness, 1e4) * 1e9 == Approx(-c.u_nm).epsilon(2e-6));
}
