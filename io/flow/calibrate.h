// From readings under weights, or on a rigid block, to the record that a rig file names.
#pragma once

#include "fit/calibration/fit_frame_stiffness.h"
#include "fit/calibration/fit_load_cell.h"
#include "io/config/config_file.h"
#include "io/tables/csv_table.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// What is known of a calibration besides the readings.
struct CalibrationRequest {
  std::string where;                   // "weights.csv: ", the beginning of messages; may be empty
  std::string id;                      // name of the record; empty: "load cell 2026-11-29"
  std::string valid_until;             // empty: a year from today
  double capacity_N = 0.0;             // rated load of the cell
  std::optional<double> span_V;        // of the converter, of either sign
  std::optional<double> nonlinearity;  // of the cell's data sheet, relative to the capacity
  std::optional<double> gravity_m_s2;  // none: 9.80665, which may be that of any place on Earth
  double mass_relative_u = 1e-4;       // standard uncertainty of the masses
};
// Throws std::invalid_argument naming the option, "--capacity must be positive".
void check_request(const CalibrationRequest& request);

// Throws std::runtime_error for a table of viscard export: its forces follow from its voltages by a calibration, and
// its rows are all readings of a test, also those out of contact.
void refuse_readings_of_test(const CsvTable& table);

// The rows of weights, or of a rigid block, that have a number in both columns; n_left_out counts the
// others.
CsvTable complete_rows(CsvTable table, bool is_block, std::size_t& n_left_out);

// In N of a mass in air.
double weight_N(double mass_kg, const CalibrationRequest& request);
// Relative standard uncertainty of such weights.
double weights_relative_u(const CalibrationRequest& request);
// A table has mass_kg or force_N, and volts_V, in the order in which the readings were taken.
WeightReadings readings_from_table(const CsvTable& table, const CalibrationRequest& request);

struct CellCalibration {
  LoadCellFit fit;
  CalibrationRecord record;
};
// rig: whose cell it is, if there is a rig file. Throws std::runtime_error for weights above the capacity, readings
// beyond the span, readings that do not lie on a line, and a record that a rig file could not take.
CellCalibration calibrated_cell(WeightReadings readings, const CalibrationRequest& request,
                                const RigConfig* rig);
// Forces at which the uncertainty is reported: some of the range, its end, and the capacity.
std::vector<double> reported_forces_N(const LoadCellCalibration& calibration);
// file: the record's; empty if none was written.
void show_keys(ResultVisitor& v, const CellCalibration& cell, const std::string& file);

struct FrameCalibration {
  FrameStiffnessFit fit;
  CalibrationRecord record;
};
// A table of position_m and force_N on a rigid block.
BlockPoints block_points_from_table(const CsvTable& table);
// Relative standard uncertainty of the cell's gain at the largest force; rig: whose cell it is, if that is known.
double gain_relative_u(const BlockPoints& points, const RigConfig* rig);
// Throws what fit_frame_stiffness() throws, and std::runtime_error for a stiffness that no frame has.
FrameCalibration calibrated_frame(const BlockPoints& points, double relative_u_of_gain,
                                  const CalibrationRequest& request);
void show_keys(ResultVisitor& v, const FrameCalibration& frame, const std::string& file);

}  // namespace viscard
