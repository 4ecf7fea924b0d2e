// Errors predicted before a run, against those of fits of emulated runs.
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/planning/protocol_study.h"
#include "tests/fit/planning/planned_bench.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

FitResult fit_of(const EmulatedTruth& truth, const TestPlan& plan,
                 std::optional<int> n_terms = std::nullopt) {
  FitOptions options;
  options.with_curves = false;
  options.n_terms = n_terms;
  return fit_indentation(indentation_from_capture(in_memory_run(truth, plan)), options);
}

// Deviations of (E_inf, E_i, ln tau_i) from their mean over runs with different noise, starts and
// surface: one row for each run. The prediction is that of two terms; a run in forty may show one.
Eigen::MatrixXd deviations_of(EmulatedTruth truth, const TestPlan& plan, int n_runs,
                              std::uint64_t first_seed) {
  Eigen::MatrixXd rows(n_runs, 5);
  int others = 0;  // runs that show another number of terms
  for (int run = 0; run < n_runs; ++run) {
    truth.seed = first_seed + static_cast<std::uint64_t>(run);
    FitResult fit = fit_of(truth, plan);
    if (fit.terms.size() != 2) {
      ++others;
      fit = fit_of(truth, plan, 2);
    }
    REQUIRE(fit.terms.size() == 2);
    rows(run, 0) = fit.E_inf_Pa;
    for (int i = 0; i < 2; ++i) {
      const FittedTerm& term = fit.terms[static_cast<std::size_t>(i)];
      rows(run, 1 + i) = term.modulus_Pa;
      rows(run, 3 + i) = std::log(term.tau_s);
    }
  }
  CHECK(40 * others <= n_runs);
  return rows.rowwise() - rows.colwise().mean();
}

// Scatter of the runs over the predicted errors: of all parameters with their correlations (1 if the
// prediction is right), and the squares of single ones.
struct Scatter {
  double whole = 0.0;
  Eigen::VectorXd squares;
};

Scatter scatter_of(const Eigen::MatrixXd& deviations, const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd unit = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = deviations * unit.asDiagonal();
  const Eigen::MatrixXd correlation = unit.asDiagonal() * covariance * unit.asDiagonal();
  const double freedom = static_cast<double>(deviations.rows() - 1);
  Scatter scatter;
  scatter.squares = scaled.colwise().squaredNorm().transpose() / freedom;
  const double form =
      scaled.cwiseProduct(correlation.ldlt().solve(scaled.transpose()).transpose()).sum();
  scatter.whole = std::sqrt(form / (freedom * static_cast<double>(deviations.cols())));
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
  // A gain that has drifted before contact is a wrong calibration: (1 + share) for E0, share (1 - g) for g.
  REQUIRE(E0.gain_drift > 0.0);
  CHECK(E0.gain_drift == Approx(predicted.result.gain_drift_relative).epsilon(1e-3));
  CHECK(errors_of({"sum_g", 0.01}, predicted).gain_drift ==
        Approx(E0.gain_drift * share * (1.0 - sum_g) / (1.0 + share)).epsilon(2e-3));
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

TEST_CASE("predicted standard errors are the scatter of 40 runs within 20 %, for six protocols",
          "[fit][slow]") {
  const EmulatedTruth truth = demo_truth(10, 1);
  const Protocol protocols[] = {{"demo", plan_with(0.13e-3, 1.0, 60.0, 20.0)},
                                {"quick ramp", plan_with(0.13e-3, 0.3, 60.0, 20.0)},
                                {"short holds", plan_with(0.13e-3, 1.0, 20.0, 10.0)},
                                {"half the depth", plan_with(0.065e-3, 1.0, 60.0, 20.0)},
                                {"long holds", plan_with(0.13e-3, 1.0, 150.0, 60.0)},
                                {"slow ramp", plan_with(0.13e-3, 4.0, 30.0, 20.0)}};
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(5);
  std::uint64_t seed = 1000;
  for (const Protocol& protocol : protocols) {
    const PredictedFit predicted = predicted_fit(protocol.plan, bench_of(truth), truth.material);
    const Scatter scatter =
        scatter_of(deviations_of(truth, protocol.plan, 40, seed), predicted.covariance);
    seed += 1000;
    squares += scatter.squares / std::size(protocols);
    CAPTURE(protocol.name);
    std::cout << protocol.name << ": scatter over prediction " << scatter.whole
              << "; of E_inf, E_1, E_2, ln tau_1, ln tau_2 "
              << scatter.squares.cwiseSqrt().transpose() << "\n";
    // 40 runs with 5 parameters give the ratio to 5 % (one standard error).
    CHECK(scatter.whole == Approx(1.0).epsilon(0.20));
  }
  // A single parameter is given by 40 runs to 11 %, by the 240 of all protocols to 5 %.
  for (const double square : squares) CHECK(std::sqrt(square) == Approx(1.0).epsilon(0.20));
}
