#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/validation_keys.h"
#include "io/materials/material_file.h"
#include "models/material/liquid.h"
#include "models/pillar/validate_material.h"

#include <fmt/format.h>

#include <ostream>

namespace viscard {
namespace {

std::string csv_from_curve(const ValidationCurve& curve, const char* quantity,
                           const std::string& command) {
  std::string text =
      head_of_table(command) + fmt::format("time_s,{},exact_{}\n", quantity, quantity);
  for (std::size_t i = 0; i < curve.time_s.size(); ++i) {
    text += fmt::format("{},{},{}\n", curve.time_s[i], curve.solver[i], curve.exact[i]);
  }
  return text;
}

void print_result(const ValidationResult& result, const std::string& name, std::ostream& out) {
  out << fmt::format("{}: pillar {:g} um x {:g} um on a fixed base, {} unknowns\n", name,
                     result.diameter_m * 1e6, result.length_m * 1e6, result.unknowns);
  out << fmt::format("  {:<11} {:>22} {:>12} {:>11} {:>8}\n", "test", "largest relative error",
                     "at time (s)", "allowed", "steps");
  const auto row = [&](const char* test, const ValidationCurve& curve) {
    out << fmt::format("  {:<11} {:>22.2e} {:>12.4g} {:>11.0e} {:>8}\n", test,
                       curve.largest_relative_error, curve.at_time_s, result.tolerance,
                       curve.steps);
  };
  row("relaxation", result.relaxation);
  row("creep", result.creep);
  out << "  exact answer: " << result.exact_method << "\n";
  for (const std::string& note : result.notes) out << "  note: " << note << "\n";
  out << (result.passed ? "  passed\n" : "  FAILED\n");
}

}  // namespace

int run_validate(const Words& words, Streams& streams) {
  std::string path;
  std::optional<std::string> relaxation_csv, creep_csv;
  bool overwrite = false;
  ValidateOptions options;
  options.tolerance = 1e-6;
  CommandSyntax syntax{"viscard validate MATERIAL.json [OPTIONS]",
                       "Runs a pillar (40 um across, 120 um long, fixed base) in relaxation and in "
                       "creep with the material through the time-stepping solver and compares with "
                       "the exact answers. Exit status 1 if they differ by more than allowed.",
                       "viscard validate data/materials/pdms_1to10_seed.json"};
  syntax.positional.add("material", &path, "material file");
  syntax.options.add("csv", &relaxation_csv, "write the relaxation curve here");
  syntax.options.add("creep-csv", &creep_csv, "write the creep curve here");
  syntax.options.add("max-error", &options.tolerance, "largest relative error allowed")
      .by_default("1e-6");
  syntax.options.add("force", &overwrite, "overwrite existing files")
      .only_with({"csv", "creep-csv"});
  syntax.results = {{"validate", "viscard validate", {[](ResultVisitor& v) {
                       show_keys(v, ValidationResult{}, "");
                     }}}};
  if (!parse_words(syntax, words, streams)) return kDone;
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0)) {
    throw UsageError("--max-error must lie between 0 and 1");
  }
  const Material material = read_material(path, given_plausible(syntax)).material;
  refuse_liquid(material, path);
  const std::string name = material.name.empty() ? path : material.name;
  const WordsOnSignal words_on_signal("the validation was stopped, and nothing is written");
  Progress progress(streams, "validate");
  options.progress = [&](double fraction) { progress.show(fraction, name); };
  const ValidationResult result = validate_material(material, options);
  progress.clear();

  const std::string command = quoted_command_line("validate", words);
  const auto write = [&](const std::optional<std::string>& file, const ValidationCurve& curve,
                         const char* quantity) {
    if (file) write_file(*file, csv_from_curve(curve, quantity, command), overwrite);
  };
  write(relaxation_csv, result.relaxation, "stress_Pa");
  write(creep_csv, result.creep, "displacement_m");
  const auto show = [&](ResultVisitor& v) { show_keys(v, result, name); };
  if (!print_result(syntax, {"viscard-validate/1", {path}}, show, streams)) {
    print_result(result, name, FittedText(streams));
  }
  if (result.passed) return kDone;
  streams.err << fmt::format(
      "viscard: {}: the pillar differs from the exact answer by {:.2e} in relaxation and {:.2e} in "
      "creep, more than the {:.0e} allowed. Look at the notes, or allow more with --max-error\n",
      name, result.relaxation.largest_relative_error, result.creep.largest_relative_error,
      result.tolerance);
  return kFailed;
}

}  // namespace viscard
