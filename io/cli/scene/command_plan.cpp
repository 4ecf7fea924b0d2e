#include "io/cli/scene/command_plan.h"

#include "io/cli/scene/tolerance_option.h"
#include "io/cli/words/command_line.h"
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

bool acts(const SceneEffect& effect) {
  return effect.on || effect.estimate > 0.0;
}

const char* state_of(const SceneEffect& effect) {
  if (effect.is_forced) return effect.on ? "on!" : "off!";
  return effect.on ? "on" : "off";
}

void print_plan(const std::string& path, const Scene& scene, const ScenePlan& plan,
                std::ostream& out) {
  out << fmt::format("{}, tolerance {:g}\n  {:<20} {:<5} {:>9}  {:<38} {}\n", path,
                     common(scene).tolerance, "effect", "", "if off", "what decides", "why");
  for (const SceneEffect& e : plan.effects) {
    const std::string number =
        e.number.empty() ? "" : fmt::format("{} = {:.3g}", e.number, e.value);
    out << fmt::format("  {:<20} {:<5} {:>9}  {:<38} {}\n", e.name, state_of(e),
                       acts(e) ? fmt::format("{:.1e}", e.estimate) : "-", number, e.reason);
  }
  out << fmt::format(
      "  left out: {:.1e}; the mesh and the steps may take {:.1e}   (! forced by the scene)\n",
      plan.left_out, common(plan.reduced).tolerance);
}

CommandSyntax plan_syntax() {
  CommandSyntax syntax{"viscard plan SCENE.toml [OPTIONS]",
                       "Says which effects a scene needs at its tolerance, with the number that "
                       "decides and the error\nof leaving each out. 'viscard simulate' follows it; "
                       "[effects] in the scene overrules it.",
                       "viscard plan data/scenes/pillar_modal.toml"};
  add_tolerance_option(syntax.options);
  syntax.positional = {"scene"};
  return syntax;
}

}  // namespace

nlohmann::json json_from_effect(const SceneEffect& effect) {
  nlohmann::json object{{"name", effect.name},
                        {"on", effect.on},
                        {"estimate", nullptr},
                        {"number", nullptr},
                        {"value", nullptr},
                        {"forced", effect.is_forced},
                        {"counted", effect.is_counted},
                        {"reason", effect.reason}};
  if (acts(effect)) object["estimate"] = effect.estimate;
  if (!effect.number.empty()) {
    object["number"] = effect.number;
    object["value"] = effect.value;
  }
  return object;
}

int run_plan(const std::vector<std::string>& words, Streams& streams) {
  CommandSyntax syntax = plan_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("scene") == 0) {
    throw UsageError(std::string("which scene? usage: ") + syntax.usage);
  }
  const auto path = (*values)["scene"].as<std::string>();
  Scene scene = read_scene(path).scene;
  apply_tolerance(*values, scene);
  ScenePlan plan;
  try {
    plan = checked_plan(scene);
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(told_with_line(path, mistake));
  }
  if (values->count("json") == 0) {
    print_plan(path, scene, plan, streams.out);
    return kDone;
  }
  nlohmann::json effects = nlohmann::json::array();
  for (const SceneEffect& effect : plan.effects) effects.push_back(json_from_effect(effect));
  const nlohmann::json object{{"effects", effects},
                              {"tolerance", common(scene).tolerance},
                              {"left_out", plan.left_out},
                              {"mesh_tolerance", common(plan.reduced).tolerance}};
  streams.out << object.dump(2) << "\n";
  return kDone;
}

}  // namespace viscard
