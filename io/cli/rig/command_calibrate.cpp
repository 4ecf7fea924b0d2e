#include "io/basics/option_use.h"
#include "io/basics/units.h"
#include "io/cli/rig/calibrate_words.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/fit_request.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

namespace viscard {
namespace {

CommandSyntax calibrate_syntax(CalibrateWords& words) {
  CommandSyntax syntax;
  syntax.usage = "viscard calibrate [--compliance] --rig FILE|--data FILE --out FILE [OPTIONS]";
  syntax.description =
      "Finds the load cell's gain with dead weights put on and taken off again, or with "
      "--compliance\n"
      "the frame's stiffness on a rigid block, each with an uncertainty budget; the record goes to "
      "a\n"
      "file that the rig file names: [calibration] file = \"cell.toml\", [frame] file = "
      "\"frame.toml\".\n"
      "--data takes a table instead of the rig: mass_kg or force_N with volts_V, or position_m "
      "with\n"
      "force_N.";
  syntax.example = "viscard calibrate --emulate --speed 20 --out cell.toml";
  const auto add = [&](const char* name, OptionTarget target, const char* what) -> Option& {
    return syntax.options.add(name, target, what);
  };
  add("rig", &words.rig_file, "rig.toml: port and driver of the load cell");
  add("data", &words.data_file, "table of weights and readings, in the order taken");
  add("compliance", &words.is_compliance, "measure the frame on a rigid block");
  add("weights", &words.weights, "masses to put on the rig, \"20 g, 50 g, 100 g, 200 g\"");
  add("series", &words.series, "number of times to go up and down, on the rig");
  add("mass-u", &words.request.mass_relative_u, "relative standard uncertainty of the masses");
  add("gravity", &words.request.gravity_m_s2, "gravity at this place, \"9.8067 m/s2\"").of("m/s2");
  add("capacity", &words.capacity_N, "rated load of the cell, if there is no rig file").of("N");
  add("nonlinearity", &words.request.nonlinearity,
      "of the cell by its data sheet, share of the capacity (0.001)");
  add("span", &words.request.span_V, "largest voltage of the converter, if there is no rig file")
      .of("V");
  add("settle", &words.settle_s, "wait after putting on a weight").of("s").by_default("1 s");
  add("seconds", &words.mean_s, "time of each mean reading").of("s").by_default("3 s");
  add("to", &words.force_N, "highest force on the block (70 % of the soft limit)")
      .of("N")
      .by_default("");
  add("steps", &words.steps, "number of steps of force on the block");
  add("id", &words.request.id, "name of the record");
  add("valid-until", &words.request.valid_until,
      "last day of validity of the load cell's record (a year from today)");
  add("out", &words.out_file, "record to write (*.toml)");
  add("emulate", &words.is_emulated, "calibrate an emulated rig");
  add("truth", &words.truth_file, "truth.toml: what the emulated cell is like");
  add("speed", &words.speed, "largest speed of the emulated clock over the wall clock");
  add("yes", &words.asks_nobody, "do not wait for Enter before the block is pressed");
  add("unverified", &words.accepts_unverified, kUnverifiedHelp);
  add("force", &words.overwrite, "replace an existing record");
  syntax.results = {result_of_load_cell(), result_of_frame()};
  return syntax;
}

std::vector<double> masses_from(const std::string& text) {
  std::vector<double> masses_kg;
  for (const std::string_view mass : split(text, ',')) {
    try {
      masses_kg.push_back(si_from_text(mass, "kg"));
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--weights: ") + error.what());
    }
    if (!(masses_kg.back() >= 0.0)) throw UsageError("--weights: a mass is negative");
  }
  return masses_kg;
}

// The options that belong to weights or to a block, on the rig or in a table.
OptionUses uses_of(const CommandSyntax& syntax, const CalibrateWords& words) {
  const bool weighs = !words.is_compliance, is_on_rig = !words.data_file;
  const bool waits_for_weights = weighs && is_on_rig && !words.is_emulated;
  const char* const kWeights = "weights (without --compliance)";
  const char* const kOnRig = "weights on the rig (without --compliance and --data)";
  const char* const kBlock = "a block on the rig (--compliance without --data)";
  OptionUses uses{
      {"weights", false, weighs && is_on_rig, kOnRig},
      {"series", false, weighs && is_on_rig, kOnRig},
      {"settle", false, weighs && is_on_rig, kOnRig},
      {"mass-u", false, weighs, kWeights},
      {"gravity", false, weighs, kWeights},
      {"nonlinearity", false, weighs, kWeights},
      {"capacity", false, weighs, kWeights},
      {"span", false, weighs, kWeights},
      {"valid-until", false, weighs, kWeights},
      {"seconds", false, is_on_rig, "readings on the rig (without --data)"},
      {"to", false, !weighs && is_on_rig, kBlock},
      {"steps", false, !weighs && is_on_rig, kBlock},
      {"yes", false, !waits_for_weights && is_on_rig,
       "a block on the rig (--compliance without --data); each weight is put on by hand"},
      {"unverified", false, !is_on_rig, "files (--data)"}};
  for (OptionUse& use : uses) {
    use.is_given = is_given(syntax, use.option);
    use.option.insert(0, "--");
  }
  return uses;
}

// Fills in what follows from other options.
void take_values(const CommandSyntax& syntax, CalibrateWords& words) {
  words.as_json = syntax.as_json;
  words.plausible = given_plausible(syntax);
  if (!words.weights.empty()) words.masses_kg = masses_from(words.weights);
  if (words.capacity_N && !(*words.capacity_N > 0.0))
    throw UsageError("--capacity must be positive");
  words.request.capacity_N = words.capacity_N.value_or(0.0);
}

void check_words(const CommandSyntax& syntax, const CalibrateWords& words) {
  const int n_sources = (words.is_emulated ? 1 : 0) + (words.data_file ? 1 : 0) +
                        (words.rig_file && !words.is_emulated && !words.data_file ? 1 : 0);
  if (words.is_emulated && words.data_file) {
    throw UsageError(
        "--data and --emulate exclude each other: a table has its readings, and an emulated rig "
        "makes its own; omit one of them");
  }
  if (n_sources != 1) {
    throw UsageError(
        "calibrate needs one of --rig FILE (weights on the rig), --data FILE (a table) or "
        "--emulate");
  }
  if (is_given(syntax, "id") && words.request.id.empty()) {
    throw UsageError(
        "--id is empty; give the record a name, such as \"cell-7 2026-11\", or omit it");
  }
  if (words.out_file.empty()) throw UsageError("calibrate needs --out FILE, the record to write");
  refuse_idle<UsageError>(uses_of(syntax, words));
  if (words.series < 1 || words.series > 100) throw UsageError("--series is outside 1 to 100");
  if (words.steps < 3 || words.steps > 100) throw UsageError("--steps is outside 3 to 100");
  if (!(words.mean_s > 0.0) || !(words.settle_s >= 0.0)) {
    throw UsageError("--seconds must be positive and --settle not negative");
  }
  if (!words.is_emulated && (words.truth_file || words.speed != 1.0)) {
    throw UsageError("--truth and --speed are for an emulated rig: add --emulate");
  }
  if (!(words.speed > 0.0) || words.speed > 500.0) {
    throw UsageError(fmt::format("--speed is {}; it must be above 0 and at most 500", words.speed));
  }
  try {
    check_request(words.request);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  refuse_existing(words.out_file, words.overwrite);
}

}  // namespace

int run_calibrate(const Words& words, Streams& streams) {
  CalibrateWords asked;
  CommandSyntax syntax = calibrate_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  take_values(syntax, asked);
  check_words(syntax, asked);
  return asked.is_compliance ? calibrate_frame(asked, streams)
                             : calibrate_load_cell(asked, streams);
}

}  // namespace viscard
