#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cost/effect_savings.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/scenes/scene_file.h"
#include "models/maths/failure_text.h"
#include "models/scene/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

const char* state_of(const SceneEffect& effect) {
  if (effect.is_forced) return effect.on ? "on!" : "off!";
  return effect.on ? "on" : "off";
}

// A warning that the effect may change everything adds nothing: the analysis does not compute this
// effect.
bool is_warning(const SceneEffect& effect) {
  return effect.is_outside && effect.estimate > 0.0 && effect.estimate < 1.0;
}

// One line for each effect: its name and why.
template <typename Condition>
std::string list_of(const ScenePlan& plan, const Condition& belongs) {
  std::string list;
  for (const SceneEffect& e : plan.effects) {
    if (!belongs(e)) continue;
    list += fmt::format("{}    {}: {}", list.empty() ? "" : "\n", e.name, e.reason);
  }
  return list;
}

void print_rows(const ScenePlan& plan, std::ostream& out) {
  for (const SceneEffect& e : plan.effects) {
    if (!e.is_choice && !is_warning(e)) continue;
    const std::string number =
        e.number.empty() ? "" : fmt::format("{} = {:.3g}", e.number, e.value);
    out << fmt::format("  {:<20} {:<9} {:>9}  {:<38} {}\n", e.name,
                       e.is_choice ? state_of(e) : "warning",
                       acts(e) ? fmt::format("{:.1e}", e.estimate) : "-", number, e.reason);
  }
}

void print_savings(const std::vector<EffectSaving>& savings, std::ostream& out) {
  for (const EffectSaving& one : savings) {
    out << fmt::format(
        "  without {}: {:.2g} s instead of {:.2g} s, {} unknowns instead of {} ({})\n", one.effect,
        one.cpu_s_without, one.cpu_s, one.unknowns_without, one.unknowns, one.discretisation);
  }
}

void print_plan(const std::string& path, const Scene& scene, const ScenePlan& plan,
                const std::vector<EffectSaving>& savings, std::ostream& out) {
  const bool has_rows =
      std::any_of(plan.effects.begin(), plan.effects.end(),
                  [](const SceneEffect& e) { return e.is_choice || is_warning(e); });
  out << fmt::format("{}, tolerance {:g}\n", path, common(scene).tolerance);
  if (has_rows) {
    out << fmt::format("  {:<20} {:<9} {:>9}  {:<38} {}\n", "effect", "", "if off", "what decides",
                       "why");
    print_rows(plan, out);
  } else {
    out << "  no effect of this scene is a choice\n";
  }
  const std::string always =
      list_of(plan, [](const SceneEffect& e) { return e.on && !e.is_choice; });
  if (!always.empty()) out << "  on, needed\n" << always << "\n";
  const std::string never =
      list_of(plan, [](const SceneEffect& e) { return !e.on && !e.is_choice && !is_warning(e); });
  if (!never.empty()) out << "  off, not needed\n" << never << "\n";
  print_savings(savings, out);
  out << fmt::format(
      "  left out: {:.1e}; the mesh and the steps may take {:.1e}   (! forced by the scene)\n",
      plan.left_out, common(plan.reduced).tolerance);
}

}  // namespace

void add_tolerance_option(OptionList& options, std::optional<double>& tolerance) {
  options.add("tol", &tolerance, "relative error allowed, instead of the scene's");
}

void apply_tolerance(const std::optional<double>& tolerance, Scene& scene) {
  if (!tolerance) return;
  try {
    set_tolerance(*tolerance, scene);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

int run_plan(const Words& words, Streams& streams) {
  std::string path;
  std::optional<double> tolerance;
  CommandSyntax syntax{
      "viscard plan SCENE.toml [OPTIONS]",
      "Prints the effects that a scene needs at its tolerance, with the number that "
      "decides, the error of leaving each out, and what that saves in processor "
      "time and unknowns. 'viscard simulate' follows it; [effects] in the scene "
      "overrules it.",
      "viscard plan data/scenes/pillar_modal.toml"};
  syntax.positional.add("scene", &path, "scene file");
  syntax.results = {described<ShownPlan>("plan", "viscard plan")};
  add_tolerance_option(syntax.options, tolerance);
  if (!parse_words(syntax, words, streams)) return kDone;
  const SceneFile file = read_scene(path, given_plausible(syntax, Plausible::kScene));
  streams.accepts_implausible |= file.accepts_implausible;
  Scene scene = file.scene;
  apply_tolerance(tolerance, scene);
  constexpr double kLimit_s = 4.0;  // of processor time
  const CostClock clock = process_clock();
  const double start_s = clock.cpu_s();
  const ScenePlan plan = with_lines_of(path, [&] { return checked_plan(scene); });
  std::vector<EffectSaving> savings;
  try {
    savings = effect_savings(scene, kLimit_s - (clock.cpu_s() - start_s));
  } catch (const std::runtime_error& e) {  // the plan itself solves nothing and stands
    if (dynamic_cast<const StopsWork*>(&e) != nullptr) throw;
    streams.err << "viscard plan: no savings are shown, because the scene has no answer on a "
                   "coarse mesh, and "
                   "viscard simulate may refuse it, too: "
                << e.what() << "\n";
  }
  const ShownPlan shown{plan.effects, savings, plan.left_out, common(scene).tolerance,
                        common(plan.reduced).tolerance};
  const auto show = [&](ResultVisitor& v) { show_keys(v, shown); };
  if (!print_result(syntax, {"viscard-plan/1", {path}}, show, streams)) {
    print_plan(path, scene, plan, savings, FittedText(streams));
  }
  return kDone;
}

}  // namespace viscard
