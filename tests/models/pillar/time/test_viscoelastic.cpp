#include "models/material/retardation_spectrum.h"
#include "models/maths/branch_step.h"
#include "models/maths/gauss_legendre.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/step_weights.h"
#include "models/pillar/time/viscoelastic_exact.h"
#include "models/pillar/time/viscoelastic_pillar.h"
#include "tests/support/convergence.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace viscard;

namespace {

Material pdms_1to10(bool shear_only) {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.terms = {{0.008206, 0.008206, 0.1945}, {0.01386, 0.01386, 2.403}};
  if (shear_only) {
    for (MaterialTerm& term : material.terms) term.k = 0.0;
  }
  return material;
}

// Strong relaxation, so that errors of time steps are far above rounding.
Material soft_material() {
  Material material;
  material.E0_Pa = 1.0e6;
  material.nu = 0.3;
  material.terms = {{0.5, 0.5, 1.0}, {0.3, 0.3, 7.0}};
  return material;
}

ViscoelasticPillar coarse_pillar(const Material& material) {
  return {{}, {.degree = 2, .layers = 1, .shaft_elements = 1}, material, TopCondition::kRigidPlate};
}

// Creep of one constant-nu body under a force history by superposition of J(t); the mean of J over
// a ramp in closed form, since a difference of integrals would cancel.
double superposed_creep(const RetardationSpectrum& J, const Course& history, double time_s) {
  double u = history.front().value * creep_compliance_1_Pa(J, time_s);
  for (std::size_t i = 1; i < history.size() && history[i - 1].time_s < time_s; ++i) {
    const CoursePoint& a = history[i - 1];
    const double end_s = std::min(history[i].time_s, time_s);
    const double length_s = history[i].time_s - a.time_s;
    const double share = length_s > 0.0 ? (end_s - a.time_s) / length_s : 1.0;
    double mean = J.instantaneous_compliance_1_Pa;
    for (const RetardationTerm& term : J.terms) {
      const double lambda_s = term.retardation_time_s;
      mean += term.compliance_1_Pa *
              (1.0 - std::exp(-(time_s - end_s) / lambda_s) * phi1((end_s - a.time_s) / lambda_s));
    }
    u += share * (history[i].value - a.value) * mean;
  }
  return u;
}

double elastic_compliance(const ViscoelasticSystem& system) {
  ViscoelasticStepper stepper(system);
  stepper.advance(0.0, Control::kForce, 1.0);
  return stepper.displacement();
}

}  // namespace

TEST_CASE("exponential moments keep their digits from zero to infinity", "[pillar][stability]") {
  // int_0^1 e^2 exp(-x e) de, by the closed form in 50-digit arithmetic.
  struct Case {
    double x, third;
  };
  const auto c = GENERATE(Case{0.0, 1.0 / 3.0}, Case{1e-9, 0.33333333308333333},
                          Case{1.0, 0.16060279414278839}, Case{5.9, 0.0090897101814677713},
                          Case{6.1, 0.0083033124822836929}, Case{1e3, 2e-9}, Case{1e12, 2e-36});
  CHECK(exponential_moments(c.x, 2)[2] == Approx(c.third).epsilon(1e-13));
}

TEST_CASE("step weights become unity for short steps and differentiation formulas for long ones",
          "[pillar]") {
  const StepWeights third({1.0, 1.0});  // degree 3 on equal steps
  const Eigen::VectorXd at_once = third.at(0.0);
  CHECK(at_once[0] == Approx(1.0).epsilon(1e-14));
  CHECK(at_once[1] == Approx(0.0).margin(1e-14));
  CHECK(at_once[2] == Approx(0.0).margin(1e-14));
  // BDF3: h u' = (11/6) (u0-u1) - (7/6) (u1-u2) + (1/3) (u2-u3).
  const double x = 1e9;
  const Eigen::VectorXd slow = x * third.at(x);
  CHECK(slow[0] == Approx(11.0 / 6.0).epsilon(1e-8));  // next term is of relative size 1/x
  CHECK(slow[1] == Approx(-7.0 / 6.0).epsilon(1e-8));
  CHECK(slow[2] == Approx(1.0 / 3.0).epsilon(1e-8));
  CHECK(StepWeights({}).at(0.7)[0] == Approx(phi1(0.7)).epsilon(1e-15));
}

TEST_CASE("creep converges with the order of the stepper", "[pillar][convergence]") {
  const int order = GENERATE(1, 2, 3, 4);
  const ViscoelasticPillar pillar = coarse_pillar(soft_material());
  const PronySeries series = young_series(soft_material());
  const RetardationSpectrum J = retardation_from_relaxation(series);
  const double scale = elastic_compliance(pillar.system()) * instantaneous_modulus_Pa(series);
  // Force t^6, so smooth at the start that the low orders of the first steps have no influence.
  const QuadratureRule rule = gauss_legendre(30);
  double exact = 0.0;
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double t = rule.points[i];
    exact += rule.weights[i] * 6.0 * std::pow(t, 5) * creep_compliance_1_Pa(J, 1.0 - t) * scale;
  }
  const auto error = [&](double h) {
    ViscoelasticStepper stepper(pillar.system(), order);
    const int steps = static_cast<int>(std::lround(1.0 / h));
    for (int i = 1; i <= steps; ++i) {
      stepper.advance(h, Control::kForce, std::pow(static_cast<double>(i) / steps, 6));
    }
    return std::abs(stepper.displacement() / exact - 1.0);
  };
  const std::vector<double> orders = test::observed_orders(error, 1.0 / 16.0, 4);
  CAPTURE(orders);
  // A polynomial of degree p through the points errs by h^(p + 1); degree 1 gains nothing by
  // symmetry.
  CHECK(orders.back() == Approx(order + 1.0).margin(0.25));
}

TEST_CASE("a held displacement relaxes exactly with linear strain per step, for any step",
          "[pillar][stability]") {
  const double dt_s = GENERATE(1e-12, 1e-3, 1.0, 1e3, 1e12);
  const ViscoelasticPillar pillar = coarse_pillar(pdms_1to10(false));
  ViscoelasticStepper stepper(pillar.system());
  stepper.advance(0.0, Control::kDisplacement, 1.0);
  const double force_0 = stepper.force();
  const PronySeries series = young_series(pdms_1to10(false));
  for (int i = 1; i <= 5; ++i) {
    stepper.advance(dt_s, Control::kDisplacement, 1.0);
    CHECK(stepper.force() / force_0 ==
          Approx(relaxation_modulus_Pa(series, i * dt_s) / 1.8e6).epsilon(1e-11));  // rounding
  }
}

TEST_CASE(
    "step, ramp, recovery and a random history over eight decades match superposition to 1e-8",
    "[pillar]") {
  const Material material = soft_material();
  const ViscoelasticPillar pillar = coarse_pillar(material);
  const PronySeries series = young_series(material);
  const RetardationSpectrum J = retardation_from_relaxation(series);
  const double scale = elastic_compliance(pillar.system()) * instantaneous_modulus_Pa(series);
  Course history;
  SECTION("a step and recovery") {
    history = {{0.0, 1.0}, {5.0, 1.0}, {5.0, 0.0}, {50.0, 0.0}};
  }
  SECTION("a ramp and a hold") {
    history = {{0.0, 0.0}, {2.0, 1.0}, {40.0, 1.0}};
  }
  SECTION("a random history") {
    std::mt19937_64 random(20240611);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    history = {{0.0, value(random)}};
    for (int i = 0; i <= 24; ++i) {
      const double time_s = 1e-5 * std::pow(10.0, i / 3.0);
      history.push_back({time_s, value(random)});
      if (i % 5 == 4) history.push_back({time_s, value(random)});  // a jump
    }
  }
  HistoryOptions options;
  options.tolerance = 1e-9;
  const HistoryResult run = run_history(pillar.system(), Control::kForce, history, options);
  CHECK(run.converged);
  double largest = 0.0;
  double size = 0.0;
  for (std::size_t i = 1; i < run.time_s.size(); ++i) {
    if (run.time_s[i] == run.time_s[i - 1]) continue;  // before or after a jump: both are recorded
    if (i + 1 < run.time_s.size() && run.time_s[i + 1] == run.time_s[i]) continue;
    const double exact = scale * superposed_creep(J, history, run.time_s[i]);
    largest = std::max(largest, std::abs(run.displacement[i] - exact));
    size = std::max(size, std::abs(exact));
  }
  CAPTURE(run.error_estimate, run.steps, largest / size);
  CHECK(largest <= 1e-8 * size);
}

TEST_CASE("modes with retardation spectra and Laplace inversion give the same creep", "[pillar]") {
  Material material = soft_material();
  material.terms[0].k = 0.1;  // neither constant bulk nor constant Poisson ratio
  material.terms[1].k = 0.4;
  const ViscoelasticPillar pillar = coarse_pillar(material);
  const ExactViscoelasticBody body(pillar.system());
  const double time_s = GENERATE(1e-3, 0.3, 4.0, 100.0);
  CHECK(body.creep_displacement(time_s) ==
        Approx(body.creep_displacement_by_spectra(time_s)).epsilon(1e-9));  // of the inversion
}

TEST_CASE("Laplace inversion returns known functions", "[pillar]") {
  const double t = GENERATE(1e-6, 1.0, 1e8);
  // 1/(s + 1/T) -> exp(-t/T) and s^-3/2 -> 2 sqrt(t/pi).
  CHECK(inverse_laplace([t](std::complex<double> s) { return 1.0 / (s + 0.5 / t); }, t) ==
        Approx(std::exp(-0.5)).epsilon(1e-10));
  CHECK(inverse_laplace([](std::complex<double> s) { return 1.0 / (s * std::sqrt(s)); }, t) ==
        Approx(2.0 * std::sqrt(t / M_PI)).epsilon(1e-10));
}

TEST_CASE("a pillar on PVDF creeps under 10 kPa as tabulated, shear alone or bulk too",
          "[pillar]") {
  // Converged by an independent program to its steps, nm: 0, 0.01, 0.1, 1, 3, 10, 30 s; film 25 um
  // thick, 60 um in radius, E 2 GPa, nu 0.29.
  const bool shear_only = GENERATE(false, true);
  const std::vector<double> expected_nm =
      shear_only
          ? std::vector<double>{659.761, 660.032, 661.999, 667.286, 670.387, 672.665, 672.802}
          : std::vector<double>{659.761, 660.071, 662.316, 668.351, 671.891, 674.492, 674.648};
  PillarGeometry geometry;
  geometry.film = FilmGeometry{25e-6, 60e-6};
  const ViscoelasticPillar pillar(geometry, {.degree = 6, .layers = 3}, pdms_1to10(shear_only),
                                  TopCondition::kPressure, isotropic_medium(2e9, 0.29, 1780.0));
  HistoryOptions options;
  options.tolerance = 1e-7;
  options.output_times_s = {0.01, 0.1, 1.0, 3.0, 10.0};
  const HistoryResult run =
      run_history(pillar.system(), Control::kForce, {{0.0, 1.0}, {30.0, 1.0}}, options);
  const double force_N = 1e4 * pillar.top_area_m2();
  std::vector<double> times_s = {0.0, 0.01, 0.1, 1.0, 3.0, 10.0, 30.0};
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    const auto at = std::find_if(run.time_s.begin() + 1, run.time_s.end(),
                                 [&](double t) { return std::abs(t - times_s[k]) <= 1e-9 * t; });
    REQUIRE(at != run.time_s.end());
    const auto i = static_cast<std::size_t>(at - run.time_s.begin());
    CAPTURE(times_s[k]);
    CHECK(run.displacement[i] * force_N * 1e9 == Approx(expected_nm[k]).epsilon(1e-5));
  }
}

TEST_CASE("energy put into a viscoelastic pillar is never returned in excess",
          "[pillar][stability]") {
  // Work over a closed cycle of displacement, from rest to rest, is not negative.
  const ViscoelasticPillar pillar = coarse_pillar(soft_material());
  const double dt_s = GENERATE(1e-6, 1e-2, 1.0, 1e6);
  ViscoelasticStepper stepper(pillar.system());
  double work = 0.0;
  double last_u = 0.0;
  double last_force = 0.0;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (int i = 0; i <= 200; ++i) {
    const double u = i == 200 ? 0.0 : value(random);
    stepper.advance(dt_s, Control::kDisplacement, u);
    work += 0.5 * (stepper.force() + last_force) * (u - last_u);
    last_u = u;
    last_force = stepper.force();
    REQUIRE(work >= 0.0);
  }
  CHECK(std::isfinite(work));
}

TEST_CASE("a history that goes back in time or has no length is refused", "[pillar]") {
  const ViscoelasticPillar pillar = coarse_pillar(soft_material());
  const auto run = [&](const Course& history) {
    return run_history(pillar.system(), Control::kForce, history, {});
  };
  CHECK_THROWS_AS(run({{0.0, 1.0}}), std::invalid_argument);
  CHECK_THROWS_AS(run({{0.0, 1.0}, {2.0, 1.0}, {1.0, 0.0}}), std::invalid_argument);
  CHECK_THROWS_AS(run({{0.0, 1.0}, {1.0, std::nan("")}}), std::invalid_argument);
}
