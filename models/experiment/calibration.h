#pragma once

#include <string>

namespace viscard {

// Straight-line calibration of a load cell behind an amplifier:
//   volts = counts * volts_per_count,   force = (volts - zero_volts)/volts_per_newton.
// The cell of the publication's rig gives 0.7255 V/N after its amplifier. For an instrument that
// sends forces (a force gauge), its own newtons stand in place of volts: the gain is then a number
// near 1 without a unit, and the zero is in N.
struct LoadCellCalibration {
  double volts_per_newton = 0.0;    // V/N
  double volts_per_newton_u = 0.0;  // standard uncertainty, V/N
  double zero_volts = 0.0;          // reading without load; a tare replaces it
  double capacity_N = 0.0;          // rated load of the cell
  std::string id;                   // names the calibration record
  std::string date;                 // ISO 8601
  std::string valid_until;          // ISO 8601, the last day; empty: a year after date
  std::string file;  // of the record that a rig file names; empty after it has been read
  // From the readings with dead weights, relative to that at the largest load; 0 if not measured.
  double nonlinearity = 0.0;   // largest departure from the line
  double hysteresis = 0.0;     // largest difference between falling and rising load
  double repeatability = 0.0;  // standard deviation when the same load is repeated
};

// One line of an uncertainty budget (JCGM 100:2008): standard uncertainty relative to the gain.
struct UncertaintyRow {
  std::string source;
  double relative_u = 0.0;
  std::string how;  // the origin of the number
};

// The last day on which the calibration is valid, such as "2027-01-15"; empty if it has no date.
std::string last_valid_day(const LoadCellCalibration& calibration);

// Throws std::invalid_argument if date or valid_until is given but is not a day of the calendar
// such as 2026-11-21 (a time may follow).
void validate_dates(const LoadCellCalibration& calibration);

// Why a calibration should not be used on that day (ISO 8601), or "" if it may be used. It must not
// be expired, dated later than that day, or without a date.
std::string calibration_trouble(const LoadCellCalibration& calibration, const std::string& today);

// Throws std::invalid_argument unless the gain is finite and not zero, and the capacity positive.
void validate(const LoadCellCalibration& calibration);

// The force at a voltage of the cell in volts, and the voltage at a force.
double force_N_from_volts(const LoadCellCalibration& calibration, double volts);
double volts_from_force_N(const LoadCellCalibration& calibration, double force_N);

}  // namespace viscard
