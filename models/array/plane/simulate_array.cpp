#include "models/array/plane/simulate_array.h"

#include "models/answer/error_control.h"
#include "models/array/plane/array_analysis.h"
#include "models/array/plane/pressed_row.h"
#include "models/pillar/analyses/simulate_pillar.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// Used if the plan leaves the film out: one pillar on a rigid base represents all pillars.
SceneAnswer without_film(const ArrayScene& scene, const Discretisation& mesh) {
  PillarScene one = single_pillar(scene);
  one.drive = analysis_of(scene).alone(scene);
  if (!analysis_of(scene).relaxes) one.pillar.terms.clear();  // answers right after loading
  const SceneAnswer single = pillar_answer_on(one, mesh);
  SceneAnswer answer;
  answer.discretisation = mesh;
  answer.unknowns = single.unknowns;
  for (const SceneMode& mode : single.modes) {
    answer.modes.insert(answer.modes.end(), static_cast<std::size_t>(scene.geometry.count), mode);
  }
  for (const SceneResult& result : single.results) {
    if (result.name != "top_displacement") continue;
    for (int i = 1; i <= scene.geometry.count; ++i) {
      const bool is_loaded =
          scene.loaded.empty() ||
          std::find(scene.loaded.begin(), scene.loaded.end(), i) != scene.loaded.end();
      answer.results.push_back({result.name + "_" + std::to_string(i),
                                is_loaded ? result.value : 0.0, "m", 0.0, std::abs(result.value)});
    }
  }
  return answer;
}

}  // namespace

// At an electrode's edge the field is singular as r^(1/2), which takes more layers than the weaker
// corners of the pillars. The shaft matters to vibrations only.
std::vector<Discretisation> array_meshes(const ArrayScene& scene) {
  std::vector<Discretisation> all;
  for (const auto& [degree, layers] :
       {std::pair{3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}, {8, 4}, {9, 5}}) {
    all.push_back({.degree = degree,
                   .layers = scene.electrodes.is_equipotential ? degree : layers,
                   .shaft_elements = analysis_of(scene).has_inertia ? 2 : 1,
                   .grades_top = scene.load == ArrayLoad::kShear && !scene.press});
  }
  return all;
}

SceneAnswer array_answer_on(const ArrayScene& scene, const Discretisation& mesh) {
  if (scene.press) return pressed_row_on(scene, mesh);
  return scene.feels_film ? analysis_of(scene).run(scene, mesh) : without_film(scene, mesh);
}

SceneAnswer simulate_array(const ArrayScene& scene) {
  validate(scene);
  if (scene.press) return simulate_pressed_row(scene, array_meshes(scene));
  const ArrayAnalysis& analysis = analysis_of(scene);
  return answer_within({scene.tolerance, array_meshes(scene), scene.progress},
                       [&](const Discretisation& mesh) {
                         SceneAnswer answer = array_answer_on(scene, mesh);
                         if (analysis.check_answer != nullptr) analysis.check_answer(scene, answer);
                         return answer;
                       });
}

}  // namespace viscard
