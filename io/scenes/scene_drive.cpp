#include "io/scenes/raw_drive.h"
#include "io/scenes/scene_words.h"
#include "models/answer/drive_parts.h"
#include "models/array/plane/array_analysis.h"
#include "models/pillar/analyses/analysis.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Parts of drives that a scene file sets: the member of a drive that has it.
constexpr auto kModes = [](auto& d) -> decltype((d.modes)) { return d.modes; };
constexpr auto kPlate = [](auto& d) -> decltype((d.plate_on_top)) { return d.plate_on_top; };
constexpr auto kPlace = [](auto& d) -> decltype((d.load_place)) { return d.load_place; };
constexpr auto kDirection = [](auto& d) -> decltype((d.direction)) { return d.direction; };
constexpr auto kPressure = [](auto& d) -> decltype((d.pressure_Pa)) { return d.pressure_Pa; };
constexpr auto kDisplacement = [](auto& d) -> decltype((d.displacement_m)) {
  return d.displacement_m;
};
constexpr auto kAcceleration = [](auto& d) -> decltype((d.base_acceleration_m_s2)) {
  return d.base_acceleration_m_s2;
};
constexpr auto kVoltage = [](auto& d) -> decltype((d.drive_V)) { return d.drive_V; };
constexpr auto kFrequencies = [](auto& d) -> decltype((d.frequencies_Hz)) {
  return d.frequencies_Hz;
};
constexpr auto kHistory = [](auto& d) -> decltype((d.history)) { return d.history; };
constexpr auto kEndTime = [](auto& d) -> decltype((d.end_time_s)) { return d.end_time_s; };
constexpr auto kOutputs = [](auto& d) -> decltype((d.outputs)) { return d.outputs; };

// Sets a part of the drive; false if it has none.
template <typename Drive, typename Part, typename Value>
bool set(Drive& drive, const Part& part, const Value& value) {
  return set_part(drive, [&](auto& d) -> decltype(void(part(d))) { part(d) = value; });
}

// The analyses whose drive has a part: "static, harmonic" and then `joint` and "transient".
template <typename Rows, typename Part>
std::string analyses_with(const Rows& rows, const Part& part, const std::string& joint) {
  std::vector<std::string> names;
  for (const auto& row : rows) {
    if (has_part(row.drive, part)) names.emplace_back(row.name);
  }
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == names.size() ? joint : ", ") + names[i];
  }
  return list;
}

// Refused, because the user wants another analysis than one that ignores the value.
template <typename Rows, typename Drive, typename Part>
void refuse_unread(bool is_given, const char* key, const Rows& rows, const char* analysis,
                   const Drive& drive, const Part& part) {
  if (!is_given || has_part(drive, part)) return;
  throw SceneMistake(std::string("analysis.") + key,
                     std::string("a ") + analysis + " analysis does not use it (" +
                         analyses_with(rows, part, ", ") + "); leave it out, or change the kind");
}

// "only harmonic and transient analyses" and what they alone do.
template <typename Part>
std::string only(const Part& part, const std::string& what) {
  return "only " + analyses_with(analyses(), part, " and ") + " analyses " + what;
}

template <typename Rows, typename Drive>
void fill_times_of(const RawDrive& raw, const Rows& rows, const char* analysis, Drive& drive) {
  const auto refuse = [&](bool is_given, const char* key, const auto& part) {
    refuse_unread(is_given, key, rows, analysis, drive, part);
  };
  refuse(raw.from_Hz != 0.0, "frequencies", kFrequencies);
  refuse(raw.end_time_s != 0.0, "end_time", kEndTime);
  refuse(!raw.history.empty(), "history", kHistory);
  refuse(raw.pulse_duration_s != 0.0, "pulse", kHistory);
  set(drive, kFrequencies, frequencies_of(raw));
  set(drive, kHistory, history_of(raw));
  set(drive, kEndTime, raw.end_time_s);
  set(drive, kOutputs, static_cast<int>(raw.outputs));
}

bool is_moved(const RawDrive& raw) {
  return !std::isnan(raw.displacement_m);
}

void fill_displacement(const RawDrive& raw, PillarScene& scene) {
  if (!is_moved(raw)) return;
  if (analysis_of(scene).history == HistoryOf::kShortening) {
    throw SceneMistake("analysis.load.displacement",
                       std::string("a ") + analysis_of(scene).name +
                           " has its shortening in time in a history, such as [[\"0 s\", "
                           "\"1 um\"], [\"10 s\", \"1 um\"]]");
  }
  if (!set(scene.drive, kDisplacement, raw.displacement_m)) {
    throw SceneMistake("analysis.load.displacement",
                       only(kDisplacement, "move the top by a given displacement"));
  }
}

// Where the load acts: on the top, or as an acceleration of the base.
void fill_place(const RawDrive& raw, PillarScene& scene) {
  const bool is_loaded =
      raw.pressure_Pa != 0.0 || raw.shear_Pa != 0.0 || raw.force_N != 0.0 || is_moved(raw);
  if (is_loaded && raw.load_on.empty()) {
    throw SceneMistake("analysis.load", "the load has no place; say on = \"top\"");
  }
  LoadPlace place = LoadPlace::kTop;
  if (!raw.load_on.empty()) {
    place = choice<LoadPlace>("analysis.load.on", raw.load_on,
                              {{"top", LoadPlace::kTop}, {"base", LoadPlace::kBase}});
  }
  if (!set(scene.drive, kPlace, place) && place == LoadPlace::kBase) {
    throw SceneMistake("analysis.load.on", only(kPlace, "shake the base; say \"top\""));
  }
  if (raw.acceleration_m_s2 != 0.0 && place != LoadPlace::kBase) {
    throw SceneMistake("analysis.load.acceleration", "is of the base; say on = \"base\"");
  }
  if (raw.pressure_Pa != 0.0 && place == LoadPlace::kBase) {
    throw SceneMistake("analysis.load.pressure", "is on the top; the base takes an acceleration");
  }
}

void fill_direction(const RawDrive& raw, PillarScene& scene) {
  const auto direction = choice<LoadDirection>(
      "analysis.load.direction", raw.direction,
      {{"axial", LoadDirection::kAxial}, {"lateral", LoadDirection::kLateral}});
  if (!set(scene.drive, kDirection, direction) && direction == LoadDirection::kLateral) {
    throw SceneMistake("analysis.load.direction", only(kDirection, "push sideways; say \"axial\""));
  }
}

// A pressure, a shear (which needs direction = "lateral"), or a force over the area of the top.
void fill_traction(const RawDrive& raw, PillarScene& scene) {
  const int given =
      (raw.pressure_Pa != 0.0) + (raw.shear_Pa != 0.0) + (raw.force_N != 0.0) + is_moved(raw);
  if (given > 1) {
    throw SceneMistake("analysis.load", "give one of pressure, shear, force and displacement");
  }
  fill_displacement(raw, scene);
  if (has_history(scene) && (given > 0 || raw.acceleration_m_s2 != 0.0)) {
    throw SceneMistake("analysis.load",
                       std::string("the load of a ") + analysis_of(scene).name +
                           " analysis stands in its history or pulse; say here only on and "
                           "direction");
  }
  if ((raw.shear_Pa != 0.0 || raw.force_N != 0.0) && load_place(scene) == LoadPlace::kBase) {
    throw SceneMistake("analysis.load", "the base takes an acceleration");
  }
  if (raw.shear_Pa != 0.0 && !is_lateral(scene)) {
    throw SceneMistake("analysis.load.shear", "a shear is sideways; say direction = \"lateral\"");
  }
  const double d_m = 2.0 * radius_at_m(scene.geometry, scene.geometry.length_m);  // of the top
  const double area_m2 = scene.plane ? d_m : 0.25 * std::numbers::pi * d_m * d_m;
  set(scene.drive, kPressure, raw.pressure_Pa + raw.shear_Pa + raw.force_N / area_m2);
  set(scene.drive, kAcceleration, raw.acceleration_m_s2);
}

void fill_voltage(const RawDrive& raw, PillarScene& scene) {
  if (!set(scene.drive, kVoltage, raw.voltage_V) && raw.voltage_V != 0.0) {
    throw SceneMistake("analysis.load.voltage", only(kVoltage, "drive the electrode"));
  }
}

}  // namespace

void fill_modes_and_top(const RawDrive& raw, PillarScene& scene) {
  set(scene.drive, kModes, static_cast<int>(raw.modes));
  if (raw.top.empty()) return;
  if (!has_part(scene.drive, kPlate)) {
    throw SceneMistake("analysis.top", only(kPlate, "say what is on the top"));
  }
  set(scene.drive, kPlate,
      choice<bool>("analysis.top", raw.top, {{"free", false}, {"plate", true}}));
}

void fill_drive(const RawDrive& raw, PillarScene& scene) {
  fill_place(raw, scene);
  fill_direction(raw, scene);
  fill_traction(raw, scene);
  fill_voltage(raw, scene);
  fill_times_of(raw, analyses(), analysis_of(scene).name, scene.drive);
}

void fill_drive(const RawDrive& raw, ArrayScene& scene) {
  set(scene.drive, kModes, static_cast<int>(raw.modes));
  fill_times_of(raw, array_analyses(), analysis_of(scene).name, scene.drive);
}

void fill_readout(const RawDrive& raw, PillarScene& scene) {
  if (raw.readout.empty()) return;
  Readout readout;
  readout.kind =
      choice<ReadoutKind>("readout.kind", raw.readout,
                          {{"voltage", ReadoutKind::kVoltage}, {"charge", ReadoutKind::kCharge}});
  if (!scene.electrodes || scene.electrodes->electrode_radius_m == 0.0) {
    throw SceneMistake("readout", "needs an electrode with a radius to be wired to");
  }
  if (raw.resistance_Ohm > 0.0) readout.resistance_Ohm = raw.resistance_Ohm;
  readout.capacitance_F = raw.capacitance_F;
  if (raw.film_resistivity_Ohm_m > 0.0) {
    readout.film_leakage_s = raw.film_resistivity_Ohm_m * scene.film->permittivity_F_m(2, 2);
  }
  try {
    validate(readout);
  } catch (const std::invalid_argument& error) {
    throw SceneMistake("readout", error.what());
  }
  scene.readout = readout;
}

}  // namespace viscard
