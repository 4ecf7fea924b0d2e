#pragma once

#include "models/experiment/calibration.h"

#include <optional>
#include <vector>

namespace viscard {

// Readings of a load cell under dead weights, in the order in which they were taken. The load goes
// up from zero to the largest and down again, once or several times.
struct WeightReadings {
  std::vector<double> force_N;     // weight applied
  std::vector<double> reading;     // mean reading, V (or N for a force gauge)
  std::vector<double> reading_se;  // standard error of each mean; empty: unknown
  double force_relative_u = 0.0;   // common to all weights: masses, local gravity
  double resolution = 0.0;         // last digit of a reading, in its unit
  double capacity_N = 0.0;         // of the cell; 0: the largest weight
  // Largest departure of the cell from a line, relative to the capacity, by its data sheet. Without
  // one it counts as kUsualNonlinearity, unless the readings show another.
  std::optional<double> nonlinearity;
};
inline constexpr double kUsualNonlinearity = 1e-3;

struct LoadCellFit {
  double gain = 0.0;          // V/N
  double zero = 0.0;          // mean reading at no load over all series
  double gain_u = 0.0;        // standard uncertainty at in_use_N
  double in_use_N = 0.0;      // the less certain one of largest weight and capacity
  double full_reading = 0.0;  // gain times the largest load
  double largest_force_N = 0.0;
  // Shares of full_reading.
  double nonlinearity = 0.0, hysteresis = 0.0, repeatability = 0.0;
  bool has_hysteresis = false;     // loads were also removed step by step
  bool has_repeatability = false;  // there was more than one series
  int n_series = 0;
  std::vector<UncertaintyRow> budget;  // at in_use_N
  std::vector<double> residual;        // of each reading from the line, in its unit
  // Departure of a parabola from the line through its ends, at half the capacity and relative to it: its
  // estimate, the standard error, and the size that is allowed for.
  double parabola = 0.0, parabola_se = 0.0, parabola_allowed = 0.0;
  LoadCellCalibration calibration;  // gain, zero, capacity, and the uncertainty at every force
};

// Straight line through the readings with one zero per series (a series begins each time the load
// returns to zero), so that drift of the zero does not tilt it:
//   reading_ij = zero_i + gain * force_ij
// Nonlinearity is the largest deviation of the mean of rising and falling load from the line.
// Hysteresis is the largest difference of the two. Repeatability is the pooled standard deviation
// of the same load in the same direction over the series. The uncertainty budget of the gain (JCGM
// 100:2008, 4.3 and 5.1; fit/calibration/README.md) holds the weights, the regression (at least the standard
// deviation of the gains of the series, whatever their number), the curvature that the readings or the data sheet allow at the force of use, half the hysteresis and the
// resolution. k = 2 for the interval at 95 %. Sources: ISO 376:2011, 7.5, 8 and annex C; EURAMET cg-4
// (2011), ch. 6. Throws std::invalid_argument that names what is missing, unless there are three
// different loads, one of them zero, with as many finite readings as loads, and std::runtime_error if the gains of the series
// differ by more than 1 %.
LoadCellFit fit_load_cell(const WeightReadings& readings);

// Weight in N of a mass in air: m g (1 - rho_air/rho_mass), with the densities that define
// conventional mass, 1.2 and 8000 kg/m3 (OIML D 28).
double weight_N_from_mass_kg(double mass_kg, double gravity_m_s2);

}  // namespace viscard
