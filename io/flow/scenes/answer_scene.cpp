#include "io/flow/scenes/answer_scene.h"

#include "io/flow/scenes/array_sweep.h"
#include "io/flow/scenes/wanted_results.h"
#include "io/materials/material_json.h"
#include "models/maths/failure_text.h"
#include "models/quantities/plausible.h"
#include "models/scene/simulate.h"

#include <map>
#include <stdexcept>
#include <vector>

namespace viscard {

void set_tolerance(double tolerance, Scene& scene) {
  const ToleranceRange& range = tolerances_of(scene);
  if (!range.contains(tolerance)) {
    throw std::invalid_argument(std::string("--tol must lie between ") + range.words);
  }
  common(scene).tolerance = tolerance;
}

void add_notes_of_file(const SceneFile& file, SceneAnswer& answer) {
  if (file.accepts_implausible) answer.notes.emplace_back(kPlausibleOffText);
  if (const std::string edited = note_of_edited(file.scene); !edited.empty())
    answer.notes.push_back(edited);
  if (!file.row_is_called_array) return;
  answer.notes.emplace_back(
      "geometry.kind is \"array\" of a row of pillars; write \"row\", because an array is one in "
      "the "
      "plane now");
}

std::string note_of_edited(const Scene& scene) {
  std::vector<const Material*> materials = {&common(scene).pillar};
  if (const auto* array = std::get_if<SpaceScene>(&scene)) {
    for (const SpaceClass& one : array->others) materials.push_back(&one.material);
  }
  for (const Material* material : materials) {
    for (const MaterialFlag& flag : material->flags) {
      if (flag.name != kEdited) continue;
      return "material" + (material->name.empty() ? "" : " " + material->name) + ": " + flag.text;
    }
  }
  return "";
}

SceneAnswer simulate_file(const Scene& scene, const std::string& path) {
  try {
    return simulate(scene);
  } catch (const NotEnoughMemory& error) {
    throw NotEnoughMemory(path + ": " + error.what());  // which is no answer of a sweep
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(text_with_line(path, mistake));
  } catch (const std::runtime_error& error) {
    if (!is_refusal(error)) throw;
    throw std::runtime_error(path + ": " + error.what());
  }
}

SceneAnswer answer_scene(const SceneFile& file, const std::string& path,
                         const std::function<void(double, const std::string&)>& progress) {
  if (!file.sweep.is_empty()) {
    std::map<std::size_t, SweepRow> rows;
    return solve_sweep(file, rows, {.progress = progress});
  }
  Scene scene = file.scene;
  if (progress) common(scene).progress = progress;
  SceneAnswer answer = simulate_file(scene, path);
  keep_wanted(common(scene).wanted, answer);
  return answer;
}

}  // namespace viscard
