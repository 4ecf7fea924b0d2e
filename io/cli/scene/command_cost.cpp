#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/cli/scene/cost_of_tests.h"
#include "io/cli/scene/cost_output.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cost/study_cost.h"
#include "io/plots/plot.h"
#include "io/scenes/scene_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

CommandSyntax cost_syntax() {
  CommandSyntax syntax{
      "viscard cost SCENE.toml [OPTIONS] | viscard cost --rig RIG.toml --specimen SPECIMEN.toml "
      "--want QUANTITY=TOLERANCE [OPTIONS]",
      "Shows what accuracy costs: error against processor time, memory and unknowns "
      "over discretisations and effects, and the cheapest for each tolerance. Rows "
      "that the budget leaves out are predicted. With --rig: error against time at the rig over "
      "tests of a specimen, and the test file to use.",
      "viscard cost data/scenes/pillar_modal.toml --budget 20s"};
  syntax.options.add_options()("budget", po::value<std::string>()->default_value("60s"),
                               "wall time to spend, such as 60s or 5min")(
      "out", po::value<std::string>(),
      "folder for cost.csv, cost.json and cost.svg; with --rig also test.toml")(
      "force", "overwrite existing files");
  add_test_options(syntax.options);
  syntax.may_exist = {"out"};
  syntax.positional = {"scene"};
  return syntax;
}

}  // namespace

int run_cost(const Words& words, Streams& streams) {
  CommandSyntax syntax = cost_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("rig") > 0) {
    return run_cost_of_tests(*values, syntax, quoted_command_line("cost", words), streams);
  }
  const auto path = required(*values, "scene", syntax);
  CostOptions options{.budget_s = *given_quantity(*values, "budget", "s")};
  if (!(options.budget_s > 0.0)) throw UsageError("--budget must be positive, such as 60s");
  const SceneFile file = read_scene(path, given_plausible(*values, Plausible::kScene));
  streams.accepts_implausible |= file.accepts_implausible;
  const Scene scene = file.scene;
  CostStudy study;
  {
    Progress progress(streams, "cost");
    options.progress = [&](double done, const std::string& name) { progress.show(done, name); };
    study = with_lines_of(path, [&] { return study_cost(scene, options); });
  }
  const JsonHead head{"viscard-cost/1", {path}};
  const nlohmann::json object = with_head(head, json_from_study(study));
  if (const auto out = given(*values, "out")) {
    const std::filesystem::path folder = *out;
    const bool overwrite = values->count("force") > 0;
    const std::string command = quoted_command_line("cost", words);
    std::filesystem::create_directories(folder);
    write_file(folder / "cost.csv", csv_from_study(study, command), overwrite);
    write_file(folder / "cost.json", text_from_json(object, 2) + "\n", overwrite);
    const std::string name = std::filesystem::path(path).filename().string();
    write_file(folder / "cost.svg", svg_from_plot(plot_from_study(study, name), "cost"), overwrite);
  }
  if (!print_json(*values, head, object, streams)) print_study(study, path, FittedText(streams));
  return kDone;
}

}  // namespace viscard
