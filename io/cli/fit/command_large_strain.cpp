#include "fit/large_strain/large_strain_result.h"
#include "io/basics/atomic_file.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/input_files.h"
#include "io/flow/large_strain/large_strain_words.h"

#include <set>

namespace viscard {
namespace {

// Options of `viscard fit` that have a meaning at large strain.
void refuse_other_options(const CommandSyntax& syntax) {
  static const std::set<std::string> kKnown{
      "file",         "json",      "out",           "force",       "model", "column",
      "sheet",        "cycle",     "weight",        "svg",         "color", "youngs-modulus",
      "terms",        "max-terms", "plausible",     "strip-paths", "table", "skip",
      "gauge-length", "area",      "poisson-ratio", "unverified"};
  for (const auto& [name, values] : syntax.given) {
    if (kKnown.count(name) > 0) continue;
    throw UsageError("--" + name + " does not belong to tests at large strain; omit it");
  }
}

}  // namespace

std::vector<LargeStrainFile> large_strain_given(const FitCommand& command,
                                                const CommandSyntax& syntax) {
  std::vector<LargeStrainFile> files;
  try {
    files = large_strain_from_words(command.files);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  for (const char* option : {"weight", "cycle"}) {
    if (!files.empty() || !is_given(syntax, option)) continue;
    throw UsageError(std::string("--") + option +
                     " is for tests at large strain (uniaxial=FILE); omit it");
  }
  return files;
}

int run_large_strain(const std::vector<LargeStrainFile>& files, const FitCommand& command,
                     const CommandSyntax& syntax, Streams& streams) {
  refuse_other_options(syntax);
  const LargeStrainRequest request = with_usage_errors(
      [&] { return large_strain_request(with_shared_options(command.large, command.fit), files); });
  const bool overwrite = command.overwrite;
  const auto &out = command.out, &svg = command.svg;
  for (const auto& output : {out, svg}) {
    if (output) refuse_existing(*output, overwrite);
  }
  Words paths;
  for (const LargeStrainFile& file : files) paths.push_back(file.path);
  refuse_repeated_files(paths);
  const FittedLargeStrain fitted = fit_large_strain_files(request);
  const auto show = [&](ResultVisitor& v) { show_keys(v, fitted); };
  if (!print_result(syntax, {"viscard-hyperelastic/1", paths}, show, streams)) {
    print_large_strain(fitted, FittedText(streams));
  }
  if (out) write_file(*out, file_of_large_strain(fitted), overwrite);
  if (svg) {
    write_file(*svg, svg_from_plot(plot_of_large_strain(fitted), "large-strain"), overwrite);
  }
  const FittedRubber& best = fitted.result.best();
  if (best.is_trustworthy) return kDone;
  std::string why;
  for (const MaterialFlag& flag : best.flags) why += (why.empty() ? "" : "; ") + flag.text;
  streams.err << "viscard: the result is not to be trusted: " << why << "\n";
  return kFailed;
}

}  // namespace viscard
