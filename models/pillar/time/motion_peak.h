#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// The largest value of a motion, with its sign.
struct MotionPeak {
  double value = 0.0;
  double time_s = 0.0;
  double error = 0.0;  // possible excess of the motion between the known times
};

// Peak of a motion whose values and rates are known at some times, ascending: of the cubics between
// them (Hermite's; the error is (h^4/384) y'''', de Boor, A Practical Guide to Splines (1978), ch. 4).
// The error compares each value with the cubic that leaves it out. If both extremes are equal
// within 2 %, the peak is on the side of the first, so that ringing without damping has a unique answer,
// whatever the tolerance is.
MotionPeak peak_of_motion(const std::vector<double>& time_s, const Eigen::VectorXd& values,
                          const Eigen::VectorXd& rates);

}  // namespace viscard
