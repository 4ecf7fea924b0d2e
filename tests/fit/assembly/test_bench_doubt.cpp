// What is believed of the bench, against closed forms and against fits on a bench that is otherwise.
#include "fit/assembly/bench_doubt.h"
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "models/material/systematic_parts.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("a doubt in frame and load cell moves E0, shares and times as the closed forms say",
          "[fit]") {
  // One term of g = 0.4; the specimen is 1.5 times as stiff as the frame. 1/k = 1/k_stage - 1/k_frame
  // holds for the glassy and the relaxed stiffness, and the retardation time is the same.
  const double g = 0.4, s = 1.5, frame_N_m = 10e3;
  const PronySeries specimen{s * frame_N_m * (1.0 - g), {{s * frame_N_m * g, 2.0}}};
  const BenchDoubt doubt{frame_N_m, 0.02, 0.003, 0.0, 0.01};
  const std::vector<SystematicPart> parts = systematic_parts_from(specimen, doubt);
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].cause == kFrameCause);
  CHECK(parts[0].E0 == Approx(s * 0.02).epsilon(1e-3));
  CHECK(parts[0].g[0] == Approx(s * (1.0 - g) * 0.02).epsilon(1e-3));
  CHECK(parts[0].tau[0] == Approx(-s * g * 0.02).epsilon(1e-3));
  CHECK(parts[1].cause == kLoadCellCause);
  CHECK(parts[1].E0 == Approx((1.0 + s) * 0.003).epsilon(1e-3));
  CHECK(parts[1].g[0] == Approx(s * (1.0 - g) * 0.003).epsilon(1e-3));
  CHECK(parts[2].cause == kGeometryCause);
  CHECK(parts[2].E0 == 0.01);
  CHECK(parts[2].g.empty());
}

TEST_CASE("on a rigid frame the load cell scales all moduli, and without doubts there are no parts",
          "[fit]") {
  const PronySeries specimen{1e4, {{1e3, 2.0}}};
  const std::vector<SystematicPart> parts =
      systematic_parts_from(specimen, {0.0, 0.02, 0.003, 0.0});
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].E0 == Approx(0.003));
  CHECK(systematic_u_of_g(parts, 0) == 0.0);
  CHECK(systematic_parts_from(specimen, {}).empty());
}

TEST_CASE("shares fitted with a wrong frame are off as their systematic part states", "[fit]") {
  EmulatedTruth truth = demo_truth(10, 3);
  const CapturedRun run = in_memory_run(truth, TestPlan{});
  IndentationData data = indentation_from_capture(run);
  FitOptions options;
  options.n_terms = 2;
  options.with_curves = false;
  data.frame_stiffness_relative_u = 0.02;
  const FitResult right = fit_indentation(data, options);
  data.frame_stiffness_N_m *= 0.96;  // two standard uncertainties
  const FitResult wrong = fit_indentation(data, options);
  for (std::size_t i = 0; i < 2; ++i) {
    const double stated = systematic_u_of_g(right.systematic_parts, i);
    CHECK(stated > 0.01);
    CHECK(std::log(wrong.terms[i].g / right.terms[i].g) == Approx(2.0 * stated).epsilon(0.1));
    const Interval wide = combined_intervals(wrong, i).g_95;
    CHECK(wide.low < right.terms[i].g);
    CHECK(right.terms[i].g < wide.high);
  }
  CHECK(std::log(wrong.E0_Pa / right.E0_Pa) ==
        Approx(2.0 * right.systematic_relative).epsilon(0.1));
  // The interval of the record alone does not reach so far.
  CHECK(wrong.terms[1].g_95.low > right.terms[1].g);
}
