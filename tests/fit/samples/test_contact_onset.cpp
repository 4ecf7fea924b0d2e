#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/intervals/flags.h"
#include "fit/samples/contact_onset.h"
#include "tests/fit/fit_checks.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// A spring behind a gap, compressed by one ramp of 0.12 mm in 0.5 s, read at 80 Hz.
struct Bench {
  double contact_m = 50e-6;
  double stiffness_N_m = 17.6e3;
  double late_s = 8e-3;  // actual start of the ramp after its command
  double noise_N = 0.0;
  double drift_N_s = 0.0;
};

IndentationData record(const Bench& bench) {
  IndentationData data;
  data.moves = {{2.0, 0.0, 120e-6, 0.24e-3, 0.2}};
  data.start_early_s = 0.02;
  data.start_late_s = 0.02;
  data.contact_from_s = 2.0;
  data.contact_to_s = 8.0;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (double t = 0.004; t < 8.0; t += 0.0125) {
    const double z_m = position_m(data.moves[0], t - bench.late_s);
    data.time_s.push_back(t);
    data.force_N.push_back(0.013 + bench.drift_N_s * t + bench.noise_N * normal(random) +
                           bench.stiffness_N_m * std::max(0.0, z_m - bench.contact_m));
  }
  return data;
}

}  // namespace

TEST_CASE("the onset of force gives contact and start of a ramp for any contact position",
          "[fit]") {
  for (const double contact_m : {0.0, 20e-6, 60e-6, 102e-6, 112e-6}) {
    CAPTURE(contact_m);
    const ContactOnset onset = contact_onset(record({.contact_m = contact_m}));
    // The data are exact, so only the last grid limits the accuracy: far below the 3 um between two
    // samples.
    CHECK(onset.contact_m == Approx(contact_m).margin(0.1e-6));
    CHECK(onset.shift_s == Approx(8e-3).margin(0.5e-3));
  }
}

TEST_CASE("noise and drift move the onset by less than one sample", "[fit][stability]") {
  for (const double contact_m : {20e-6, 102e-6}) {
    CAPTURE(contact_m);
    const ContactOnset noisy =
        contact_onset(record({.contact_m = contact_m, .noise_N = 5e-3}));  // 10 times the demo's
    CHECK(noisy.contact_m == Approx(contact_m).margin(3e-6));
    const ContactOnset drifting =
        contact_onset(record({.contact_m = contact_m, .drift_N_s = 2e-3}));
    CHECK(drifting.contact_m == Approx(contact_m).margin(3e-6));
  }
}

TEST_CASE("a single sample of the ramp under load is enough for start values", "[fit][stability]") {
  // One sample during the indentation determines only a combination of contact and start: contact
  // is as uncertain as the start, 20 ms at 0.24 mm/s.
  const double contact_m = 118e-6;
  const ContactOnset onset = contact_onset(record({.contact_m = contact_m}));
  CHECK(onset.contact_m == Approx(contact_m).margin(4.8e-6));
}

TEST_CASE("a ramp without contact is refused", "[fit]") {
  CHECK_THROWS_WITH(contact_onset(record({.contact_m = 130e-6, .noise_N = 5e-4})),
                    Catch::Contains("the force does not rise with the ramp"));
}

TEST_CASE("the move that lifts the punch off is found from the force", "[fit]") {
  IndentationData data = record({.noise_N = 5e-4});
  data.moves.push_back({5.0, 120e-6, 40e-6, 4e-3, 0.2});
  CHECK_FALSE(first_lifting_move(data).has_value());  // the force stays above zero
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] > 5.02) data.force_N[i] = data.force_N[i % 100];  // force as out of contact
  }
  REQUIRE(first_lifting_move(data).has_value());
  CHECK(*first_lifting_move(data) == 1);
  const IndentationData kept = before_move(data, 1);
  CHECK(kept.moves.size() == 1);
  CHECK(kept.contact_to_s == Approx(4.98).margin(1e-9));
  CHECK(kept.time_s.back() <= 4.98);
  CHECK(kept.time_s.size() == kept.force_N.size());
}

TEST_CASE("a guess of the modulus five times too low or too high does not affect the fit",
          "[fit]") {
  for (const double guess : {0.2, 1.0, 5.0}) {
    CAPTURE(guess);
    EmulatedTruth truth = demo_truth(10, 11);
    truth.material.terms = {{0.1, 0.1, 1.0}};
    RunConditions conditions;
    conditions.guess_over_truth = guess;
    TestPlan plan;
    plan.hold_s = 15.0;
    plan.recovery_s = 5.0;
    if (guess > 1.0) plan.depth_m = 0.04e-3;  // the cell could not carry the depth for this guess
    const FitResult fit =
        fit_indentation(indentation_from_capture(in_memory_run(truth, plan, conditions)));
    CHECK(fit.is_trustworthy);
    CHECK(fit.E0_Pa == Approx(truth.material.E0_Pa).epsilon(0.01));
    CHECK(fit.E0_interval_95.low <= truth.material.E0_Pa);
    CHECK(fit.E0_interval_95.high >= truth.material.E0_Pa);
    REQUIRE(fit.terms.size() == 1);
    CHECK(fit.terms[0].g == Approx(0.1).epsilon(0.05));
    CHECK(fit.terms[0].tau_s == Approx(1.0).epsilon(0.1));
    CHECK(*fit.contact_position_m == Approx(truth.surface_position_m).margin(1e-6));
    // Unloading to a tenth of a depth that counts from too early a contact lifts the punch off.
    CHECK(has_flag(fit, "unloading-left-out") == (guess < 1.0));
  }
}

TEST_CASE("a residual of many times the noise out of contact is a misfit", "[fit]") {
  CapturedRun run = in_memory_run(demo_truth(10, 4), {});
  const FitResult good = fit_indentation(indentation_from_capture(run));
  CHECK_FALSE(has_flag(good, "misfit"));
  // The stage slips during the hold: the force drops more suddenly than any relaxation.
  const double slip_s = run.moves.front().move.start_time_s + 30.0;
  for (LoadSample& sample : run.load_samples) {
    if (sample.host_time_s > slip_s && sample.host_time_s < slip_s + 12.0) *sample.counts *= 0.9;
  }
  const FitResult slipped = fit_indentation(indentation_from_capture(run));
  CHECK(has_flag(slipped, "misfit"));
  CHECK_FALSE(slipped.is_trustworthy);
}

TEST_CASE("a misfit is many times the noise and not small compared with the force", "[fit]") {
  const auto flagged = [](double sigma, double quiet_sigma, std::size_t n_quiet, double peak) {
    FitResult fit;
    flag_misfit(sigma, quiet_sigma, n_quiet, peak, fit);
    return has_flag(fit, "misfit");
  };
  CHECK(flagged(8.9e-3, 0.46e-3, 300, 1.5));
  CHECK_FALSE(flagged(1.2e-3, 0.46e-3, 300, 1.0));  // less than ten times the noise
  CHECK_FALSE(flagged(0.4e-3, 0.03e-3, 300, 1.0));  // steps of the stage, resolved by a better cell
  CHECK_FALSE(flagged(8.9e-3, 0.46e-3, 4, 1.5));    // the noise is unknown
}
