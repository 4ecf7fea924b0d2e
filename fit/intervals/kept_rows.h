#pragma once

#include "fit/curves/history_model.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/slow_noise.h"
#include "fit/samples/noise_model.h"

#include <memory>
#include <vector>

namespace viscard {

// The rows of one test as its own fit used them, and what that fit found about their noise: for a fit
// of several tests together (FitOptions::keep_rows).
struct KeptRows {
  enum class Shape { kStep, kCreep, kHistory, kOscillation };
  Shape shape = Shape::kStep;
  std::vector<double> at{};             // s, or Hz for an oscillation; empty for a history
  std::vector<double> value{}, loss{};  // modulus, compliance or storage modulus; loss modulus
  HistoryInput history{};               // kHistory only
  double zero_s = 0.0;                  // when the load began
  bool with_drift = false, with_dashpot = false;
  TestWindow window{};

  double variance = 1.0;  // of one weighted sample
  Autoregression noise{};
  SlowNoise slow{};
  Eigen::VectorXd row_scale{};  // of the model's rows, as in LevelNoise
  int n_parameters = 0;
};

}  // namespace viscard
