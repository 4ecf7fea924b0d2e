#include "rig/rig_check.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/tcp_port.h"
#include "rig/run/preflight.h"
#include "rig/run/rest_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace viscard {
namespace {

constexpr int kFewestReadings = 10;
constexpr double kSlowLink_s = 0.020;
constexpr double kFullLine = 0.95;           // of the bytes per second that a baud rate allows
constexpr double kBits = 10.0;               // of one byte on the wire
constexpr double kBaudReserve = 1.25;        // of the baud rate proposed over the one needed
constexpr double kFallsBehind = 0.01;        // more than the error of a device's clock
constexpr double kFallsBehind_wall_s = 0.1;  // more than a busy machine delays
constexpr double kSlowestShare = 0.9;  // of the expected rate; below it the readings count as late

struct Delay {
  double at_s = 0.0, delay_s = 0.0;
};

struct Readings {
  std::vector<Delay> delays;  // host time minus device time, if the device has a clock
  std::vector<double> force_N;
  double first_made_s = 0.0, last_made_s = 0.0;
  LifeWatch life;
  double shortest_delay_s = 1e9, longest_delay_s = -1e9;
};

// Growth of the delay from the first to the last quarter of the readings; in each quarter the
// smallest delay counts.
double falls_behind(const std::vector<Delay>& delays, const RigClock& clock) {
  const std::size_t quarter = delays.size() / 4;
  if (quarter == 0) return 0.0;
  const auto smaller = [](const Delay& a, const Delay& b) { return a.delay_s < b.delay_s; };
  const auto n = static_cast<std::ptrdiff_t>(quarter);
  const Delay first = *std::min_element(delays.begin(), delays.begin() + n, smaller);
  const Delay last = *std::min_element(delays.end() - n, delays.end(), smaller);
  const double growth_s = last.delay_s - first.delay_s;
  const double over_s = last.at_s - first.at_s;
  const bool is_real =
      growth_s > kFallsBehind * over_s + clock.from_wall_s(kFallsBehind_wall_s) && over_s > 0.0;
  return is_real ? growth_s / over_s : 0.0;
}

int baud_for(double bytes_per_s) {
  constexpr std::array<int, 9> kBauds{9600,   19200,  38400,  57600,  115200,
                                      230400, 460800, 921600, 2000000};
  for (const int baud : kBauds) {
    if (baud >= kBaudReserve * kBits * bytes_per_s) return baud;
  }
  return kBauds.back();
}

// The same over TCP, where only a device server has a baud rate, and the rig file does not know it.
std::string network_trouble(const LoadCellConfig& cell, const RigCheck& check,
                            const std::string& needs, double needed_B_s) {
  const std::string late =
      check.falls_behind > 0.0
          ? "each second the readings fall behind by " + text_from_number(check.falls_behind, 3) +
                " s"
          : "the readings come at " + text_from_number(check.rate_Hz, 1) + "/s and not at the " +
                text_from_number(cell.expected_rate_Hz, 1) + "/s of expected_rate";
  return late + ": " + needs +
         ". Look for the slow part of the way: the network, or the serial line behind a device "
         "server, which "
         "needs " +
         std::to_string(baud_for(needed_B_s)) +
         " baud or more. If the amplifier makes no more readings, set expected_rate under "
         "[load_cell] of the "
         "rig file to their number";
}

// Describes a line that is too slow for an amplifier sending by itself: its readings become older
// and older. "" if the line is fast enough.
std::string lag_trouble(const RigConfig& rig, const RigCheck& check) {
  const LoadCellConfig& cell = rig.load_cell;
  if (!check.is_stream) return "";
  const bool is_slow = check.rate_Hz < kSlowestShare * cell.expected_rate_Hz && !check.has_clock;
  const double rate_Hz = check.has_clock ? check.rate_Hz : cell.expected_rate_Hz;
  const double needed_B_s = check.line_bytes * std::max(rate_Hz, check.rate_Hz);
  const std::string needs = text_from_number(rate_Hz, 0) + " lines/s of " +
                            text_from_number(check.line_bytes, 1) + " bytes need " +
                            text_from_number(needed_B_s, 0) + " bytes/s";
  if (is_tcp_port(cell.port)) {
    return check.falls_behind > 0.0 || is_slow ? network_trouble(cell, check, needs, needed_B_s)
                                               : "";
  }
  const std::string remedy = "Set the amplifier, and baud under [load_cell] of the rig file, to " +
                             std::to_string(std::max(baud_for(needed_B_s), cell.baud)) +
                             " baud or more";
  if (needed_B_s > kFullLine * cell.baud / kBits) {
    return "the readings become older and older: " + needs + ", and " + std::to_string(cell.baud) +
           " baud carry " + text_from_number(cell.baud / kBits, 0) + ". " + remedy;
  }
  if (check.falls_behind > 0.0) {
    return "each second the readings fall behind by " + text_from_number(check.falls_behind, 3) +
           " s: " + needs + ", and the line carries less than its " + std::to_string(cell.baud) +
           " baud. Look for a slower part of it (adapter, radio link); that part needs " +
           std::to_string(baud_for(needed_B_s)) + " baud or more";
  }
  if (!is_slow) return "";
  return "the readings come at " + text_from_number(check.rate_Hz, 1) + "/s and not at the " +
         text_from_number(cell.expected_rate_Hz, 1) +
         "/s of expected_rate, and without a clock in the lines a slow line looks like that too: " +
         needs +
         ". If the amplifier makes no more readings, set expected_rate under [load_cell] "
         "of the rig file to that; otherwise look for the slow part of the line, which needs " +
         std::to_string(baud_for(needed_B_s)) + " baud or more";
}

void advise(const RigConfig& rig, const RestReadings& seen, RigCheck& check) {
  const auto add = [&](bool is_fatal, const std::string& text) {
    check.advice.push_back(text);
    check.is_usable = check.is_usable && !is_fatal;
  };
  const double capacity_N = rig.calibration.capacity_N;
  const bool is_late = check.late_s > 0.0;
  if (is_late) {
    add(true, "this computer was late by " + text_from_number(check.late_s, 2) +
                  " s, so neither the rate nor the delay of the readings is known. Close the "
                  "programs that keep it busy, or start viscard with priority (chrt -f 50 viscard "
                  "...), then check again");
  }
  const std::string lag = is_late ? "" : lag_trouble(rig, check);
  if (!lag.empty()) add(true, lag);
  if (check.rate_Hz < kSlowestReadings_Hz) {
    add(true, text_from_number(check.rate_Hz, 1) +
                  " readings/s are too few to stop an approach in time: " +
                  remedy_for_slow_readings(rig.load_cell));
  } else if (check.rate_Hz < kSlowReadings_Hz) {
    add(false, text_from_number(check.rate_Hz, 1) +
                   " readings/s: an approach waits for a reading after each of its steps. For a "
                   "faster one, " +
                   remedy_for_slow_readings(rig.load_cell));
  }
  bool is_rate_wrong = false;
  for (const RestFinding& found : findings_at_rest(seen, rig)) {
    const bool is_rate = found.about == RestFinding::About::kRate;
    is_rate_wrong = is_rate_wrong || is_rate;
    // A late computer has no rate, and a line that falls behind has its own remedy.
    if (!is_rate || (!is_late && lag.empty())) add(true, found.text);
  }
  for (const RestFinding& found : findings_of_stage(check.dynamics)) add(true, found.text);
  check.is_proven = is_proven_by_noise(seen);
  if (!check.is_proven && rig.load_cell.answered_on.empty() && check.is_usable) {
    add(true,
        "the last digit of the readings hides their noise, so they do not show whether the load "
        "cell measures. Put a finger or a weight on it while 'viscard rig touch --rig FILE' "
        "listens: it writes the day into the rig file (answered_on under [load_cell])");
  }
  if (check.rate_Hz >= kSlowestReadings_Hz && !is_rate_wrong && !is_late && lag.empty() &&
      std::abs(check.rate_Hz / rig.load_cell.expected_rate_Hz - 1.0) > 0.1) {
    add(false, "the readings come at " + text_from_number(check.rate_Hz, 1) +
                   "/s: set expected_rate of the load cell in the rig file to that");
  }
  if (check.jitter_s > kSlowLink_s && !is_late) {
    add(false, "readings are up to " + text_from_number(check.jitter_s * 1e3, 0) +
                   " ms late: with an FTDI adapter set its latency_timer to 1");
  }
  if (check.stream.missing > 0 || check.stream.unreadable > 0) {
    add(false, counted(static_cast<std::size_t>(check.stream.missing), "reading") +
                   " missing and " +
                   counted(static_cast<std::size_t>(check.stream.unreadable), "line") +
                   " unreadable: check the cable");
  }
  if (2 * check.stream.duplicate > check.stream.received) {
    add(false,
        "each line of the load cell comes twice, with the same time, and counts once. Look for a "
        "second print in the program of its board");
  }
  if (check.reads_as == "volts" && rig.load_cell.line_format == "auto") {
    add(false,
        "numbers with a decimal point and without a unit are read as volts: set line_format = "
        "\"volts\" of the load cell in the rig file if they are volts, or unit = \"g\" if they are "
        "weights");
  }
  if (check.noise_N > 0.005 * capacity_N) {
    add(false, "noise of " + text_from_number(check.noise_N * 1e3, 2) +
                   " mN is above 0.5 % of capacity: shield the cell's wires");
  }
}

void take_thermometer(const Thermometer& thermometer, RigCheck& check) {
  check.has_thermometer = true;
  check.temperature_C = thermometer.newest_C();
  check.n_temperatures = thermometer.readings_C().size();
  check.thermometer_trouble = thermometer.trouble();
  if (!check.thermometer_trouble.empty()) {
    check.advice.push_back(
        check.thermometer_trouble +
        ". A run goes on without it, and its temperature is then the note of the "
        "specimen file");
  }
}

}  // namespace

RigCheck check_rig(Stage& stage, LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                   double duration_s, Thermometer* thermometer) {
  const Pump pump = [&] {
    wait_readable({&stage.transport(), &load_cell.transport()}, clock, 0.002);
    load_cell.service();
    stage.service();
    if (thermometer != nullptr) thermometer->service();
  };
  load_cell.accept_restarts(true);  // opening its port may reset a board, late
  load_cell.connect(pump);
  stage.connect(pump);
  if (load_cell.n_restarts() > 0) load_cell.connect(pump);
  load_cell.accept_restarts(false);
  Readings readings;
  load_cell.set_listener([&](const LoadSample& sample) {
    const double made_s = load_cell.made_at_s(sample);
    const double delay_s = sample.host_time_s - made_s;
    if (readings.force_N.empty()) readings.first_made_s = made_s;
    readings.last_made_s = made_s;
    if (sample.device_time_s) {
      readings.delays.push_back({sample.host_time_s, sample.host_time_s - *sample.device_time_s});
    }
    readings.shortest_delay_s = std::min(readings.shortest_delay_s, delay_s);
    readings.longest_delay_s = std::max(readings.longest_delay_s, delay_s);
    const std::optional<double> force_N = force_N_from_sample(sample, rig);
    if (sample.is_saturated) readings.life.take_at_end();
    if (sample.is_glitch || sample.is_saturated || !force_N) return;
    readings.force_N.push_back(*force_N);
    readings.life.take(received_value(sample), made_s);
  });
  const std::size_t n_bytes_before = load_cell.n_bytes();
  const std::int64_t n_before = load_cell.counts().received;
  const int n_late_before = clock.lateness().n_long();
  double late_s = 0.0;
  const double end_s = clock.now_s() + duration_s;
  while (clock.now_s() < end_s) {
    pump();
    if (clock.lateness().n_long() > n_late_before) {
      late_s = std::max(late_s, clock.lateness().newest_long_s());
    }
  }
  load_cell.set_listener({});
  if (thermometer != nullptr) {
    while (thermometer->readings_C().empty() && thermometer->trouble().empty()) pump();
  }

  RigCheck check{.stage_identity = stage.identity(),
                 .dynamics = stage.dynamics(),
                 .position_m = stage.position_m(),
                 .latency = stage.report_latency(),
                 .stream = load_cell.counts(),
                 .reads_as = load_cell.reads_as(),
                 .advice = stage.advice(),
                 .is_usable = true,
                 .late_s = late_s};
  const auto n = static_cast<double>(readings.force_N.size());
  if (readings.life.signs().n_at_end > 0 && n < kFewestReadings) {
    throw RigError(
        "the readings from '" + load_cell.transport().name() +
        "' are the end of the converter's range: a wire between the load cell and its amplifier is "
        "open, or far too much presses on the cell. Check the four wires of the cell");
  }
  if (n < kFewestReadings) {
    throw RigError("only " + text_from_number(n, 0) + " usable readings came in " +
                   text_from_number(duration_s, 1) + " s from '" + load_cell.transport().name() +
                   "'. Check the amplifier and its wires");
  }
  for (const double force_N : readings.force_N) check.force_N += force_N / n;
  for (const double force_N : readings.force_N) {
    check.noise_N += (force_N - check.force_N) * (force_N - check.force_N) / (n - 1.0);
  }
  check.noise_N = std::sqrt(check.noise_N);
  check.rate_Hz = (n - 1.0) / (readings.last_made_s - readings.first_made_s);
  check.jitter_s = (readings.longest_delay_s - readings.shortest_delay_s) / clock.speed();
  check.is_stream = load_cell.sends_by_itself();
  check.has_clock = check.is_stream && !readings.delays.empty();
  check.falls_behind = falls_behind(readings.delays, clock);
  check.line_bytes = static_cast<double>(load_cell.n_bytes() - n_bytes_before) /
                     static_cast<double>(load_cell.counts().received - n_before);
  if (thermometer != nullptr) take_thermometer(*thermometer, check);
  const RestReadings seen{.force_N = check.force_N,
                          .noise_N = check.noise_N,
                          .drift = drift_of(readings.force_N, check.noise_N,
                                            readings.last_made_s - readings.first_made_s),
                          .rate_Hz = check.rate_Hz,
                          .life = readings.life.signs()};
  advise(rig, seen, check);
  return check;
}

}  // namespace viscard
