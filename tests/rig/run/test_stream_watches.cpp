#include "rig/run/served_devices.h"
#include "rig/run/spike_watch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace viscard {
namespace {

constexpr double kPeriod_s = 0.0125;

// Listens in passes of 5 ms, with a reading every period until quiet_from_s; returns the time at
// which the stream counts as silent.
double silent_at_s(SilenceWatch& watch, double quiet_from_s, bool is_moving) {
  double next_s = 0.0;
  for (double t = 0.0; t < 10.0; t += 0.005) {
    const bool has_arrived = t < quiet_from_s && t >= next_s;
    if (has_arrived) next_s = t + kPeriod_s;
    watch.pass(t, has_arrived, is_moving);
    if (watch.is_silent(kPeriod_s)) return t;
  }
  return 10.0;
}

std::vector<double> noisy(const std::vector<double>& clean, double sigma) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<double> result = clean;
  for (double& value : result) value += noise(random);
  return result;
}

std::vector<std::int64_t> spikes_in(const std::vector<double>& values) {
  SpikeWatch watch;
  std::vector<std::int64_t> found;
  const auto add = [&](const std::vector<std::int64_t>& more) {
    found.insert(found.end(), more.begin(), more.end());
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    add(watch.take(static_cast<std::int64_t>(i), static_cast<double>(i), values[i]));
  }
  add(watch.finish());
  return found;
}

// The forces of a test: rest, ramp, hold with relaxation, quick unloading, peak.
std::vector<double> force_like() {
  std::vector<double> values(200, 1000.0);
  for (int i = 0; i < 80; ++i) values.push_back(1000.0 + 3000.0 * i);
  for (int i = 0; i < 400; ++i) values.push_back(241000.0 - 20000.0 * (1 - std::exp(-i / 50.0)));
  values.push_back(120000.0);  // one reading in the middle of the unloading
  for (int i = 0; i < 200; ++i) values.push_back(25000.0);
  for (int i = 0; i < 50; ++i) values.push_back(25000.0 + 2000.0 * i);
  for (int i = 50; i > 0; --i) values.push_back(25000.0 + 2000.0 * i);
  for (int i = 0; i < 100; ++i) values.push_back(25000.0);
  return values;
}

}  // namespace

TEST_CASE("a silent stream is noticed within a few periods", "[rig]") {
  SilenceWatch watch;
  const double at_s = silent_at_s(watch, 2.0, true);
  CHECK(at_s >= 2.0 + 3 * kPeriod_s - kPeriod_s);
  CHECK(at_s <= 2.0 + 0.1 + 0.010);  // the floor, and a pass or two
}

TEST_CASE(
    "the limit of a stream that is bursty at rest is twice its longest silence, at most 0.25 s",
    "[rig]") {
  SilenceWatch watch;
  for (int i = 1; i <= 30; ++i) watch.pass(0.005 * i, i % 14 == 0, false);  // 70 ms apart
  CHECK(watch.limit_s(kPeriod_s) == Approx(0.140).margin(1e-9));
  for (int i = 31; i <= 200; ++i) watch.pass(0.005 * i, i == 200, false);
  CHECK(watch.limit_s(kPeriod_s) == Approx(0.25).margin(1e-12));
  CHECK(watch.limit_s(0.1) == Approx(0.3).margin(1e-12));  // three periods of a slow converter
}

TEST_CASE("a pause of the machine itself is not taken for silence", "[rig]") {
  SilenceWatch watch;
  watch.pass(0.0, true, true);
  watch.pass(3.0, false, true);  // no pass for 3 s
  CHECK_FALSE(watch.is_silent(kPeriod_s));
  CHECK(watch.silent_s() <= 0.010 + 1e-12);
}

TEST_CASE("ramps, corners, steps and peaks of true forces are no spikes", "[rig]") {
  for (const double sigma : {0.3, 30.0, 300.0, 3000.0}) {
    CAPTURE(sigma);
    CHECK(spikes_in(noisy(force_like(), sigma)).empty());
  }
  CHECK(spikes_in(force_like()).empty());
}

TEST_CASE("a garbled digit that stands out is found at every position", "[rig]") {
  std::vector<double> values = noisy(force_like(), 300.0);
  // 20 times the noise; the one at 250 lies in a ramp of 10 times the noise per reading.
  for (const std::size_t at : {100u, 250u, 450u, 800u}) values[at] += 6000.0;
  CHECK(spikes_in(values) == std::vector<std::int64_t>{100, 250, 450, 800});
}

TEST_CASE("garbled digits are found at the beginning, at the end and side by side", "[rig]") {
  std::vector<double> values = noisy(std::vector<double>(300, 84213.0), 300.0);
  // 20 times the noise, in either direction; 30 if there are neighbours on one side only.
  for (const std::size_t at : {0u, 298u, 299u}) values[at] += 9000.0;
  for (const std::size_t at : {4u, 9u, 150u}) values[at] += 6000.0;
  values[151] -= 6000.0;
  values[200] += 6000.0;
  values[201] += 6000.0;
  CHECK(spikes_in(values) == std::vector<std::int64_t>{0, 4, 9, 150, 151, 200, 201, 298, 299});
}

TEST_CASE("a garbled digit is found although two of the five readings behind it are bad", "[rig]") {
  const double slope = GENERATE(0.0, 3000.0);  // ten times the noise per reading
  for (std::size_t i = 1; i <= 5; ++i) {
    for (std::size_t j = i + 1; j <= 5; ++j) {
      for (const double sign : {1.0, -1.0}) {
        CAPTURE(slope, i, j, sign);
        std::vector<double> values;
        for (int k = 0; k < 300; ++k) values.push_back(84213.0 + slope * k);
        values = noisy(values, 300.0);
        values[150] += 20000.0;
        values[150 + i] += 20000.0;
        values[150 + j] += sign * 20000.0;
        const std::vector<std::int64_t> found = spikes_in(values);
        CHECK(std::count(found.begin(), found.end(), 150) == 1);
        CHECK(found.size() <= 3);
      }
    }
  }
}

TEST_CASE("at rest an error of 8 times the noise is found, and noise is not marked", "[rig]") {
  std::vector<double> values = noisy(std::vector<double>(200000, 84213.0), 300.0);
  CHECK(spikes_in(values).empty());  // 1 in 2 million is expected at most
  std::size_t n_off = 0;
  for (std::size_t at = 1000; at < values.size(); at += 100) {
    values[at] += (at % 200 == 0 ? 8.0 : -8.0) * 300.0;
    ++n_off;
  }
  // The margin is 8 - 6.6 standard deviations of the noise: 92 %. Half of that would fail.
  CHECK(4 * spikes_in(values).size() > 3 * n_off);
  CHECK(spikes_in(values).size() <= n_off + 1);
}

TEST_CASE("an hour of noise has no spikes, and an error of 12 times the noise is found in it",
          "[rig]") {
  std::vector<double> values = noisy(std::vector<double>(300'000, 1000.0), 10.0);
  CHECK(spikes_in(values).empty());
  const std::size_t place = values.size() - 100;
  values[place] = 1000.0 + 12.0 * 10.0;
  CHECK(spikes_in(values) == std::vector<std::int64_t>{static_cast<std::int64_t>(place)});
}

TEST_CASE("readings made a little early or late on a ramp are no spikes", "[rig]") {
  // 40 times the noise per reading, and a fifth of the period of unevenness in time.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> early(-0.2, 0.2);
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back(0.0);
  for (int i = 0; i < 200; ++i) values.push_back(12000.0 * (i + early(random)));
  CHECK(spikes_in(noisy(values, 300.0)).empty());
}

TEST_CASE("the staircase of a coarse stage has no spikes", "[rig]") {
  // One step of 4 um at 4.7 N/mm is 38 times a noise of 0.5 mN.
  for (const double steps_per_reading : {0.02, 0.1, 0.2, 0.38, 0.66, 0.9, 1.3, 2.2}) {
    CAPTURE(steps_per_reading);
    std::vector<double> values(100, 0.0);
    for (int i = 0; i < 200; ++i) {
      values.push_back(38.0 * 300.0 * std::floor(steps_per_reading * i));
    }
    CHECK(spikes_in(noisy(values, 300.0)).empty());
    values[200] += 60.0 * 38.0 * 300.0;
    CHECK(spikes_in(noisy(values, 300.0)) == std::vector<std::int64_t>{200});
  }
}

TEST_CASE("a specimen that relaxes between the steps of a coarse stage makes no spikes", "[rig]") {
  // Steps of 4 um at 4.7 N/mm, as counts; a ramp of 1.1 s with a step in 2.4 of 88 readings.
  constexpr double kStep = 11300.0, kNoise = 330.0, kRelaxing = 0.3, kTau = 24.0;
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int n_found = 0, n_garbled = 0;
  constexpr int kRamps = 200;
  for (int ramp = 0; ramp < kRamps; ++ramp) {
    SpikeWatch watch;
    watch.expect_step(kStep);
    const double phase = share(random);
    double force = 0.0, relaxing = 0.0;
    int n_steps = 0;
    for (int i = 0; i < 400; ++i) {
      const int due = static_cast<int>(std::clamp(i - 150, 0, 88) / 2.4 + phase);
      relaxing *= std::exp(-1.0 / kTau);
      for (; n_steps < due; ++n_steps) {
        force += (1.0 - kRelaxing) * kStep;
        relaxing += kRelaxing * kStep;
      }
      const double garbled = i == 200 ? 10.0 * kStep : 0.0;
      for (const std::int64_t index :
           watch.take(i, i, 12000.0 + force + relaxing + garbled + noise(random))) {
        ++(index == 200 ? n_garbled : n_found);
      }
    }
  }
  CHECK(n_found == 0);
  CHECK(n_garbled == kRamps);
}

TEST_CASE("single steps of a quiet converter are no spikes", "[rig]") {
  std::vector<double> values(100, 5.0);
  values[60] = 6.0;
  values[80] = 4.0;
  CHECK(spikes_in(values).empty());
}

}  // namespace viscard
