#include "models/contact/punch_contact.h"
#include "models/maths/text_of_number.h"
#include "rig/emulator/demo_rig.h"
#include "rig/run/preflight.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

const StageDynamics kFine{3200e3, 0.2, 10e-3};

}  // namespace

TEST_CASE("a speed below the smallest of the stage is a warning with the speed used instead",
          "[rig]") {
  StageDynamics coarse{3200e3, 0.2, 10e-3, 0.122e-3};
  TestPlan plan;
  plan.approach_speed_m_s = 0.05e-3;
  plan.depth_m = 0.05e-3;
  plan.ramp_s = 10.0;
  const Preflight slow = preflight(demo_rig(), plan, demo_specimen(10.0), coarse);
  const auto n_warnings_with = [&](const std::string& words) {
    return std::count_if(slow.warnings.begin(), slow.warnings.end(), [&](const std::string& text) {
      return text.find(words) != std::string::npos;
    });
  };
  CHECK(n_warnings_with("no slower than 0.1220 mm/s: the approach") == 1);
  CHECK(n_warnings_with("the move 'ramp' goes at that") == 1);
  coarse.min_speed_m_s = 0.0;
  const Preflight free = preflight(demo_rig(), plan, demo_specimen(10.0), coarse);
  // The overshoot is that of the true speed of the approach.
  CHECK(slow.approach_overshoot_N > 1.5 * free.approach_overshoot_N);
}

TEST_CASE("a guess a thousand times off is asked for, instead of a depth of nothing", "[rig]") {
  Specimen stiff = demo_specimen(10.0);
  stiff.modulus_guess_Pa *= 1e3;
  const Preflight result = preflight(demo_rig(), TestPlan{}, stiff);
  REQUIRE(!result.problems.empty());
  CHECK_THAT(result.problems[0],
             Catch::Contains("unit of modulus_guess") && !Catch::Contains("0.000 mm"));
}

TEST_CASE("a depth of 0.25 mm is refused for all three mixing ratios, and a safe one is named",
          "[rig]") {
  const double ratio = GENERATE(10.0, 13.0, 20.0);
  TestPlan plan;
  plan.depth_m = 0.25e-3;
  const Preflight result = preflight(demo_rig(), plan, demo_specimen(ratio));
  // Independent of punch_contact.h: 2 a E h/(1 - nu^2), raised by the layer; kappa is above 1.27 at
  // a/H = 0.2 and nu = 0.495 (Hayes et al. 1972: 1.28 at nu = 0.5).
  const double half_space_N =
      2 * 2.2e-3 * demo_specimen(ratio).modulus_guess_Pa * 0.25e-3 / (1 - 0.495 * 0.495);
  CHECK(result.peak_force_N > 1.27 * half_space_N);
  CHECK(result.peak_force_N < 1.29 * half_space_N);
  CHECK(result.peak_force_N > 2.4517);  // the rating itself
  CHECK(half_space_N > 0.8 * 2.4517);   // the 80 % limit even without the layer
  REQUIRE(result.problems.size() == 1);
  CHECK(result.problems[0].find("above the cell's rating") != std::string::npos);
  CHECK(result.problems[0].find("Lower depth") != std::string::npos);
  // The depth in the message is accepted.
  const std::string text = result.problems[0];
  const std::size_t at = text.rfind(" to ");
  plan.depth_m = std::stod(text.substr(at + 4)) * 1e-3;
  CHECK(plan.depth_m > 0.1e-3);
  CHECK(preflight(demo_rig(), plan, demo_specimen(ratio)).problems.empty());
}

TEST_CASE("the demonstration's depth of 0.13 mm passes with an expected force of 1.82 N", "[rig]") {
  const Preflight result = preflight(demo_rig(), TestPlan{}, demo_specimen(10.0), kFine);
  CHECK(result.problems.empty());
  CHECK(result.peak_force_N == Approx(1.82).margin(0.005));  // two printed digits
  // depth and frame spring of 10 N/mm in series
  CHECK(result.stage_travel_m == Approx(0.13e-3 + result.peak_force_N / 10e3).epsilon(1e-12));
  CHECK(result.ramp_speed_m_s == Approx(result.stage_travel_m).epsilon(1e-12));  // in 1 s
}

TEST_CASE("the distance of a gentle stop is GRBL's queue and the deceleration", "[rig]") {
  // 250 steps/mm: 7.5 steps are 30 um at any speed.
  CHECK(stop_distance_m(0.1e-3, {250e3, 0.2, 1e-2}) == Approx(30e-6 + 0.025e-6).epsilon(1e-9));
  // 3200 steps/mm at 2 mm/s and 10 mm/s2: 60 ms, then v^2/(2a) = 0.2 mm.
  CHECK(stop_distance_m(2e-3, {3200e3, 0.01, 1e-2}) == Approx(120e-6 + 200e-6).epsilon(1e-9));
}

TEST_CASE("an approach that would overshoot the limit is refused", "[rig]") {
  TestPlan plan;
  plan.approach_speed_m_s = 2e-3;
  const Preflight result =
      preflight(demo_rig(), plan, demo_specimen(10.0), StageDynamics{250e3, 0.01, 10e-3});
  REQUIRE_FALSE(result.problems.empty());
  CHECK(result.problems[0].find("speed under [approach]") != std::string::npos);
  // The speed in the message is accepted, and a slightly larger one is not.
  const std::size_t at = result.problems[0].rfind(" to ");
  const double named_m_s = std::stod(result.problems[0].substr(at + 4)) * 1e-3;
  const auto problems_at = [&](double speed_m_s) {
    plan.approach_speed_m_s = speed_m_s;
    return preflight(demo_rig(), plan, demo_specimen(10.0), StageDynamics{250e3, 0.01, 10e-3})
        .problems.size();
  };
  CHECK(problems_at(named_m_s) == 0);
  CHECK(problems_at(named_m_s + 2e-6) == 1);
}

TEST_CASE("a converter at 10 readings/s is waited for, and the time is stated beforehand",
          "[rig]") {
  RigConfig rig = demo_rig();
  const Preflight fast = preflight(rig, TestPlan{}, demo_specimen(10.0));
  rig.load_cell.expected_rate_Hz = 10.0;
  const Preflight slow = preflight(rig, TestPlan{}, demo_specimen(10.0));
  CHECK(slow.problems.empty());
  REQUIRE_FALSE(slow.warnings.empty());
  CHECK_THAT(slow.warnings.front(),
             Catch::Matchers::Contains("10.0 readings/s") &&
                 Catch::Matchers::Contains("in steps") &&
                 Catch::Matchers::Contains(text_from_number(slow.total_s, 0) + " s instead of " +
                                           text_from_number(fast.total_s, 0) + " s") &&
                 Catch::Matchers::Contains("80/s"));
  CHECK(slow.total_s > fast.total_s + 10.0);
  // A ramp so fast that it cannot be stopped in time is refused with one that can.
  TestPlan quick;
  quick.ramp_s = 0.3;
  const Preflight refused = preflight(rig, quick, demo_specimen(10.0));
  REQUIRE(refused.problems.size() == 1);
  CHECK_THAT(refused.problems[0], Catch::Matchers::Contains("until a reading stops it"));
  quick.ramp_s = std::stod(refused.problems[0].substr(refused.problems[0].find("file to ") + 8));
  CHECK(preflight(rig, quick, demo_specimen(10.0)).problems.empty());
  rig.load_cell.expected_rate_Hz = 1.0;
  const Preflight slowest = preflight(rig, TestPlan{}, demo_specimen(10.0));
  REQUIRE(slowest.problems.size() == 1);
  CHECK_THAT(slowest.problems[0], Catch::Matchers::Contains("fewer than the 2/s of any test"));
}

TEST_CASE("a load to a force in a time that no stage keeps is refused as a ramp is", "[rig]") {
  TestPlan plan;
  plan.protocol = "creep";
  plan.creep.force_N = 0.3;
  plan.creep.ramp_s = 1e-3;
  StageDynamics dynamics;
  dynamics.steps_per_m = 1.6e6;
  dynamics.acceleration_m_s2 = 0.2;
  dynamics.max_speed_m_s = 10e-3;
  const Preflight refused = preflight(demo_rig(), plan, demo_specimen(10.0), dynamics);
  REQUIRE(refused.problems.size() == 1);
  CHECK_THAT(refused.problems[0], Catch::Matchers::Contains("duration under [creep]"));
  REQUIRE_FALSE(refused.warnings.empty());
  CHECK_THAT(refused.warnings[0], Catch::Matchers::Contains("holds only 0 readings"));
}

TEST_CASE("impossible plans and rigs are refused with the value to change", "[rig]") {
  TestPlan plan;
  plan.ramp_s = 0.0;
  CHECK_THROWS_WITH(preflight(demo_rig(), plan, demo_specimen(10.0)),
                    Catch::Matchers::Contains("duration under [ramp]"));
  Specimen unknown = demo_specimen(10.0);
  unknown.modulus_guess_Pa = 0.0;
  CHECK_THROWS_WITH(preflight(demo_rig(), TestPlan{}, unknown),
                    Catch::Matchers::Contains("modulus_guess"));
  RigConfig rig = demo_rig();
  rig.calibration.volts_per_newton = 0.0;
  CHECK_THROWS_AS(preflight(rig, TestPlan{}, demo_specimen(10.0)), std::invalid_argument);
}

TEST_CASE("a test that no approach would notice is refused before it starts", "[rig]") {
  Specimen soft = demo_specimen(10.0);
  soft.modulus_guess_Pa = 200.0;  // 2 MPa with a factor lost
  const Preflight result = preflight(demo_rig(), TestPlan{}, soft);
  REQUIRE(result.problems.size() == 1);
  CHECK_THAT(result.problems[0],
             Catch::Matchers::Contains("not above the contact_force of 10 mN") &&
                 Catch::Matchers::Contains("modulus_guess") &&
                 !Catch::Matchers::Contains("0.0000 N"));
}

TEST_CASE("an approach longer than the stage's travel is refused with a limit that fits", "[rig]") {
  TestPlan plan;
  plan.approach_limit_m = 0.9;
  const Preflight result = preflight(demo_rig(), plan, demo_specimen(10.0));
  REQUIRE(result.problems.size() == 1);
  CHECK_THAT(result.problems[0], Catch::Matchers::Contains("travel is 10.0000 mm") &&
                                     Catch::Matchers::Contains("limit under [approach]"));
  plan.approach_limit_m = demo_rig().stage.travel_m;
  CHECK(preflight(demo_rig(), plan, demo_specimen(10.0)).problems.empty());
}

TEST_CASE("an unloading that will lift off is a warning with a fraction that will not", "[rig]") {
  TestPlan plan;
  plan.unload_to_fraction = 0.03;
  Specimen specimen = demo_specimen(10.0);
  const auto warnings = [&] { return preflight(demo_rig(), plan, specimen).warnings; };
  REQUIRE(warnings().size() == 1);
  CHECK_THAT(warnings()[0],
             Catch::Matchers::Contains("lift off") &&
                 Catch::Matchers::Contains("unload_to_fraction of the test file to 0.10"));
  specimen.relaxation_guess = 0.02;
  CHECK(warnings().empty());
  plan.unload_to_fraction = 0.1;
  specimen.relaxation_guess = 0.3;
  CHECK(warnings().size() == 1);
  plan.unload_to_fraction = 0.6;
  CHECK(warnings().empty());
}

}  // namespace viscard
