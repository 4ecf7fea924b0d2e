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
  // What gain_relative_u() needs; all 0 in a record of which the range of force is unknown.
  double largest_force_N = 0.0;  // the range of the calibration is 0 to this
  double common_u = 0.0;         // weights and regression: the same at every force, relative
  double shape_u = 0.0;         // departures from a parabola, resolution: relative at largest_force
  double curvature_u = 0.0;     // relative change of the gain from no load to the capacity
  double curvature_at_N = 0.0;  // force at which the line through the readings meets the parabola
};

// One line of an uncertainty budget (JCGM 100:2008): standard uncertainty relative to the gain.
struct UncertaintyRow {
  std::string source;
  double relative_u = 0.0;
  std::string how;  // the origin of the number
};

// The last day on which the calibration is valid, such as "2027-01-15"; empty if it has no date.
std::string last_valid_day(const LoadCellCalibration& calibration);

// True for a day of the calendar such as 2026-11-21; a time may follow.
bool is_iso_day(const std::string& text);

// Throws std::invalid_argument naming the key unless the text is such a day, or empty.
void validate_date(const std::string& key, const std::string& text);

// Throws std::invalid_argument if date or valid_until is given but is not a day of the calendar
// such as 2026-11-21 (a time may follow).
void validate_dates(const LoadCellCalibration& calibration);

// Why a calibration should not be used on that day (ISO 8601), or "" if it may be used. It must not
// be expired, dated later than that day, or without a date.
std::string calibration_trouble(const LoadCellCalibration& calibration, const std::string& today);

// Relative standard uncertainty of the gain for a force, counted from no load. A cell with a parabola
// has another gain at each force; the weights determine that at curvature_at_N:
//   u^2 = common_u^2 + (curvature_u (F - curvature_at)/capacity)^2 + (shape_u s)^2 + (hysteresis h)^2/3
// with s = F_max/F, kept within 1 to 4, and h = 2 (1 - F/F_max), at least 1/3: a rising force departs from the
// mean of both directions by half a loop, and a third of the loop counts as creep (ISO 376:2011, annex
// C). A larger volts_per_newton_u, such as that of a certificate, enlarges it in proportion. Without a known
// range it is volts_per_newton_u at every force.
double gain_relative_u(const LoadCellCalibration& calibration, double force_N);

// By its parts, the larger one of those at the largest weight and at the capacity; volts_per_newton_u of
// a new record.
double gain_relative_u_in_use(const LoadCellCalibration& calibration);

// Why a force up to this size is a doubt: it is more than 1.2 times the largest one of the calibration. ""
// if it is not, or if the range is unknown.
std::string calibration_range_doubt(const LoadCellCalibration& calibration, double force_N);

// Throws std::invalid_argument unless the gain is finite and not zero, and the capacity positive.
void validate(const LoadCellCalibration& calibration);

// The force at a voltage of the cell in volts, and the voltage at a force.
double force_N_from_volts(const LoadCellCalibration& calibration, double volts);
double volts_from_force_N(const LoadCellCalibration& calibration, double force_N);

}  // namespace viscard
