#include "fit/large_strain/large_strain_result.h"
#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/input_files.h"
#include "io/flow/large_strain/large_strain_words.h"

#include <nlohmann/json.hpp>

#include <set>

namespace po = boost::program_options;

namespace viscard {
namespace {

// Options of `viscard fit` that have a meaning at large strain.
void refuse_other_options(const po::variables_map& values) {
  static const std::set<std::string> kKnown{
      "file",   "json", "out",  "force",          "model", "column",    "sheet",    "cycle",
      "weight", "svg",  "help", "youngs-modulus", "terms", "max-terms", "plausible"};
  for (const auto& [name, value] : values) {
    if (value.defaulted() || kKnown.count(name) > 0) continue;
    throw UsageError("--" + name + " does not belong to tests at large strain; omit it");
  }
}

}  // namespace

void add_large_strain_options(po::options_description& options) {
  auto add = options.add_options();
  add("weight", po::value<std::string>(),
      "at large strain: equal (default; every stress counts alike) or relative (by its own size)");
  add("youngs-modulus", po::value<std::string>(),
      "at large strain: the modulus at rest that the law must have, such as \"1.8 MPa\" or \"1.8 "
      "MPa +- 0.1 MPa\" (95 %); \"E_inf=1.5 MPa\" is that after all relaxation");
  add("cycle", po::value<std::string>(),
      "at large strain: fit the loading of this cycle of records with unloading (default: the "
      "last), "
      "or all rows");
  add("svg", po::value<std::string>(), "at large strain: draw stress against stretch here");
}

std::vector<LargeStrainFile> large_strain_given(const Words& words,
                                                const po::variables_map& values) {
  std::vector<LargeStrainFile> files;
  try {
    files = large_strain_from_words(words);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  for (const char* option : {"svg", "weight", "youngs-modulus", "cycle"}) {
    if (!files.empty() || values.count(option) == 0) continue;
    throw UsageError(std::string("--") + option +
                     " is for tests at large strain (uniaxial=FILE); omit it");
  }
  return files;
}

int run_large_strain(const std::vector<LargeStrainFile>& files, const po::variables_map& values,
                     Streams& streams) {
  refuse_other_options(values);
  const LargeStrainRequest request = with_usage_errors([&] {
    return large_strain_request(
        {given(values, "model"), given(values, "weight"), given(values, "youngs-modulus"),
         given(values, "cycle"), given(values, "sheet"), given(values, "plausible"),
         given<Words>(values, "column").value_or(Words{}), given<int>(values, "terms"),
         values["max-terms"].defaulted() ? std::nullopt : given<int>(values, "max-terms")},
        files);
  });
  const bool overwrite = values.count("force") > 0;
  const auto out = given(values, "out"), svg = given(values, "svg");
  for (const auto& output : {out, svg}) {
    if (output) refuse_existing(*output, overwrite);
  }
  Words paths;
  for (const LargeStrainFile& file : files) paths.push_back(file.path);
  refuse_repeated_files(paths);
  const FittedLargeStrain fitted = fit_large_strain_files(request);
  if (!print_json(values, {"viscard-hyperelastic/1", paths}, json_from_large_strain(fitted),
                  streams)) {
    print_large_strain(fitted, FittedText(streams));
  }
  if (out) write_file(*out, text_from_json(json_from_large_strain(fitted), 2) + "\n", overwrite);
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
