// Errors predicted before a run, against those of fits of emulated runs.
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/planning/protocol_study.h"
#include "tests/fit/planning/planned_bench.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

PronySeries series_of(const FitResult& fit) {
  PronySeries series{fit.E_inf_Pa, {}};
  for (const FittedTerm& term : fit.terms) series.terms.push_back({term.modulus_Pa, term.tau_s});
  return series;
}

FitResult fit_of(const EmulatedTruth& truth, const TestPlan& plan) {
  FitOptions options;
  options.with_curves = false;
  return fit_indentation(indentation_from_capture(in_memory_run(truth, plan)), options);
}

// Standard deviation of ln(quantity) over runs with different noise, starts and surface.
std::vector<double> scatter_of(EmulatedTruth truth, const TestPlan& plan,
                               const std::vector<WantedQuantity>& wanted, int n_runs,
                               std::uint64_t first_seed) {
  std::vector<double> sums(wanted.size()), squares(wanted.size());
  int n = 0;
  for (int run = 0; run < n_runs; ++run) {
    truth.seed = first_seed + static_cast<std::uint64_t>(run);
    const FitResult fit = fit_of(truth, plan);
    REQUIRE(fit.terms.size() == 2);
    ++n;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double value = std::log(value_of(wanted[i], series_of(fit)));
      sums[i] += value;
      squares[i] += value * value;
    }
  }
  std::vector<double> scatter;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    scatter.push_back(std::sqrt((squares[i] - sums[i] * sums[i] / n) / (n - 1)));
  }
  return scatter;
}

struct Protocol {
  const char* name;
  TestPlan plan;
};

TestPlan plan_with(double depth_m, double ramp_s, double hold_s, double recovery_s) {
  TestPlan plan;
  plan.depth_m = depth_m;
  plan.ramp_s = ramp_s;
  plan.hold_s = hold_s;
  plan.recovery_s = recovery_s;
  return plan;
}

}  // namespace

TEST_CASE("predicted errors are those that the fit of a run states", "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 3);
  const FitResult fit = fit_of(truth, {});
  REQUIRE(fit.terms.size() == 2);
  // At the fit's own parameters and noise, because errors of the fast term depend on its time.
  Bench bench = bench_of(truth);
  bench.performance.noise_N = fit.noise.sigma;
  const PredictedFit predicted = predicted_fit({}, bench, material_from_fit(fit, 0.495, 0.0));
  // What remains is the noise in motion, which the fit estimates from some 100 readings.
  const auto near = [](double value) { return Approx(value).epsilon(0.05); };
  CHECK(predicted.result.E0_Pa == Approx(fit.E0_Pa).epsilon(1e-9));
  CHECK(predicted.result.E0_se_Pa == near(fit.E0_se_Pa));
  CHECK(predicted.result.E_inf_se_Pa == near(fit.E_inf_se_Pa));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(predicted.result.terms[i].modulus_se_Pa == near(fit.terms[i].modulus_se_Pa));
    CHECK(predicted.result.terms[i].ln_tau_se == near(fit.terms[i].ln_tau_se));
  }
  // The errors by cause add up to those of the result.
  const ErrorCauses E0 = errors_of({"E0", 0.01}, predicted);
  CHECK(std::hypot(E0.noise, E0.gain_drift) * predicted.result.E0_Pa ==
        Approx(predicted.result.E0_se_Pa).epsilon(1e-6));
  CHECK(errors_of({"tau_2", 0.01}, predicted).noise ==
        Approx(predicted.result.terms[1].ln_tau_se).epsilon(1e-6));
}

TEST_CASE("the systematic part of E0 is that of the fit, and shares of terms have one too",
          "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 3);
  Bench bench = bench_of(truth);
  const double share = force_per_modulus_and_depth_m(truth.contact) * truth.material.E0_Pa / 10e3;
  const PredictedFit predicted = predicted_fit({}, bench, truth.material);
  const ErrorCauses E0 = errors_of({"E0", 0.01}, predicted);
  // As systematic_share() of fit_indentation.cpp: the frame's share of the specimen's stiffness.
  CHECK(E0.frame == Approx(0.02 * share).epsilon(1e-3));
  CHECK(fit_of(truth, {}).systematic_relative == Approx(0.02 * share).epsilon(0.01));
  // 1 - g = E_inf/E_0 and both are wrong by their own shares, so d ln g = (1 - g) share u.
  double sum_g = 0.0;
  for (const MaterialTerm& term : truth.material.terms) sum_g += term.g;
  CHECK(errors_of({"sum_g", 0.01}, predicted).frame ==
        Approx(0.02 * share * (1.0 - sum_g)).epsilon(2e-3));
  CHECK(errors_of({"tau_2", 0.01}, predicted).geometry < 1e-12);
  bench.rig.calibration.volts_per_newton_u = 0.01 * bench.rig.calibration.volts_per_newton;
  bench.specimen.contact.punch_radius_u_m = 0.01 * bench.specimen.contact.punch_radius_m;
  const ErrorCauses doubted = errors_of({"E0", 0.01}, predicted_fit({}, bench, truth.material));
  CHECK(doubted.calibration == Approx(0.01 * (1.0 + share)).epsilon(2e-3));
  CHECK(doubted.geometry == Approx(relative_uncertainty(bench.specimen.contact)).epsilon(1e-6));
}

TEST_CASE("a planned run has the readings, moves and time of the run itself", "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 3);
  const IndentationData planned = planned_run({}, bench_of(truth)).data;
  const IndentationData recorded = indentation_from_capture(in_memory_run(truth, {}));
  REQUIRE(planned.moves.size() == recorded.moves.size());
  for (std::size_t m = 0; m < planned.moves.size(); ++m) {
    // The surface lies up to 2 um from where the rig believes it.
    CHECK(duration_s(planned.moves[m]) == Approx(duration_s(recorded.moves[m])).margin(0.02));
  }
  const auto count = static_cast<double>(recorded.time_s.size());
  CHECK(static_cast<double>(planned.time_s.size()) == Approx(count).epsilon(0.01));
  TestPlan creep;
  creep.protocol = "creep";
  creep.creep.force_N = 1.0;
  CHECK_THROWS_WITH(planned_run(creep, bench_of(truth)), Catch::Contains("given force"));
}

TEST_CASE("what cannot be planned is refused with what to do", "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 3);
  Bench bench = bench_of(truth);
  const PredictedFit fit = predicted_fit({}, bench, truth.material);
  CHECK_THROWS_WITH(errors_of({"g_3", 0.1}, fit), Catch::Contains("2 terms"));
  for (const char* name : {"E", "g_", "g_0", "g_x", "Young", "tau_1s"}) {
    CHECK_THROWS_WITH(errors_of({name, 0.1}, fit), Catch::Contains("known are E0"));
  }
  bench.performance.noise_N = 0.0;
  CHECK_THROWS_WITH(predicted_fit({}, bench, truth.material), Catch::Contains("[performance]"));
}

TEST_CASE("predicted standard errors are the scatter of 40 runs, for six protocols",
          "[fit][slow]") {
  const EmulatedTruth truth = demo_truth(10, 1);
  const std::vector<WantedQuantity> wanted{{"E0", 0.01}, {"g_2", 0.05}, {"tau_2", 0.05}};
  const Protocol protocols[] = {{"demo", plan_with(0.13e-3, 1.0, 60.0, 20.0)},
                                {"quick ramp", plan_with(0.13e-3, 0.3, 60.0, 20.0)},
                                {"short holds", plan_with(0.13e-3, 1.0, 20.0, 10.0)},
                                {"half the depth", plan_with(0.065e-3, 1.0, 60.0, 20.0)},
                                {"long holds", plan_with(0.13e-3, 1.0, 200.0, 60.0)},
                                {"slow ramp", plan_with(0.13e-3, 2.0, 40.0, 20.0)}};
  std::uint64_t seed = 1000;
  for (const Protocol& protocol : protocols) {
    const PredictedFit predicted = predicted_fit(protocol.plan, bench_of(truth), truth.material);
    const std::vector<double> scatter = scatter_of(truth, protocol.plan, wanted, 40, seed);
    seed += 1000;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double expected = errors_of(wanted[i], predicted).noise;
      CAPTURE(protocol.name, wanted[i].name);
      std::cout << protocol.name << ", " << wanted[i].name << ": predicted " << 100.0 * expected
                << " %, scatter of 40 runs " << 100.0 * scatter[i] << " %\n";
      CHECK(scatter[i] == Approx(expected).epsilon(0.20));
    }
  }
}
