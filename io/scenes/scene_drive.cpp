#include "io/scenes/scene_drive.h"

#include "io/scenes/scene_fields.h"
#include "models/answer/drive_parts.h"
#include "models/array/plane/array_analysis.h"
#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

// Parts of drives that a scene file sets: the member of a drive that has it.
constexpr auto kModes = [](auto& d) -> decltype((d.modes)) { return d.modes; };
constexpr auto kPlate = [](auto& d) -> decltype((d.plate_on_top)) { return d.plate_on_top; };
constexpr auto kBow = [](auto& d) -> decltype((d.bow_m)) { return d.bow_m; };
constexpr auto kStrain = [](auto& d) -> decltype((d.collapse_strain)) { return d.collapse_strain; };
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

// Straight pieces that stand for half a sine: they err by (pi/256)^2/8 = 2e-5 of its height.
constexpr int kPulsePieces = 256;

Course half_sine(double height, double duration_s) {
  Course points;
  for (int i = 0; i <= kPulsePieces; ++i) {
    const double share = static_cast<double>(i) / kPulsePieces;
    points.push_back({share * duration_s, height * std::sin(std::numbers::pi * share)});
  }
  points.back().value = 0.0;
  return points;
}

// What stands in [analysis] of times and frequencies; 0 and empty: not given.
struct TimeKeys {
  double from_Hz = 0.0, to_Hz = 0.0;
  std::int64_t count = 0;
  bool is_log = true;
  double end_time_s = 0.0, pulse_height = 0.0, pulse_duration_s = 0.0;
  Pairs history;
};

template <typename Drive>
TimeKeys times_of(const Drive& drive) {
  TimeKeys keys{.end_time_s = part_of(drive, kEndTime, 0.0)};
  keys.history = pairs_of(part_of(drive, kHistory, Course()));
  const auto f_Hz = part_of(drive, kFrequencies, std::vector<double>());
  if (f_Hz.empty()) return keys;
  keys.from_Hz = f_Hz.front();
  keys.to_Hz = f_Hz.size() > 1 ? f_Hz.back() : 0.0;
  keys.count = std::ssize(f_Hz);
  keys.is_log =
      f_Hz.size() < 3 || std::abs(f_Hz[2] - 2.0 * f_Hz[1] + f_Hz[0]) > 1e-9 * (f_Hz[2] - f_Hz[0]);
  return keys;
}

std::vector<double> frequencies_of(const TimeKeys& keys) {
  std::vector<double> frequencies_Hz;
  if (keys.from_Hz == 0.0) return frequencies_Hz;
  const double to_Hz = keys.to_Hz > 0.0 ? keys.to_Hz : keys.from_Hz;
  const auto n = keys.count > 0 ? keys.count : (keys.to_Hz > 0.0 ? 100 : 1);
  if (n > 1 && !(to_Hz > keys.from_Hz)) {
    throw SceneMistake("analysis.frequencies", "'to' must lie above 'from'");
  }
  for (std::int64_t i = 0; i < n; ++i) {
    const double share = n == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(n - 1);
    frequencies_Hz.push_back(keys.is_log ? keys.from_Hz * std::pow(to_Hz / keys.from_Hz, share)
                                         : keys.from_Hz + share * (to_Hz - keys.from_Hz));
  }
  return frequencies_Hz;
}

Course history_or_pulse(const TimeKeys& keys) {
  if (!(keys.pulse_duration_s > 0.0)) return history_of(keys.history);
  if (!keys.history.empty()) {
    throw SceneMistake("analysis.pulse", "a scene has a history or a pulse, not both");
  }
  return half_sine(keys.pulse_height, keys.pulse_duration_s);
}

template <typename Rows, typename Drive>
void fill_times(const TimeKeys& keys, const Rows& rows, const char* analysis, Drive& drive) {
  const auto refuse = [&](bool is_given, const char* key, const auto& part) {
    refuse_unread(is_given, key, rows, analysis, drive, part);
  };
  refuse(keys.from_Hz != 0.0, "frequencies", kFrequencies);
  refuse(keys.end_time_s != 0.0, "end_time", kEndTime);
  refuse(!keys.history.empty(), "history", kHistory);
  refuse(keys.pulse_duration_s != 0.0, "pulse", kHistory);
  set(drive, kFrequencies, frequencies_of(keys));
  set(drive, kHistory, history_or_pulse(keys));
  set(drive, kEndTime, keys.end_time_s);
}

// analysis.kind with its drive, and the number of modes.
template <typename Rows, typename Scene>
void show_kind(FieldVisitor& v, const Rows& rows, int most_modes, Scene& scene) {
  std::vector<std::string> known;
  for (const auto& row : rows) known.emplace_back(row.name);
  std::sort(known.begin(), known.end());
  std::string kind = analysis_of(scene).name;
  v.word({"kind", "static"}, known, kind);
  for (const auto& row : rows) {
    if (v.reads() && row.name == kind) scene.drive = row.drive;
  }
  int modes = part_of(scene.drive, kModes, 1);
  v.integer("modes", 1, most_modes, modes);
  set(scene.drive, kModes, modes);
}

// The keys in time and frequency; histories and pulses have `unit`.
template <typename Rows, typename Scene>
void show_times(FieldVisitor& v, const char* unit, const Rows& rows, Scene& scene) {
  const auto keys = std::make_shared<TimeKeys>(times_of(scene.drive));
  v.section("frequencies", [&](FieldVisitor& f) {
    f.quantity({.key = "from", .unit = "Hz", .range = Range::kPositive, .is_exact = true},
               keys->from_Hz);
    f.quantity({.key = "to", .unit = "Hz", .range = Range::kPositive, .is_exact = true},
               keys->to_Hz);
    f.integer("count", 1, 100000, keys->count);
    f.choice({"spacing", "log"}, {{"log", true}, {"linear", false}}, keys->is_log);
  });
  v.quantity({.key = "end_time", .unit = "s", .range = Range::kPositive, .is_exact = true},
             keys->end_time_s);
  int outputs = part_of(scene.drive, kOutputs, 1000);
  v.integer("outputs", 10, 200000, outputs);
  set(scene.drive, kOutputs, outputs);
  v.section("pulse", [&](FieldVisitor& p) {
    p.quantity({.key = "height", .unit = unit}, keys->pulse_height);
    p.quantity({.key = "duration", .unit = "s", .range = Range::kPositive}, keys->pulse_duration_s);
  });
  v.quantity_pairs("history", "s", unit, keys->history);
  v.after_all_keys(
      [&scene, &rows, keys] { fill_times(*keys, rows, analysis_of(scene).name, scene.drive); });
}

// What stands in analysis.load.
struct LoadKeys {
  std::optional<LoadPlace> on;
  LoadDirection direction = LoadDirection::kAxial;
  double pressure_Pa = 0.0, shear_Pa = 0.0, force_N = 0.0, acceleration_m_s2 = 0.0, voltage_V = 0.0;
  double displacement_m = std::numeric_limits<double>::quiet_NaN();  // NaN: not given
  bool is_moved() const { return !std::isnan(displacement_m); }
};

LoadKeys load_of(const PillarScene& scene) {
  LoadKeys keys{.direction = is_lateral(scene) ? LoadDirection::kLateral : LoadDirection::kAxial,
                .acceleration_m_s2 = base_acceleration_m_s2(scene),
                .voltage_V = drive_V(scene)};
  (is_lateral(scene) ? keys.shear_Pa : keys.pressure_Pa) = pressure_Pa(scene);
  if (const auto moved_m = displacement_m(scene)) keys.displacement_m = *moved_m;
  if (pressure_Pa(scene) != 0.0 || keys.is_moved() || load_place(scene) == LoadPlace::kBase) {
    keys.on = load_place(scene);
  }
  return keys;
}

void fill_displacement(const LoadKeys& keys, PillarScene& scene) {
  if (!keys.is_moved()) return;
  if (analysis_of(scene).history == HistoryOf::kShortening) {
    throw SceneMistake("analysis.load.displacement",
                       std::string("a ") + analysis_of(scene).name +
                           " has its shortening in time in a history, such as [[\"0 s\", "
                           "\"1 um\"], [\"10 s\", \"1 um\"]]");
  }
  if (!set(scene.drive, kDisplacement, keys.displacement_m)) {
    throw SceneMistake("analysis.load.displacement",
                       only(kDisplacement, "move the top by a given displacement"));
  }
}

// Where the load acts: on the top, or as an acceleration of the base.
void fill_place(const LoadKeys& keys, PillarScene& scene) {
  const bool is_loaded =
      keys.pressure_Pa != 0.0 || keys.shear_Pa != 0.0 || keys.force_N != 0.0 || keys.is_moved();
  if (is_loaded && !keys.on) {
    throw SceneMistake("analysis.load", "the load has no place; write on = \"top\"");
  }
  const LoadPlace place = keys.on.value_or(LoadPlace::kTop);
  if (!set(scene.drive, kPlace, place) && place == LoadPlace::kBase) {
    throw SceneMistake("analysis.load.on", only(kPlace, "shake the base; write \"top\""));
  }
  if (keys.acceleration_m_s2 != 0.0 && place != LoadPlace::kBase) {
    throw SceneMistake("analysis.load.acceleration", "is of the base; write on = \"base\"");
  }
  if (keys.pressure_Pa != 0.0 && place == LoadPlace::kBase) {
    throw SceneMistake("analysis.load.pressure", "is on the top; the base takes an acceleration");
  }
  if (!set(scene.drive, kDirection, keys.direction) && keys.direction == LoadDirection::kLateral) {
    throw SceneMistake("analysis.load.direction",
                       only(kDirection, "push sideways; write \"axial\""));
  }
}

// A pressure, a shear (which needs direction = "lateral"), or a force over the area of the top.
void fill_traction(const LoadKeys& keys, PillarScene& scene) {
  const int given =
      (keys.pressure_Pa != 0.0) + (keys.shear_Pa != 0.0) + (keys.force_N != 0.0) + keys.is_moved();
  if (given > 1) {
    throw SceneMistake("analysis.load", "give one of pressure, shear, force and displacement");
  }
  fill_displacement(keys, scene);
  if (has_history(scene) && (given > 0 || keys.acceleration_m_s2 != 0.0)) {
    throw SceneMistake("analysis.load",
                       std::string("the load of a ") + analysis_of(scene).name +
                           " analysis stands in its history or pulse; write here only on and "
                           "direction");
  }
  if ((keys.shear_Pa != 0.0 || keys.force_N != 0.0) && load_place(scene) == LoadPlace::kBase) {
    throw SceneMistake("analysis.load", "the base takes an acceleration");
  }
  if (keys.shear_Pa != 0.0 && !is_lateral(scene)) {
    throw SceneMistake("analysis.load.shear", "a shear is sideways; write direction = \"lateral\"");
  }
  const double d_m = 2.0 * radius_at_m(scene.geometry, scene.geometry.length_m);  // of the top
  const double area_m2 = scene.plane ? d_m : 0.25 * std::numbers::pi * d_m * d_m;
  set(scene.drive, kPressure, keys.pressure_Pa + keys.shear_Pa + keys.force_N / area_m2);
  set(scene.drive, kAcceleration, keys.acceleration_m_s2);
}

void fill_voltage(const LoadKeys& keys, PillarScene& scene) {
  if (!set(scene.drive, kVoltage, keys.voltage_V) && keys.voltage_V != 0.0) {
    throw SceneMistake("analysis.load.voltage", only(kVoltage, "drive the electrode"));
  }
}

void show_load(FieldVisitor& v, LoadKeys& keys) {
  v.section("load", [&](FieldVisitor& l) {
    l.quantity({.key = "pressure", .unit = "Pa"}, keys.pressure_Pa);
    l.quantity({.key = "shear", .unit = "Pa"}, keys.shear_Pa);
    l.quantity({.key = "force", .unit = "N"}, keys.force_N);
    l.quantity({.key = "displacement", .unit = "m"}, keys.displacement_m);
    l.quantity({.key = "acceleration", .unit = "m/s2"}, keys.acceleration_m_s2);
    l.quantity({.key = "voltage", .unit = "V"}, keys.voltage_V);
    l.choice({"on", "top"}, {{"top", LoadPlace::kTop}, {"base", LoadPlace::kBase}}, keys.on);
    l.choice({"direction", "axial"},
             {{"axial", LoadDirection::kAxial}, {"lateral", LoadDirection::kLateral}},
             keys.direction);
  });
}

// Of a pillar that is not straight.
void show_bow(FieldVisitor& v, PillarScene& scene) {
  BucklingDrive bowed;
  if (const auto* now = std::get_if<BucklingDrive>(&scene.drive)) bowed = *now;
  v.quantity({.key = "bow", .unit = "m", .range = Range::kNotNegative}, bowed.bow_m);
  v.quantity({.key = "collapse_strain", .range = Range::kPositive}, bowed.collapse_strain);
  v.after_all_keys([&scene, bowed] {
    const bool is_taken = set(scene.drive, kBow, bowed.bow_m);
    set(scene.drive, kStrain, bowed.collapse_strain);
    if (bowed.bow_m == 0.0 && bowed.collapse_strain != BucklingDrive{}.collapse_strain) {
      throw SceneMistake("analysis.collapse_strain",
                         "is that of a pillar that is not straight; add bow, such as \"1 um\"");
    }
    if (is_taken || bowed.bow_m == 0.0) return;
    throw SceneMistake("analysis.bow", only(kBow, "answer a pillar that is not straight"));
  });
}

}  // namespace

void show_analysis(FieldVisitor& v, PillarScene& scene) {
  show_kind(v, analyses(), 40, scene);
  std::optional<bool> plate;
  if (has_part(scene.drive, kPlate) && !v.reads()) plate = plate_on_top(scene);
  v.choice({"top", "plate"}, {{"free", false}, {"plate", true}}, plate);
  show_bow(v, scene);
  const auto load = std::make_shared<LoadKeys>(load_of(scene));
  show_load(v, *load);
  v.after_all_keys([&scene, plate, load] {
    if (plate && !set(scene.drive, kPlate, *plate)) {
      throw SceneMistake("analysis.top", only(kPlate, "state what is on the top"));
    }
    fill_place(*load, scene);
    fill_traction(*load, scene);
    fill_voltage(*load, scene);
  });
  const bool is_shortened = analysis_of(scene).history == HistoryOf::kShortening;
  show_times(v,
             load->on == LoadPlace::kBase ? "m/s2"
             : is_shortened               ? "m"
                                          : "Pa",
             analyses(), scene);
}

void show_analysis(FieldVisitor& v, ArrayScene& scene) {
  show_kind(v, array_analyses(), 12, scene);
  show_times(v, "Pa", array_analyses(), scene);
}

Course history_of(const Pairs& pairs) {
  Course history;
  for (const auto& [time_s, value] : pairs) history.push_back({time_s, value});
  validate_history(history);
  // A history may begin with nothing at time 0 and jump there.
  if (history.size() > 1 && history[0].time_s == history[1].time_s) {
    if (history[0].value == 0.0) history.erase(history.begin());
  }
  return history;
}

Pairs pairs_of(const Course& history) {
  Pairs pairs;
  for (const CoursePoint& point : history) pairs.emplace_back(point.time_s, point.value);
  return pairs;
}

std::shared_ptr<ReadoutKeys> show_readout(FieldVisitor& v, const std::optional<Readout>& now,
                                          const Medium* film) {
  const auto keys = std::make_shared<ReadoutKeys>();
  if (now) {
    keys->kind = now->kind;
    if (std::isfinite(now->resistance_Ohm)) keys->resistance_Ohm = now->resistance_Ohm;
    keys->capacitance_F = now->capacitance_F;
    if (std::isfinite(now->film_leakage_s) && film != nullptr) {
      keys->film_resistivity_Ohm_m = now->film_leakage_s / film->permittivity_F_m(2, 2);
    }
  }
  v.choice({"kind", "voltage"},
           {{"voltage", ReadoutKind::kVoltage}, {"charge", ReadoutKind::kCharge}}, keys->kind);
  v.quantity({.key = "resistance", .unit = "ohm", .range = Range::kPositive}, keys->resistance_Ohm);
  v.quantity({.key = "capacitance", .unit = "F", .range = Range::kPositive}, keys->capacitance_F);
  v.quantity({.key = "film_resistivity", .unit = "ohm m", .range = Range::kPositive},
             keys->film_resistivity_Ohm_m);
  return keys;
}

Readout readout_of(const ReadoutKeys& keys, const Medium& film, const FilmLoss& loss) {
  Readout readout{.kind = *keys.kind, .capacitance_F = keys.capacitance_F};
  if (keys.resistance_Ohm > 0.0) readout.resistance_Ohm = keys.resistance_Ohm;
  if (keys.film_resistivity_Ohm_m > 0.0) {
    if (std::isfinite(loss.leakage_s)) {
      throw SceneMistake("readout.film_resistivity",
                         "the film's material states its resistivity, too; give one of them");
    }
    readout.film_leakage_s = keys.film_resistivity_Ohm_m * film.permittivity_F_m(2, 2);
  }
  return readout;
}

}  // namespace viscard
