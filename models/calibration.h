#pragma once

#include <string>

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
};

// Throws std::invalid_argument unless the gain is finite and not zero and the capacity positive.
void validate(const LoadCellCalibration& calibration);

double force_N_from_volts(const LoadCellCalibration& calibration, double volts);
double volts_from_force_N(const LoadCellCalibration& calibration, double force_N);

}  // namespace viscard
