#include "fit/intervals/flags.h"
#include "io/basics/atomic_file.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/fit/fit_next.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/flow/command_error.h"
#include "io/flow/fit_file.h"
#include "io/flow/test_words.h"
#include "io/flow/words/fit_text.h"
#include "io/materials/material_file.h"

#include <exception>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace po = boost::program_options;

namespace viscard {
namespace {

using Numbers = std::vector<double>;

// How to fit.
void add_fit_options(po::options_description& options) {
  auto add = options.add_options();
  add("kind", po::value<std::string>(),
      "indentation, relaxation, creep or dma; by default the columns decide");
  add("terms", po::value<int>(), "use this number of terms instead of choosing one");
  add("max-terms", po::value<int>()->default_value(40), "largest number of terms to try");
  add("liquid", "no equilibrium modulus (by itself if the data show none)");
  add("solid", "keep the equilibrium modulus also where the data do not show it");
  add("allow-negative", "terms may have negative moduli");
  add("noise", po::value<std::string>()->default_value("auto"),
      "white: no inflation for autocorrelation, sigma^2 = rss/(n - p)");
  add("drift",
      "tables of relaxation or indentation: fit a drift linear in time; by default it is tried if "
      "the residual calls for it");
  add("no-drift", "never fit a drift to a table");
  add("full-data", "fit every sample instead of averages in log time");
  add("profiles", "asymmetric intervals of E_inf and times from profile likelihoods");
  add("diagnose",
      "compare by BIC with laws of few parameters: stretched exponential, springpot, fractional "
      "Maxwell, Kelvin-Voigt and Zener");
  add("model", po::value<std::string>(),
      "answer with this law: kww, springpot, fractional-maxwell, fractional-kelvin-voigt or "
      "fractional-zener; its Prony series goes to --out. At large strain: neo-hooke, "
      "mooney-rivlin, "
      "yeoh, ogden-1, ogden-2, ogden-3, arruda-boyce or gent");
  add("bootstrap", po::value<int>(), "intervals from this many resamples of blocks of residuals");
  add("fix", po::value<Words>()->composing(),
      "hold a parameter at a value in SI, such as tau_1=0.2; parameters are E0, E_inf, and E_i, "
      "g_i, tau_i of term i (repeatable, needs --terms)");
  add("bound", po::value<Words>()->composing(),
      "keep a parameter within bounds, such as g_2=0:0.1 (repeatable, needs --terms)");
  add("constraints", po::value<std::string>(), "file with the text of one --fix or --bound a line");
}

// What the data are.
void add_data_options(po::options_description& options) {
  auto add = options.add_options();
  add("column", po::value<Words>()->composing(),
      "NAME=HEADER or NAME=2: the column of a quantity; also NAME=-HEADER and NAME=1e9*HEADER");
  add("sheet", po::value<std::string>(),
      "of an Excel workbook (.xlsx), or the struct of a MATLAB file (.mat); default: the one with "
      "most numbers");
  add("segment", po::value<Words>()->composing(), "use only rows of this segment (repeatable)");
  add("time-zero", po::value<std::string>()->default_value("0"), "time in the table where t = 0");
  add("from", po::value<std::string>(), "fit only rows from this time on, such as \"2 s\"");
  add("to", po::value<std::string>(), "fit only rows up to this time");
  add("hold", po::value<int>(),
      "fit only this hold of the record, from 1, with the ramp that leads to it");
  add("crop", po::value<std::string>(),
      "auto: fit only up to the end of the longest hold (without a depth: from the largest value "
      "to the lift of the punch)");
  add("depth", po::value<std::string>(),
      "constant depth of a table of force and time, such as \"0.1 mm\": gives stiffnesses");
  add("specimen", po::value<std::string>(), "specimen.toml with the geometry under the punch");
  add("punch-diameter", po::value<std::string>(), "of a flat punch, such as \"4.4 mm\"");
  add("layer-thickness", po::value<std::string>(),
      "of the specimen on a rigid base; without it, the specimen is a half-space");
  add("poisson-ratio", po::value<double>(), "default 0.495");
  add("frame-stiffness", po::value<std::string>(),
      "between stage and punch, such as \"10 N/mm\"; needed if depth_m is the stage's position");
  add("reference-temperature", po::value<std::string>(),
      "of the master curve of a table with several temperatures (temperature_C), such as "
      "\"20 degC\"; default: the middle one");
  add("vertical-shift", po::value<std::string>()->default_value("auto"),
      "factors on the moduli of each isotherm of a master curve: auto (if the data clearly need "
      "them), on or off");
  add("density", po::value<std::string>(), "for the material file, such as \"965 kg/m3\"");
  add("ratio", po::value<Numbers>()->composing(),
      "mixing ratio, parts of base to one of curing agent; with --joint once for each file");
}

void show_fit(ResultVisitor& v, const FileOutcome& outcome, const NextMeasurements& next) {
  show_keys(v, outcome);
  v.when(next.has_value(), [&] {
    v.object("next", "what to measure next, if --want asks for it", [&] {
      v("text", next ? text_of_next(*next) : "", "in a sentence");
      v("measurements", next.value_or(std::vector<NextMeasurement>{}), "best first");
    });
  });
}

void show_fits(ResultVisitor& v, const std::vector<FileOutcome>& outcomes) {
  v.list("fits", "one for each file, in their order, with the keys of viscard-fit/1", outcomes,
         [&](const FileOutcome& outcome) {
           show_head(v, {"viscard-fit/1", {outcome.path}});
           show_keys(v, outcome);
         });
}

// Moduli, stiffnesses, forces, and a file that could not be fitted.
std::vector<FileOutcome> examples() {
  FittedFile modulus, stiffness, force;
  stiffness.result.is_stiffness = true;
  stiffness.result.tests.push_back({.is_stiffness = true});
  force.has_no_depth = true;
  return {{"", modulus, nullptr}, {"", stiffness, nullptr}, {"", force, nullptr}, {}};
}

std::vector<DescribedResult> results_of_fit() {
  DescribedResult fit{"fit", "viscard fit FILE, or several tests of one material", {}};
  for (const FileOutcome& one : examples()) {
    fit.examples.emplace_back([one](ResultVisitor& v) { show_fit(v, one, std::nullopt); });
  }
  DescribedResult joint{"joint", "viscard fit --joint, and the file that it writes", {}};
  for (const int degree : {1, kPerRatio}) {
    RatioFit one;
    one.best.form.E0_degree = one.best.form.g_degree = one.best.form.tau_degree = degree;
    one.law.form = one.best.form;
    one.forms.push_back({.form = one.best.form});
    joint.examples.emplace_back([one](ResultVisitor& v) { show_keys(v, one); });
  }
  return {fit,
          {"fits", "viscard fit FILE FILE ...",
           {[](ResultVisitor& v) { show_fits(v, examples()); }}},
          joint,
          described<FittedLargeStrain>("hyperelastic",
                                       "viscard fit of tests at large strain; --out writes the same "
                                       "without version and inputs")};
}

CommandSyntax fit_syntax() {
  CommandSyntax syntax;
  syntax.usage = "viscard fit FILE... [OPTIONS]";
  syntax.description =
      "Fits the instantaneous modulus and a Prony series, with 95 % intervals, to captures "
      "(*.viscap) or tables from any machine. Columns are found by name and unit (force_N, \"Force "
      "[N]\", t (s)). The fit uses the exact loading history and chooses the number of terms "
      "unless it is given. Several tests of one material are fitted together if each states its "
      "kind: relaxation=a.csv creep=b.csv dma=c.csv indentation=d.csv. Tests at large strain give "
      "a law "
      "of rubber: uniaxial=a.csv compression=b.csv planar=c.csv equibiaxial=d.csv (stretch or "
      "nominal "
      "strain, and nominal stress).";
  syntax.example = "viscard fit data/demo/example_relaxation.csv --out material.json";
  add_fit_options(syntax.options);
  add_data_options(syntax.options);
  auto add = syntax.options.add_options();
  add("joint",
      "fit all files together: the law of the material in its mixing ratio, from captures, tables "
      "or material files; --out writes the joint file that viscard card reads");
  add("specimen-id", po::value<Words>()->composing(),
      "with --joint, once for each file: the specimen it was measured on; files with the same id "
      "are repeated touches. Default: id of the capture, column specimen of the table");
  add("own-terms", "with --joint: each mixing ratio keeps its own number of terms");
  add("share", po::value<Words>()->composing(),
      "with --joint: E0, g, tau or one of them (tau_1) is the same at all ratios (repeatable)");
  add_next_option(syntax.options);
  add_large_strain_options(syntax.options);
  add("out", po::value<std::string>(), "material file to write (one input file, or several tests)");
  add("force", "replace an existing material file");
  syntax.positional = {"file"};
  syntax.results = results_of_fit();
  syntax.last_is_repeatable = true;
  syntax.choices = {{"kind", {"indentation", "relaxation", "creep", "dma"}},
                    {"noise", {"auto", "white"}},
                    {"crop", {"auto"}},
                    {"vertical-shift", {"auto", "on", "off"}},
                    {"model",
                     {"kww", "springpot", "fractional-maxwell", "fractional-kelvin-voigt",
                      "fractional-zener", "neo-hooke", "mooney-rivlin", "yeoh", "ogden-1",
                      "ogden-2", "ogden-3", "arruda-boyce", "gent"}},
                    {"share", {"E0", "g", "tau"}}};
  return syntax;
}

void print_as_text(const std::vector<FileOutcome>& outcomes, std::ostream& out) {
  bool is_first = true;
  for (const FileOutcome& outcome : outcomes) {
    if (!outcome.fitted) continue;
    if (!is_first) out << "\n";
    is_first = false;
    print_fit(*outcome.fitted, out);
  }
}

// One file has its keys at the top, several stand in a list.
void print_as_json(const std::vector<FileOutcome>& outcomes, const Words& files,
                   const NextMeasurements& next, Streams& streams) {
  if (outcomes.size() == 1) {
    print_result({"viscard-fit/1", files},
                 [&](ResultVisitor& v) { show_fit(v, outcomes.front(), next); }, streams);
  } else {
    print_result({"viscard-fits/1", files}, [&](ResultVisitor& v) { show_fits(v, outcomes); },
                 streams);
  }
}

// Without a single result the command fails as a whole, with the first reason.
void require_one(const std::vector<FileOutcome>& outcomes) {
  for (const FileOutcome& outcome : outcomes) {
    if (outcome.fitted) return;
  }
  std::rethrow_exception(outcomes.front().error);
}

// Prints one line for each file that failed and for each result that is not to be trusted, and
// returns the exit status.
int report_defects(const std::vector<FileOutcome>& outcomes, std::ostream& err) {
  int status = kDone;
  for (const FileOutcome& outcome : outcomes) {
    if (outcome.fitted && outcome.fitted->result.is_trustworthy) continue;
    status = kFailed;
    if (!outcome.fitted) {
      try {
        std::rethrow_exception(outcome.error);
      } catch (const std::exception& error) {
        err << "viscard: " << error.what() << "\n";
      }
      continue;
    }
    std::string names;
    for (const MaterialFlag& flag : outcome.fitted->result.flags) {
      if (is_defect(flag.name)) names += (names.empty() ? "" : "; ") + flag.text;
    }
    err << "viscard: " << outcome.path << ": the result is not to be trusted: " << names << "\n";
  }
  return status;
}

std::vector<TestFile> tests_given(const Words& words) {
  try {
    return tests_from_words(words);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

int run_fit(const Words& words, Streams& streams) {
  CommandSyntax syntax = fit_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  auto files = required<Words>(*values, "file", syntax);
  if (const auto large = large_strain_given(files, *values); !large.empty()) {
    return run_large_strain(large, *values, streams);
  }
  const FitWords options = fit_words(*values);
  const Words want = next_words(*values, files);
  const auto out = given(*values, "out");
  const std::string command = quoted_command_line("fit", words);
  std::vector<TestFile> tests;
  FitRequest request;
  MaterialRequest about;  // refuses bad words before the fit
  with_usage_errors([&] {
    tests = tests_given(files);
    if (!tests.empty()) files = paths_of(tests);
    refuse_contradictions(options, tests, files.size(), out.has_value());
  });
  const bool overwrite = values->count("force") > 0;
  if (out) refuse_existing(*out, overwrite);
  if (options.joint) {
    JointRequest joint = with_usage_errors([&] { return joint_request(options, files, command); });
    return run_joint_fit(std::move(joint), {out.value_or(""), overwrite, values->count("json") > 0},
                         streams);
  }
  with_usage_errors([&] {
    request = fit_request(options);
    about = material_request(options, command);
  });
  request.needs_modulus = out.has_value();
  if (tests.size() == 1) request.kind = tests.front().kind;
  Progress progress(streams, "fit");
  const FlowProgress show = [&](double done, const std::string& file) {
    progress.show(done, file);
  };
  std::vector<FileOutcome> outcomes;
  if (tests.size() > 1) {
    const FittedFile fitted = fit_tests(tests, request, show);
    outcomes.push_back({fitted.path, fitted, nullptr});
  } else {
    outcomes = fit_each_file(files, request, show);
  }
  progress.clear();
  require_one(outcomes);
  const NextMeasurements next = next_of(outcomes.front(), want);
  const bool as_json = values->count("json") > 0;
  if (!as_json) print_as_text(outcomes, FittedText(streams));
  if (!as_json && next) streams.out << "next: " << text_of_next(*next) << "\n";
  if (out) {
    Material material = material_from_fitted(*outcomes.front().fitted, about);
    if (!options.ratio.empty()) material.mixing_ratio = options.ratio.front();
    write_file(*out, json_from_material(material), overwrite);
  }
  if (as_json) print_as_json(outcomes, files, next, streams);
  return report_defects(outcomes, streams.err);
}

}  // namespace viscard
