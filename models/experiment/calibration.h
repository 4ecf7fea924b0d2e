#pragma once

#include <string>
#include <vector>

namespace viscard {

// Straight-line calibration of a load cell behind an amplifier:
//   volts = counts * volts_per_count,   force = (volts - zero_volts)/volts_per_newton.
// The seed rig's cell gives 0.7255 V/N after its amplifier. An instrument that sends a force by
// itself (a force gauge) takes the place of volts with its own newtons: the gain is then a pure
// number near 1, and the zero is in N.
struct LoadCellCalibration {
  double volts_per_newton = 0.0;    // V/N
  double volts_per_newton_u = 0.0;  // standard uncertainty, V/N
  double zero_volts = 0.0;          // reading at no load; a tare replaces it
  double capacity_N = 0.0;          // rated load of the cell
  std::string id;                   // names the calibration record
  std::string date;                 // ISO 8601
  std::string valid_until;          // ISO 8601, the last day; empty: a year after date
  std::string file;  // of the record that a rig file names; empty once it has been read
  // Of the readings with dead weights, as shares of that at the largest load; 0 where not measured.
  double nonlinearity = 0.0;   // largest departure from the line
  double hysteresis = 0.0;     // largest difference between falling and rising load
  double repeatability = 0.0;  // standard deviation of the same load again
};

// One line of an uncertainty budget (JCGM 100:2008): standard uncertainty relative to the gain.
struct UncertaintyRow {
  std::string source;
  double relative_u = 0.0;
  std::string how;  // where the number is from
};

// "2027-01-15": the last day on which the calibration counts; empty if it has no date.
std::string last_valid_day(const LoadCellCalibration& calibration);

// Throws std::invalid_argument on a date or valid_until that is given and is no day of the calendar
// such as 2026-11-21 (a time may follow).
void validate_dates(const LoadCellCalibration& calibration);

// Why a calibration should not be used on that day (ISO 8601), or "" if it may be: expired, dated
// later than that day, or undated so that nobody can tell.
std::string calibration_trouble(const LoadCellCalibration& calibration, const std::string& today);

// Throws std::invalid_argument unless the gain is finite and not zero and the capacity positive.
void validate(const LoadCellCalibration& calibration);

double force_N_from_volts(const LoadCellCalibration& calibration, double volts);
double volts_from_force_N(const LoadCellCalibration& calibration, double force_N);

}  // namespace viscard
