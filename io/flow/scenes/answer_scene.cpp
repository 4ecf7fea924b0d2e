#include "io/flow/scenes/answer_scene.h"

#include "io/flow/scenes/array_sweep.h"
#include "models/scene/simulate.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

// "centre_voltage" stands for centre_voltage_1, centre_voltage_2, ...; of an array in the plane for
// centre_voltage_1_1, ... and the extremes of the map.
bool is_named(const std::string& result, const std::string& wanted) {
  if (!result.starts_with(wanted)) return false;
  const std::string rest = result.substr(wanted.size());
  return rest.empty() || rest == "_largest" || rest == "_smallest" ||
         (rest.size() > 1 && rest[0] == '_' &&
          rest.find_first_not_of("0123456789_", 1) == std::string::npos);
}

}  // namespace

void keep_wanted(const std::vector<std::string>& wanted, SceneAnswer& answer) {
  if (wanted.empty() || answer.results.empty()) return;
  const auto stands_for = [&](const std::string& name, const SceneResult& r) {
    if (is_named(r.name, name)) return true;
    const bool is_curve =
        std::any_of(answer.curves.begin(), answer.curves.end(), [&](const SceneCurve& curve) {
          return curve.name == name || curve.name.starts_with(name + "_");
        });
    return is_curve && r.name.starts_with(name + "_");
  };
  std::erase_if(answer.results, [&](const SceneResult& r) {
    return std::none_of(wanted.begin(), wanted.end(),
                        [&](const std::string& name) { return stands_for(name, r); });
  });
}

void set_tolerance(double tolerance, Scene& scene) {
  const ToleranceRange& range = tolerances_of(scene);
  if (!range.contains(tolerance)) {
    throw std::invalid_argument(std::string("--tol must lie between ") + range.words);
  }
  common(scene).tolerance = tolerance;
}

SceneAnswer simulate_file(const Scene& scene, const std::string& path) {
  try {
    return simulate(scene);
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(text_with_line(path, mistake));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

SceneAnswer answer_scene(const SceneFile& file, const std::string& path,
                         const std::function<void(double, const std::string&)>& progress) {
  if (!file.sweep.is_empty()) {
    SweepStore store("", "");
    return solve_sweep(file, store, progress);
  }
  Scene scene = file.scene;
  if (progress) common(scene).progress = [&](double done) { progress(done, ""); };
  SceneAnswer answer = simulate_file(scene, path);
  keep_wanted(common(scene).wanted, answer);
  return answer;
}

}  // namespace viscard
