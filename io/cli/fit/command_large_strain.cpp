#include "fit/large_strain/large_strain_result.h"
#include "io/basics/atomic_file.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/input_files.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/law_stability.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace po = boost::program_options;

namespace viscard {
namespace {

// Options of `viscard fit` that have a meaning at large strain.
void refuse_other_options(const po::variables_map& values) {
  static const std::set<std::string> kKnown{"file",   "json",   "out",   "force",
                                            "model",  "column", "sheet", "cycle",
                                            "weight", "svg",    "help",  "youngs-modulus"};
  for (const auto& [name, value] : values) {
    if (value.defaulted() || kKnown.count(name) > 0) continue;
    throw UsageError("--" + name + " does not belong to tests at large strain; omit it");
  }
}

std::vector<HyperelasticForm> forms_from(const po::variables_map& values) {
  const auto model = given(values, "model");
  if (!model) return hyperelastic_forms();
  for (const HyperelasticForm form : hyperelastic_forms()) {
    if (*model == name_of(form)) return {form};
  }
  throw UsageError("--model " + *model + " is no law of rubber" +
                   did_you_mean(*model, hyperelastic_names()) + " Use " +
                   listed(hyperelastic_names()));
}

ColumnMap columns_from(const po::variables_map& values) {
  try {
    return column_map_from_words(given<Words>(values, "column").value_or(Words{}));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

StressWeight weight_from(const po::variables_map& values) {
  const std::string word = given(values, "weight").value_or("equal");
  if (word == "equal") return StressWeight::kEqual;
  if (word == "relative") return StressWeight::kRelative;
  throw UsageError("--weight " + word + " is not known; use equal or relative");
}

// A number from 1, or "all".
std::optional<int> cycle_from(const po::variables_map& values) {
  const auto word = given(values, "cycle");
  if (!word) return std::nullopt;
  if (*word == "all") return 0;
  const auto number = integer_from_text(*word);
  if (number && *number >= 1 && *number <= 1000000) return static_cast<int>(*number);
  throw UsageError("--cycle " + *word + " must be a number from 1, or all");
}

// "1.8 MPa" or "1.8 MPa +- 0.1 MPa".
std::optional<KnownModulus> modulus_from(const po::variables_map& values) {
  const auto text = given(values, "youngs-modulus");
  if (!text) return std::nullopt;
  try {
    const std::size_t sign = text->find("+-");
    KnownModulus known{si_from_text(trimmed(std::string_view(*text).substr(0, sign)), "Pa"), 0.0};
    if (sign != std::string::npos) {
      const double half = si_from_text(trimmed(std::string_view(*text).substr(sign + 2)), "Pa");
      if (!(half > 0.0)) throw std::invalid_argument("the error must be positive");
      known.se_Pa = half / kNormal95;
    }
    if (!(known.value_Pa > 0.0)) throw std::invalid_argument("a modulus must be positive");
    return known;
  } catch (const std::invalid_argument& error) {
    throw UsageError("--youngs-modulus " + *text + ": " + error.what());
  }
}

std::string stretches(const StableRange& range) {
  const std::string low = range.low_is_open ? "" : text_of(range.low, 3);
  const std::string high = range.high_is_open ? "" : text_of(range.high, 3);
  if (low.empty() && high.empty()) return "all";
  if (low.empty()) return "up to " + high;
  return high.empty() ? "from " + low : low + " to " + high;
}

void print_tests(const FittedLargeStrain& fitted, std::ostream& out) {
  const LargeStrainResult& result = fitted.result;
  out << fmt::format("  {:<16} {:>8} {:>18} {:>16}\n", "test", "readings", "stretch",
                     "left by law kPa");
  for (const RubberTestSummary& test : result.tests) {
    out << fmt::format("  {:<16} {:>8} {:>18} {:>16.3g}\n", test.name, test.n_readings,
                       text_of(test.least_stretch, 4) + " to " + text_of(test.largest_stretch, 4),
                       1e-3 * test.rms_Pa);
  }
  for (std::size_t i = 0; i < result.tests.size(); ++i) {
    const CycleChoice& choice = fitted.cycles[i];
    if (choice.fitted == 0) continue;
    out << fmt::format("  {}: the loading of cycle {} of {} is fitted; {} left out (--cycle)\n",
                       result.tests[i].name, choice.fitted, choice.n_cycles,
                       counted(choice.n_left_out, "row"));
  }
}

void print_laws(const LargeStrainResult& result, std::ostream& out) {
  out << fmt::format("\n  {:<14} {:>10} {:>9} {:>10} {:>10} {:>22}   {}\n", "law", "parameters",
                     "rms %", "BIC", "E0 kPa", "95 %", "stable stretches (uniaxial)");
  for (std::size_t i = 0; i < result.laws.size(); ++i) {
    const FittedRubber& law = result.laws[i];
    out << fmt::format("{} {:<14} {:>10} {:>9.3g} {:>10.2f} {:>10.5g} {:>22}   {}{}\n",
                       i == result.chosen ? "*" : " ", name_of(law.law.form), law.n_parameters,
                       100.0 * law.rms_relative, law.bic, 1e-3 * law.E0_Pa,
                       fmt::format("{:.5g} to {:.5g}", 1e-3 * law.E0_interval_95.low,
                                   1e-3 * law.E0_interval_95.high),
                       stretches(law.stable[0]), law.is_trustworthy ? "" : "   !");
  }
}

void print_best(const LargeStrainResult& result, std::ostream& out) {
  const FittedRubber& best = result.best();
  out << "\n  " << name_of(best.law.form) << "\n";
  for (const LawParameter& one : best.parameters) {
    out << fmt::format("    {:<16} {:>14.6g}   95 % {:.6g} to {:.6g}\n", one.name, one.value,
                       one.interval_95.low, one.interval_95.high);
  }
  if (best.inflation > 1.0) {
    out << fmt::format(
        "    (variances times {:.3g}: the law leaves a structure in the residuals)\n",
        best.inflation);
  }
  for (std::size_t d = 0; d < best.stable.size(); ++d) {
    out << fmt::format("    stable stretches, {:<12} {}\n", deformation_names()[d],
                       stretches(best.stable[d]));
  }
  for (const MaterialFlag& flag : best.flags) out << "  " << flag.name << ": " << flag.text << "\n";
  for (const MaterialFlag& flag : result.notes) {
    out << "  " << flag.name << ": " << flag.text << "\n";
  }
}

void print_large_strain(const FittedLargeStrain& fitted, std::ostream& out) {
  std::size_t n_readings = 0;
  for (const LargeStrainTest& test : fitted.tests) n_readings += test.stretch.size();
  out << counted(fitted.tests.size(), "test") << " at large strain, "
      << counted(n_readings, "reading") << "\n";
  print_tests(fitted, out);
  print_laws(fitted.result, out);
  print_best(fitted.result, out);
}

}  // namespace

void add_large_strain_options(po::options_description& options) {
  auto add = options.add_options();
  add("weight", po::value<std::string>(),
      "at large strain: equal (default; every stress counts alike) or relative (by its own size)");
  add("youngs-modulus", po::value<std::string>(),
      "at large strain: the modulus at rest that the law must have, such as \"1.8 MPa\" or \"1.8 "
      "MPa "
      "+- 0.1 MPa\" (95 %)");
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
  LargeStrainRequest request;
  request.files = files;
  request.columns = columns_from(values);
  request.sheet = given(values, "sheet").value_or("");
  request.options.forms = forms_from(values);
  request.options.weight = weight_from(values);
  request.options.modulus = modulus_from(values);
  request.cycle = cycle_from(values);
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
  if (out) write_file(*out, json_from_large_strain(fitted).dump(2) + "\n", overwrite);
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
