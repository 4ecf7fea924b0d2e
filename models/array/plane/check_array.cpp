#include "models/answer/scene_mistake.h"
#include "models/array/plane/array_analysis.h"
#include "models/array/plane/pressed_row.h"
#include "models/array/plane/simulate_array.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/buckling_limit.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

void check_loaded(const ArrayScene& scene) {
  for (std::size_t i = 0; i < scene.loaded.size(); ++i) {
    const int pillar = scene.loaded[i];
    const std::string key = "analysis.load.pillars." + std::to_string(i + 1);
    if (pillar < 1 || pillar > scene.geometry.count) {
      throw SceneMistake(key, "there is no pillar " + std::to_string(pillar) +
                                  "; they are numbered from 1 to " +
                                  std::to_string(scene.geometry.count));
    }
    const auto here = scene.loaded.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(scene.loaded.begin(), here, pillar) != here) {
      throw SceneMistake(key, "pillar " + std::to_string(pillar) + " is named twice");
    }
  }
}

void check_density(const ArrayScene& scene) {
  if (!(scene.pillar.rho_kg_m3 > 0.0)) {
    throw SceneMistake("materials.pillar", "vibrations need the pillars' density, rho");
  }
  if (!(scene.film.rho_kg_m3 > 0.0)) {
    throw SceneMistake("materials", "vibrations need the film's density, rho");
  }
}

}  // namespace

void validate(const ArrayScene& scene) {
  at_key("geometry", [&] { validate(scene.geometry, scene.electrodes); });
  at_key("materials.pillar", [&] { validate(scene.pillar); });
  check_tolerance(scene.tolerance, ArrayScene::kTolerances);
  if (scene.electrodes.is_equipotential && !is_electric(scene)) {
    throw SceneMistake("geometry.electrode",
                       "electrodes need a film with a permittivity, such as one from a file");
  }
  if (!(scene.surface_energy_J_m2 > 0.0)) {
    throw SceneMistake("materials.surface_energy", "the surface energy must be positive");
  }
  const ArrayAnalysis& analysis = analysis_of(scene);
  if (scene.press) return check_row_press(scene);
  if (analysis.has_inertia) check_density(scene);
  if (analysis.is_loaded) check_loaded(scene);
  if (analysis.check != nullptr) analysis.check(scene);
}

void check_pressure(const ArrayScene& scene, double pressure_Pa, const char* key) {
  const double critical_Pa = engesser_pressure_Pa(single_pillar(scene));
  if (scene.load != ArrayLoad::kPressure || pressure_Pa < critical_Pa) return;
  throw SceneMistake(key, "a pressure of " + text_of(pressure_Pa, 5) + " Pa is beyond the " +
                              text_of(critical_Pa, 5) +
                              " Pa at which these pillars buckle (Euler, Engesser); reduce it, or "
                              "make them shorter or thicker");
}

void check_load(const ArrayScene& scene) {
  if (scene.load_Pa == 0.0 || !std::isfinite(scene.load_Pa)) {
    throw SceneMistake("analysis.load",
                       "needs a pressure or a shear, such as pressure = \"1 kPa\"");
  }
  check_pressure(scene, scene.load_Pa, "analysis.load");
}

std::vector<std::string> result_names(const ArrayScene& scene) {
  if (scene.press) return pressed_row_names(scene);
  return analysis_of(scene).result_names(scene);
}

}  // namespace viscard
