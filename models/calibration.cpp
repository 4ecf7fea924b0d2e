#include "models/calibration.h"

#include <cmath>
#include <stdexcept>

namespace viscard {

void validate(const LoadCellCalibration& calibration) {
  if (!std::isfinite(calibration.volts_per_newton) || calibration.volts_per_newton == 0.0) {
    throw std::invalid_argument("load cell gain is " +
                                std::to_string(calibration.volts_per_newton) +
                                " V/N; it must be finite and not zero");
  }
  if (!(calibration.capacity_N > 0.0) || !std::isfinite(calibration.capacity_N)) {
    throw std::invalid_argument("load cell capacity is " + std::to_string(calibration.capacity_N) +
                                " N; it must be positive");
  }
}

double force_N_from_volts(const LoadCellCalibration& calibration, double volts) {
  return (volts - calibration.zero_volts) / calibration.volts_per_newton;
}

double volts_from_force_N(const LoadCellCalibration& calibration, double force_N) {
  return force_N * calibration.volts_per_newton + calibration.zero_volts;
}

}  // namespace viscard
