#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_specimen.h"
#include "rig/emulator/emulated_touch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace viscard;

TEST_CASE("without scatter the first touch is the truth itself, later ones differ in their noise",
          "[rig]") {
  const EmulatedTruth truth = demo_truth(10.0, 7);
  const EmulatedTruth first = truth_of_touch(truth, "a", 1);
  CHECK(first.material.E0_Pa == truth.material.E0_Pa);
  CHECK(first.contact_factor == 1.0);
  CHECK(first.surface_position_m == truth.surface_position_m);
  CHECK(first.seed == truth.seed);
  const EmulatedTruth second = truth_of_touch(truth, "a", 2);
  CHECK(second.material.E0_Pa == truth.material.E0_Pa);
  CHECK(second.contact_factor == 1.0);
  CHECK(second.seed != truth.seed);
  CHECK(second.seed != truth_of_touch(truth, "a", 3).seed);
  CHECK(second.seed != truth_of_touch(truth, "b", 2).seed);
}

TEST_CASE("specimens and touches scatter as the truth states, the same on every run", "[rig]") {
  EmulatedTruth truth = demo_truth(10.0, 7);
  truth.specimen_scatter = 0.05;
  truth.alignment_scatter = 0.02;
  truth.surface_scatter_m = 2e-6;
  constexpr int kSpecimens = 40, kTouches = 10;
  double specimens = 0.0, touches = 0.0, surfaces = 0.0;
  for (int s = 0; s < kSpecimens; ++s) {
    const std::string id = "specimen " + std::to_string(s);
    const double E0_Pa = truth_of_touch(truth, id, 1).material.E0_Pa;
    specimens += std::pow(std::log(E0_Pa / truth.material.E0_Pa), 2) / kSpecimens;
    for (int k = 1; k <= kTouches; ++k) {
      const EmulatedTruth touch = truth_of_touch(truth, id, k);
      CHECK(touch.material.E0_Pa == E0_Pa);
      CHECK(touch.contact_factor == truth_of_touch(truth, id, k).contact_factor);
      touches += std::pow(std::log(touch.contact_factor), 2) / (kSpecimens * kTouches);
      surfaces += std::pow(touch.surface_position_m - truth.surface_position_m, 2) /
                  (kSpecimens * kTouches);
    }
  }
  // Three standard errors: of 40 specimens 34 %, of 400 touches 11 %.
  CHECK(std::sqrt(specimens) == Approx(0.05).epsilon(0.34));
  CHECK(std::sqrt(touches) == Approx(0.02).epsilon(0.11));
  CHECK(std::sqrt(surfaces) == Approx(2e-6).epsilon(0.11));
}

TEST_CASE("the force on an emulated specimen follows its contact factor", "[rig]") {
  EmulatedTruth truth = demo_truth(10.0, 7);
  truth.frame_stiffness_N_m = 0.0;
  const double depth_m = 1e-5;
  const double ideal_N = EmulatedSpecimen(truth).advance(1.0, truth.surface_position_m + depth_m);
  truth.contact_factor = 1.03;
  const double tilted_N = EmulatedSpecimen(truth).advance(1.0, truth.surface_position_m + depth_m);
  CHECK(tilted_N == Approx(1.03 * ideal_N).epsilon(1e-12));
}
