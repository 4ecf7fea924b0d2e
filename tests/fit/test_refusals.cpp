#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/indentation_from_capture.h"
#include "tests/fit/spectra.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

TEST_CASE("data that cannot be fitted are refused with the reason", "[fit]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RelaxationData data = relaxation_of(s2(), 50, 100.0, 0.0, 1);
  SECTION("nothing but NaN") {
    data.value.assign(50, nan);
    CHECK_THROWS_WITH(fit_relaxation(data), Contains("only 0 of 50 rows"));
  }
  SECTION("two samples") {
    CHECK_THROWS_WITH(fit_relaxation({{0.0, 1.0}, {1.0, 0.9}, {}}), Contains("at least 4"));
  }
  SECTION("columns of unequal length") {
    data.value.pop_back();
    CHECK_THROWS_AS(fit_relaxation(data), std::invalid_argument);
  }
  SECTION("one time") {
    data.time_s.assign(50, 3.0);
    CHECK_THROWS_WITH(fit_relaxation(data), Contains("same time"));
  }
  SECTION("negative modulus") {
    for (double& value : data.value) value = -value;
    CHECK_THROWS_WITH(fit_relaxation(data), Contains("negative"));
  }
  SECTION("everything before the step") {
    for (double& t : data.time_s) t -= 1000.0;
    CHECK_THROWS_WITH(fit_relaxation(data), Contains("--time-zero"));
  }
}

TEST_CASE("a negative relaxation is refused with the column to flip, of forces or of moduli",
          "[fit]") {
  RelaxationData data;
  data.time_s = {0.1, 0.3, 1.0, 3.0, 10.0, 30.0};
  data.value = {-2.0, -1.8, -1.6, -1.5, -1.4, -1.3};
  CHECK_THROWS_WITH(fit_relaxation(data), Contains("--column modulus_Pa=-NAME"));
  for (const char* unit : {"N", "N/m"}) {
    data.unit = unit;
    CHECK_THROWS_WITH(fit_relaxation(data), Contains("the force of a relaxation is positive") &&
                                                Contains("--column force_N=-NAME"));
  }
}

TEST_CASE("invalid creep, oscillation and strain histories are refused with the reason", "[fit]") {
  const std::vector<double> arguments{0.1, 0.3, 1.0, 3.0, 10.0, 30.0};
  SECTION("negative compliance") {
    CHECK_THROWS_WITH(fit_creep({arguments, {-1.0, -1.1, -1.2, -1.3, -1.4, -1.5}}),
                      Contains("--column compliance_1_Pa=-NAME"));
  }
  SECTION("negative storage") {
    CHECK_THROWS_WITH(
        fit_dma({arguments, {-1.0, -1.1, -1.2, -1.3, -1.4, -1.5}, {.1, .1, .1, .1, .1, .1}}),
        Contains("--column storage_modulus_Pa=-NAME"));
  }
  SECTION("a row of zeros among moduli") {
    CHECK_THROWS_WITH(
        fit_dma({arguments, {1.0, 1.1, 0.0, 1.3, 1.4, 1.5}, {.1, .1, 0.0, .1, .1, .1}}),
        Contains("both zero at 1 Hz"));
  }
  SECTION("no strain") {
    CHECK_THROWS_WITH(
        fit_relaxation({arguments, {1.0, .9, .8, .7, .6, .5}, std::vector<double>(6, 0.0)}),
        Contains("strain is zero"));
  }
}

TEST_CASE("as many parameters as samples are not fitted, because nothing would determine the noise",
          "[fit]") {
  // Regression: five noisy samples once gave two terms with intervals of zero width.
  FitOptions options;
  options.n_terms = 4;
  RelaxationData data;
  for (const double t : {0.1, 0.6, 4.0, 25.0, 160.0}) {
    data.time_s.push_back(t);
    data.value.push_back(1e6 + 5e5 * std::exp(-t / 3.0) + 2e4 * std::sin(40.0 * t));
  }
  const FitResult fit = fit_relaxation(data, options);
  CHECK(fit.terms.size() == 1);
  CHECK(fit.E0_se_Pa > 1e3);
  REQUIRE_FALSE(fit.flags.empty());
  CHECK_THAT(fit.flags.front().text, Contains("5 values cannot determine more than 1"));
}

TEST_CASE("a fit is refused unless the samples can determine the parameters left free", "[fit]") {
  RelaxationData data;
  for (const double t : {0.1, 0.6, 4.0, 25.0, 160.0}) {
    data.time_s.push_back(t);
    data.value.push_back(1e6 + 5e5 * std::exp(-t / 3.0) + 2e4 * std::sin(40.0 * t));
  }
  FitOptions options;
  options.n_terms = 3;
  options.constraints = {{"tau_1", 0.5, 0.5}};
  CHECK_THROWS_WITH(fit_relaxation(data, options),
                    Contains("5 values cannot determine 6 free parameters"));
  options.n_terms = 1;
  options.constraints = {{"tau_1", 3.0, 3.0}};
  const FitResult fit = fit_relaxation(data, options);
  // E_inf and E_1 are fitted, and three of the five values remain to estimate the noise.
  CHECK(fit.noise.sigma == Approx(std::sqrt(fit.rss / 3.0)).epsilon(1e-12));
}

TEST_CASE("rows without numbers are left out and counted", "[fit]") {
  RelaxationData data = relaxation_of(s2(), 400, 1000.0, 0.001, 1);
  data.value[7] = std::numeric_limits<double>::infinity();
  data.time_s[9] = std::numeric_limits<double>::quiet_NaN();
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.n_left_out == 2);
  CHECK(fit.n_samples == 398);
}

TEST_CASE("an indentation whose force does not follow the depth is refused", "[fit]") {
  IndentationData data = indentation_of(s2(), even_times(20.0, 0.02), ramp_and_hold(1.0), 1e-3, 2);
  SECTION("constant force") {
    data.force_N.assign(data.force_N.size(), 0.5);
    CHECK_THROWS_WITH(fit_indentation(data), Contains("constant"));
  }
  SECTION("negative force") {
    for (double& force : data.force_N) force = -force;
    CHECK_THROWS_WITH(fit_indentation(data), Contains("--column force_N=-NAME"));
  }
  SECTION("depth counted the other way") {
    for (double& depth : data.depth_m) depth = 1e-4 - depth;
    CHECK_THROWS_WITH(fit_indentation(data), Contains("--column depth_m=-NAME"));
  }
}

TEST_CASE("a captured run without a ramp, a gain or readings is refused", "[fit]") {
  CapturedRun run = in_memory_run(demo_truth(10, 1), {});
  SECTION("no ramp") {
    run.moves.clear();
    run.status = "interrupted";
    CHECK_THROWS_WITH(indentation_from_capture(run),
                      Contains("no ramp") && Contains("interrupted"));
  }
  SECTION("no ramp, because the side file is missing") {
    run.moves.clear();
    run.integrity.has_lost_log = true;
    run.integrity.lost_log = "run.viscap-wal";
    CHECK_THROWS_WITH(indentation_from_capture(run),
                      Contains("run.viscap-wal") && Contains("is missing"));
  }
  SECTION("no readings, because all are damaged") {
    run.integrity.n_left_out_samples = run.load_samples.size();
    run.load_samples.clear();
    CHECK_THROWS_WITH(indentation_from_capture(run), Contains("0 usable force readings") &&
                                                         Contains("checksums") &&
                                                         !Contains("amplifier"));
  }
  SECTION("readings that end before the ramp") {
    const double ramp_s = run.moves.front().move.start_time_s;
    std::erase_if(run.load_samples,
                  [&](const LoadSample& sample) { return sample.host_time_s > ramp_s - 0.1; });
    CHECK_THROWS_WITH(indentation_from_capture(run), Contains("end before the punch"));
  }
  SECTION("no readings") {
    run.load_samples.clear();
    CHECK_THROWS_WITH(indentation_from_capture(run), Contains("0 usable force readings"));
  }
  SECTION("no gain") {
    run.rig.calibration.volts_per_newton = 0.0;
    CHECK_THROWS_AS(indentation_from_capture(run), std::invalid_argument);
  }
  SECTION("load cell mounted the other way round") {
    run.rig.load_cell.compression_is_positive = false;
    CHECK_THROWS_WITH(fit_indentation(indentation_from_capture(run)),
                      Contains("sign of the load cell"));
  }
}

TEST_CASE("a frame that yields by more than the stage moved is refused by its stiffness", "[fit]") {
  // 1 N under 0.13 mm, and a frame of 10 N/m where 10 N/mm was meant: 100 mm.
  IndentationData data;
  data.frame_stiffness_N_m = 10.0;
  for (int i = 0; i < 20; ++i) {
    data.time_s.push_back(0.1 * i);
    data.force_N.push_back(1.0 - 0.005 * i);
    data.depth_m.push_back(1.3e-4);
  }
  CHECK_THROWS_WITH(fit_indentation(data), Contains("a frame of 10 N/m yields by 100 mm at 1 N") &&
                                               Contains("--frame-stiffness \"10 N/mm\""));
}
