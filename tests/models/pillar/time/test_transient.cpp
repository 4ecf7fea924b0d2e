#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/inertial_stepper.h"
#include "models/pillar/time/modal_response.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/motion_peak.h"
#include "models/pillar/time/spectrum.h"
#include "models/pillar/time/state_transition.h"
#include "models/pillar/time/transient_run.h"
#include "models/pillar/time/viscoelastic_pillar.h"
#include "tests/support/convergence.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;

namespace {

Material rod_material(std::vector<MaterialTerm> terms) {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.0;
  material.rho_kg_m3 = 965.0;
  material.terms = std::move(terms);
  return material;
}

struct Body {
  explicit Body(const Material& material)
      : model({}, {.degree = 4, .layers = 1},
              {isotropic_medium(material.E0_Pa, material.nu, material.rho_kg_m3), {}},
              {.motion = Motion::kLongitudinal}),
        system(viscoelastic_system(model, material, true)) {
    system.load = unit_top_force(model);
    reduced = reduce_dynamic(system, {system.load},
                             {.lowest_rad_s = 1.0, .highest_rad_s = 5e6, .tolerance = 1e-3});
  }
  PillarModel model;
  ViscoelasticSystem system;
  ReducedBody reduced;
};

}  // namespace

TEST_CASE("a spectrum shows a sine at its frequency and amplitude", "[pillar]") {
  std::vector<double> samples(1000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] =
        5.0 + 3.0 * std::sin(2.0 * std::numbers::pi * 50.0 * static_cast<double>(i) * 1e-3);
  }
  const Spectrum spectrum = amplitude_spectrum(samples, 1e-3);
  CHECK(spectrum.frequency_Hz[50] == Approx(50.0).epsilon(1e-12));  // rounding
  CHECK(spectrum.amplitude[50] == Approx(3.0).epsilon(1e-12));      // a whole number of periods
  CHECK(spectrum.amplitude[0] == Approx(0.0).margin(1e-12));
}

TEST_CASE("steps with inertia converge at second order to the damped oscillator",
          "[pillar][convergence]") {
  // One unknown: m u'' + k0 u + memory = f, against very fine steps of itself and, without memory,
  // against 1 - cos.
  SymmetricSparse one(1, 1);
  one.insert(0, 0) = 1.0;
  one.makeCompressed();
  ViscoelasticSystem small;
  small.elastic = one * 0.0;
  small.shear = one;
  small.bulk = one * 0.0;
  small.mass = one;
  const Eigen::VectorXd force = Eigen::VectorXd::Ones(1);
  const auto at_two = [&](double h) {
    InertialStepper stepper(small);
    stepper.set_step(h);
    const int n = static_cast<int>(std::lround(2.0 / h));
    for (int i = 0; i < n; ++i) stepper.advance(force, force);
    return stepper.displacement()[0];
  };
  std::vector<double> orders = test::observed_orders(
      [&](double h) { return std::abs(at_two(h) - (1.0 - std::cos(2.0))); }, 0.1, 4);
  CAPTURE(orders);
  CHECK(orders.back() == Approx(2.0).margin(0.02));
  small.terms = {{0.5, 0.0, 0.7}};
  // u'' + 0.5 u + 0.5 d = 1, d' = u' - d/0.7, integrated independently by classical Runge-Kutta.
  Eigen::Vector3d y(0.0, 0.0, 0.0);
  const auto rate = [](const Eigen::Vector3d& s) {
    return Eigen::Vector3d(s[1], 1.0 - 0.5 * s[0] - 0.5 * s[2], s[1] - s[2] / 0.7);
  };
  const double h = 1e-3;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d a = rate(y);
    const Eigen::Vector3d b = rate(y + 0.5 * h * a);
    const Eigen::Vector3d c = rate(y + 0.5 * h * b);
    const Eigen::Vector3d d = rate(y + h * c);
    y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  orders =
      test::observed_orders([&](double step) { return std::abs(at_two(step) - y[0]); }, 0.1, 4);
  CAPTURE(orders);
  CHECK(orders.back() == Approx(2.0).margin(0.02));
}

TEST_CASE("energy never grows without work, for any step", "[pillar][stability]") {
  const Body body(rod_material({{0.3, 0.3, 1e-6}, {0.3, 0.1, 1e-4}}));
  const double dt_s = GENERATE(1e-10, 1e-7, 1e-5, 1e-2, 1e6);
  InertialStepper stepper(body.reduced.system);
  stepper.set_step(dt_s);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(body.reduced.system.load.size());
  double energy = 0.0;
  double put_in = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd next =
        (i < 60 ? value(random) : 0.0) * body.reduced.system.load;  // then let alone
    const Eigen::VectorXd before = stepper.displacement();
    stepper.advance(force, next);
    const double work = 0.5 * (force + next).dot(stepper.displacement() - before);
    const double now = stepper.energy_J();
    put_in += std::abs(work);
    CAPTURE(i, work, now - energy);
    REQUIRE(now - energy <= work + 1e-9 * put_in);  // rounding
    energy = now;
    force = next;
  }
  CHECK(std::isfinite(energy));
}

TEST_CASE("the matrix exponential of any part of a step is that of an oscillator and a decay",
          "[pillar]") {
  // Frequencies and rates fourteen decades apart; closed form cos, sin, exp.
  const double w = GENERATE(1e-6, 1.0, 1e8);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 3);
  A(0, 1) = w;
  A(1, 0) = -w;
  A(2, 2) = -1e-6;
  const StateTransition transition(A, 1.0);
  const double dt = GENERATE(1.0, 0.3, 1e-5, 0.0);
  Eigen::VectorXd x = Eigen::Vector3d(1.0, 0.0, 1.0);
  transition.advance(dt, x);
  const double rounding = 1e-13 + 1e-15 * w;  // of the angle itself
  CHECK(x[0] == Approx(std::cos(w * dt)).margin(rounding));
  CHECK(x[1] == Approx(-std::sin(w * dt)).margin(rounding));
  // Each of up to 30 square roots rounds a number near 1 once.
  CHECK(std::abs(x[2] - 1.0 - std::expm1(-1e-6 * dt)) <= 30 * 1.2e-16);
  CHECK_THROWS_AS(transition.advance(1.1, x), std::invalid_argument);
  CHECK_THROWS_AS(StateTransition(A, 1.0, true).advance(w > 1.0 ? 0.3 : 1.1, x),
                  std::invalid_argument);
}

TEST_CASE("a peak between known times is within its error", "[pillar]") {
  // A decaying sine, whose crests are known: tan(w t) = w/d.
  const double w = 2.0 * std::numbers::pi, d = 0.7;
  const int per_period = GENERATE(3, 5, 8, 20, 100);
  std::vector<double> time_s;
  Eigen::VectorXd y(3 * per_period + 1), rate(3 * per_period + 1);
  for (int i = 0; i < y.size(); ++i) {
    const double t = static_cast<double>(i) / per_period;
    time_s.push_back(t);
    y[i] = std::exp(-d * t) * std::sin(w * t);
    rate[i] = std::exp(-d * t) * (w * std::cos(w * t) - d * std::sin(w * t));
  }
  const double at_s = std::atan2(w, d) / w;
  const double crest = std::exp(-d * at_s) * std::sin(w * at_s);
  const MotionPeak peak = peak_of_motion(time_s, y, rate);
  CAPTURE(per_period, peak.value, crest);
  CHECK(std::abs(peak.value - crest) <= peak.error);
  CHECK(peak.error <= 30.0 * std::pow(per_period, -4));
  if (per_period >= 20) CHECK(peak.time_s == Approx(at_s).epsilon(1e-2));
  // Turned over, the same peak; at rest, none.
  CHECK(peak_of_motion(time_s, -y, -rate).value == -peak.value);
  CHECK(peak_of_motion(time_s, 0.0 * y, 0.0 * rate).value == 0.0);
}

TEST_CASE("of two sides that are alike the peak is on the first, and else on the larger",
          "[pillar]") {
  const double growth = GENERATE(1.0, 1.015, 1.03);
  std::vector<double> time_s;
  Eigen::VectorXd y(81), rate(81);
  for (int i = 0; i < y.size(); ++i) {
    const double t = i / 40.0, w = 2.0 * std::numbers::pi;  // two periods: down, then up
    const double size = t < 0.5 ? 1.0 : growth;
    time_s.push_back(t);
    y[i] = -size * std::sin(w * t);
    rate[i] = -size * w * std::cos(w * t);
  }
  const MotionPeak peak = peak_of_motion(time_s, y, rate);
  CHECK((peak.value < 0.0) == (growth < 1.02));
}

TEST_CASE("exact modes and increasingly fine steps give one answer", "[pillar]") {
  // Under a jump, a ramp and a jump back, with two relaxation times near the resonance.
  const Body body(rod_material({{0.3, 0.3, 1e-6}, {0.2, 0.2, 2e-5}}));
  TransientRequest request{.load = body.reduced.system.load, .end_s = 3e-5};
  request.history = {{0.0, 1.0}, {4.3e-6, 1.0}, {1.21e-5, 2.0}, {1.21e-5, 0.5}, {1.0, 0.5}};
  request.outputs = 50;
  request.first_step_s = 1e-7;
  request.tolerance = 1e-5;
  const Eigen::MatrixXd observer = body.reduced.system.load.transpose();
  REQUIRE(relaxes_alike(body.reduced.system));
  const TransientResult modes = run_transient(body.reduced.system, request, observer);
  const TransientResult steps = run_by_steps(body.reduced.system, request, observer);
  REQUIRE(steps.converged);
  CHECK(modes.steps < steps.steps / 100);
  const double size = steps.values.cwiseAbs().maxCoeff();
  CHECK((modes.values - steps.values).cwiseAbs().maxCoeff() <= 2e-5 * size);  // of the steps
  const TransientResult exact = run_exactly(body.reduced.system, request, observer);
  CHECK((modes.values - exact.values).cwiseAbs().maxCoeff() <= 1e-9 * size);  // rounding
  // Rates, and values at corners between the outputs.
  REQUIRE(modes.motion.time_s.size() == 53);
  const double rate = steps.motion.rates.cwiseAbs().maxCoeff();
  CHECK((modes.motion.rates - exact.motion.rates).cwiseAbs().maxCoeff() <= 1e-9 * rate);
  CHECK((modes.motion.values - steps.motion.values).cwiseAbs().maxCoeff() <= 2e-5 * size);
}

TEST_CASE("shear and bulk that relax apart take as many steps as there are outputs and corners",
          "[pillar]") {
  // Steps, halved until they agree to 1e-5, took ten thousands for this.
  Material material = rod_material({{0.3, 0.05, 1e-6}, {0.2, 0.1, 2e-5}, {0.1, 0.0, 1e3}});
  material.nu = 0.4;
  const Body apart(material);
  REQUIRE_FALSE(relaxes_alike(apart.reduced.system));
  TransientRequest request{.load = apart.reduced.system.load, .end_s = 3e-5};
  request.history = {{0.0, 1.0}, {4.3e-6, 1.0}, {1.21e-5, 2.0}, {1.21e-5, 0.5}, {1.0, 0.5}};
  request.outputs = 50;
  request.first_step_s = 1e-7;
  request.tolerance = 1e-5;
  const Eigen::MatrixXd observer = apart.reduced.system.load.transpose();
  const TransientResult exact = run_transient(apart.reduced.system, request, observer);
  const TransientResult steps = run_by_steps(apart.reduced.system, request, observer);
  REQUIRE(steps.converged);
  CHECK(exact.converged);
  CHECK(exact.steps == 52);
  const double size = steps.values.cwiseAbs().maxCoeff();
  CHECK((exact.values - steps.values).cwiseAbs().maxCoeff() <= 2e-5 * size);  // of the steps
}
