#include "io/scenes/touch_section.h"

#include "io/scenes/scene_words.h"
#include "models/array/space/touch_steps.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <cmath>
#include <string>
#include <utility>

namespace viscard {
namespace {

void refuse_at_rest(const RawDrive& raw, const SpaceScene& scene) {
  if (!raw.history.empty()) {
    throw SceneMistake(
        "analysis.history",
        "a load at rest has none; say kind = \"relaxation\" for the depth of a shape "
        "in time, or \"creep\" for its force");
  }
  if (!raw.readout.empty() && !scene.noise) {
    throw SceneMistake("readout",
                       "charge leaks in time, and [noise] is that of an amplifier; add [noise], or "
                       "say kind = \"relaxation\" or \"creep\", with a "
                       "history and a shape");
  }
}

void check_kind(const std::string& kind, const SpaceScene& scene) {
  if (kind != "relaxation" && kind != "creep") {
    throw SceneMistake("analysis.kind", "cannot be '" + kind +
                                            "': arrays in the plane are answered for loads at "
                                            "rest, kind = \"static\", and under a shape in time, "
                                            "\"relaxation\" and \"creep\"; rows (model = "
                                            "\"plane-stress\") have other analyses too");
  }
  if (!scene.press) {
    throw SceneMistake("analysis.kind", "'" + kind +
                                            "' of an array in the plane needs a [shape] that "
                                            "presses on it, such as kind = \"sphere\"");
  }
  const bool is_force = scene.press->force_N > 0.0;
  if (!is_force && !(scene.press->depth_m > 0.0)) return;
  throw SceneMistake(is_force ? "shape.force" : "shape.depth",
                     "stands in analysis.history: the depth for \"relaxation\", the force for "
                     "\"creep\"");
}

SpaceTouch touch_along(const RawShape& shape) {
  SpaceTouch touch;
  touch.is_creep = !std::isnan(shape.path.front().force_N);
  for (std::size_t i = 0; i < shape.path.size(); ++i) {
    const RawStop& stop = shape.path[i];
    const bool has_depth = !std::isnan(stop.depth_m), has_force = !std::isnan(stop.force_N);
    if (has_depth == has_force || has_force != touch.is_creep) {
      throw SceneMistake("shape.path." + std::to_string(i + 1),
                         "needs a depth or a force, and the same one in all entries, such as { "
                         "time = \"1 s\", x = \"50 um\", y = \"0 um\", depth = \"2 um\" }");
    }
    touch.history.push_back({stop.time_s, touch.is_creep ? stop.force_N : stop.depth_m});
    touch.place_m.emplace_back(stop.x_m, stop.y_m);
  }
  return touch;
}

// What a path says itself.
void refuse_beside_path(const std::string& kind, const RawDrive& raw, const RawShape& shape) {
  const char* key = !raw.history.empty()      ? "analysis.history"
                    : shape.depth_m != 0.0    ? "shape.depth"
                    : shape.force_N != 0.0    ? "shape.force"
                    : !shape.at_m.empty()     ? "shape.at"
                    : !shape.before_m.empty() ? "shape.before"
                                              : nullptr;
  if (key != nullptr) {
    throw SceneMistake(key,
                       "cannot stand beside shape.path, which has the times, places and "
                       "depths or forces");
  }
  const bool is_creep = !std::isnan(shape.path.front().force_N);
  if (kind == "static" || kind == (is_creep ? "creep" : "relaxation")) return;
  throw SceneMistake("analysis.kind", "cannot be '" + kind +
                                          "' beside shape.path; leave it out, or say "
                                          "\"relaxation\" for depths and \"creep\" for forces");
}

}  // namespace

Readout readout_from(const RawDrive& raw, const SpaceScene& scene) {
  Readout readout;
  readout.kind =
      choice<ReadoutKind>("readout.kind", raw.readout,
                          {{"voltage", ReadoutKind::kVoltage}, {"charge", ReadoutKind::kCharge}});
  if (raw.resistance_Ohm > 0.0) readout.resistance_Ohm = raw.resistance_Ohm;
  readout.capacitance_F = raw.capacitance_F;
  if (raw.film_resistivity_Ohm_m > 0.0) {
    readout.film_leakage_s = raw.film_resistivity_Ohm_m * scene.film.permittivity_F_m(2, 2);
  }
  return readout;
}

void show_touch_history(FieldVisitor& v, const std::string& kind, RawDrive& drive) {
  v.quantity_pairs("history", "s", kind == "creep" ? "N" : "m", drive.history);
}

void fill_touch(const std::string& kind, const RawDrive& raw, const RawShape& shape,
                SpaceScene& scene) {
  const bool is_path = !shape.path.empty();
  if (is_path) {
    if (!scene.press) throw SceneMistake("shape", "has a path, but no kind, such as \"sphere\"");
    refuse_beside_path(kind, raw, shape);
  } else if (kind == "static") {
    refuse_at_rest(raw, scene);
    return;
  } else {
    check_kind(kind, scene);
  }
  SpaceTouch touch;
  if (is_path) {
    touch = touch_along(shape);
  } else {
    touch.is_creep = kind == "creep";
    touch.history = history_of(raw);
  }
  if (!raw.readout.empty()) touch.readout = readout_from(raw, scene);
  press_in_time(scene, std::move(touch));
}

}  // namespace viscard
