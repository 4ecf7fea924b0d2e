// Which test to make, and what to measure next.
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/planning/next_measurement.h"
#include "fit/planning/protocol_study.h"
#include "tests/fit/planning/planned_bench.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

// The demo's bench with a frame that is known well, so that noise counts.
Bench known_bench(const EmulatedTruth& truth) {
  Bench bench = bench_of(truth);
  bench.rig.frame.stiffness_relative_u = 1e-4;
  return bench;
}

ProtocolOptions options_for(const EmulatedTruth& truth) {
  ProtocolOptions options;
  options.is_given = true;
  options.deepest_m = 0.14e-3;  // 80 % of the cell's capacity
  options.longest_s = 600.0;
  options.most_touches = 3;
  options.guesses = guesses_about(truth.material);
  return options;
}

// A small part of the grid, so that the test takes seconds.
bool is_quick(const TestPlan& plan) {
  return plan.hold_s <= 60.0 && plan.recovery_s <= 20.0 && plan.ramp_s >= 0.5;
}

double spread_of(EmulatedTruth truth, const TestPlan& plan, const WantedQuantity& wanted) {
  double sum = 0.0, square = 0.0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    truth.seed = 500 + static_cast<std::uint64_t>(run);
    FitOptions options;
    options.with_curves = false;
    const FitResult fit =
        fit_indentation(indentation_from_capture(in_memory_run(truth, plan)), options);
    REQUIRE(fit.terms.size() == 2);
    const double value = std::log(value_of(wanted, fitted_series(fit)));
    sum += value;
    square += value * value;
  }
  return std::sqrt((square - sum * sum / kRuns) / (kRuns - 1));
}

FittedRun fitted_run(const EmulatedTruth& truth, const Bench& bench) {
  FitOptions options;
  options.with_curves = false;
  FittedRun run{{}, bench, {}};
  run.fit = fit_indentation(indentation_from_capture(in_memory_run(truth, {})), options);
  return run;
}

}  // namespace

TEST_CASE("the front of protocols falls, and its advice is the quickest that is good enough",
          "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 1);
  ProtocolOptions options = options_for(truth);
  options.is_allowed = is_quick;
  const std::vector<WantedQuantity> wanted{{"E0", 0.003}, {"g_2", 0.05}};
  const ProtocolStudy study = study_protocols(known_bench(truth), wanted, options);
  REQUIRE(study.advised);
  REQUIRE(study.at_equal_time);
  double before_s = 0.0, before = std::numeric_limits<double>::infinity();
  for (const ProtocolRow& row : study.rows) {
    CHECK(row.total_s >= before_s);
    before_s = row.total_s;
    if (row.is_on_front) {
      CHECK(row.shortfall < before);
      before = row.shortfall;
    }
    CHECK(row.touches >= 1);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      // The best guess is one of those over which the worst is taken.
      CHECK(row.worst_half_width[i] >= row.errors[i].half_width_95());
      CHECK(row.shortfall >= row.errors[i].half_width_95() / wanted[i].tolerance * (1.0 - 1e-12));
    }
  }
  CHECK(study.meets_all);
  CHECK(study.rows[*study.advised].shortfall <= 1.0);
  for (const ProtocolRow& row : study.rows) {
    if (row.total_s < study.rows[*study.advised].total_s) CHECK(row.shortfall > 1.0);
  }
  const auto given = std::find_if(study.rows.begin(), study.rows.end(),
                                  [](const ProtocolRow& row) { return row.is_given; });
  REQUIRE(given != study.rows.end());
  CHECK(study.rows[*study.at_equal_time].total_s <= given->total_s);
  CHECK(study.rows[*study.at_equal_time].shortfall < given->shortfall);
}

TEST_CASE("ramp, depth, hold, unloading, recovery and touches are all varied", "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 1);
  const ProtocolOptions options = options_for(truth);
  const std::vector<TestPlan> plans = protocol_grid(options);
  const auto n_values = [&](double TestPlan::*member) {
    std::set<double> found;
    for (const TestPlan& plan : plans) found.insert(plan.*member);
    return found.size();
  };
  CHECK(n_values(&TestPlan::ramp_s) == 4);
  CHECK(n_values(&TestPlan::depth_m) == 2);
  CHECK(n_values(&TestPlan::hold_s) == 8);
  CHECK(n_values(&TestPlan::unload_to_fraction) == 2);
  CHECK(n_values(&TestPlan::recovery_s) == 6);
  // Each of them makes another prediction.
  const auto noise_of_g_2 = [&](const TestPlan& plan) {
    return errors_of({"g_2", 0.01}, predicted_fit(plan, bench_of(truth), truth.material)).noise;
  };
  TestPlan base;
  base.hold_s = 20.0;
  base.recovery_s = 10.0;
  std::set<double> noises{noise_of_g_2(base)};
  for (double TestPlan::*member : {&TestPlan::ramp_s, &TestPlan::depth_m, &TestPlan::hold_s,
                                   &TestPlan::unload_to_fraction, &TestPlan::recovery_s}) {
    TestPlan other = base;
    other.*member *= 0.5;
    CHECK(noises.insert(noise_of_g_2(other)).second);
  }
  CHECK(noises.size() == 6);
}

TEST_CASE("what the frame alone prevents is named, and does not hide the rest", "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 1);
  ProtocolOptions options = options_for(truth);
  options.is_allowed = [](const TestPlan& plan) { return is_quick(plan) && plan.ramp_s == 1.0; };
  const ProtocolStudy study =
      study_protocols(bench_of(truth), {{"E0", 0.01}, {"tau_2", 0.05}}, options);
  CHECK(study.is_beyond_reach ==
        std::vector<bool>{true, false});  // 2 % of the frame is 5.5 % of E0
  CHECK(study.meets_all);                 // as far as a test can
  CHECK(study.rows.front().errors[0].half_width_95() > 0.05);
}

TEST_CASE("the doubt in a guess is that of its covariance, or a factor", "[fit]") {
  Material guess = demo_truth(10, 1).material;
  const std::vector<Material> wide = guesses_about(guess);
  REQUIRE(wide.size() == 7);
  CHECK(wide.front().E0_Pa == guess.E0_Pa);
  CHECK(wide[1].E0_Pa == Approx(guess.E0_Pa / 1.3));
  CHECK(wide[2].terms[1].g == Approx(0.5 * guess.terms[1].g));
  CHECK(wide[6].terms[0].tau_s == Approx(2.0 * guess.terms[0].tau_s));
  guess.uncertainty.emplace();
  guess.uncertainty->E0_Pa_95 = {0.99 * guess.E0_Pa, 1.01 * guess.E0_Pa};
  guess.uncertainty->terms.resize(2);
  guess.uncertainty->terms[1].ln_tau_se = 0.05;
  const std::vector<Material> narrow = guesses_about(guess);
  CHECK(narrow[4].E0_Pa == Approx(guess.E0_Pa * std::exp(0.02 / kNormal95)));
  CHECK(narrow[6].terms[1].tau_s == Approx(guess.terms[1].tau_s * std::exp(0.1)));
  guess.terms = {{0.6, 0.6, 1.0}, {0.3, 0.3, 10.0}};
  guess.uncertainty.reset();
  for (const Material& other : guesses_about(guess)) CHECK_NOTHROW(validate(other));
}

TEST_CASE("the mean of touches has the noise of one over the root of their number", "[fit]") {
  const ErrorCauses one{0.02, 0.001, 0.01, 0.003, 0.004};
  const ErrorCauses four = one.of_touches(4);
  CHECK(four.noise == Approx(0.01));
  CHECK(four.frame == one.frame);
  CHECK(four.gain_drift == one.gain_drift);
  CHECK(one.total() == Approx(std::sqrt(4e-4 + 1e-6 + 1e-4 + 9e-6 + 16e-6)));
}

TEST_CASE("the next measurement is that of the largest doubt", "[fit]") {
  const EmulatedTruth truth = demo_truth(10, 4);
  FittedRun run = fitted_run(truth, bench_of(truth));
  const std::vector<WantedQuantity> E0{{"E0", 0.01}};
  const std::vector<NextMeasurement> frame = next_measurements(run, E0);
  REQUIRE_FALSE(frame.empty());
  CHECK(frame.front().how == "viscard calibrate --compliance");
  // Nearly all of the error is the frame's, so it halves.
  CHECK(frame.front().after == Approx(0.5 * frame.front().before).epsilon(0.01));
  CHECK(text_of_next(frame).find("E0 from +- 5.5 % to +- 2.7 %") != std::string::npos);

  run.bench.rig.frame.stiffness_relative_u = 0.0;
  const std::vector<NextMeasurement> touch = next_measurements(run, {{"g_2", 0.01}, {"E0", 0.5}});
  REQUIRE_FALSE(touch.empty());
  CHECK(touch.front().what.find("touch") != std::string::npos);
  const auto same = std::find_if(touch.begin(), touch.end(), [](const NextMeasurement& one) {
    return one.what == "another touch as this one";
  });
  REQUIRE(same != touch.end());
  // The same information once more. The fit's own covariance is at its own parameters.
  CHECK(same->after == Approx(same->before / std::sqrt(2.0)).epsilon(0.05));
  for (std::size_t i = 1; i < touch.size(); ++i) {
    CHECK(touch[i - 1].gain_per_minute() >= touch[i].gain_per_minute());
  }

  run.bench.specimen.contact.layer_thickness_u_m = 1e-3;
  const std::vector<NextMeasurement> layer = next_measurements(run, E0);
  REQUIRE_FALSE(layer.empty());
  CHECK(layer.front().what.find("layer") != std::string::npos);
  const auto measured = std::find_if(layer.begin(), layer.end(), [](const NextMeasurement& one) {
    return one.what.find("layer's thickness") != std::string::npos;
  });
  REQUIRE(measured != layer.end());
  CHECK(measured->after == Approx(0.5 * measured->before).epsilon(0.02));
}

TEST_CASE("the recommended test beats the demo's in the same time", "[fit][slow]") {
  const EmulatedTruth truth = demo_truth(10, 1);
  ProtocolOptions options = options_for(truth);
  options.is_allowed = [](const TestPlan& plan) { return plan.hold_s <= 120.0; };
  const WantedQuantity wanted{"g_2", 0.02};
  const ProtocolStudy study = study_protocols(known_bench(truth), {wanted}, options);
  REQUIRE(study.at_equal_time);
  const ProtocolRow& best = study.rows[*study.at_equal_time];
  const double demo = spread_of(truth, {}, wanted);
  // Touches are independent, so that their mean scatters less by the root of their number.
  const double better = spread_of(truth, best.plan, wanted) / std::sqrt(best.touches);
  std::cout << "g_2: scatter of 40 runs of the demo's test " << 100.0 * demo << " %, of "
            << best.touches << " touches of " << best.plan.hold_s << " s and "
            << best.plan.recovery_s << " s, " << best.total_s << " s in all, " << 100.0 * better
            << " %\n";
  CHECK(better < demo);
  CHECK(better == Approx(best.errors[0].noise).epsilon(0.25));
}
