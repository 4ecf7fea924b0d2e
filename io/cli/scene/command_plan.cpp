#include "io/cli/scene/command_plan.h"

#include "io/cli/words/command_line.h"
#include "io/scenes/scene_array.h"
#include "io/scenes/scene_file.h"
#include "models/array/plane/array_plan.h"
#include "models/pillar/plan/plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>
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

// What is printed of the plan of any scene.
struct Plan {
  std::vector<SceneEffect> effects;
  double tolerance = 0.0, left_out = 0.0, mesh_tolerance = 0.0;
};

void print_plan(const std::string& path, const Plan& plan, std::ostream& out) {
  out << fmt::format("{}, tolerance {:g}\n  {:<20} {:<5} {:>9}  {:<38} {}\n", path, plan.tolerance,
                     "effect", "", "if off", "what decides", "why");
  for (const SceneEffect& e : plan.effects) {
    const std::string number =
        e.number.empty() ? "" : fmt::format("{} = {:.3g}", e.number, e.value);
    out << fmt::format("  {:<20} {:<5} {:>9}  {:<38} {}\n", e.name, state_of(e),
                       acts(e) ? fmt::format("{:.1e}", e.estimate) : "-", number, e.reason);
  }
  out << fmt::format(
      "  left out: {:.1e}; the mesh and the steps may take {:.1e}   (! forced by the scene)\n",
      plan.left_out, plan.mesh_tolerance);
}

Plan plan_of(const std::string& path, std::optional<double> tolerance) {
  const auto planned = [](const auto& scene, const auto& plan) {
    return Plan{plan.effects, scene.tolerance, plan.left_out, plan.reduced.tolerance};
  };
  if (scene_kind(path) == "array") {
    ArrayScene scene = read_array_scene(path).scene;
    scene.tolerance = tolerance.value_or(scene.tolerance);
    return planned(scene, plan_effects(scene));
  }
  Scene scene = read_scene(path).scene;
  scene.tolerance = tolerance.value_or(scene.tolerance);
  refuse_beyond_buckling(scene);
  return planned(scene, plan_effects(scene));
}

CommandSyntax plan_syntax() {
  CommandSyntax syntax{"viscard plan SCENE.toml [OPTIONS]",
                       "Says which effects a scene needs at its tolerance, with the number that "
                       "decides and the error\nof leaving each out. 'viscard simulate' follows it; "
                       "[effects] in the scene overrules it.",
                       "viscard plan data/scenes/pillar_modal.toml"};
  syntax.options.add_options()("tol", po::value<double>(),
                               "relative error allowed, instead of the scene's");
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
  std::optional<double> tolerance;
  if (values->count("tol") > 0) tolerance = (*values)["tol"].as<double>();
  if (tolerance && !(*tolerance >= 1e-9 && *tolerance < 1.0)) {
    throw UsageError("--tol must lie between 1e-9 and 1");
  }
  Plan plan;
  try {
    plan = plan_of(path, tolerance);
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(told_with_line(path, mistake));
  }
  if (values->count("json") == 0) {
    print_plan(path, plan, streams.out);
    return kDone;
  }
  nlohmann::json effects = nlohmann::json::array();
  for (const SceneEffect& effect : plan.effects) effects.push_back(json_from_effect(effect));
  const nlohmann::json object{{"effects", effects},
                              {"tolerance", plan.tolerance},
                              {"left_out", plan.left_out},
                              {"mesh_tolerance", plan.mesh_tolerance}};
  streams.out << object.dump(2) << "\n";
  return kDone;
}

}  // namespace viscard
