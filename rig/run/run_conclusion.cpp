#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"
#include "rig/run/count_comparison.h"
#include "rig/run/test_run.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <utility>

namespace viscard {
namespace {

constexpr double kHighForce = 1.5;  // of the expected peak, which is an upper bound
constexpr double kFlatForce = 0.2;  // of the expected peak: below this the punch hardly pressed
constexpr double kLongGap_s = 1.0;  // wall time without a reading
constexpr double kLongGapPeriods = 20.0;

// A stage that has lost steps still reports the commanded depth; only the force shows that the
// punch is not there.
void doubt_flat_force(RunSession& session, RunOutcome& outcome) {
  const double expected_N = outcome.expected.peak_force_N;
  if (outcome.status != "finished" || outcome.peak_force_N > kFlatForce * expected_N) return;
  outcome.doubts.push_back("the force reached only " + text_from_number(outcome.peak_force_N, 4) +
                           " N of the " + text_from_number(expected_N, 4) +
                           " N expected. Did the stage lose steps, or is modulus_guess of the "
                           "specimen far too high?");
  session.event("doubt", "force_flat", outcome.doubts.back());
}

void doubt_high_force(RunSession& session, RunOutcome& outcome) {
  const double expected_N = outcome.expected.peak_force_N;
  if (outcome.status != "finished" ||
      outcome.peak_force_N <= kHighForce * expected_N + 6.0 * outcome.noise_N)
    return;
  outcome.doubts.push_back("the force reached " + text_from_number(outcome.peak_force_N, 3) +
                           " N, where at most " + text_from_number(expected_N, 3) +
                           " N was expected. Are punch_diameter and layer_thickness right, or is "
                           "modulus_guess of the specimen far too low?");
  session.event("doubt", "force_high", outcome.doubts.back());
}

// A stream of bare counts does not show whether the amplifier restarted in a long pause, and lost
// its tare.
void doubt_gap(RunSession& session, RunOutcome& outcome, double most_s) {
  if (outcome.status != "finished" || outcome.stream.longest_gap_s < most_s) return;
  // Readings that were only delayed have arrived since.
  if (static_cast<double>(outcome.stream.missing) * session.load_cell().period_s() < 0.5 * most_s) {
    return;
  }
  outcome.doubts.push_back("no reading came for " +
                           text_from_number(outcome.stream.longest_gap_s, 2) + " s, at " +
                           text_from_number(outcome.stream.longest_gap_at_s, 1) +
                           " s. Did the amplifier restart, and is its zero the same?");
  session.event("doubt", "gap", outcome.doubts.back());
}

// Text carries no checksum, so an unreadable line means that some readable ones are wrong as well.
// A digit has 80 single-bit errors, of which 30 make another digit: for each unreadable line expect
// 0.6 readable errors. For each marked reading expect one more error too small to stand out,
// because about half of the digits of a count are below that threshold.
void doubt_line(RunSession& session, RunOutcome& outcome) {
  constexpr double kReadableToNot = 30.0 / 50.0;
  const StreamCounts& stream = outcome.stream;
  // Then only readings that stand out are doubtful.
  const bool has_check = session.load_cell().has_check();
  if ((has_check ? 0 : stream.unreadable) + stream.implausible == 0) return;
  const double n_hidden = std::ceil(kReadableToNot * static_cast<double>(stream.unreadable) +
                                    static_cast<double>(stream.implausible));
  outcome.doubts.push_back(counted(static_cast<std::size_t>(stream.unreadable), "line") +
                           " of the load cell could not be read and " +
                           counted(static_cast<std::size_t>(stream.implausible), "reading") +
                           " stood out of the neighbours (these are left out of a fit): about " +
                           text_from_number(n_hidden, 0) +
                           " more readings may be wrong by less than can be detected, about 8 "
                           "times the noise. Check its "
                           "cable and its ground");
  session.event("doubt", "line_noise", outcome.doubts.back());
}

// A run without a temperature, or with one that drifted, is a valid run, but its temperature should
// not go into the material.
void doubt_temperature(RunSession& session, const RigConfig& rig, RunOutcome& outcome) {
  const Thermometer* thermometer = session.thermometer();
  if (thermometer == nullptr) return;
  outcome.temperature = run_temperature(thermometer->readings_C());
  outcome.thermometer_trouble = thermometer->trouble();
  std::string silent = thermometer->trouble();
  if (silent.empty() && thermometer->longest_silence_s() > silent_after_s(rig.thermometer)) {
    silent = "the thermometer on " + thermometer->name() + " was silent for " +
             text_from_number(thermometer->longest_silence_s(), 1) + " s";
  }
  const std::string drift =
      outcome.temperature
          ? temperature_drift_text(*outcome.temperature, rig.thermometer.drift_limit_K)
          : "";
  for (const auto& [name, text] :
       {std::pair{kThermometerSilent, silent}, std::pair{kTemperatureDrift, drift}}) {
    if (text.empty()) continue;
    outcome.doubts.push_back(text);
    session.event("doubt", name, text);
  }
}

// Every record states which errors would have been detected, even if none was found.
void record_hidden_error(RunSession& session, RunOutcome& outcome) {
  if (outcome.noise_N <= 0.0) return;  // ended before the noise was measured
  outcome.hidden_error_N = SpikeWatch::kSurelyFound * outcome.noise_N;
  session.event(
      "checked", text_from_number(outcome.hidden_error_N, 6),
      std::string(session.load_cell().has_check() ? "Each reading carries a checksum, and they"
                                                  : "The line carries no checksum: readings") +
          " were compared with their neighbours, "
          "which shows errors above " +
          text_from_number(outcome.hidden_error_N * 1e3, 3) +
          " mN at rest, and above twice the step between readings on a ramp; of the first "
          "five and the last two readings above twice that");
}

// What fails after an early end is added to its reason.
void record(RunOutcome& outcome, const std::function<void()>& part) {
  try {
    part();
  } catch (const std::exception& error) {
    if (outcome.reason.empty()) throw;
    outcome.reason += "; besides: " + failure_text(error, "the end of the run");
  }
}

}  // namespace

void judge_record(RunSession& session, const RigConfig& rig, const RunControl& control,
                  RunOutcome& outcome) {
  const RigClock& clock = *control.clock;
  outcome.peak_force_N = session.peak_force_N();
  outcome.stream = session.load_cell().counts();
  outcome.n_late = session.n_late();
  outcome.longest_late_s = session.longest_late_s();
  outcome.line_format = session.load_cell().line_format();
  record(outcome, [&] {
    session.finish_marking();
    const std::vector<std::string>& seen = session.doubts();
    outcome.doubts.insert(outcome.doubts.end(), seen.begin(), seen.end());
    outcome.stream.implausible += session.n_implausible();
    record_hidden_error(session, outcome);
    doubt_line(session, outcome);
    doubt_flat_force(session, outcome);
    doubt_high_force(session, outcome);
    doubt_temperature(session, rig, outcome);
    doubt_gap(
        session, outcome,
        std::max(kLongGapPeriods * session.load_cell().period_s(), clock.from_wall_s(kLongGap_s)));
  });
}

void record_end(RunSession& session, const std::string& why, RunOutcome& outcome) {
  record(outcome, [&] {
    record_depth(session, why, outcome);
    session.event(outcome.status, outcome.reason.empty() ? "" : "reason",
                  outcome.reason.empty() ? "The run is complete" : outcome.reason);
  });
}

}  // namespace viscard
