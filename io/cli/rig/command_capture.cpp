#include "io/cli/rig/capture_summary.h"
#include "io/cli/rig/capture_words.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/capture_setup.h"
#include "io/flow/command_error.h"
#include "io/flow/rig_keys.h"
#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"
#include "rig/run/rest_findings.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

struct SeriesResult {
  std::vector<CaptureOfSeries> runs;
  std::string trouble;  // why the series ended early; empty if it did not
  std::string code = "interrupted";
  std::string unchanged;  // a capture that lacks what homing at the end has shown; empty: none
};

void show_keys(ResultVisitor& v, const SeriesResult& series) {
  v("runs", series.runs,
    "one for each capture, in their order, with the keys of viscard-capture/1");
  v("reason", series.trouble, "why the series ended early; empty: it did not");
  v.when(!series.trouble.empty() || !series.unchanged.empty(), [&] {
    const auto last = series.runs.empty() ? std::nullopt : error_of(series.runs.back());
    v("error",
      series.trouble.empty() ? command_error("file", series.unchanged)
      : last                 ? *last
                             : command_error(series.code, series.trouble),
      "why the series ended early, or a capture lacks what homing at its end has shown");
  });
}

std::vector<DescribedResult> results_of_capture() {
  return {
      described<CaptureOfSeries>("capture", "viscard capture, one test"),
      described<SeriesResult>("capture-series", "viscard capture, several specimens or touches")};
}

CommandSyntax capture_syntax(CaptureWords& words) {
  CommandSyntax syntax;
  syntax.usage = "viscard capture --rig FILE --test FILE --specimen FILE... --out FILE [OPTIONS]";
  syntax.description =
      "Runs one indentation test and records every byte of it. With --emulate no rig\n"
      "and no file is needed: a GRBL stage and an HX711 amplifier are emulated behind real ports.\n"
      "Ctrl-C stops the stage, lifts the punch and keeps the record. Several --specimen options "
      "make\n"
      "a series: --out is then a folder, and --resume captures what is not finished in it. "
      "--repeat touches each specimen several times; viscard fit --joint then separates the "
      "scatter of touches "
      "from that of specimens.";
  syntax.example = "viscard capture --emulate --speed 50 --out run.viscap";
  const auto add = [&](const char* name, OptionTarget target, const char* what) -> Option& {
    return syntax.options.add(name, target, what);
  };
  add("rig", &words.rig_file, "rig.toml: ports, calibration");
  add("test", &words.test_file, "test.toml: depth, ramp, hold");
  add("specimen", &words.specimen_files,
      "specimen.toml: geometry, modulus guess; repeat for each further specimen");
  add("out", &words.out_file, "capture file to write (*.viscap), or a folder");
  add("resume", &words.resumes,
      "skip finished captures, repeat interrupted ones in files beside them");
  add("repeat", &words.repeats,
      "touch each specimen this many times, with a new contact each time; --out is then a folder, "
      "and the touches in it are numbered on");
  add("lift-wait", &words.lift_wait_s,
      "how long the punch stays lifted between two touches, such as \"60 s\" (default)")
      .of("s");
  add("yes", &words.asks_nobody, "do not wait for Enter between specimens");
  add("live", &words.shows_page,
      "keep a page with force against time beside the capture: *.live.html");
  add("acknowledge", &words.acknowledges,
      "report on stderr how many records are safe from a crash, and how many from a power cut");
  add("lift", &words.lifts_at_start,
      "if the punch presses at the start (after a crash), lift it and go on instead of ending");
  add("uncalibrated", &words.is_uncalibrated,
      "capture although the load cell's calibration has expired");
  add("emulate", &words.is_emulated, "use an emulated rig");
  add("truth", &words.truth_files,
      "truth.toml: what the emulated specimen is made of; once, or once for each --specimen");
  add("seed", &words.seed, "seed of the emulated noise");
  add("speed", &words.speed,
      "largest speed of the emulated clock over the wall clock, up to 500; changes no result");
  add("fault", &words.fault,
      "what breaks on the emulated rig, in which phase of the test and how many seconds after it "
      "has begun: frozen@hold+0.5; without @PHASE from the start");
  add("force", &words.overwrite, "replace an existing capture file");
  syntax.may_exist = {"out"};
  syntax.results = results_of_capture();
  return syntax;
}

// A calibration without a date is a warning on a real rig.
void check_calibration(const CaptureWords& words, const CaptureSetup& setup, Streams& streams) {
  if (!words.rig_file || words.is_uncalibrated) return;
  const std::string doubt = refuse_expired_calibration(setup.rig.calibration);
  if (!doubt.empty() && !words.is_emulated) streams.err << "viscard: " << doubt << "\n";
}

void check_before_start(const CaptureWords& words, const CaptureSetup& setup, Streams& streams) {
  const Preflight expected = safe_preflight(setup);
  for (const std::string& text : expected.warnings) streams.err << "viscard: " << text << "\n";
  try {
    check_fault(setup.fault, setup.plan);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + error.what());
  }
  const std::filesystem::path file = words.out_file;
  const auto beside = [&](const char* ending) {
    return std::filesystem::path(file).replace_extension(ending);
  };
  refuse_existing(file, words.overwrite);
  if (setup.truth) refuse_existing(beside(kTruthEnding), words.overwrite);
  if (words.shows_page) refuse_existing(beside(kPageEnding), words.overwrite);
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
void check_somebody_is_there(const CaptureWords& words, const std::vector<SeriesStep>& steps) {
  std::set<std::size_t> left;
  for (const SeriesStep& step : steps) {
    if (step.finished_file.empty()) left.insert(step.specimen);
  }
  if (left.size() < 2 || words.is_emulated || words.asks_nobody || isatty(STDIN_FILENO) == 1)
    return;
  throw UsageError(
      "between several specimens capture waits for Enter, but there is no terminal: add --yes if "
      "the specimens are changed automatically");
}

// "touch 2 of 3: " of a repeated specimen.
std::string touch_text(const SeriesStep& step) {
  if (step.touch == 0) return "";
  return fmt::format("touch {} of {}: ", step.touch, step.last_touch);
}

// Changes the specimen, or waits until it has recovered from the last touch. Returns why the series
// ends here, or nothing.
std::string wait_for(const SeriesStep& step, const SeriesStep* previous, const CaptureWords& words,
                     Streams& streams) {
  if (previous == nullptr) return "";
  if (previous->specimen != step.specimen) {
    return is_next_ready(step, words, streams)
               ? ""
               : "the series was ended before " + touch_text(step) + step.specimen_file;
  }
  if (wait_lifted(step, words, streams)) return "";
  return fmt::format("the series was stopped while the punch was lifted, before touch {} of {}",
                     step.touch, step.last_touch);
}

// Runs one step after the wait before it; false ends the series.
bool run_step(const SeriesStep& step, const SeriesStep* previous, const CaptureWords& words,
              const std::string& command, SeriesHoming& homing, SeriesResult& result,
              Streams& streams) {
  CaptureWords one = words;
  one.out_file = step.out_file;
  const CaptureSetup setup = capture_setup(one, step);
  check_before_start(one, setup, streams);
  check_calibration(one, setup, streams);
  const bool has_answered = homing.has_answered || !setup.rig.load_cell.answered_on.empty();
  if (!words.is_emulated && !has_answered) streams.err << "viscard: " << kUnanswered << "\n";
  result.trouble = wait_for(step, previous, words, streams);
  if (!result.trouble.empty()) return false;
  if (step.touch > 0) streams.err << "viscard: " << touch_text(step) << step.out_file << "\n";
  const CaptureOutcome outcome = capture_once(one, setup, homing, command, streams);
  result.runs.push_back({.file = outcome.file,
                         .run = outcome.run,
                         .specimen = step.touch > 0 ? setup.specimen.id : "",
                         .touch = step.touch});
  if (!words.as_json) print_text(outcome, FittedText(streams));
  if (outcome.run.status == "finished") return true;
  result.trouble = touch_text(step) + outcome.run.reason;
  return false;
}

// What homing after the last run has shown concerns those before it.
void share_count_of_last(SeriesResult& result, const SeriesHoming& homing,
                         const CaptureWords& words, Streams& streams) {
  // Steps that were finished before have no run here.
  const auto behind = std::find_if(result.runs.rbegin(), result.runs.rend(),
                                   [](const CaptureOfSeries& one) { return one.run.has_value(); });
  if (behind == result.runs.rend()) return;
  const RunOutcome& last = *behind->run;
  std::vector<EarlierRun> earlier;
  for (CaptureOfSeries& capture : result.runs) {
    if (capture.run && &capture != &*behind) earlier.push_back({capture.file, &*capture.run});
  }
  if (homing.homed && homing.is_doubtful && !last.count) {
    streams.err << "viscard: a run is doubtful, so the stage was not homed after it, and its count "
                   "was not compared\n";
  }
  for (const UnchangedCapture& one : share_count(earlier, last)) {
    streams.err << "viscard: " << one.why << "\n";
    if (result.unchanged.empty()) result.unchanged = one.why;
    for (CaptureOfSeries& capture : result.runs) {
      if (capture.file == one.path) capture.error = command_error("file", one.why);
    }
  }
  if (!last.count || last.doubts.empty() || words.as_json) return;
  FittedText fitted(streams);
  std::ostream& out = fitted;
  for (const EarlierRun& run : earlier) {
    out << run.path.string() << ": doubtful\n  doubt           " << run.outcome->doubts.back()
        << "\n";
  }
}

SeriesResult run_series(const std::vector<SeriesStep>& steps, const CaptureWords& words,
                        const std::string& command, Streams& streams) {
  SeriesResult result;
  const SeriesStep* previous = nullptr;  // captured by this command
  const auto last = std::find_if(steps.rbegin(), steps.rend(),
                                 [](const SeriesStep& step) { return step.finished_file.empty(); });
  SeriesHoming homing;
  for (const SeriesStep& step : steps) {
    if (!step.finished_file.empty()) {
      result.runs.push_back({.file = step.finished_file, .status = "finished before"});
      if (!words.as_json) streams.out << step.finished_file << ": finished before\n";
      continue;
    }
    try {
      homing.is_last = last != steps.rend() && &step == &*last;
      if (!run_step(step, previous, words, command, homing, result, streams)) return result;
    } catch (const std::exception& error) {
      if (previous == nullptr) throw;  // nothing was captured that the result has to report
      const CommandError why = command_error(error);
      result.trouble = touch_text(step) + failure_text(error, "this run");
      result.code = why.code;
      result.runs.push_back({.file = step.out_file, .status = "not begun", .error = why});
      return result;
    }
    previous = &step;
  }
  share_count_of_last(result, homing, words, streams);
  return result;
}

// What is recorded, and how to go on.
void print_rest(const std::vector<SeriesStep>& steps, const SeriesResult& result,
                const CaptureWords& words, std::ostream& err) {
  const auto n_done =
      std::count_if(result.runs.begin(), result.runs.end(), [](const CaptureOfSeries& run) {
        return status_of(run) == "finished" || status_of(run) == "finished before";
      });
  err << fmt::format("viscard: {} of {} are recorded and kept; ", n_done,
                     counted(steps.size(), "capture"));
  const int last_touch = steps.back().last_touch;
  err << (last_touch > words.repeats
              ? fmt::format("the same command with --repeat {} --resume continues", last_touch)
              : std::string("the same command with --resume continues from here"))
      << "\n";
}

}  // namespace

int run_capture(const Words& words, Streams& streams) {
  CaptureWords asked;
  CommandSyntax syntax = capture_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  asked.as_json = syntax.as_json;
  asked.plausible = given_plausible(syntax);
  check_words(asked);
  const std::vector<SeriesStep> steps = series_from_words(asked);
  check_somebody_is_there(asked, steps);
  const SeriesResult result =
      run_series(steps, asked, quoted_command_line("capture", words), streams);
  if (asked.as_json) {
    const Words inputs = given_words(syntax, {"rig", "test", "specimen", "truth"});
    if (steps.size() == 1) {
      print_result(
          {"viscard-capture/1", inputs}, [&](ResultVisitor& v) { show_keys(v, result.runs.at(0)); },
          streams, -1);
    } else {
      print_result(
          {"viscard-capture-series/1", inputs}, [&](ResultVisitor& v) { show_keys(v, result); },
          streams, -1);
    }
  }
  if (result.trouble.empty()) return result.unchanged.empty() ? kDone : kFailed;
  streams.err << "viscard: " << result.trouble << "\n";
  if (steps.size() > 1 || asked.resumes) {
    print_rest(steps, result, asked, streams.err);
  }
  return kFailed;
}

}  // namespace viscard
