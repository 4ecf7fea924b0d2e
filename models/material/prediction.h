#pragma once

#include "models/material/load_history.h"
#include "models/material/series_band.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Response of a material in a test: the curve with its 95 % band, and where it leaves the window of
// the fit.

// Kinds of tests that can be predicted.
enum class PredictedTest { kRelaxation, kCreep, kRecovery, kCycles, kOscillation, kHistory };

// Largest number of points of all cycles together: 10000 cycles with 200 points of each motion.
inline constexpr int kMostCyclePoints = 4'000'000;

// The test to predict.
struct PredictionRequest {
  PredictedTest test = PredictedTest::kRelaxation;
  // Size of the input: strain, or stress in Pa. Relaxation and creep without one are ideal steps and
  // give E(t) and J(t); recovery without one is of a stress of 1 kPa, cycles of a strain of 1 %.
  std::optional<double> strain, stress_Pa;
  double ramp_s = 0.0;               // duration of each loading and unloading; 0: a jump
  std::optional<double> hold_s;      // under load; none: to the end of the window
  std::optional<double> recovery_s;  // after unloading; none: as long as the hold
  double period_s = 1.0;             // of a cycle: up and down again
  int n_cycles = 5;
  // First and last time of E(t) and J(t), or frequency in Hz; none: those of the window. `from` is
  // also the first time after each motion of the other tests.
  std::optional<double> from, to;
  int points = 200;               // of each motion
  std::optional<Course> history;  // of kHistory: strain, or stress in Pa
  bool is_stress_history = false;
  std::vector<double> also_at;  // more times or frequencies, such as those of measured data
};

// One predicted quantity; the name has the unit: "modulus_Pa", "strain".
struct PredictedCurve {
  std::string name;
  BandedCurve curve;
};

// Input and predicted curves of a test.
struct TestPrediction {
  PredictedTest test = PredictedTest::kRelaxation;
  std::string argument;                // "time_s" or "frequency_Hz"
  std::vector<double> at;              // ascending; equal times are a jump
  std::string input_name;              // "strain" or "stress_Pa"; empty: no input
  std::vector<double> input;           // at the same times
  std::vector<PredictedCurve> curves;  // all as long as `at`
  bool is_window_known = false;
  double t_min_s = 0.0, t_max_s = 0.0;  // window of the fit
  std::vector<bool> is_inside;          // the window; all true if it is not known
};

// Frequencies f belong to the time 1/(2 pi f). Throws std::invalid_argument for values that are not
// possible (a hold of -1 s, a stress in a relaxation test).
TestPrediction predict_test(const Material& material, const PredictionRequest& request);

}  // namespace viscard
