#include "models/experiment/sample_force.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

RigConfig rig_of(double gain, double zero) {
  RigConfig rig;
  rig.load_cell.volts_per_count = 2e-6;
  rig.calibration.volts_per_newton = gain;
  rig.calibration.zero_volts = zero;
  return rig;
}

}  // namespace

TEST_CASE("counts, volts and newtons of one load give one force", "[models]") {
  RigConfig rig = rig_of(0.5, 0.25);
  LoadSample sample;
  sample.volts = 1.25;
  CHECK(*force_N_from_sample(sample, rig) == Approx(2.0).epsilon(1e-14));  // (1.25 - 0.25)/0.5
  sample.volts.reset();
  sample.counts = 625000.0;  // times 2 uV
  CHECK(*force_N_from_sample(sample, rig) == Approx(2.0).epsilon(1e-14));
  sample.counts.reset();
  sample.force_N = 1.25;
  CHECK(*force_N_from_sample(sample, rig) == Approx(2.0).epsilon(1e-14));
  rig.load_cell.compression_is_positive = false;
  CHECK(*force_N_from_sample(sample, rig) == Approx(-2.0).epsilon(1e-14));
}

TEST_CASE("a sample without a number, or counts without volts per count, has no force",
          "[models]") {
  RigConfig rig = rig_of(0.5, 0.0);
  LoadSample sample;
  CHECK_FALSE(force_N_from_sample(sample, rig).has_value());
  sample.counts = 7.0;
  rig.load_cell.volts_per_count = 0.0;
  CHECK_FALSE(force_N_from_sample(sample, rig).has_value());
}

}  // namespace viscard
