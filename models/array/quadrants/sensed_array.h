#pragma once

#include "models/array/quadrants/decoupling.h"
#include "models/array/quadrants/quadrant_gains.h"
#include "models/maths/offset_sums.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// An array of pillars over electrodes in quarters: the data needed to find loads from voltages.
struct QuadrantArray {
  std::vector<SourcePoint> pillars;  // their kind is the class
  int classes = 1;
  double reach_m = 0.0;  // between axes, beyond which nothing is read
  OffsetSums::Kernel
      kernel;  // voltages of the quarters at an offset per load, V/Pa: quarters x loads
  // Voltages of the quarters under loads of all pillars: pillars x loads to pillars x quarters.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& loads_Pa)> voltages_V;
  bool by_neighbours = true;  // false: each pillar is read by its own voltages
};

// By class; gains of a pillar that stands alone.
std::vector<QuadrantGains> gains_by_class(const QuadrantArray& array);

// The loads behind the voltages of all pillars.
struct SensedArray {
  Eigen::MatrixXd loads_Pa;  // pillars x loads
  Eigen::MatrixXd alone_Pa;  // the same of each pillar read by its own voltages
  // Part of the voltages that the loads leave unexplained, pillars x quarters.
  Eigen::MatrixXd left_V;
};
// Eq. Q2. Throws as decouple().
SensedArray sensed_array(const QuadrantArray& array, const std::vector<QuadrantGains>& gains,
                         const Eigen::MatrixXd& quarters_V);

// Amplification of noise for the pillar nearest to the middle, with its nearest 49 within twice the
// reach.
NoiseGrowth growth_in_middle(const QuadrantArray& array, const std::vector<QuadrantGains>& gains);

}  // namespace viscard
