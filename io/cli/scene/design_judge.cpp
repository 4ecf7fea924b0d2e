#include "io/cli/scene/design_judge.h"

#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"
#include "io/basics/file_kind.h"
#include "io/basics/json_string.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/flow/design/judge_scene.h"
#include "io/flow/design/judgement_output.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

Judgement judgement_of(const po::variables_map& values, const std::string& scene,
                       const Requirements& requirements, Streams& streams) {
  Progress progress(streams, "design");
  JudgeOptions options;
  options.tolerance = given<double>(values, "tol");
  options.search_s = *given_quantity(values, "search-time", "s");
  if (options.search_s < 0.0) throw UsageError("--search-time must not be negative, such as 60s");
  options.progress = [&](double done, const std::string& what) { progress.announce(done, what); };
  try {
    std::string text = read_file(scene);
    if (given_plausible(values) == Plausible::kOff) text = "plausible = \"off\"\n" + text;
    return judge_scene(text, scene, requirements, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

void add_judge_options(po::options_description& options) {
  options.add_options()("require", po::value<std::string>(),
                        "judge SCENE.toml: file with a table [require], such as "
                        "data/requirements/human_hand.toml");
  options.add_options()(
      "search-time", po::value<std::string>()->default_value("60s"),
      "processor time for the search of the dimensions that would pass, summed over all cores; the "
      "judgement itself comes first and is not limited; 0s: no search");
  add_tolerance_option(options);
}

int run_design_judge(const po::variables_map& values, const Words& words, Streams& streams) {
  const auto scene = given(values, "scene");
  const auto require = given(values, "require");
  if (!scene) throw UsageError("--require judges a scene; name its file, such as SCENE.toml");
  if (!require) {
    refuse_other_kind(read_file(*scene), *scene, FileKind::kScene);
    throw UsageError(
        "'" + *scene + "'" +
        example_with_data(" is judged by what is required; add --require FILE, such as "
                          "data/requirements/human_hand.toml"));
  }
  const Requirements requirements = read_requirements(*require);
  const Judgement judgement = judgement_of(values, *scene, requirements, streams);
  const JsonHead head{"viscard-design-judge/1", {*scene, *require}};
  const nlohmann::json object = with_head(head, json_from_judgement(judgement));
  if (const auto out = given(values, "out")) {
    nlohmann::json stored = object;
    stored["command"] = quoted_command_line("design", words);
    stored["created_by"] = "viscard " VISCARD_VERSION;
    std::filesystem::create_directories(*out);
    write_file(std::filesystem::path(*out) / "judgement.json", text_from_json(stored, 2) + "\n",
               values.count("force") > 0);
  }
  if (!print_json(values, head, object, streams)) {
    streams.out << *scene << "\n" << text_from_judgement(judgement);
  }
  return judgement.passes() ? kDone : kFailed;
}

}  // namespace viscard
