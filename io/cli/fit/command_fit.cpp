#include "fit/intervals/flags.h"
#include "io/basics/atomic_file.h"
#include "io/basics/written_path.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/command_error.h"
#include "io/flow/fit_file.h"
#include "io/flow/test_words.h"
#include "io/flow/words/fit_text.h"
#include "io/materials/material_file.h"
#include "io/plots/plot.h"
#include "io/report/report_figures.h"
#include "models/maths/failure_text.h"

#include <exception>
#include <functional>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

void show_fit(ResultVisitor& v, const FileOutcome& outcome, const NextMeasurements& next,
              bool with_curves) {
  show_keys(v, outcome);
  v.when(with_curves, [&] { show_curves(v, outcome.fitted ? *outcome.fitted : FittedFile{}); });
  v.when(next.has_value(), [&] {
    v.object("next", "what to measure next, if --want asks for it", [&] {
      v("text", next ? text_of_next(*next) : "", "in a sentence");
      v("measurements", next.value_or(std::vector<NextMeasurement>{}), "best first");
    });
  });
}

void show_fits(ResultVisitor& v, const std::vector<FileOutcome>& outcomes) {
  std::vector<FileOutcome> shown = outcomes;
  write_paths_of(shown);
  for (FileOutcome& outcome : shown) {
    if (outcome.fitted) outcome.fitted->path = outcome.path;
  }
  v.list("fits", "one for each file, in their order, with the keys of viscard-fit/1", shown,
         [&](const FileOutcome& outcome) {
           show_head(v, {"viscard-fit/1", {outcome.path}});
           show_keys(v, outcome);
         });
}

// Moduli, stiffnesses, forces, and a file that could not be fitted.
std::vector<FileOutcome> examples() {
  FittedFile modulus, stiffness, force;
  modulus.modulus = MeasuredModulus{.kind = ModulusKind::kShear, .nu_95 = Interval{}};
  modulus.notes = {""};
  stiffness.result.is_stiffness = true;
  stiffness.result.tests.push_back({.is_stiffness = true});
  force.has_no_depth = true;
  return {{"", modulus, nullptr}, {"", stiffness, nullptr}, {"", force, nullptr}, {}};
}

std::vector<DescribedResult> results_of_fit() {
  DescribedResult fit{"fit", "viscard fit FILE, or several tests of one material", {}};
  for (const FileOutcome& one : examples()) {
    fit.examples.emplace_back([one](ResultVisitor& v) { show_fit(v, one, std::nullopt, false); });
  }
  DescribedResult joint{"joint", "viscard fit --joint, and the file that it writes", {}};
  for (const int degree : {1, kPerRatio}) {
    RatioFit one;
    one.best.form.E0_degree = one.best.form.g_degree = one.best.form.tau_degree = degree;
    one.law.form = one.best.form;
    one.forms.push_back({.form = one.best.form});
    joint.examples.emplace_back([one](ResultVisitor& v) { show_keys(v, one); });
  }
  return {
      fit,
      {"fits", "viscard fit FILE FILE ...", {[](ResultVisitor& v) { show_fits(v, examples()); }}},
      joint,
      result_of_table(),
      described<FittedLargeStrain>("hyperelastic",
                                   "viscard fit of tests at large strain; --out writes the same "
                                   "without version and inputs")};
}

CommandSyntax fit_syntax(FitCommand& command) {
  CommandSyntax syntax{
      "viscard fit FILE... [OPTIONS]",
      "Fits the instantaneous modulus and a Prony series, with 95 % intervals, to captures "
      "(*.viscap) or tables from any machine. Columns are found by name and unit (force_N, \"Force "
      "[N]\", t (s)). The fit uses the exact loading history and chooses the number of terms "
      "unless it is given. Several tests of one material are fitted together if each states its "
      "kind: relaxation=a.csv creep=b.csv dma=c.csv indentation=d.csv. Tests at large strain give "
      "a law of rubber: uniaxial=a.csv compression=b.csv planar=c.csv equibiaxial=d.csv (stretch "
      "or nominal strain, and nominal stress); foams (--model hyperfoam) also confined=e.csv "
      "volumetric=f.csv shear=g.csv.",
      "viscard fit data/demo/example_relaxation.csv --out material.json"};
  syntax.positional.add("file", &command.files, "captures and tables");
  OptionList& options = syntax.options;
  options = options_of(command.fit);
  add_large_strain_options(options, command.large);
  options.group("Output");
  options
      .add("csv", &command.csv,
           "write a table here: of one file its data, fit, residuals and weights; of several files "
           "one row each with moduli, intervals and flags")
      .only_typed();
  options
      .add("svg", &command.svg,
           "draw data, fit and residuals here (one file), or stress against stretch")
      .only_typed();
  options
      .add("want", &command.want,
           "of one capture: a quantity and the relative half-width of its 95 % interval, such as "
           "g_2=5% (repeatable; E0, E_inf, sum_g, E_i, g_i, tau_i); prints what to measure next: "
           "what narrows the widest one most for a minute at the rig")
      .only_typed();
  options
      .add("curves", &command.curves,
           "with --json and one file: the object has data and fit, as --csv writes them")
      .only_typed();
  options
      .add(
          "show-table", &command.show_table,
          "print how a table is read, with its columns, their quantities and what was guessed; fit "
          "nothing")
      .only_typed();
  options.add("out", &command.out, "material file to write (one input file, or several tests)")
      .only_typed();
  options.add("force", &command.overwrite, "replace existing files")
      .only_typed()
      .only_with({"out", "csv", "svg"});
  syntax.results = results_of_fit();
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
                   const NextMeasurements& next, bool with_curves, Streams& streams) {
  if (outcomes.size() == 1) {
    print_result(
        {"viscard-fit/1", files},
        [&](ResultVisitor& v) { show_fit(v, outcomes.front(), next, with_curves); }, streams);
  } else {
    print_result(
        {"viscard-fits/1", files}, [&](ResultVisitor& v) { show_fits(v, outcomes); }, streams);
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
        err << "viscard: " << failure_text(error, outcome.path) << "\n";
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

// --curves belongs to one object, and --show-table fits nothing that it could write.
void check_shown(const FitCommand& asked, bool as_json, std::size_t n_files, bool are_tests) {
  if (asked.curves && (!as_json || n_files > 1 || asked.fit.joint)) {
    throw UsageError(
        "--curves adds data and fit to the object of one file; give --json and one file");
  }
  if (!asked.show_table) return;
  if (asked.out || asked.csv || asked.svg || asked.fit.joint || asked.curves) {
    throw UsageError(
        "--show-table fits nothing, so it excludes --out, --csv, --svg, --curves and --joint");
  }
  if (are_tests) throw UsageError("--show-table takes plain files, without KIND=; state --kind");
}

// The data of several tests together have different meanings, and a joint fit has only a law.
void check_curves(const FitCommand& asked, std::size_t n_results) {
  if (asked.fit.joint && (asked.csv || asked.svg)) {
    throw UsageError(
        "--csv and --svg show fits of files, not a joint fit; omit them, or omit --joint");
  }
  if (asked.svg && n_results > 1) {
    throw UsageError("--svg draws one fit, but " + std::to_string(n_results) +
                     " files are given; name one file");
  }
}

void write_curves(const FitCommand& asked, const std::vector<FileOutcome>& outcomes,
                  const std::string& command) {
  if (!asked.csv && !asked.svg) return;
  const bool is_one = outcomes.size() == 1;
  if (is_one && outcomes.front().fitted->result.curves.time_s.empty()) {
    throw std::runtime_error(outcomes.front().path +
                             ": this fit has no single curve for --csv or --svg (several tests "
                             "together); fit the files apart");
  }
  if (asked.csv) {
    write_file(
        *asked.csv,
        is_one ? csv_from_fit(*outcomes.front().fitted, command) : csv_from_fits(outcomes, command),
        asked.overwrite);
  }
  if (!asked.svg) return;
  const FittedFile& fitted = *outcomes.front().fitted;
  auto plot = fit_plot(fitted.result, fitted.master.has_value());
  if (const auto spectrum = spectrum_panel(fitted.result); plot && spectrum) {
    plot->panels.push_back(*spectrum);
    plot->height_px += 300;
  }
  if (!plot) throw std::runtime_error(fitted.path + ": has too few rows to draw");
  write_file(*asked.svg, svg_from_plot(*plot, "fit"), asked.overwrite);
}

}  // namespace

int run_fit(const Words& words, Streams& streams) {
  FitCommand asked;
  CommandSyntax syntax = fit_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  if (const auto large = large_strain_given(asked, syntax); !large.empty()) {
    return run_large_strain(large, asked, syntax, streams);
  }
  check_want(asked);
  Words files = asked.files;
  const FitWords& options = asked.fit;
  const auto& out = asked.out;
  const bool as_json = syntax.as_json;
  const std::string command = quoted_command_line("fit", words);
  std::vector<TestFile> tests;
  FitRequest request;
  MaterialRequest about;  // refuses bad words before the fit
  with_usage_errors([&] {
    tests = tests_given(files);
    if (!tests.empty()) files = paths_of(tests);
    refuse_contradictions(options, tests, files.size(), out.has_value());
  });
  const bool overwrite = asked.overwrite;
  for (const auto& output : {out, asked.csv, asked.svg}) {
    if (output) refuse_existing(*output, overwrite);
  }
  check_curves(asked, tests.empty() ? files.size() : 1);
  check_shown(asked, as_json, files.size(), !tests.empty());
  if (options.joint) {
    JointRequest joint = with_usage_errors([&] { return joint_request(options, files, command); });
    return run_joint_fit(std::move(joint), {out.value_or(""), overwrite, as_json}, streams);
  }
  with_usage_errors([&] {
    request = fit_request(options);
    about = material_request(options, command);
  });
  if (asked.show_table) return show_tables(files, request, as_json, streams);
  request.needs_modulus = out.has_value();
  if (tests.size() == 1) request.kind = tests.front().kind;
  const WordsOnSignal words_on_signal("the fit was stopped, and nothing is written");
  Progress progress(streams, "fit");
  const FlowProgress show = [&](double done, const std::string& file) {
    progress.show(done, file);
  };
  std::mutex drawing;  // the isotherms of one file may be fitted side by side
  if (files.size() == 1) {
    request.options.resampled = [&](double done) {
      const std::lock_guard lock(drawing);
      progress.show(done, "resamples of " + files.front());
    };
  }
  std::vector<FileOutcome> outcomes;
  if (tests.size() > 1) {
    const FittedFile fitted = fit_tests(tests, request, show);
    outcomes.push_back({fitted.path, fitted, nullptr});
  } else {
    outcomes = fit_each_file(files, request, show);
  }
  progress.clear();
  require_one(outcomes);
  const NextMeasurements next = next_of(outcomes.front(), asked.want);
  if (!as_json) print_as_text(outcomes, FittedText(streams));
  if (!as_json && next) streams.out << "next: " << text_of_next(*next) << "\n";
  if (out) {
    Material material = material_from_fitted(*outcomes.front().fitted, about);
    if (!options.ratio.empty()) material.mixing_ratio = options.ratio.front();
    write_file(*out, json_from_material(material), overwrite);
  }
  write_curves(asked, outcomes, command);
  if (as_json) print_as_json(outcomes, files, next, asked.curves, streams);
  return report_defects(outcomes, streams.err);
}

}  // namespace viscard
