#include "io/scenes/scene_drive.h"

#include "io/scenes/scene_words.h"
#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Straight pieces that stand for half a sine: they err by (pi/256)^2/8 = 2e-5 of its height.
constexpr int kPulsePieces = 256;

std::vector<HistoryPoint> half_sine(double height, double duration_s) {
  std::vector<HistoryPoint> points;
  for (int i = 0; i <= kPulsePieces; ++i) {
    const double share = static_cast<double>(i) / kPulsePieces;
    points.push_back({share * duration_s, height * std::sin(std::numbers::pi * share)});
  }
  points.back().value = 0.0;
  return points;
}

void fill_frequencies(const RawDrive& raw, Scene& scene) {
  if (raw.from_Hz == 0.0) return;
  const bool is_log =
      choice<bool>("analysis.frequencies.spacing", raw.spacing, {{"log", true}, {"linear", false}});
  const double to_Hz = raw.to_Hz > 0.0 ? raw.to_Hz : raw.from_Hz;
  const auto n = raw.count > 0 ? raw.count : (raw.to_Hz > 0.0 ? 100 : 1);
  if (n > 1 && !(to_Hz > raw.from_Hz)) {
    throw SceneMistake("analysis.frequencies", "'to' must lie above 'from'");
  }
  for (std::int64_t i = 0; i < n; ++i) {
    const double share = n == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(n - 1);
    scene.frequencies_Hz.push_back(is_log ? raw.from_Hz * std::pow(to_Hz / raw.from_Hz, share)
                                          : raw.from_Hz + share * (to_Hz - raw.from_Hz));
  }
}

void fill_history(const RawDrive& raw, Scene& scene) {
  if (raw.pulse_duration_s > 0.0) {
    if (!raw.history.empty()) {
      throw SceneMistake("analysis.pulse", "a scene has a history or a pulse, not both");
    }
    scene.history = half_sine(raw.pulse_height, raw.pulse_duration_s);
    return;
  }
  for (const auto& [time_s, value] : raw.history) scene.history.push_back({time_s, value});
  validate(scene.history);
  // A history may begin with nothing at time 0 and jump there.
  if (scene.history.size() > 1 && scene.history[0].time_s == scene.history[1].time_s) {
    if (scene.history[0].value == 0.0) scene.history.erase(scene.history.begin());
  }
}

void fill_readout(const RawDrive& raw, Scene& scene) {
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

// What an analysis does not read would be an experiment other than the one that is meant.
void refuse_unread(bool is_given, const char* key, const std::string& analysis,
                   const std::vector<std::string>& readers) {
  if (!is_given || std::find(readers.begin(), readers.end(), analysis) != readers.end()) return;
  std::string list;
  for (const std::string& reader : readers) list += (list.empty() ? "" : ", ") + reader;
  throw SceneMistake(std::string("analysis.") + key, "a " + analysis +
                                                         " analysis does not use it (" + list +
                                                         "); leave it out, or change the kind");
}

bool is_moved(const RawDrive& raw) {
  return !std::isnan(raw.displacement_m);
}

void fill_displacement(const RawDrive& raw, Scene& scene) {
  if (!is_moved(raw)) return;
  if (scene.kind == AnalysisKind::kRelaxation) {
    throw SceneMistake("analysis.load.displacement",
                       "a relaxation has its shortening in time in a history, such as [[\"0 s\", "
                       "\"1 um\"], [\"10 s\", \"1 um\"]]");
  }
  if (scene.kind != AnalysisKind::kStatic) {
    throw SceneMistake("analysis.load.displacement",
                       "only static analyses move the top by a given displacement");
  }
  scene.displacement_m = raw.displacement_m;
}

// A pressure, a shear (which says the direction), or a force over the top's area.
void fill_traction(const RawDrive& raw, Scene& scene) {
  const int given =
      (raw.pressure_Pa != 0.0) + (raw.shear_Pa != 0.0) + (raw.force_N != 0.0) + is_moved(raw);
  if (given > 1) {
    throw SceneMistake("analysis.load", "give one of pressure, shear, force and displacement");
  }
  fill_displacement(raw, scene);
  const bool in_time = scene.kind == AnalysisKind::kCreep ||
                       scene.kind == AnalysisKind::kRelaxation ||
                       scene.kind == AnalysisKind::kTransient;
  if (in_time && (given > 0 || raw.acceleration_m_s2 != 0.0)) {
    throw SceneMistake("analysis.load",
                       std::string("the load of a ") + analysis_of(scene.kind).name +
                           " analysis stands in its history or pulse; say here only on and "
                           "direction");
  }
  if ((raw.shear_Pa != 0.0 || raw.force_N != 0.0) && scene.load_place == LoadPlace::kBase) {
    throw SceneMistake("analysis.load", "the base takes an acceleration");
  }
  if (raw.shear_Pa != 0.0 && scene.direction == LoadDirection::kAxial) {
    throw SceneMistake("analysis.load.shear", "a shear is sideways; say direction = \"lateral\"");
  }
  const double d_m = 2.0 * radius_at_m(scene.geometry, scene.geometry.length_m);  // of the top
  const double area_m2 = scene.plane ? d_m : 0.25 * std::numbers::pi * d_m * d_m;
  scene.pressure_Pa = raw.pressure_Pa + raw.shear_Pa + raw.force_N / area_m2;
}

}  // namespace

void show_drive(FieldVisitor& v, const std::string& analysis, RawDrive& d) {
  v.section("load", [&](FieldVisitor& l) {
    l.quantity({.key = "pressure", .unit = "Pa"}, d.pressure_Pa);
    l.quantity({.key = "shear", .unit = "Pa"}, d.shear_Pa);
    l.quantity({.key = "force", .unit = "N"}, d.force_N);
    l.quantity({.key = "displacement", .unit = "m"}, d.displacement_m);
    l.quantity({.key = "acceleration", .unit = "m/s2"}, d.acceleration_m_s2);
    l.quantity({.key = "voltage", .unit = "V"}, d.voltage_V);
    l.text({"on", "top"}, d.load_on);
    l.text({"direction", "axial"}, d.direction);
  });
  show_times(v, d.load_on == "base" ? "m/s2" : analysis == "relaxation" ? "m" : "Pa", d);
}

void show_times(FieldVisitor& v, const char* unit, RawDrive& d) {
  v.section("frequencies", [&](FieldVisitor& f) {
    f.quantity({.key = "from", .unit = "Hz", .range = Range::kPositive}, d.from_Hz);
    f.quantity({.key = "to", .unit = "Hz", .range = Range::kPositive}, d.to_Hz);
    f.integer("count", 1, 100000, d.count);
    f.text({"spacing", "log"}, d.spacing);
  });
  v.quantity({.key = "end_time", .unit = "s", .range = Range::kPositive}, d.end_time_s);
  v.integer("outputs", 10, 200000, d.outputs);
  v.section("pulse", [&](FieldVisitor& p) {
    p.quantity({.key = "height", .unit = unit}, d.pulse_height);
    p.quantity({.key = "duration", .unit = "s", .range = Range::kPositive}, d.pulse_duration_s);
  });
  v.quantity_pairs("history", "s", unit, d.history);
}

void show_readout(FieldVisitor& v, RawDrive& d) {
  v.text({"kind", "voltage"}, d.readout);
  v.quantity({.key = "resistance", .unit = "ohm", .range = Range::kPositive}, d.resistance_Ohm);
  v.quantity({.key = "capacitance", .unit = "F", .range = Range::kPositive}, d.capacitance_F);
  v.quantity({.key = "film_resistivity", .unit = "ohm m", .range = Range::kPositive},
             d.film_resistivity_Ohm_m);
}

void fill_drive(const RawDrive& raw, Scene& scene) {
  const bool is_loaded =
      raw.pressure_Pa != 0.0 || raw.shear_Pa != 0.0 || raw.force_N != 0.0 || is_moved(raw);
  if (is_loaded && raw.load_on.empty()) {
    throw SceneMistake("analysis.load", "the load has no place; say on = \"top\"");
  }
  if (!raw.load_on.empty()) {
    scene.load_place = choice<LoadPlace>("analysis.load.on", raw.load_on,
                                         {{"top", LoadPlace::kTop}, {"base", LoadPlace::kBase}});
  }
  const bool moves =
      scene.kind == AnalysisKind::kHarmonic || scene.kind == AnalysisKind::kTransient;
  if (scene.load_place == LoadPlace::kBase && !moves) {
    throw SceneMistake("analysis.load.on",
                       "only harmonic and transient analyses shake the base; say \"top\"");
  }
  if (raw.acceleration_m_s2 != 0.0 && scene.load_place != LoadPlace::kBase) {
    throw SceneMistake("analysis.load.acceleration", "is of the base; say on = \"base\"");
  }
  if (raw.pressure_Pa != 0.0 && scene.load_place == LoadPlace::kBase) {
    throw SceneMistake("analysis.load.pressure", "is on the top; the base takes an acceleration");
  }
  scene.direction = choice<LoadDirection>(
      "analysis.load.direction", raw.direction,
      {{"axial", LoadDirection::kAxial}, {"lateral", LoadDirection::kLateral}});
  const bool may_push_sideways = moves || scene.kind == AnalysisKind::kStatic;
  if (scene.direction == LoadDirection::kLateral && !may_push_sideways) {
    throw SceneMistake("analysis.load.direction",
                       "only static, harmonic and transient analyses push sideways; say \"axial\"");
  }
  fill_traction(raw, scene);
  scene.base_acceleration_m_s2 = raw.acceleration_m_s2;
  if (raw.voltage_V != 0.0 && scene.kind != AnalysisKind::kStatic) {
    throw SceneMistake("analysis.load.voltage", "only static analyses drive the electrode");
  }
  scene.drive_V = raw.voltage_V;
  scene.end_time_s = raw.end_time_s;
  scene.outputs = static_cast<int>(raw.outputs);
  fill_times(raw, analysis_of(scene.kind).name, scene);
  fill_readout(raw, scene);
}

void fill_times(const RawDrive& raw, const std::string& analysis, Scene& scene) {
  refuse_unread(raw.from_Hz != 0.0, "frequencies", analysis, {"harmonic"});
  refuse_unread(raw.end_time_s != 0.0, "end_time", analysis, {"transient"});
  const std::vector<std::string> in_time = {"relaxation", "creep", "transient"};
  refuse_unread(!raw.history.empty(), "history", analysis, in_time);
  refuse_unread(raw.pulse_duration_s != 0.0, "pulse", analysis, in_time);
  fill_frequencies(raw, scene);
  fill_history(raw, scene);
}

}  // namespace viscard
