#pragma once

#include "io/config/config_fields.h"
#include "models/array/plane/array_scene.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/load_history.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// How a scene is driven and what its electrode is wired to, as the file gives it.
struct RawDrive {
  std::string top;         // "plate" or "free"; empty: not given
  std::int64_t modes = 4;  // of each family
  std::string load_on, direction = "axial";
  double pressure_Pa = 0.0, shear_Pa = 0.0, force_N = 0.0, acceleration_m_s2 = 0.0, voltage_V = 0.0;
  double displacement_m = std::numeric_limits<double>::quiet_NaN();  // NaN: not given
  double from_Hz = 0.0, to_Hz = 0.0;
  std::string spacing = "log";
  std::int64_t count = 0;
  double end_time_s = 0.0;
  std::int64_t outputs = 1000;
  double pulse_height = 0.0, pulse_duration_s = 0.0;
  std::vector<std::pair<double, double>> history;
  std::string readout;
  double resistance_Ohm = 0.0, capacitance_F = 0.0, film_resistivity_Ohm_m = 0.0;
};

// Keys of [analysis]: load = { pressure | shear | force | displacement | acceleration | voltage,
// on = "top" | "base", direction }, frequencies = { from, to, count, spacing }, end_time, outputs,
// pulse = { height, duration } and history. `history_unit` is that of a load on the top.
void show_drive(FieldVisitor& analysis_table, const char* history_unit, RawDrive& drive);
// The keys in time and frequency alone; histories and pulses have `unit`.
void show_times(FieldVisitor& analysis_table, const char* unit, RawDrive& drive);
// [readout]: kind = "voltage" | "charge", resistance, capacitance, film_resistivity.
void show_readout(FieldVisitor& readout_table, RawDrive& drive);

// The frequencies, and the history or pulse; empty if the file gives none. Throw SceneMistake.
std::vector<double> frequencies_of(const RawDrive& drive);
std::vector<HistoryPoint> history_of(const RawDrive& drive);

// Fill the drive of a scene, which has the default values of its analysis. They fill every part
// that the drive has, for any analysis. Throw SceneMistake for a key that the analysis does not
// use, naming the analyses that do.
void fill_modes_and_top(const RawDrive& raw, PillarScene& scene);
void fill_drive(const RawDrive& raw, PillarScene& scene);
void fill_drive(const RawDrive& raw, ArrayScene& scene);  // all but the load

void fill_readout(const RawDrive& raw, PillarScene& scene);

}  // namespace viscard
