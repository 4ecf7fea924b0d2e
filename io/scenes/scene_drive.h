#pragma once

#include "io/config/config_fields.h"
#include "models/pillar/scene/scene.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// How a scene's pillar is driven and what its electrode is wired to, as it stands in the file.
struct RawDrive {
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
// pulse = { height, duration } and history. `analysis` is its kind, which decides the unit of the
// history.
void show_drive(FieldVisitor& analysis_table, const std::string& analysis, RawDrive& drive);
// Of these the ones in time and frequency; histories and pulses have `unit`.
void show_times(FieldVisitor& analysis_table, const char* unit, RawDrive& drive);
// [readout]: kind = "voltage" | "charge", resistance, capacitance, film_resistivity.
void show_readout(FieldVisitor& readout_table, RawDrive& drive);

// Fills the scene's frequencies and history alone. Throws SceneMistake, also for a key that an
// analysis of this name does not use.
void fill_times(const RawDrive& raw, const std::string& analysis, Scene& scene);

// Fills the scene's loads, histories, frequencies and readout. Throws SceneMistake.
void fill_drive(const RawDrive& drive, Scene& scene);

}  // namespace viscard
