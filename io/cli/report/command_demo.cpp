#include "io/basics/data_folder.h"
#include "io/basics/number_text.h"
#include "io/cli/report/demo_record.h"
#include "io/cli/report/report_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/config/config_file.h"
#include "io/flow/capture_setup.h"
#include "io/materials/material_file.h"
#include "rig/run/preflight.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace fs = std::filesystem;
namespace viscard {
namespace {

struct DemoSpecimen {
  const char* ratio;  // as it is usually written
  const char* stem;   // of the names of its files
  const char* specimen_file;
  const char* truth_file;
};

constexpr DemoSpecimen kSpecimens[] = {
    {"1:10", "pdms_1to10", "03_pdms_1to10.toml", "03_pdms_1to10.truth.toml"},
    {"1:13", "pdms_1to13", "04_pdms_1to13.toml", "04_pdms_1to13.truth.toml"},
    {"1:20", "pdms_1to20", "05_pdms_1to20.toml", "05_pdms_1to20.truth.toml"},
};

struct CardChoice {
  const char* target;
  const char* suffix;
};
constexpr CardChoice kCards[] = {
    {"abaqus", ".inp"}, {"ansys", ".mac"}, {"febio", ".feb"}, {"json", ".neutral.json"}};

bool has_flagged_term(const fs::path& material_file) {
  const std::vector<MaterialFlag> flags = read_material(material_file).material.flags;
  return std::any_of(flags.begin(), flags.end(),
                     [](const MaterialFlag& flag) { return flag.term > 0; });
}

class Demo {
 public:
  Demo(Streams& streams, const CommandRunner& run_command, fs::path out, fs::path data,
       std::string speed, bool is_forced, bool strips_paths)
      : streams_(streams),
        run_command_(run_command),
        out_(std::move(out)),
        data_(std::move(data)),
        record_(out_),
        speed_(std::move(speed)),
        is_forced_(is_forced),
        strips_paths_(strips_paths) {}

  // Runs one command unless its output is up to date. Throws std::runtime_error if it fails.
  void step(const Words& words, const fs::path& output, const std::vector<fs::path>& inputs) {
    const std::string made_from = sum_of_inputs(inputs, strips_paths_ ? "--strip-paths" : "");
    if (!is_forced_ && record_.is_up_to_date(output, made_from)) {
      ++n_kept_;
      return;
    }
    if (!is_forced_ && !record_.knows(output) && fs::exists(output)) {
      throw std::runtime_error(output.string() +
                               " is not of an earlier demo. Name another folder with --out, or "
                               "replace it with --force");
    }
    record_.begin(output);
    streams_.err << "$ " << quoted_command_line(words[0], {words.begin() + 1, words.end()}) << "\n";
    std::vector<std::string> forced = words;
    forced.push_back("--force");  // replaces only files of an earlier demo
    if (strips_paths_) forced.push_back("--strip-paths");
    std::ostringstream printed;
    Streams inner{printed, streams_.err, streams_.err_is_terminal};
    if (run_command_(forced, inner) != kDone) {
      throw std::runtime_error(
          "the demo stopped, because the command above failed or was stopped; the same command "
          "keeps what is finished and goes on");
    }
    record_.finish(output, made_from);
  }

  void run_specimen(const DemoSpecimen& specimen) {
    const fs::path stem = out_ / specimen.stem;
    const auto file = [&](const char* suffix) { return fs::path(stem.string() + suffix); };
    const fs::path test = data_ / "02_test.toml";
    const fs::path what = data_ / specimen.specimen_file;
    const fs::path truth = data_ / specimen.truth_file;
    step({"capture", "--emulate", "--truth", truth, "--test", test, "--specimen", what, "--speed",
          speed_, "--out", file(".viscap")},
         file(".viscap"), {test, what, truth});
    step({"export", file(".viscap"), "--out", file(".csv")}, file(".csv"), {file(".viscap")});
    step({"fit", file(".viscap"), "--out", file(".json")}, file(".json"), {file(".viscap")});
    for (const CardChoice& card : kCards) {
      std::vector<std::string> words{"card",    file(".json"), "--for", card.target,
                                     "--units", "mm-t-s",      "--out", file(card.suffix)};
      // Rarely the noise makes a term doubtful. The card then has a warning in its header.
      if (has_flagged_term(file(".json"))) words.emplace_back("--accept-flags");
      step(words, file(card.suffix), {file(".json")});
    }
    step({"validate", file(".json"), "--csv", file(".validation.csv")}, file(".validation.csv"),
         {file(".json")});
  }

  fs::path run_report() {
    fs::path page = out_ / "report.html";
    std::vector<std::string> words{"report"};
    std::vector<fs::path> inputs;
    for (const DemoSpecimen& specimen : kSpecimens) {
      inputs.push_back(out_ / (std::string(specimen.stem) + ".viscap"));
      words.push_back(inputs.back());
    }
    for (const DemoSpecimen& specimen : kSpecimens) {
      inputs.push_back(data_ / specimen.truth_file);
      words.insert(words.end(), {"--truth", inputs.back()});
    }
    words.insert(words.end(),
                 {"--title", "Three mixing ratios of PDMS on the emulated rig", "--out", page});
    step(words, page, inputs);
    return page;
  }

  std::vector<ScoreRow> scores() const {
    std::vector<ScoreRow> rows;
    for (const DemoSpecimen& specimen : kSpecimens) {
      const Material material =
          read_material(out_ / (std::string(specimen.stem) + ".json")).material;
      const std::vector<ScoreRow> more =
          score_rows(specimen.ratio, read_truth(data_ / specimen.truth_file), material);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
  }

  int n_kept() const { return n_kept_; }

 private:
  Streams& streams_;
  const CommandRunner& run_command_;
  fs::path out_;
  fs::path data_;
  DemoRecord record_;
  std::string speed_;
  bool is_forced_;
  bool strips_paths_;
  int n_kept_ = 0;
};

// Explains why the demo does not indent as deep as the thesis that it follows: the peak forces that
// the check before a run predicts for that depth.
std::string depth_explained(const fs::path& data) {
  constexpr double kThesisDepth_m = 0.25e-3;
  const RigConfig rig = read_rig(data / "01_rig.toml");
  TestPlan plan = read_test(data / "02_test.toml");
  const double depth_m = plan.depth_m;
  plan.depth_m = kThesisDepth_m;
  std::string text = fmt::format(
      "The test indents by {:g} mm, not by {:g} mm as in the thesis \"Design of a piezoelectric\n"
      "tactile sensor\" that it follows. With the moduli guessed before the test, the peak force "
      "at\n"
      "that depth would be\n",
      1e3 * depth_m, 1e3 * kThesisDepth_m);
  for (const DemoSpecimen& specimen : kSpecimens) {
    const Preflight check = preflight(rig, plan, read_specimen(data / specimen.specimen_file));
    text +=
        fmt::format("  {:<5} {:.2f} N (limit of the test {:.2f} N, rating of the cell {:.2f} N)\n",
                    specimen.ratio, check.peak_force_N, check.limit_N, rig.calibration.capacity_N);
  }
  return text;
}

void show_scores(ResultVisitor& v, const std::vector<ScoreRow>& rows, const fs::path& page) {
  v("report", page.string(), "the page");
  v.list("scores", "true values of the emulated rig and estimates", rows, [&](const ScoreRow& row) {
    v("estimate", row.estimate, "of the fit");
    v("interval_95", row.interval_95, "95 % interval, [low, high]");
    v("is_inside", row.is_inside, "whether the truth is inside");
    v("quantity", row.quantity, "its name");
    v("specimen", row.specimen, "mixing ratio");
    v("truth", row.truth, "of the emulated specimen");
    v("unit", row.unit, "its unit");
  });
}

}  // namespace

int run_demo(const Words& words, Streams& streams, const CommandRunner& run_command) {
  std::string folder = "demo";
  std::optional<std::string> own_data;
  double speed = 50.0;
  bool overwrite = false;
  CommandSyntax syntax{
      "viscard demo [--out DIR] [OPTIONS]",
      "Runs the whole flow on the emulated rig for three mixing ratios of PDMS: capture, fit, "
      "cards, validation and one HTML page. Prints each command as you would type it. Results of "
      "an earlier demo that are up to date are kept.",
      "viscard demo --out demo"};
  syntax.reads_quantities = false;
  syntax.options.add("out", &folder, "folder for all results");
  syntax.options.add("data", &own_data,
                     "folder with the rig, test, specimen and truth files (otherwise those that "
                     "came with viscard)");
  syntax.options.add("speed", &speed, "speed of the emulated clock relative to real time");
  syntax.options.add("force", &overwrite, "run every step again");
  syntax.may_exist = {"out"};
  syntax.results = {{"demo", "viscard demo", {[](ResultVisitor& v) { show_scores(v, {}, ""); }}}};
  if (!parse_words(syntax, words, streams)) return kDone;
  if (!(speed > 0.0) || speed > kFastestEmulation) {
    throw UsageError(
        fmt::format("--speed is {}; it must be above 0 and at most {}", speed, kFastestEmulation));
  }
  const fs::path out = folder;
  fs::create_directories(out);
  const fs::path data = own_data ? fs::path(*own_data) : data_folder() / "demo";
  streams.err << depth_explained(data);
  const WordsOnSignal words_on_signal(
      "the demo was stopped; the same command keeps what is finished and goes on");
  Demo demo(streams, run_command, out, data, text_from_number(speed), overwrite,
            is_given(syntax, "strip-paths"));
  for (const DemoSpecimen& specimen : kSpecimens) demo.run_specimen(specimen);
  const fs::path page = fs::absolute(demo.run_report());
  const std::vector<ScoreRow> rows = demo.scores();
  const auto show = [&](ResultVisitor& v) { show_scores(v, rows, page); };
  if (print_result(syntax, {"viscard-demo/1", {data.string()}}, show, streams)) return kDone;
  if (demo.n_kept() > 0) {
    streams.err << fmt::format(
        "{} results were up to date and kept (--force runs every step again).\n", demo.n_kept());
  }
  streams.out << "\nTrue values of the emulated rig, and estimates of the fit:\n\n"
              << fitted(table_from_scores(rows), streams.columns)
              << "\nThe page with all results: " << page.string() << "\n";
  return kDone;
}

}  // namespace viscard
