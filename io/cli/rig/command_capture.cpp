#include "io/basics/timestamp.h"
#include "io/cli/rig/capture_words.h"
#include "io/cli/rig/json_errors.h"
#include "io/cli/rig/live_view.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/capture_to_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kPictureWidth = 60;

CommandSyntax capture_syntax(CaptureWords& words) {
  CommandSyntax syntax;
  syntax.usage = "viscard capture --rig FILE --test FILE --specimen FILE... --out FILE [OPTIONS]";
  syntax.description =
      "Runs one indentation test and records every byte of it. With --emulate no rig\n"
      "and no file is needed: a GRBL stage and an HX711 amplifier are emulated behind real ports.\n"
      "Ctrl-C stops the stage, lifts the punch and keeps the record. Several --specimen options "
      "make\n"
      "a series: --out is then a folder, and --resume captures what is not finished in it.";
  syntax.example = "viscard capture --emulate --speed 50 --out run.viscap";
  auto add = syntax.options.add_options();
  add("rig", into(words.rig_file), "rig.toml: ports, calibration");
  add("test", into(words.test_file), "test.toml: depth, ramp, hold");
  add("specimen", po::value(&words.specimen_files),
      "specimen.toml: geometry, modulus guess; repeat for each further specimen");
  add("out", po::value(&words.out_file), "capture file to write (*.viscap), or a folder");
  add("resume", po::bool_switch(&words.resumes),
      "skip finished captures, repeat interrupted ones in files beside them");
  add("yes", po::bool_switch(&words.asks_nobody), "do not wait for Enter between specimens");
  add("live", po::bool_switch(&words.shows_page),
      "keep a page with force against time beside the capture: *.live.html");
  add("acknowledge", po::bool_switch(&words.acknowledges),
      "report on stderr how many records are safe from a crash, and how many from a power cut");
  add("lift", po::bool_switch(&words.lifts_at_start),
      "if the punch presses at the start (after a crash), lift it and go on instead of ending");
  add("uncalibrated", po::bool_switch(&words.is_uncalibrated),
      "capture although the load cell's calibration has expired");
  add("emulate", po::bool_switch(&words.is_emulated), "use an emulated rig");
  add("truth", into(words.truth_file), "truth.toml: what the emulated specimen is made of");
  add("seed", into(words.seed), "seed of the emulated noise");
  add("speed", po::value(&words.speed)->default_value(1.0),
      "largest speed of the emulated clock over the wall clock, up to 500; changes no result");
  add("force", po::bool_switch(&words.overwrite), "replace an existing capture file");
  return syntax;
}

// An expired calibration is refused. One without a date is a warning on a real rig.
void check_calibration(const CaptureWords& words, const CaptureSetup& setup, Streams& streams) {
  if (!words.rig_file || words.is_uncalibrated) return;
  const std::string trouble = calibration_trouble(setup.rig.calibration, today());
  if (trouble.empty()) return;
  if (!last_valid_day(setup.rig.calibration).empty()) {
    throw CodedError("calibration", trouble + "; or add --uncalibrated to capture without one");
  }
  if (!words.is_emulated) streams.err << "viscard: " << trouble << "\n";
}

void check_before_start(const CaptureWords& words, const CaptureSetup& setup, Streams& streams) {
  const Preflight expected = preflight(setup.rig, setup.plan, setup.specimen);
  if (!expected.problems.empty()) throw CodedError("preflight", expected.problems.front());
  for (const std::string& text : expected.warnings) streams.err << "viscard: " << text << "\n";
  const std::filesystem::path file = words.out_file;
  const auto beside = [&](const char* ending) {
    return std::filesystem::path(file).replace_extension(ending);
  };
  refuse_existing(file, words.overwrite);
  if (setup.truth) refuse_existing(beside(kTruthEnding), words.overwrite);
  if (words.shows_page) refuse_existing(beside(kPageEnding), words.overwrite);
}

void print_text(const CaptureOutcome& capture, std::ostream& out) {
  const RunOutcome& outcome = capture.run;
  const StreamCounts& stream = outcome.stream;
  out << fmt::format("{}: {}\n", capture.file, outcome.status)
      << (outcome.line_format.empty() ? std::string()
                                      : fmt::format("  lines read as   {}\n", outcome.line_format))
      << fmt::format("  peak force      {:.4f} N (expected at most {:.4f}, limit {:.4f})\n",
                     outcome.peak_force_N, outcome.expected.peak_force_N, outcome.expected.limit_N)
      << (outcome.contact_position_m
              ? fmt::format("  depth reached   {:.4f} mm\n", outcome.achieved_depth_m * 1e3)
              : std::string("  depth reached   none: no contact was found\n"))
      << fmt::format("  noise           {:.3f} mN per reading\n", outcome.noise_N * 1e3)
      << fmt::format(
             "  readings        expected {}, received {}, missing {}, duplicate {}, glitch {}, "
             "unreadable {}, implausible {}\n",
             stream.expected(), stream.received, stream.missing, stream.duplicate, stream.glitch,
             stream.unreadable, stream.implausible)
      << fmt::format("  longest gap     {:.4f} s, at {:.1f} s\n", stream.longest_gap_s,
                     stream.longest_gap_at_s);
  if (outcome.hidden_error_N > 0.0) {
    out << fmt::format(
        "  checked         against neighbours: errors above {:.3f} mN would show at rest\n",
        outcome.hidden_error_N * 1e3);
  }
  if (outcome.temperature) {
    out << fmt::format("  temperature     {:.2f} C, from {:.2f} to {:.2f} C\n",
                       outcome.temperature->mean_C, outcome.temperature->min_C,
                       outcome.temperature->max_C);
  }
  if (outcome.n_late > 0) {
    out << fmt::format("  computer        late by up to {:.2f} s, {} in all: not watched then\n",
                       outcome.longest_late_s,
                       counted(static_cast<std::size_t>(outcome.n_late), "time"));
  }
  for (const std::string& doubt : outcome.doubts) out << "  doubt           " << doubt << "\n";
  if (!capture.force_N.empty()) {
    out << "  force           " << sparkline(capture.force_N, kPictureWidth) << "\n";
  }
}

// The message also states where the punch was left, which the reason says behind the cause.
ordered_json error_of_run(const RunOutcome& outcome) {
  const bool has_cause = !outcome.cause.empty() && outcome.reason.rfind(outcome.cause, 0) == 0;
  CommandError error = command_error(outcome.code.empty() ? "failed" : outcome.code,
                                     has_cause ? outcome.cause : outcome.reason, outcome.phase);
  if (has_cause) error.message += outcome.reason.substr(outcome.cause.size());
  return ordered_json::parse(json_from_error(error));
}

ordered_json json_from_outcome(const CaptureOutcome& capture) {
  const RunOutcome& outcome = capture.run;
  const StreamCounts& stream = outcome.stream;
  ordered_json json;
  json["file"] = capture.file;
  json["status"] = outcome.status;
  json["reason"] = outcome.reason;
  if (outcome.status != "finished") json["error"] = error_of_run(outcome);
  json["peak_force_N"] = outcome.peak_force_N;
  json["expected_peak_force_N"] = outcome.expected.peak_force_N;
  json["limit_N"] = outcome.expected.limit_N;
  json["depth_m"] = outcome.achieved_depth_m;
  json["contact_position_m"] = outcome.contact_position_m
                                   ? ordered_json(*outcome.contact_position_m)
                                   : ordered_json(nullptr);
  json["noise_N"] = outcome.noise_N;
  json["hidden_error_N"] = outcome.hidden_error_N;
  json["doubts"] = outcome.doubts;
  json["line_format"] = outcome.line_format;
  if (outcome.temperature) {
    json["temperature"] = {{"mean_C", outcome.temperature->mean_C},
                           {"min_C", outcome.temperature->min_C},
                           {"max_C", outcome.temperature->max_C},
                           {"n_readings", outcome.temperature->n_readings}};
  }
  if (!outcome.thermometer_trouble.empty()) {
    json["thermometer_trouble"] = outcome.thermometer_trouble;
  }
  json["computer_late"] = {{"times", outcome.n_late}, {"longest_s", outcome.longest_late_s}};
  json["readings"] = {{"expected", stream.expected()},
                      {"received", stream.received},
                      {"missing", stream.missing},
                      {"duplicate", stream.duplicate},
                      {"glitch", stream.glitch},
                      {"saturated", stream.saturated},
                      {"unreadable", stream.unreadable},
                      {"implausible", stream.implausible},
                      {"longest_gap_s", stream.longest_gap_s},
                      {"longest_gap_at_s", stream.longest_gap_at_s}};
  return json;
}

// Waits until the person has changed the specimen; false if the person ended the series.
bool is_next_ready(const SeriesStep& step, const CaptureWords& words, Streams& streams) {
  if (words.is_emulated || words.asks_nobody) return true;
  streams.err << "Put the specimen of " << step.specimen_file
              << " under the punch and press Enter (q ends here): " << std::flush;
  std::string answer;
  return std::getline(std::cin, answer) && answer.rfind('q', 0) != 0;
}

// Several specimens need a person at a terminal to change them, unless --yes was given.
void check_somebody_is_there(const CaptureWords& words, std::size_t n_left) {
  if (n_left < 2 || words.is_emulated || words.asks_nobody || isatty(STDIN_FILENO) == 1) return;
  throw UsageError(
      "between several specimens capture waits for Enter, but there is no terminal: add --yes if "
      "the "
      "specimens are changed automatically");
}

struct SeriesResult {
  ordered_json runs = ordered_json::array();
  std::string trouble;  // why the series ended early; empty if it did not
};

SeriesResult run_series(const std::vector<SeriesStep>& steps, const CaptureWords& words,
                        const std::string& command, Streams& streams) {
  SeriesResult result;
  bool is_first = true;
  for (const SeriesStep& step : steps) {
    if (!step.finished_file.empty()) {
      result.runs.push_back({{"file", step.finished_file}, {"status", "finished before"}});
      if (!words.as_json) streams.out << step.finished_file << ": finished before\n";
      continue;
    }
    CaptureWords one = words;
    one.out_file = step.out_file;
    const CaptureSetup setup = capture_setup(one, step.specimen_file);
    check_before_start(one, setup, streams);
    check_calibration(one, setup, streams);
    if (!is_first && !is_next_ready(step, words, streams)) {
      result.trouble = "the series was ended before " + step.specimen_file;
      return result;
    }
    is_first = false;
    const CaptureOutcome outcome = capture_once(one, setup, command, streams);
    result.runs.push_back(json_from_outcome(outcome));
    if (!words.as_json) print_text(outcome, streams.out);
    if (outcome.run.status == "finished") continue;
    result.trouble = outcome.run.reason;
    return result;
  }
  return result;
}

int capture(const Words& words, Streams& streams) {
  CaptureWords asked;
  CommandSyntax syntax = capture_syntax(asked);
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  asked.as_json = values->count("json") > 0;
  check_words(asked);
  const std::vector<SeriesStep> steps = series_from_words(asked);
  std::size_t n_left = 0;
  for (const SeriesStep& step : steps) n_left += step.finished_file.empty() ? 1 : 0;
  check_somebody_is_there(asked, n_left);
  const SeriesResult result =
      run_series(steps, asked, quoted_command_line("capture", words), streams);
  if (asked.as_json) {
    ordered_json series = {{"runs", result.runs}, {"reason", result.trouble}};
    if (!result.trouble.empty()) {
      const ordered_json& last = result.runs.empty() ? series : result.runs.back();
      series["error"] =
          last.contains("error")
              ? last["error"]
              : ordered_json::parse(json_from_error(command_error("interrupted", result.trouble)));
    }
    streams.out << (steps.size() == 1 ? result.runs.at(0) : series).dump() << "\n";
  }
  if (result.trouble.empty()) return kDone;
  streams.err << "viscard: " << result.trouble << "\n";
  if (steps.size() > 1 || asked.resumes) {
    streams.err << "viscard: the same command with --resume continues from here\n";
  }
  return kFailed;
}

}  // namespace

int run_capture(const Words& words, Streams& streams) {
  return with_json_errors(words, streams, [&] { return capture(words, streams); });
}

}  // namespace viscard
