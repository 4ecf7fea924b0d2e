#include "models/pillar/large/large_static.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace viscard;

namespace {

constexpr double kE_Pa = 1.8e6;

HyperelasticLaw neo_hooke() {
  return {HyperelasticForm::kNeoHooke, Eigen::VectorXd::Constant(1, kE_Pa / 6.0), {}};
}

// A round pillar of 40 x 120 um of a law; the model has the same moduli at rest.
struct Pillar {
  PillarModel model;
  LargeBody body;
  Pillar(const FiniteLaw& law, const Discretisation& mesh, ModelOptions options = {},
         PillarGeometry geometry = {})
      : model(geometry, mesh,
              {isotropic_medium(law.shear_Pa * 2.0 * (1.0 + law.poisson_ratio), law.poisson_ratio,
                                965.0),
               std::nullopt},
              options),
        body(model, law) {}
  double linear_m(double pressure_Pa) const {
    return pressure_Pa * model.mean_top_displacement_m(model.solve(-model.top_traction()));
  }
};

// Nominal stress of compressible Neo-Hooke under tension along z at the stretch s: the lateral stretch t
// follows from dW/dt = 0 by bisection; W = mu/2 (J^(-2/3) (s^2 + 2 t^2) - 3) + K/2 (J - 1)^2.
double uniaxial_stress_Pa(const FiniteLaw& law, double s) {
  const double mu = law.shear_Pa, K = law.bulk_Pa;
  if (std::isinf(K)) return mu * (s - 1.0 / (s * s));
  const auto by_t = [&](double t) {
    const double J = s * t * t;
    const double shape = std::pow(J, -2.0 / 3.0);
    return mu / 2.0 * shape * (4.0 * t - 2.0 / 3.0 * (s * s + 2.0 * t * t) * 2.0 / t) +
           K * (J - 1.0) * 2.0 * s * t;
  };
  double low = 0.3, high = 3.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (by_t(middle) < 0.0 ? low : high) = middle;
  }
  const double t = 0.5 * (low + high);
  const double J = s * t * t;
  return mu / 2.0 * std::pow(J, -2.0 / 3.0) * (2.0 * s - 2.0 / 3.0 * (s * s + 2.0 * t * t) / s) +
         K * (J - 1.0) * t * t;
}

// A smooth displacement of some percent, by the place of the unknowns.
Eigen::VectorXd some_motion(const PillarModel& model, double size) {
  const DiscreteSystem& system = model.system();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(system.size());
  for (int node = 0; node < system.section().node_count(); ++node) {
    const double r = system.section().node_x(node), z = system.section().node_z(node);
    const double along = z / 120e-6, out = r / 20e-6;
    const double value[] = {r * along * (1.0 + std::cos(2.0 * out)),
                            120e-6 * along * (0.5 * out * out - along)};
    for (int field = 0; field < 2; ++field) {
      const int dof = system.dofs().dof(field, node);
      if (dof >= 0) u[dof] = size * value[field];
    }
  }
  return u;
}

}  // namespace

TEST_CASE("the tangent of a pillar at large strain is the derivative of its forces",
          "[pillar][gradient]") {
  for (const double nu : {0.33, 0.4999, 0.5}) {
    const Pillar pillar(finite_law(neo_hooke(), nu), {.degree = 4, .layers = 1});
    const Eigen::VectorXd u = some_motion(pillar.model, 0.1);
    const Eigen::VectorXd direction = some_motion(pillar.model, 0.03).array().sin();
    const Eigen::VectorXd slope = times(pillar.body.forces(u, true).tangent, direction);
    const auto error = [&](double h) {
      const Eigen::VectorXd difference = (pillar.body.forces(u + h * direction, false).internal -
                                          pillar.body.forces(u - h * direction, false).internal) /
                                         (2.0 * h);
      return (difference - slope).norm() / slope.norm();
    };
    INFO("Poisson ratio " << nu);
    CHECK(error(1e-4) < 1e-7);
    CHECK(error(0.2) / error(0.1) == Approx(4.0).margin(0.4));
  }
}

TEST_CASE("at rest the tangent is the stiffness of the linear pillar", "[pillar][reduction]") {
  for (const double nu : {0.33, 0.49, 0.4999}) {
    const Pillar pillar(finite_law(neo_hooke(), nu), {.degree = 4, .layers = 2});
    const SymmetricSparse tangent =
        pillar.body.forces(Eigen::VectorXd::Zero(pillar.model.system().size()), true).tangent;
    const SymmetricSparse stiffness = pillar.model.stiffness();
    CHECK((tangent.coeffs() - stiffness.coeffs()).matrix().norm() <=
          1e-10 * stiffness.coeffs().matrix().norm());
  }
}

TEST_CASE("a frictionless column of Neo-Hooke follows the closed form", "[pillar][identity]") {
  const double area_m2 = M_PI * 20e-6 * 20e-6;
  for (const double nu : {0.0, 0.33, 0.45, 0.49, 0.4999, 0.5}) {
    const FiniteLaw law = finite_law(neo_hooke(), nu);
    for (const double stretch : {0.7, 0.95, 1.3}) {
      Pillar pillar(law, {.degree = 3, .layers = 1}, {.bottom_slides = true, .rigid_top = true});
      const LargeState state =
          solve_large(pillar.body, {.displacement_m = (stretch - 1.0) * 120e-6});
      const double stress_Pa = uniaxial_stress_Pa(law, stretch);
      INFO("Poisson ratio " << nu << ", stretch " << stretch);
      CHECK(state.force_N == Approx(stress_Pa * area_m2).epsilon(1e-8));
      CHECK(state.top_displacement_m == Approx((stretch - 1.0) * 120e-6).epsilon(1e-12));
      // By a dead pressure of that size: the same state.
      Pillar pressed(law, {.degree = 3, .layers = 1}, {.bottom_slides = true});
      const LargeState by_force = solve_large(pressed.body, {.pressure_Pa = -stress_Pa});
      CHECK(by_force.top_displacement_m == Approx((stretch - 1.0) * 120e-6).epsilon(1e-8));
      // The true stress is the nominal one over the area that is left.
      const double x = 5e-6, z = 60e-6;
      const Eigen::Vector4d true_Pa = pillar.body.true_stress_at_Pa(
          state.u, pillar.model.element_at(x, z, kPillarRegion), x, z);
      if (nu == 0.5) CHECK(true_Pa[2] == Approx(stress_Pa * stretch).epsilon(1e-7));
      CHECK(std::abs(true_Pa[0]) < 1e-6 * std::abs(true_Pa[2]));
      CHECK(std::abs(true_Pa[1]) < 1e-6 * std::abs(true_Pa[2]));
    }
  }
}

TEST_CASE("Newton's method converges quadratically", "[pillar][convergence]") {
  for (const double nu : {0.33, 0.49}) {
    Pillar pillar(finite_law(neo_hooke(), nu), {.degree = 4, .layers = 2}, {.rigid_top = true});
    const LargeState state = solve_large(pillar.body, {.displacement_m = 20e-6});
    const std::vector<double> size = state.corrections;
    CAPTURE(nu, size, state.rest);
    REQUIRE(state.load_steps == 1);
    REQUIRE(size.size() == 4);
    const double order = std::log(size[3] / size[2]) / std::log(size[2] / size[1]);
    if (nu == 0.33) {
      CHECK(order == Approx(2.0).margin(0.2));
    }
    // Pressures of their own converge with the displacement, whose squares they are 7.6 times here.
    for (std::size_t i = 2; i < size.size(); ++i) CHECK(size[i] < 10.0 * size[i - 1] * size[i - 1]);
    CHECK(state.rest < 1e-12);
  }
}

TEST_CASE("a pillar of St Venant-Kirchhoff shortens as FEBio's did", "[pillar][identity]") {
  // FEBio 4: 1.23 % more shortening at 10 kPa than in its own linear limit, and 0.12 % at 1 kPa. Its
  // pressure follows the surface, which counts: 1.5 times the strain by the law and 2 nu by the area.
  const FiniteLaw law = st_venant_kirchhoff(kE_Pa, 0.33);
  const auto excess_percent = [&](double pressure_Pa, const Discretisation& mesh, bool follows) {
    Pillar pillar(law, mesh);
    const LargeState state =
        solve_large(pillar.body, {.pressure_Pa = pressure_Pa, .follows_surface = follows});
    return 100.0 * (state.top_displacement_m / pillar.linear_m(pressure_Pa) - 1.0);
  };
  const double fine = excess_percent(10e3, {.degree = 7, .layers = 3}, true);
  CHECK(fine == Approx(1.23).margin(0.005));  // 1.232
  CHECK(excess_percent(10e3, {.degree = 5, .layers = 2}, true) == Approx(fine).margin(1e-3));
  CHECK(excess_percent(1e3, {.degree = 5, .layers = 2}, true) == Approx(0.12).margin(0.005));
  // A dead load of the same size: the law's part alone.
  const double strain_percent = 100.0 * 10e3 / kE_Pa;
  CHECK(excess_percent(10e3, {.degree = 5, .layers = 2}, false) ==
        Approx(1.5 * strain_percent).epsilon(0.05));
}

TEST_CASE("the difference to the linear pillar vanishes in proportion to the load",
          "[pillar][reduction]") {
  for (const double nu : {0.33, 0.49, 0.5}) {
    const FiniteLaw law = finite_law(neo_hooke(), nu);
    const Discretisation mesh{.degree = 4, .layers = 2};
    const auto difference = [&](double pressure_Pa) {
      Pillar pillar(law, mesh);
      const LargeState state = solve_large(pillar.body, {.pressure_Pa = pressure_Pa});
      return state.top_displacement_m / pillar.linear_m(pressure_Pa) - 1.0;
    };
    const double at_2 = difference(2e3), at_1 = difference(1e3);
    INFO("Poisson ratio " << nu);
    // Neo-Hooke in compression stiffens by one strain: P = E e (1 + e).
    CHECK(at_2 < -0.5 * 2e3 / kE_Pa);
    CHECK(at_2 / at_1 == Approx(2.0).epsilon(0.01));
  }
}

TEST_CASE("a pillar at large strain converges from mesh to mesh", "[pillar][convergence]") {
  std::vector<double> moved;
  for (const Discretisation& mesh :
       {Discretisation{.degree = 4, .layers = 2}, Discretisation{.degree = 6, .layers = 3},
        Discretisation{.degree = 8, .layers = 4}}) {
    Pillar pillar(finite_law(neo_hooke(), 0.49), mesh);
    moved.push_back(solve_large(pillar.body, {.pressure_Pa = 100e3}).top_displacement_m);
  }
  CAPTURE(moved);
  CHECK(std::abs(moved[1] / moved[2] - 1.0) < 0.3 * std::abs(moved[0] / moved[2] - 1.0));
  CHECK(moved[1] == Approx(moved[2]).epsilon(5e-5));
}

TEST_CASE("a load that no equilibrium bears is refused with the load reached", "[pillar]") {
  // St Venant-Kirchhoff bears at most E/(3 sqrt 3) of dead compression, at a stretch of 1/sqrt 3.
  const double most_Pa = kE_Pa / (3.0 * std::sqrt(3.0));
  const FiniteLaw law = st_venant_kirchhoff(kE_Pa, 0.0);
  const auto press = [&](double pressure_Pa) {
    Pillar pillar(law, {.degree = 3, .layers = 1}, {.bottom_slides = true, .rigid_top = true});
    return solve_large(pillar.body, {.pressure_Pa = pressure_Pa});
  };
  CHECK(press(0.99 * most_Pa).load_steps >= 1);
  CHECK_THROWS_WITH(press(1.2 * most_Pa),
                    Catch::Contains("no equilibrium") && Catch::Contains("% of the load") &&
                        Catch::Contains("% of the length") && Catch::Contains("smaller load"));
  CHECK_THROWS_WITH(press(1.2 * most_Pa),
                    Catch::Contains("by a displacement instead") && !Catch::Contains("e+"));
  // Compressed by more than its length.
  CHECK_THROWS_WITH(
      [&] {
        Pillar pillar(law, {.degree = 3, .layers = 1}, {.bottom_slides = true, .rigid_top = true});
        solve_large(pillar.body, {.displacement_m = -2.0 * pillar.model.geometry().length_m});
      }(),
      Catch::Contains("smaller displacement") && !Catch::Contains("instead of a pressure") &&
          !Catch::Contains("e+"));
  Pillar pillar(law, {.degree = 3, .layers = 1});
  CHECK_THROWS_WITH(solve_large(pillar.body, {.displacement_m = 1e-6, .follows_surface = true}),
                    Catch::Contains("needs its size"));
}

TEST_CASE("the film under a pillar at large strain yields as in the linear answer",
          "[pillar][reduction]") {
  PillarGeometry geometry;
  geometry.film = FilmGeometry{25e-6, 60e-6};
  const FiniteLaw law = finite_law(neo_hooke(), 0.45);
  const PillarMedia media{isotropic_medium(kE_Pa, 0.45, 965.0),
                          isotropic_medium(2e7, 0.29, 1780.0)};
  const PillarModel model(geometry, {.degree = 4, .layers = 2}, media, {});
  LargeBody body(model, law);
  const double small_Pa = 1.0;
  const double linear_m =
      model.mean_top_displacement_m(model.solve(-small_Pa * model.top_traction()));
  CHECK(solve_large(body, {.pressure_Pa = small_Pa}).top_displacement_m ==
        Approx(linear_m).epsilon(2e-6));
  CHECK(solve_large(body, {.pressure_Pa = 1e5}).top_displacement_m / (1e5 * linear_m) < 0.99);
}
