#pragma once

#include "models/experiment/calibration.h"

#include <string>
#include <vector>

namespace viscard {

// Readings of a load cell under dead weights, in the order in which they were taken; loads go up
// and down between no load and the largest, once or several times.
struct WeightReadings {
  std::vector<double> force_N;     // weight put on
  std::vector<double> reading;     // mean, V (or N of a force gauge)
  std::vector<double> reading_se;  // standard error of each mean; empty: not known
  double force_relative_u = 0.0;   // of all weights together: masses, local gravity
  double resolution = 0.0;         // last digit of a reading, in its unit
};

struct LoadCellFit {
  double gain = 0.0;          // V/N
  double zero = 0.0;          // reading at no load, mean of all series
  double gain_u = 0.0;        // standard uncertainty, all of the budget
  double full_reading = 0.0;  // gain times the largest load
  double largest_force_N = 0.0;
  // Shares of full_reading.
  double nonlinearity = 0.0, hysteresis = 0.0, repeatability = 0.0;
  bool has_hysteresis = false;     // loads were also taken off step by step
  bool has_repeatability = false;  // there was more than one series
  int n_series = 0;
  std::vector<UncertaintyRow> budget;
  std::vector<double> residual;  // of each reading from the line, in its unit
};

// Straight line through the readings, one zero per series (a series begins each time the load comes
// back to none), so that drift of the zero does not tilt it:
//   reading_ij = zero_i + gain * force_ij.
// Nonlinearity is the largest departure of the mean of rising and falling load from the line,
// hysteresis the largest difference of the two, repeatability the pooled standard deviation of the
// same load in the same direction in several series. Budget of the gain (JCGM 100:2008, 4.3
// and 5.1): weights, regression, and what the line leaves out - nonlinearity and half the
// hysteresis as rectangular distributions - resolution. k = 2 for the interval at 95 %. Sources:
// ISO 376:2011, 7.5 and 8; EURAMET cg-4 (2011), ch. 6. Throws std::invalid_argument, saying what is
// missing, unless there are three different loads of which one is none, all finite, of equal
// number.
LoadCellFit fit_load_cell(const WeightReadings& readings);

// Weight in N of a mass in air: m g (1 - rho_air/rho_mass), with the densities by which
// conventional masses are defined, 1.2 and 8000 kg/m3 (OIML D 28).
double weight_N_from_mass_kg(double mass_kg, double gravity_m_s2);

}  // namespace viscard
