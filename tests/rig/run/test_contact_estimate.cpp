#include "rig/run/approach_phase.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

using namespace viscard;

namespace {

constexpr double kNoise_N = 0.5e-3;
constexpr double kStep_m = 0.3e-6;
constexpr double kSurface_m = 700e-6;

JogEnd stop_at(double position_m, double stiffness_N_m) {
  return {position_m, position_m > kSurface_m ? stiffness_N_m * (position_m - kSurface_m) : 0.0};
}

}  // namespace

TEST_CASE("a correct guess of the stiffness gives the true contact", "[rig]") {
  const ContactEstimate contact =
      contact_from_stops(stop_at(690e-6, 8e3), stop_at(705e-6, 8e3), kNoise_N, kStep_m, 8e3);
  CHECK(contact.position_m == Approx(kSurface_m).margin(1e-9));  // exact readings
  CHECK(contact.least_stiffness_N_m < 8e3);
  CHECK(contact.least_stiffness_N_m > 1e3);
}

TEST_CASE("for a specimen stiffer than guessed, contact is not before a stop without force",
          "[rig]") {
  // 60 N/mm guessed as 8.7: the guess alone would be 82 um too early.
  const ContactEstimate contact =
      contact_from_stops(stop_at(700e-6, 60e3), stop_at(714e-6, 60e3), kNoise_N, kStep_m, 8.7e3);
  CHECK(contact.position_m == Approx(kSurface_m).margin(1e-9));
  CHECK(contact.least_stiffness_N_m == Approx(60e3).epsilon(0.03));  // less noise and one step
  CHECK(contact.least_stiffness_N_m < 60e3);
}

TEST_CASE("two stops in contact need no guess", "[rig]") {
  for (const double guess_N_m : {2e3, 50e3}) {
    const ContactEstimate contact = contact_from_stops(stop_at(701e-6, 10e3), stop_at(706e-6, 10e3),
                                                       kNoise_N, kStep_m, guess_N_m);
    CHECK(contact.position_m == Approx(kSurface_m).margin(1e-9));
  }
}

TEST_CASE("without a distance between the stops the guess decides", "[rig]") {
  const JogEnd touched = stop_at(705e-6, 8e3);
  const ContactEstimate contact = contact_from_stops(touched, touched, kNoise_N, kStep_m, 16e3);
  CHECK(contact.position_m == Approx(702.5e-6).margin(1e-9));
  CHECK(contact.least_stiffness_N_m == Approx(0.0).margin(1e-12));
}

TEST_CASE("the depth reached is the one asked for, although modulus_guess is wrong", "[rig][pty]") {
  // The frame takes half of the way: by the guess alone, the depth would be 0.10 to 0.16 mm.
  EmulatedRigOptions options = RigFixture::options();
  options.truth.material.E0_Pa = 1.2e6;
  Specimen specimen = demo_specimen(10.0);
  specimen.modulus_guess_Pa = GENERATE(0.7e6, 1.2e6, 1.28e6, 1.8e6);
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan(), specimen);
  CAPTURE(specimen.modulus_guess_Pa, outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(2e-6));
  CHECK(rig.emulated.outcome().peak_depth_m == Approx(0.13e-3).margin(2e-6));
  CHECK(*outcome.contact_position_m ==
        Approx(demo_truth(10.0, 7).surface_position_m).margin(0.7e-6));
}
