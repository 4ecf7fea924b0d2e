#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/scene_commands.h"
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
                       "decides and the error of leaving each out. 'viscard simulate' follows it; "
                       "[effects] in the scene overrules it.",
                       "viscard plan data/scenes/pillar_modal.toml"};
  add_tolerance_option(syntax.options);
  syntax.positional = {"scene"};
  return syntax;
}

}  // namespace

nlohmann::json json_from_effects(const std::vector<SceneEffect>& effects) {
  using nlohmann::json;
  json list = json::array();
  for (const SceneEffect& effect : effects) {
    const bool has_number = !effect.number.empty();
    list.push_back({{"name", effect.name},
                    {"on", effect.on},
                    {"estimate", acts(effect) ? json(effect.estimate) : json()},
                    {"number", has_number ? json(effect.number) : json()},
                    {"value", has_number ? json(effect.value) : json()},
                    {"forced", effect.is_forced},
                    {"counted", effect.is_counted},
                    {"reason", effect.reason}});
  }
  return list;
}

void add_tolerance_option(po::options_description& options) {
  options.add_options()("tol", po::value<double>(),
                        "relative error allowed, instead of the scene's");
}

void apply_tolerance(const po::variables_map& values, Scene& scene) {
  const auto tolerance = given<double>(values, "tol");
  if (!tolerance) return;
  const ToleranceRange& range = tolerances_of(scene);
  if (!range.contains(*tolerance)) {
    throw UsageError(std::string("--tol must lie between ") + range.words);
  }
  common(scene).tolerance = *tolerance;
}

int run_plan(const Words& words, Streams& streams) {
  CommandSyntax syntax = plan_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const auto path = required(*values, "scene", syntax);
  Scene scene = read_scene(path).scene;
  apply_tolerance(*values, scene);
  const ScenePlan plan = with_lines_of(path, [&] { return checked_plan(scene); });
  const nlohmann::json object{{"effects", json_from_effects(plan.effects)},
                              {"tolerance", common(scene).tolerance},
                              {"left_out", plan.left_out},
                              {"mesh_tolerance", common(plan.reduced).tolerance}};
  if (!print_json(*values, object, streams)) print_plan(path, scene, plan, streams.out);
  return kDone;
}

}  // namespace viscard
