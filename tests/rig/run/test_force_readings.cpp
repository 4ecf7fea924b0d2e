#include "rig/emulator/demo_rig.h"
#include "rig/run/force_readings.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

namespace viscard {
namespace {

constexpr double kNoise_N = 0.5e-3;
constexpr double kPeriod_s = 0.0125;

std::vector<double> noisy(std::vector<double> values, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise_N);
  for (double& value : values) value += noise(random);
  return values;
}

RigConfig rig_with_force_gauge() {
  RigConfig rig = demo_rig();
  rig.calibration.volts_per_newton = 1.0;  // of an instrument that sends newtons
  return rig;
}

ForceReadings readings_of(const RigConfig& rig, const std::vector<double>& forces_N) {
  ForceReadings readings(rig);
  readings.collect_from(0.0);
  for (std::size_t i = 0; i < forces_N.size(); ++i) {
    LoadSample sample;
    sample.force_N = forces_N[i];
    readings.take(sample, static_cast<double>(i) * kPeriod_s);
  }
  return readings;
}

}  // namespace

TEST_CASE("one garbled reading at any place does not move a mean force", "[rig]") {
  const RigConfig rig = rig_with_force_gauge();
  for (std::size_t at = 0; at < 20; ++at) {
    for (const double garbled_N : {2.0, -0.9, 0.13}) {
      CAPTURE(at, garbled_N);
      std::vector<double> forces_N = noisy(std::vector<double>(20, 0.1));
      const double clean_N = readings_of(rig, forces_N).collected_mean().force_N;
      forces_N[at] = garbled_N;
      const ForceMean found = readings_of(rig, forces_N).collected_mean();
      // 20 um of contact are 0.12 N; a mean over 19 instead of 20 readings moves by 0.03 sd.
      CHECK(found.force_N == Approx(clean_N).margin(0.2 * kNoise_N));
      CHECK(found.sd_N < 2.0 * kNoise_N);
      CHECK(found.n == 19);
      CHECK(found.rate_Hz == Approx(1.0 / kPeriod_s).epsilon(1e-9));
    }
  }
}

TEST_CASE("the mean of a clean force keeps every reading", "[rig]") {
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    std::vector<double> flat(20, 0.1), ramp, relaxing, counts;
    for (int i = 0; i < 20; ++i) {
      ramp.push_back(0.007 * i);
      relaxing.push_back(0.1 + 0.05 * std::exp(-i / 3.0));
      counts.push_back(static_cast<double>((static_cast<unsigned>(i) * seed) % 7 == 0));
    }
    for (const auto& values : {noisy(flat, seed), noisy(ramp, seed), noisy(relaxing, seed)}) {
      CHECK(without_spikes(values).size() == values.size());
    }
    CHECK(without_spikes(counts).size() == counts.size());  // single steps of a quiet converter
    CHECK(without_spikes(relaxing).size() == relaxing.size());
  }
}

TEST_CASE("the sound force is the newest one unless that stands out", "[rig]") {
  const RigConfig rig = rig_with_force_gauge();
  CHECK(readings_of(rig, {0.001, 0.002, 0.003}).sound_force_N(kNoise_N) == Approx(0.003));
  CHECK(readings_of(rig, {0.001, 0.008, 0.015}).sound_force_N(kNoise_N) == Approx(0.015));
  CHECK(readings_of(rig, {0.001, 0.002, 0.012}).sound_force_N(kNoise_N) == Approx(0.002));
  CHECK(readings_of(rig, {0.012}).sound_force_N(kNoise_N) == Approx(0.012));
}

TEST_CASE("the force rises in a move away only by what was read after its start", "[rig]") {
  const RigConfig rig = rig_with_force_gauge();
  ForceReadings readings = readings_of(rig, {0.3, 0.3, 0.3});
  const auto take = [&](double force_N, double made_at_s) {
    LoadSample sample;
    sample.force_N = force_N;
    readings.take(sample, made_at_s);
    return readings.rise_N();
  };
  readings.watch_rise({.from_s = 1.0});
  CHECK(take(0.5, 0.8) <= 0.0);  // late readings of the press before it
  CHECK(take(0.5, 0.9) <= 0.0);
  CHECK(take(0.45, 1.1) <= 0.0);
  CHECK(take(9.0, 1.2) <= 0.0);  // one garbled digit
  CHECK(take(0.45, 1.3) <= 0.0);
  take(0.7, 1.4);
  CHECK(take(0.7, 1.5) == Approx(0.2));
  readings.watch_rise({.from_s = 2.0, .goes_on = true});
  CHECK(take(0.7, 2.1) == Approx(0.2));
  readings.end_rise(2.2);
  take(0.7, 2.3);
  CHECK(take(5.0, 2.4) == Approx(0.2));
  // A punch that is pulled comes free at zero.
  take(-0.5, 2.5);
  take(-0.5, 2.6);
  readings.watch_rise({.from_s = 2.7});
  take(0.01, 2.8);
  CHECK(take(0.01, 2.9) == Approx(0.01));
}

}  // namespace viscard
