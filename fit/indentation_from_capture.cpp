#include "fit/indentation_from_capture.h"

#include "fit/samples/median.h"
#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

const CommandedMove* first_move(const CapturedRun& run, const std::string& purpose) {
  for (const CommandedMove& move : run.moves) {
    if (move.purpose == purpose) return &move;
  }
  return nullptr;
}

// A reading, its time on the amplifier's clock and its place in the capture.
struct Reading {
  double clock_s = 0.0, host_s = 0.0;
  std::size_t place = 0;
};

bool has_clock(const CapturedRun& run) {
  return std::all_of(run.load_samples.begin(), run.load_samples.end(),
                     [](const LoadSample& s) { return s.device_time_s.has_value(); });
}

// Without a clock the readings are taken as evenly spaced.
double clock_of(const LoadSample& sample, bool has_clock) {
  return has_clock ? *sample.device_time_s : static_cast<double>(sample.index);
}

bool is_usable(const LoadSample& sample) {
  return !sample.is_saturated && !sample.is_glitch &&
         (sample.volts || sample.counts || sample.force_N);
}

// Scatter of the time stamps may swap neighbours. A stamp that goes back by more than this comes
// from a clock that restarted.
double longest_swap_s(const std::vector<Reading>& received) {
  constexpr double kFewReadings = 5.0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < received.size(); ++i) {
    steps.push_back(std::abs(received[i].clock_s - received[i - 1].clock_s));
  }
  return steps.empty() ? 0.0 : kFewReadings * median(std::move(steps));
}

// Readings in the order of their time stamps, without those after a restart of the clock. An equal
// stamp is a reading that was sent twice.
std::vector<Reading> in_order(const std::vector<Reading>& received) {
  if (received.size() < 2) return received;
  const double swap_s = longest_swap_s(received);
  std::vector<Reading> kept;
  double newest_s = received.front().clock_s;
  for (const Reading& reading : received) {
    if (reading.clock_s < newest_s - swap_s) continue;
    newest_s = std::max(newest_s, reading.clock_s);
    kept.push_back(reading);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Reading& a, const Reading& b) { return a.clock_s < b.clock_s; });
  const auto is_repeated = [](const Reading& a, const Reading& b) {
    return a.clock_s == b.clock_s;
  };
  kept.erase(std::unique(kept.begin(), kept.end(), is_repeated), kept.end());
  return kept;
}

std::vector<Reading> usable_readings(const CapturedRun& run) {
  const bool with_clock = has_clock(run);
  std::vector<Reading> received;
  for (std::size_t i = 0; i < run.load_samples.size(); ++i) {
    const LoadSample& sample = run.load_samples[i];
    if (!is_usable(sample)) continue;
    received.push_back({clock_of(sample, with_clock), sample.host_time_s, i});
  }
  return received;
}

ClockLine line_of(const std::vector<Reading>& ordered) {
  std::vector<double> clock_s, host_s;
  for (const Reading& reading : ordered) {
    clock_s.push_back(reading.clock_s);
    host_s.push_back(reading.host_s);
  }
  return line_from_below(clock_s, host_s);
}

struct Readings {
  std::vector<double> time_s, force_N;
};

Readings good_readings(const CapturedRun& run, IndentationData& data) {
  for (const LoadSample& sample : run.load_samples) {
    if (sample.is_saturated) ++data.n_saturated;
    if (sample.is_glitch) ++data.n_glitch;
  }
  const std::vector<Reading> ordered = in_order(usable_readings(run));
  const ClockLine line = line_of(ordered);
  Readings readings;
  for (const Reading& reading : ordered) {
    const std::optional<double> force_N =
        force_N_from_sample(run.load_samples[reading.place], run.rig);
    if (!force_N) {
      throw std::runtime_error(
          "the capture holds raw counts, but its rig has no volts_per_count. Add "
          "it under [load_cell] in the rig file");
    }
    readings.time_s.push_back(line.at(reading.clock_s));
    readings.force_N.push_back(*force_N);
  }
  return readings;
}

// Time at which the last move before `first` has settled.
double still_since_s(const CapturedRun& run, const CommandedMove& first) {
  constexpr double kRinging_s = 0.1;
  double since_s = -1e300;
  for (const CommandedMove& move : run.moves) {
    if (&move == &first) break;
    since_s = std::max(since_s, move.move.start_time_s + duration_s(move.move) +
                                    move.start_uncertainty_s + kRinging_s);
  }
  return since_s;
}

// End of contact, and the time from which the force is zero again; infinite without a retraction.
double free_again_s(const CapturedRun& run, IndentationData& data) {
  const CommandedMove* retract = first_move(run, "retract");
  if (retract == nullptr) return 1e300;
  data.contact_to_s = std::min(data.contact_to_s, retract->move.start_time_s - data.start_early_s);
  return retract->move.start_time_s + duration_s(retract->move) + retract->start_uncertainty_s +
         data.start_early_s + kFreeAgain_s;
}

// The specimen remembers the touch of the approach.
void take_approach(const CapturedRun& run, const CommandedMove& first, IndentationData& data) {
  constexpr double kSamePlace_m = 5e-6;  // a stop is reported with three decimals of a mm
  for (const CommandedMove& move : run.moves) {
    if (&move == &first) break;
    data.approach.push_back(move.move);
  }
  double gap_m = 0.0;
  for (std::size_t m = 0; m < data.approach.size(); ++m) {
    const bool is_last = m + 1 == data.approach.size();
    const StageMove& next = is_last ? first.move : data.approach[m + 1];
    gap_m = std::max(gap_m, std::abs(next.from_m - data.approach[m].to_m));
  }
  if (gap_m > kSamePlace_m) {
    data.approach_doubt = "the moves before the ramp do not follow one another (" +
                          text_of(1e6 * gap_m, 3) + " um are missing)";
  } else if (data.approach.empty() && run.integrity.is_damage_accepted) {
    data.approach_doubt = "the capture is damaged and holds no move before the ramp";
  }
}

// The stage is homed after the test: its acceleration shakes the cell.
double homed_from_s(const CapturedRun& run) {
  for (const RunEvent& event : run.events) {
    if (event.name == "phase" && event.value == "home") return event.host_time_s;
  }
  return 1e300;
}

void take_moves_in_contact(const CapturedRun& run, IndentationData& data) {
  for (const CommandedMove& move : run.moves) {
    const bool in_contact =
        move.move.start_time_s >= data.contact_from_s && move.move.start_time_s < data.contact_to_s;
    if (!in_contact) continue;
    data.moves.push_back(move.move);
    data.start_late_s = std::max(data.start_late_s, move.start_uncertainty_s);
  }
}

// Of the contact, above the mean before it. One reading in a hundred may be a spike.
double largest_force_N(const IndentationData& data) {
  constexpr double kShare = 0.99;
  std::vector<double> in_contact_N;
  double before_N = 0.0;
  int n_before = 0;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] < data.contact_from_s) {
      before_N += data.force_N[i];
      ++n_before;
    } else if (data.time_s[i] <= data.contact_to_s) {
      in_contact_N.push_back(data.force_N[i]);
    }
  }
  if (in_contact_N.empty()) return 0.0;
  const auto place =
      in_contact_N.begin() +
      static_cast<std::ptrdiff_t>(kShare * static_cast<double>(in_contact_N.size() - 1));
  std::nth_element(in_contact_N.begin(), place, in_contact_N.end());
  return std::max(0.0, *place - (n_before > 0 ? before_N / n_before : 0.0));
}

// What to do about a record with too little in it: the usual, unless the file explains it.
std::string remedy(const CapturedRun& run, const std::string& usual) {
  const RecordIntegrity& integrity = run.integrity;
  if (integrity.has_lost_log) {
    return "Its side file " + integrity.lost_log +
           ", which may hold the rest, is missing: copy it to where the capture lies. Without it, "
           "repeat the run with viscard capture";
  }
  if (integrity.n_left_out_samples > 0) {
    return std::to_string(integrity.n_left_out_samples) +
           " readings were left out, because their checksums show that they are not what was "
           "written: use another copy of the capture (viscard export --verify lists the damage)";
  }
  return usual;
}

}  // namespace

ClockLine line_from_below(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2 || !(x.back() > x.front())) return {x.empty() ? 0.0 : y[0] - x[0], 1.0};
  // The least delayed message near each end determines the slope. Which message that is depends on
  // the slope itself, so a few iterations are needed. An edge of the lower convex hull would be a
  // bad substitute: it may be short and tilt the line.
  const std::size_t count = x.size();
  const std::size_t third = std::max<std::size_t>(1, count / 3);
  ClockLine line{0.0, (y.back() - y.front()) / (x.back() - x.front())};
  const auto least_delayed = [&](std::size_t from, std::size_t to) {
    std::size_t best = from;
    for (std::size_t i = from; i < to; ++i) {
      if (y[i] - line.slope * x[i] < y[best] - line.slope * x[best]) best = i;
    }
    return best;
  };
  for (int round = 0; round < 8; ++round) {
    const std::size_t early = least_delayed(0, third);
    const std::size_t late = least_delayed(count - third, count);
    line.slope = (y[late] - y[early]) / (x[late] - x[early]);
  }
  const std::size_t lowest = least_delayed(0, count);
  line.offset_s = y[lowest] - line.slope * x[lowest];
  return line;
}

std::optional<double> usable_force_N(const LoadSample& sample, const RigConfig& rig) {
  return is_usable(sample) ? force_N_from_sample(sample, rig) : std::nullopt;
}

std::vector<double> sample_times_s(const CapturedRun& run) {
  const bool with_clock = has_clock(run);
  const std::vector<Reading> received = usable_readings(run);
  const std::vector<Reading> ordered = in_order(received);
  const ClockLine line = line_of(ordered);
  const double swap_s = longest_swap_s(received);
  std::vector<double> times_s;
  double newest_s = ordered.empty() ? 0.0 : ordered.front().clock_s;
  for (const LoadSample& sample : run.load_samples) {
    const double clock_s = clock_of(sample, with_clock);
    const bool is_known = ordered.size() > 1 && clock_s >= newest_s - swap_s;
    times_s.push_back(is_known ? line.at(clock_s) : sample.host_time_s);
    if (is_usable(sample)) newest_s = std::max(newest_s, clock_s);
  }
  return times_s;
}

IndentationData indentation_from_capture(const CapturedRun& run) {
  IndentationData data;
  validate(run.rig.calibration);
  // A preload, if there is one, is the first contact.
  const CommandedMove* preload = first_move(run, "preload");
  const CommandedMove* ramp = preload != nullptr ? preload : first_move(run, "ramp");
  if (ramp == nullptr) {
    throw std::runtime_error("the capture holds no ramp: the run ended (" + run.status +
                             ") before the punch was driven in. " +
                             remedy(run, "Repeat it with viscard capture"));
  }
  const Readings readings = good_readings(run, data);
  if (readings.time_s.size() < 20) {
    throw std::runtime_error("the capture holds only " + std::to_string(readings.time_s.size()) +
                             " usable force readings (" + std::to_string(data.n_saturated) +
                             " saturated, " + std::to_string(data.n_glitch) + " glitches). " +
                             remedy(run, "Check the amplifier, then repeat the run"));
  }
  data.start_early_s = kStartEarly_s * std::max(1.0, run.rig.clock_speed);
  data.contact_from_s = ramp->move.start_time_s;
  data.first_reading_s = readings.time_s.front();
  data.contact_to_s = readings.time_s.back();
  const double free_s = free_again_s(run, data);
  const double still_s = still_since_s(run, *ramp);
  take_approach(run, *ramp, data);
  const double homed_s = homed_from_s(run);
  take_moves_in_contact(run, data);
  if (data.moves.empty()) {
    throw std::runtime_error(
        "the readings end before the punch is driven in, so there is nothing to fit. " +
        remedy(run, "Repeat the run with viscard capture"));
  }
  for (std::size_t i = 0; i < readings.time_s.size(); ++i) {
    const double t = readings.time_s[i];
    const bool before = t > still_s && t < data.contact_from_s;
    const bool contact = t >= data.contact_from_s && t <= data.contact_to_s;
    if (!before && !contact && !(t > free_s && t < homed_s)) continue;
    data.time_s.push_back(t);
    data.force_N.push_back(readings.force_N[i]);
  }
  data.frame_stiffness_N_m = run.rig.frame.stiffness_N_m;
  data.frame_stiffness_relative_u = run.rig.frame.stiffness_relative_u;
  data.depth_relative_u = run.rig.stage.depth_relative_u;
  data.largest_force_N = largest_force_N(data);
  data.force_relative_u = gain_relative_u(run.rig.calibration, data.largest_force_N);
  data.force_doubt = calibration_range_doubt(run.rig.calibration, data.largest_force_N);
  if (run.specimen.contact.punch_radius_m > 0.0) data.contact = run.specimen.contact;
  return data;
}

}  // namespace viscard
