#include "io/scenes/touch_section.h"

#include "io/scenes/scene_words.h"
#include "models/answer/scene_mistake.h"
#include "models/array/space/touch_steps.h"

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

void fill_touch(const std::string& kind, const RawDrive& raw, SpaceScene& scene) {
  if (kind == "static") {
    refuse_at_rest(raw, scene);
    return;
  }
  check_kind(kind, scene);
  SpaceTouch touch{.is_creep = kind == "creep", .history = history_of(raw), .readout = {}};
  if (!raw.readout.empty()) touch.readout = readout_from(raw, scene);
  press_in_time(scene, std::move(touch));
}

}  // namespace viscard
