#include "rig/run/rest_findings.h"

#include "models/maths/text_of_number.h"
#include "rig/run/preflight.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kRateOff = 0.2;          // of expected_rate
constexpr double kNoisiest = 0.02;        // of the capacity; contact counts from six times it on
constexpr double kMostDrift_1_s = 0.005;  // of the capacity per second
constexpr double kDriftSigmas = 6.0;
constexpr double kMostAtEnd = 0.05;  // of the readings
constexpr double kMostZeros = 0.2;   // of the readings, where noise would make few
constexpr double kFineDigit = 5e-6;  // of the capacity: every real noise is larger
constexpr double kFewestSteps_m = 5e3, kMostSteps_m = 1e9;
constexpr double kLeastAcceleration_m_s2 = 1e-4, kMostAcceleration_m_s2 = 1e3;
constexpr double kLeastTopSpeed_m_s = 1e-6, kMostTopSpeed_m_s = 10.0;

std::string percent_text(double share) {
  return text_from_number(100.0 * share, share < 0.1 ? 1 : 0) + " %";
}

// One count of the converter over the capacity; 0 if its readings are no counts.
double digit_of(const RigConfig& rig) {
  if (!has_converter(rig.load_cell) || !rig.load_cell.unit.empty()) return 0.0;
  return std::abs(rig.load_cell.volts_per_count / rig.calibration.volts_per_newton) /
         rig.calibration.capacity_N;
}

std::string dead_signal(const RestReadings& seen, const RigConfig& rig) {
  const LifeSigns& life = seen.life;
  const auto n = static_cast<double>(life.n);
  const auto share = [&](std::int64_t part) {
    return static_cast<double>(part) / std::max(1.0, n);
  };
  if (share(life.n_at_end) > kMostAtEnd) {
    return percent_text(share(life.n_at_end)) +
           " of the readings are the end of the converter's range: a wire between the load cell "
           "and its amplifier is open, or far too much presses on the cell. Check the four wires "
           "of the cell, then take away what presses";
  }
  const double digit = digit_of(rig);
  const bool is_fine = digit > 0.0 && digit < kFineDigit;
  const bool has_digits = is_fine || life.usual_step > 3.0 * life.least_step;
  if (life.n_zero > 1 && has_digits && share(life.n_zero) > kMostZeros) {
    return percent_text(share(life.n_zero)) +
           " of the readings are exactly 0, which no converter measures: the board does not reach "
           "its converter. Check the wires between them (data, clock, supply), then the readings "
           "with: viscard rig check";
  }
  if (is_fine && life.n > 1 && life.n_equal >= life.n - life.n_at_end - 1) {
    return "all " + text_from_number(n, 0) +
           " readings are the same number, which no converter of this resolution measures: the "
           "signal is frozen or in saturation. Switch the amplifier off and on, and check its "
           "wires";
  }
  if (life.repeats_values() && (1.0 - life.share_equal()) * seen.rate_Hz <
                                   (1.0 - kRateOff) * rig.load_cell.expected_rate_Hz) {
    return "the board sends " + text_from_number(seen.rate_Hz, 1) + " readings/s, but only " +
           text_from_number((1.0 - life.share_equal()) * seen.rate_Hz, 1) +
           "/s are new ones: it repeats each reading until the converter has made the next. Let it "
           "print each one once, and " +
           remedy_for_slow_readings(rig.load_cell);
  }
  return "";
}

std::string wrong_rate(const RestReadings& seen, const RigConfig& rig) {
  const double expected_Hz = rig.load_cell.expected_rate_Hz;
  if (seen.rate_Hz < (1.0 - kRateOff) * expected_Hz) {
    return "the load cell gives " + text_from_number(seen.rate_Hz, 1) +
           " readings/s, but expected_rate in the rig file is " + text_from_number(expected_Hz, 1) +
           " Hz, so the approach would not stop in time: " +
           remedy_for_slow_readings(rig.load_cell) +
           ", or correct expected_rate under [load_cell] of the rig file";
  }
  if (has_converter(rig.load_cell) && seen.rate_Hz > (1.0 + kRateOff) * expected_Hz) {
    return "the load cell gives " + text_from_number(seen.rate_Hz, 1) +
           " readings/s, but expected_rate in the rig file is " + text_from_number(expected_Hz, 1) +
           " Hz: no converter is so much faster than its clock, so these lines may not be its "
           "readings. Check the board's program, or correct expected_rate under [load_cell] of the "
           "rig file";
  }
  return "";
}

}  // namespace

bool is_proven_by_noise(const RestReadings& seen) {
  return seen.life.shows_noise() && !seen.life.repeats_values();
}

std::vector<RestFinding> findings_at_rest(const RestReadings& seen, const RigConfig& rig) {
  using About = RestFinding::About;
  std::vector<RestFinding> found;
  const auto add = [&](About about, const std::string& text) {
    if (!text.empty()) found.push_back({about, text});
  };
  const double capacity_N = rig.calibration.capacity_N;
  add(About::kSignal, dead_signal(seen, rig));
  add(About::kRate, wrong_rate(seen, rig));
  if (seen.noise_N > kNoisiest * capacity_N) {
    add(About::kNoise,
        "the noise of " + text_from_number(seen.noise_N * 1e3, 1) + " mN per reading is " +
            percent_text(seen.noise_N / capacity_N) + " of the capacity, above " +
            percent_text(kNoisiest) +
            ": no touch could be felt. Look for an open wire of the load cell, shield its wires, "
            "or correct volts_per_newton of the calibration");
  }
  const double free_N = kPressesAtStart * capacity_N;
  const double drift_N_s = std::abs(seen.drift.N_per_s);
  if (std::abs(seen.force_N) <= free_N && drift_N_s > kDriftSigmas * seen.drift.u_N_per_s &&
      drift_N_s > kMostDrift_1_s * capacity_N) {
    add(About::kDrift,
        "the force drifts by " + text_from_number(seen.drift.N_per_s * 1e3, 1) +
            " mN/s while nothing moves, more than " + percent_text(kMostDrift_1_s) +
            " of the capacity per second. Look for an open wire of the load cell; otherwise let "
            "the amplifier warm up, and keep hands and draught away");
  }
  if (std::abs(seen.force_N) > free_N) {
    add(About::kForce,
        "the load cell reads " + text_from_number(seen.force_N, 3) +
            " N before anything was touched, more than " + percent_text(kPressesAtStart) +
            " of its capacity of " + text_from_number(capacity_N, 3) +
            " N. Take away what presses on it, or correct zero_volts of the calibration");
  }
  return found;
}

std::vector<RestFinding> findings_of_stage(const StageDynamics& dynamics) {
  std::vector<RestFinding> found;
  const auto check = [&](double value, double least, double most, double per_mm, const char* what) {
    if (value >= least && value <= most) return;
    found.push_back({RestFinding::About::kStage,
                     "the stage reports " + text_from_number(value * per_mm, 3) + " " + what +
                         "; real stages have " + text_of(least * per_mm) + " to " +
                         text_of(most * per_mm) +
                         ". Its memory was erased or the value mistyped: set it as the maker of "
                         "the stage states"});
  };
  check(dynamics.steps_per_m, kFewestSteps_m, kMostSteps_m, 1e-3, "steps/mm (GRBL: $100 to $102)");
  check(dynamics.acceleration_m_s2, kLeastAcceleration_m_s2, kMostAcceleration_m_s2, 1e3,
        "mm/s2 of acceleration (GRBL: $120 to $122)");
  check(dynamics.max_speed_m_s, kLeastTopSpeed_m_s, kMostTopSpeed_m_s, 1e3,
        "mm/s of largest speed (GRBL: $110 to $112)");
  return found;
}

}  // namespace viscard
