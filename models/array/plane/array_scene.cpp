#include "models/array/plane/array_scene.h"

#include "models/pillar/mesh/scene_mistake.h"
#include "models/pillar/plan/effects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace viscard {
namespace {

void check_pressure(const ArrayScene& scene, double pressure_Pa, const char* key) {
  const double critical_Pa = engesser_pressure_Pa(single_pillar(scene));
  if (scene.load != ArrayLoad::kPressure || pressure_Pa < critical_Pa) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "a pressure of %.5g Pa is beyond the %.5g Pa at which these pillars buckle (Euler, "
                "Engesser); load them less, or make them shorter or thicker",
                pressure_Pa, critical_Pa);
  throw SceneMistake(key, text);
}

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
    throw SceneMistake("materials.pillar", "what moves needs a density, rho");
  }
  if (!(scene.film.rho_kg_m3 > 0.0)) {
    throw SceneMistake("materials", "what moves needs the film's density, rho");
  }
}

void check_history(const ArrayScene& scene) {
  if (scene.history.size() < 2) {
    throw SceneMistake("analysis", "a transient analysis needs a history or a pulse");
  }
  validate(scene.history);
  if (!(scene.end_time_s > 0.0) || !std::isfinite(scene.end_time_s)) {
    throw SceneMistake("analysis", "a transient analysis needs an end_time that is positive");
  }
  if (scene.outputs < 10 || scene.outputs > 200000) {
    throw SceneMistake("analysis.outputs", "must lie between 10 and 200000");
  }
  for (const HistoryPoint& point : scene.history) {
    check_pressure(scene, point.value, "analysis.history");
  }
}

void check_frequencies(const ArrayScene& scene) {
  const std::vector<double>& f = scene.frequencies_Hz;
  if (f.empty()) throw SceneMistake("analysis", "a harmonic analysis needs frequencies");
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (!(f[i] > (i == 0 ? 0.0 : f[i - 1])) || !std::isfinite(f[i])) {
      throw SceneMistake("analysis.frequencies", "must be positive and ascend");
    }
  }
}

}  // namespace

Scene single_pillar(const ArrayScene& scene) {
  Scene one;
  one.tolerance = scene.tolerance;
  one.geometry.diameter_m = scene.geometry.diameter_m;
  one.geometry.length_m = scene.geometry.length_m;
  one.plane = scene.plane;
  one.pillar = scene.pillar;
  return one;
}

void validate(const ArrayScene& scene) {
  at_key("geometry", [&] { validate(scene.geometry, scene.electrodes); });
  at_key("materials.pillar", [&] { validate(scene.pillar); });
  if (!(scene.tolerance >= 1e-7 && scene.tolerance < 1.0)) {
    char text[100];
    std::snprintf(text, sizeof text, "is %g; for a row of pillars it must lie between 1e-7 and 1",
                  scene.tolerance);
    throw SceneMistake("tolerance", text);
  }
  if (scene.electrodes.is_equipotential && !(scene.film.permittivity_F_m(2, 2) > 0.0)) {
    throw SceneMistake("geometry.electrode",
                       "electrodes need a film with a permittivity, such as one from a file");
  }
  if (!(scene.surface_energy_J_m2 > 0.0)) {
    throw SceneMistake("materials.surface_energy", "must be positive");
  }
  if (scene.analysis != ArrayAnalysis::kStatic) check_density(scene);
  if (scene.analysis == ArrayAnalysis::kModal) return;
  check_loaded(scene);
  if (scene.analysis == ArrayAnalysis::kTransient) return check_history(scene);
  if (scene.analysis == ArrayAnalysis::kHarmonic) check_frequencies(scene);
  if (scene.load_Pa == 0.0 || !std::isfinite(scene.load_Pa)) {
    throw SceneMistake("analysis.load",
                       "needs a pressure or a shear, such as pressure = \"1 kPa\"");
  }
  check_pressure(scene, scene.load_Pa, "analysis.load");
}

std::vector<std::string> result_names(const ArrayScene& scene) {
  if (scene.analysis == ArrayAnalysis::kModal) return {"frequency", "lateral", "longitudinal"};
  const bool is_in_time = scene.analysis != ArrayAnalysis::kStatic;
  std::vector<std::string> names = {"top_displacement"};
  if (!(scene.film.permittivity_F_m(2, 2) > 0.0)) return names;
  const auto add = [&](const char* name) { names.emplace_back(name); };
  const bool is_read = !scene.electrodes.is_equipotential;
  const auto loaded = static_cast<int>(scene.loaded.size());
  const bool all_loaded = loaded == 0 || loaded == scene.geometry.count;
  const bool is_endless = scene.geometry.ends == FilmEnds::kMirror;
  const bool has_midway = is_endless || scene.geometry.count > 1;
  add(is_read ? "centre_voltage" : "electrode_voltage");
  if (is_in_time) return names;
  add(is_read ? "mean_voltage" : "electrode_charge");
  if (has_midway) add("midway_voltage");
  if (has_midway && (all_loaded || loaded > 1 || is_endless)) add("coupling_percent");
  if (!all_loaded) add("crosstalk_percent");
  if (!all_loaded && is_read) add("crosstalk_centre_percent");
  add("neighbours_percent");
  add("deviation_percent");
  return names;
}

}  // namespace viscard
