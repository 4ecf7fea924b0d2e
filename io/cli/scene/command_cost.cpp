#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/option_use.h"
#include "io/cli/scene/cost_of_tests.h"
#include "io/cli/scene/cost_output.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/cost/study_cost.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/plots/plot.h"
#include "io/scenes/scene_file.h"

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

// The options of `viscard cost`.
struct CostWords {
  std::optional<std::string> scene;
  double budget_s = 60.0;
  std::optional<double> cpu_budget_s;
  CostOfTestsWords tests;
  StudyFiles files;
};

CommandSyntax cost_syntax(CostWords& words) {
  CommandSyntax syntax{
      "viscard cost SCENE.toml [OPTIONS] | viscard cost --rig RIG.toml --specimen SPECIMEN.toml "
      "--want QUANTITY=TOLERANCE [OPTIONS]",
      "Shows what accuracy costs: error against processor time, memory and unknowns "
      "over discretisations and effects, and the cheapest for each tolerance. Rows "
      "that the budget leaves out are predicted. With --rig: error against time at the rig over "
      "tests of a specimen, and the test file to use.",
      "viscard cost data/scenes/pillar_modal.toml --budget 20s"};
  syntax.positional.add("scene", &words.scene, "scene file");
  syntax.options.group("Discretisations of a scene");
  syntax.options.add("budget", &words.budget_s, "wall time to spend, such as 60s or 5min")
      .of("s")
      .by_default("60s");
  syntax.options
      .add("cpu-budget", &words.cpu_budget_s, "processor time to spend at most, such as 30s")
      .of("s");
  syntax.options.group("Tests at a rig");
  add_test_options(syntax.options, words.tests);
  syntax.options.group("Output");
  syntax.options.add("out", &words.files.folder,
                     "folder for cost.csv, cost.json and cost.svg; with --rig also test.toml");
  syntax.options.add("force", &words.files.overwrite, "overwrite existing files")
      .only_with({"out"});
  syntax.may_exist = {"out"};
  syntax.results = {described<CostStudy>("cost", "viscard cost"), result_of_test_study()};
  return syntax;
}

}  // namespace

int run_cost(const Words& words, Streams& streams) {
  CostWords asked;
  CommandSyntax syntax = cost_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  const std::string command = quoted_command_line("cost", words);
  if (asked.tests.rig) {
    const char* const kScenes = "a scene; tests at a rig have --at-most";
    refuse_idle<UsageError>({{"--budget", is_given(syntax, "budget"), false, kScenes},
                             {"--cpu-budget", is_given(syntax, "cpu-budget"), false, kScenes}});
    asked.tests.scene = asked.scene;
    return run_cost_of_tests(asked.tests, asked.files, syntax, command, streams);
  }
  if (!asked.scene) throw UsageError(std::string("no scene given; usage: ") + syntax.usage);
  const std::string path = *asked.scene;
  CostOptions options{.budget_s = asked.budget_s, .cpu_budget_s = asked.cpu_budget_s};
  if (!(options.budget_s > 0.0)) throw UsageError("--budget must be positive, such as 60s");
  if (options.cpu_budget_s && !(*options.cpu_budget_s > 0.0)) {
    throw UsageError("--cpu-budget must be positive, such as 30s");
  }
  const SceneFile file = read_scene(path, given_plausible(syntax, Plausible::kScene));
  streams.accepts_implausible |= file.accepts_implausible;
  const Scene scene = file.scene;
  CostStudy study;
  {
    Progress progress(streams, "cost");
    options.progress = [&](double done, const std::string& name) { progress.show(done, name); };
    const WordsOnSignal words_on_signal(
        "the study of costs was stopped; nothing is written. A smaller --budget ends earlier");
    study = with_lines_of(path, [&] { return study_cost(scene, options); });
  }
  if (const std::string edited = note_of_edited(scene); !edited.empty())
    study.notes.push_back(edited);
  const JsonHead head{"viscard-cost/1", {path}};
  const auto show = [&](ResultVisitor& v) { show_keys(v, study); };
  if (asked.files.folder) {
    const std::filesystem::path folder = *asked.files.folder;
    const bool overwrite = asked.files.overwrite;
    std::filesystem::create_directories(folder);
    write_file(folder / "cost.csv", csv_from_study(study, command), overwrite);
    write_file(folder / "cost.json", text_from_json(with_head(head, show), 2) + "\n", overwrite);
    const std::string name = std::filesystem::path(path).filename().string();
    write_file(folder / "cost.svg", svg_from_plot(plot_from_study(study, name), "cost"), overwrite);
  }
  if (!print_result(syntax, head, show, streams)) print_study(study, path, FittedText(streams));
  return kDone;
}

}  // namespace viscard
