#include "rig/rig_check.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/run/preflight.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr int kFewestReadings = 10;
constexpr double kSlowLink_s = 0.020;
constexpr double kLeastRate_Hz = 20.0;

struct Readings {
  std::vector<double> force_N;
  double first_made_s = 0.0, last_made_s = 0.0;
  double shortest_delay_s = 1e9, longest_delay_s = -1e9;
};

void advise(const RigConfig& rig, RigCheck& check) {
  const auto add = [&](bool is_fatal, const std::string& text) {
    check.advice.push_back(text);
    check.is_usable = check.is_usable && !is_fatal;
  };
  const double capacity_N = rig.calibration.capacity_N;
  if (check.rate_Hz < kLeastRate_Hz) {
    add(true, text_from_number(check.rate_Hz, 1) +
                  " readings/s are too few to stop an approach in time: " +
                  remedy_for_slow_readings(rig.load_cell));
  } else if (std::abs(check.rate_Hz / rig.load_cell.expected_rate_Hz - 1.0) > 0.1) {
    add(false, "the readings come at " + text_from_number(check.rate_Hz, 1) +
                   "/s: set expected_rate of the load cell in the rig file to that");
  }
  if (check.jitter_s > kSlowLink_s) {
    add(false, "readings are up to " + text_from_number(check.jitter_s * 1e3, 0) +
                   " ms late: with an FTDI adapter set its latency_timer to 1");
  }
  if (check.stream.missing > 0 || check.stream.unreadable > 0) {
    add(false, counted(static_cast<std::size_t>(check.stream.missing), "reading") +
                   " missing and " +
                   counted(static_cast<std::size_t>(check.stream.unreadable), "line") +
                   " unreadable: check the cable");
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
  if (std::abs(check.force_N) > 0.5 * capacity_N) {
    add(true, "the cell reads " + text_from_number(check.force_N, 3) +
                  " N at rest: take away what presses on it, or correct zero_volts");
  }
}

}  // namespace

RigCheck check_rig(Stage& stage, LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                   double duration_s) {
  const Pump pump = [&] {
    wait_readable({&stage.transport(), &load_cell.transport()}, 0.002);
    load_cell.service();
    stage.service();
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
    readings.shortest_delay_s = std::min(readings.shortest_delay_s, delay_s);
    readings.longest_delay_s = std::max(readings.longest_delay_s, delay_s);
    const std::optional<double> force_N = force_N_from_sample(sample, rig);
    if (sample.is_glitch || sample.is_saturated || !force_N) return;
    readings.force_N.push_back(*force_N);
  });
  const double end_s = clock.now_s() + duration_s;
  while (clock.now_s() < end_s) pump();
  load_cell.set_listener({});

  RigCheck check{.stage_identity = stage.identity(),
                 .dynamics = stage.dynamics(),
                 .position_m = stage.position_m(),
                 .latency = stage.report_latency(),
                 .stream = load_cell.counts(),
                 .reads_as = load_cell.reads_as(),
                 .advice = stage.advice(),
                 .is_usable = true};
  const auto n = static_cast<double>(readings.force_N.size());
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
  advise(rig, check);
  return check;
}

}  // namespace viscard
