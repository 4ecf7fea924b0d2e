#include "io/cli/command_capture.h"

#include "io/atomic_file.h"
#include "io/capture_file.h"
#include "io/cli/capture_setup.h"
#include "io/cli/command_line.h"
#include "io/cli/progress.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/run_indentation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void ask_to_stop(int) {
  stop_asked = true;
}

// While it lives, Ctrl-C and termination stop the stage first and then end the run.
class StopOnSignal {
 public:
  StopOnSignal() {
    stop_asked = false;
    struct sigaction action {};
    action.sa_handler = ask_to_stop;
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
  }
  ~StopOnSignal() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

CommandSyntax capture_syntax() {
  CommandSyntax syntax;
  syntax.usage = "viscard capture --rig FILE --test FILE --specimen FILE --out FILE [OPTIONS]";
  syntax.description =
      "Runs one stress-relaxation indentation and records every byte of it. With --emulate no rig\n"
      "and no file is needed: a GRBL stage and an HX711 amplifier are emulated behind real ports.\n"
      "Ctrl-C stops the stage, lifts the punch and keeps what was recorded.";
  syntax.example = "viscard capture --emulate --speed 50 --out run.viscap";
  syntax.options.add_options()("rig", po::value<std::string>(), "rig.toml: ports, calibration")(
      "test", po::value<std::string>(), "test.toml: depth, ramp, hold")(
      "specimen", po::value<std::string>(), "specimen.toml: geometry, modulus guess")(
      "out", po::value<std::string>(), "capture file to write (*.viscap)")(
      "emulate", "use an emulated rig")("truth", po::value<std::string>(),
                                        "truth.toml: what the emulated specimen is made of")(
      "seed", po::value<std::uint64_t>(), "seed of the emulated noise")(
      "speed", po::value<double>()->default_value(1.0),
      "emulated clock over wall clock, up to 500")("force", "replace an existing capture file");
  return syntax;
}

CaptureWords words_from(const po::variables_map& values) {
  const auto text = [&](const char* name) {
    return values.count(name) > 0 ? std::optional(values[name].as<std::string>()) : std::nullopt;
  };
  CaptureWords words;
  words.rig_file = text("rig");
  words.test_file = text("test");
  words.specimen_file = text("specimen");
  words.truth_file = text("truth");
  words.out_file = text("out").value_or("");
  words.is_emulated = values.count("emulate") > 0;
  if (values.count("seed") > 0) words.seed = values["seed"].as<std::uint64_t>();
  words.speed = values["speed"].as<double>();
  words.overwrite = values.count("force") > 0;
  words.as_json = values.count("json") > 0;
  return words;
}

void check_before_start(const CaptureWords& words, const CaptureSetup& setup) {
  const Preflight expected = preflight(setup.rig, setup.plan, setup.specimen);
  if (!expected.problems.empty()) throw std::runtime_error(expected.problems.front());
  if (!words.overwrite && std::filesystem::exists(words.out_file)) {
    throw std::runtime_error(
        "'" + words.out_file +
        "' exists already. Choose another --out, or add --force to replace it");
  }
}

std::string percent(double part, double whole) {
  return fmt::format("{:.0f} %", 100 * part / whole);
}

RunControl run_control(const RigClock& clock, Progress& progress, const RigConfig& rig) {
  RunControl control;
  control.clock = &clock;
  control.stop = &stop_asked;
  control.progress = [&progress, &rig](const RunProgress& state) {
    progress.show(
        state.fraction,
        fmt::format("{}  {:.3f} N ({} of the cell)  {:.1f} um", state.phase, state.force_N,
                    percent(state.force_N, rig.calibration.capacity_N), state.depth_m * 1e6));
  };
  return control;
}

// Opens both ports, then the file, then runs.
RunOutcome capture(const CaptureWords& words, const CaptureSetup& setup, const std::string& command,
                   Streams& streams) {
  const RigConfig& rig = setup.rig;
  const StopOnSignal on_signal;
  const RigClock clock(rig.clock_speed);
  RigDevices devices = open_ports(rig, clock);

  CapturedRun about;
  about.rig = rig;
  about.plan = setup.plan;
  about.specimen = setup.specimen;
  about.program = "viscard " VISCARD_VERSION;
  about.command = command;
  CaptureOptions options;
  options.overwrite = words.overwrite;
  CaptureWriter writer(words.out_file, about, options);
  if (setup.truth) {
    std::filesystem::path path = words.out_file;
    write_file(path.replace_extension(".truth.json"), json_from_truth(*setup.truth), true);
  }
  const RecordSink sink =
      failing_once([&writer](const RunRecord& record) { writer.append(record); });
  add_drivers(devices, rig, clock, sink);
  Progress progress(streams, "capture");
  RunOutcome outcome = run_indentation(*devices.stage, *devices.load_cell, rig, setup.plan,
                                       setup.specimen, sink, run_control(clock, progress, rig));
  progress.clear();
  try {
    writer.finish(outcome.status == "finished" ? "finished" : "interrupted");
  } catch (const std::exception& error) {
    if (outcome.reason.empty()) throw;  // otherwise the reason is this very failure
  }
  const std::size_t dropped = writer.counts().dropped;
  if (dropped > 0 && outcome.status == "finished") {
    outcome.status = "interrupted";
    outcome.reason = fmt::format(
        "{} records were lost because the disk did not keep up. Write to a faster disk", dropped);
  }
  return outcome;
}

void print_text(const CaptureWords& words, const RunOutcome& outcome, std::ostream& out) {
  const StreamCounts& stream = outcome.stream;
  out << fmt::format("{}: {}\n", words.out_file, outcome.status)
      << fmt::format("  peak force      {:.4f} N (expected at most {:.4f}, limit {:.4f})\n",
                     outcome.peak_force_N, outcome.expected.peak_force_N, outcome.expected.limit_N)
      << fmt::format("  depth reached   {:.4f} mm\n", outcome.achieved_depth_m * 1e3)
      << fmt::format("  noise           {:.3f} mN per reading\n", outcome.noise_N * 1e3)
      << fmt::format(
             "  readings        expected {}, received {}, missing {}, duplicate {}, glitch {}, "
             "unreadable {}\n",
             stream.expected(), stream.received, stream.missing, stream.duplicate, stream.glitch,
             stream.unreadable)
      << fmt::format("  longest gap     {:.4f} s, at {:.1f} s\n", stream.longest_gap_s,
                     stream.longest_gap_at_s);
}

void print_json(const CaptureWords& words, const RunOutcome& outcome, std::ostream& out) {
  const StreamCounts& stream = outcome.stream;
  nlohmann::ordered_json json;
  json["file"] = words.out_file;
  json["status"] = outcome.status;
  json["reason"] = outcome.reason;
  json["peak_force_N"] = outcome.peak_force_N;
  json["expected_peak_force_N"] = outcome.expected.peak_force_N;
  json["limit_N"] = outcome.expected.limit_N;
  json["depth_m"] = outcome.achieved_depth_m;
  json["contact_position_m"] = outcome.contact_position_m
                                   ? nlohmann::ordered_json(*outcome.contact_position_m)
                                   : nlohmann::ordered_json(nullptr);
  json["noise_N"] = outcome.noise_N;
  json["readings"] = {{"expected", stream.expected()},
                      {"received", stream.received},
                      {"missing", stream.missing},
                      {"duplicate", stream.duplicate},
                      {"glitch", stream.glitch},
                      {"saturated", stream.saturated},
                      {"unreadable", stream.unreadable},
                      {"longest_gap_s", stream.longest_gap_s},
                      {"longest_gap_at_s", stream.longest_gap_at_s}};
  out << json.dump() << "\n";
}

}  // namespace

int run_capture(const std::vector<std::string>& words, Streams& streams) {
  CommandSyntax syntax = capture_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const CaptureWords asked = words_from(*values);
  CaptureSetup setup = capture_setup(asked);
  check_before_start(asked, setup);
  std::unique_ptr<EmulatedRig> emulated;
  if (setup.truth) {
    EmulatedRigOptions options;
    options.truth = *setup.truth;
    options.config = setup.rig;
    emulated = std::make_unique<EmulatedRig>(options);
    setup.rig = emulated->config();
  }
  const RunOutcome outcome = capture(asked, setup, quoted_command_line("capture", words), streams);
  if (asked.as_json) {
    print_json(asked, outcome, streams.out);
  } else {
    print_text(asked, outcome, streams.out);
  }
  if (outcome.status == "finished") return kDone;
  streams.err << "viscard: " << outcome.reason << "\n";
  return kFailed;
}

}  // namespace viscard
