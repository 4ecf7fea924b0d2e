#include "io/cli/fit/command_fit.h"

#include "fit/intervals/flags.h"
#include "io/basics/atomic_file.h"
#include "io/cli/fit/fit_batch.h"
#include "io/cli/fit/fit_joint.h"
#include "io/cli/fit/fit_material.h"
#include "io/cli/fit/fit_options.h"
#include "io/cli/fit/fit_output.h"
#include "io/cli/words/command_line.h"
#include "io/materials/material_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

using Words = std::vector<std::string>;

CommandSyntax fit_syntax() {
  CommandSyntax syntax;
  syntax.usage = "viscard fit FILE... [OPTIONS]";
  syntax.description =
      "Finds the instantaneous modulus and a Prony series, with 95 % intervals, in captures "
      "(*.viscap)\n"
      "or tables from any machine. Columns are found by name and unit (force_N, \"Force [N]\", t "
      "(s)).\n"
      "Times come from the exact history of loading; the number of terms is chosen unless given.";
  syntax.example = "viscard fit data/demo/example_relaxation.csv --out material.json";
  syntax.options.add_options()(
      "kind", po::value<std::string>(),
      "indentation, relaxation, creep or dma; default: by the columns there are")(
      "terms", po::value<int>(), "this number of terms instead of a choice")(
      "max-terms", po::value<int>()->default_value(40), "largest number tried")(
      "liquid", "no equilibrium modulus")("allow-negative", "terms may have negative moduli")(
      "noise", po::value<std::string>()->default_value("auto"),
      "white: no inflation for autocorrelation, sigma^2 = rss/(n - p)")(
      "full-data", "every sample for itself instead of averages in log time")(
      "profiles", "intervals of E_inf and times from profile likelihoods (asymmetric)")(
      "diagnose", "compare with a power law between two plateaus (fractional Zener) by BIC")(
      "bootstrap", po::value<int>(), "intervals from this many resamples of blocks of residuals")(
      "column", po::value<Words>()->composing(),
      "NAME=HEADER or NAME=2: where a column is, also -HEADER and 1e9*HEADER")(
      "segment", po::value<Words>()->composing(), "only rows of this segment (repeatable)")(
      "time-zero", po::value<std::string>()->default_value("0"), "time of the table that is t = 0")(
      "specimen", po::value<std::string>(), "specimen.toml: geometry under the punch")(
      "punch-diameter", po::value<std::string>(), "of a flat punch, for instance \"4.4 mm\"")(
      "layer-thickness", po::value<std::string>(),
      "of the specimen on a rigid base; left out: deep")("poisson-ratio", po::value<double>(),
                                                         "default 0.495")(
      "frame-stiffness", po::value<std::string>(),
      "when depth_m is the stage's: \"10 N/mm\" between stage and punch")(
      "reference-temperature", po::value<std::string>(),
      "of the master curve that a table with several temperatures (temperature_C) becomes: \"20 "
      "degC\"; default: the middle one")("density", po::value<std::string>(),
                                         "for the material file, for instance \"965 kg/m3\"")(
      "out", po::value<std::string>(), "material file to write (one input file)")(
      "force", "replace an existing material file")(
      "ratio", po::value<std::vector<double>>()->composing(),
      "mixing ratio, parts of base to one of curing agent; with --joint once for each file")(
      "joint",
      "all files together: the law of the material in its mixing ratio, from captures, tables or "
      "material files; --out takes the joint file that viscard card reads")(
      "fix", po::value<Words>()->composing(),
      "tau_1=0.2: this parameter at this value, in SI; E0, E_inf, and E_i, g_i, tau_i of term i "
      "(repeatable, needs --terms)")("bound", po::value<Words>()->composing(),
                                     "g_2=0:0.1: this parameter within bounds")(
      "constraints", po::value<std::string>(), "file with one --fix or --bound text a line")(
      "share", po::value<Words>()->composing(),
      "with --joint: E0, g or tau, or one of them (tau_1), the same at all ratios (repeatable)");
  syntax.positional = {"file"};
  syntax.last_is_repeatable = true;
  return syntax;
}

int run_joint(const po::variables_map& values, const Words& files, const std::string& command,
              Streams& streams) {
  JointWords joint{.files = files, .fit = words_from(values)};
  if (values.count("ratio") > 0) joint.ratios = values["ratio"].as<std::vector<double>>();
  if (values.count("share") > 0) joint.shared = values["share"].as<Words>();
  joint.material = material_words(values, command);
  if (values.count("out") > 0) joint.out = values["out"].as<std::string>();
  joint.overwrite = values.count("force") > 0;
  joint.json = values.count("json") > 0;
  return run_joint_fit(joint, streams);
}

void print(const std::vector<FittedFile>& fitted, bool as_json, std::ostream& out) {
  if (!as_json) {
    for (const FittedFile& file : fitted) {
      if (&file != &fitted.front()) out << "\n";
      print_fit(file, out);
    }
    return;
  }
  if (fitted.size() == 1) {
    out << json_from_fit(fitted.front()).dump(2) << "\n";
    return;
  }
  nlohmann::ordered_json json;
  json["fits"] = nlohmann::ordered_json::array();
  for (const FittedFile& file : fitted) json["fits"].push_back(json_from_fit(file));
  out << json.dump(2) << "\n";
}

// One line for each result that must not be trusted.
int report_defects(const std::vector<FittedFile>& fitted, std::ostream& err) {
  int status = kDone;
  for (const FittedFile& file : fitted) {
    if (file.result.is_trustworthy) continue;
    status = kFailed;
    std::string names;
    for (const MaterialFlag& flag : file.result.flags) {
      if (is_defect(flag.name)) names += (names.empty() ? "" : "; ") + flag.text;
    }
    err << "viscard: " << file.path << ": the result is not to be trusted: " << names << "\n";
  }
  return status;
}

}  // namespace

int run_fit(const Words& words, Streams& streams) {
  CommandSyntax syntax = fit_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("file") == 0) {
    throw UsageError(std::string("which file? usage: ") + syntax.usage);
  }
  const auto files = (*values)["file"].as<Words>();
  const bool has_out = values->count("out") > 0;
  const bool is_joint = values->count("joint") > 0;
  if (!is_joint && values->count("share") > 0) throw UsageError("--share needs --joint");
  if (!is_joint && values->count("ratio") > 0 && files.size() > 1) {
    throw UsageError("--ratio is of one file here; with --joint once for each");
  }
  if (has_out && files.size() > 1 && !is_joint) {
    throw UsageError("--out takes the material of one input file; fit the " +
                     std::to_string(files.size()) + " files one by one");
  }
  const bool overwrite = values->count("force") > 0;
  if (has_out && !overwrite && std::filesystem::exists((*values)["out"].as<std::string>())) {
    throw std::runtime_error(
        "'" + (*values)["out"].as<std::string>() +
        "' exists already. Choose another --out, or add --force to replace it");
  }
  if (is_joint) return run_joint(*values, files, quoted_command_line("fit", words), streams);
  FitWords fit_words = words_from(*values);
  fit_words.needs_modulus = has_out;
  const FittedMaterialWords about =
      material_words(*values, quoted_command_line("fit", words));  // before the work
  const std::vector<FittedFile> fitted = fit_files(files, fit_words, streams);
  print(fitted, values->count("json") > 0, streams.out);
  if (has_out) {
    Material material = material_from_fitted(fitted.front(), about);
    if (values->count("ratio") > 0) {
      material.mixing_ratio = (*values)["ratio"].as<std::vector<double>>().front();
    }
    write_file((*values)["out"].as<std::string>(), json_from_material(material), overwrite);
  }
  return report_defects(fitted, streams.err);
}

}  // namespace viscard
