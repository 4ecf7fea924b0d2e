#pragma once

#include "models/array/contact/point_exchange.h"
#include "models/array/contact/top_compliance.h"
#include "models/array/contact/top_pressure.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Forces on the points of a top, or their motions: rings along r, then theta, then down; a column per
// angle.
using PointVectors = Eigen::MatrixXd;

// The contact of one kind of top that sticks to the shape (eq. T9): points that touch follow the shape
// downward and do not slide, as if each had touched only at the end. That is right for a depth that only
// grows.
class StickingTop {
 public:
  explicit StickingTop(StickingCompliance compliance);

  // The shape only pushes. `start` (rings x angles) is a guess of the points that touch, or empty. Throws
  // std::runtime_error if the set of points that touch does not settle.
  // `last`: forces as start, or none; those of the answer after the call.
  TopPressure press(const Overlap& overlap, const PointMask& start = {},
                    PointVectors* last = nullptr) const;
  // All points follow the shape, also where they must be pulled.
  TopPressure follow(const Overlap& overlap) const;

  const StickingCompliance& compliance() const { return compliance_; }
  PointVectors motion(const PointVectors& forces_N) const;
  PointVectors forces(const PointVectors& motion_m) const;  // the inverse
  // Forces that hold the points at the overlap (rings x angles) where they touch, and do not pull.
  // `softness_m_N` as for TopContact.
  PointVectors pushing_forces(const Eigen::MatrixXd& overlap_m, const PointMask& start = {},
                              const Eigen::MatrixXd& softness_m_N = {},
                              const PointVectors& start_N = {}) const;

 private:
  using Blocks = std::vector<Eigen::MatrixXd>;
  PointVectors in_harmonics(const PointVectors& values, const Blocks& blocks) const;
  void hold(const Eigen::MatrixXd& overlap_m, const PointMask& touches,
            const PointVectors& softness_m_N, double accuracy, PointVectors& forces_N) const;
  TopPressure pressure_of(const PointVectors& forces_N) const;
  Eigen::Index rings() const { return compliance_.ring_area_m2.size(); }

  StickingCompliance compliance_;
  // C_m and their inverses, as they act on waves of unit length; those of the last harmonic without the
  // coupling of waves that vanish at all points.
  Blocks on_waves_m_N_, inverse_N_m_;
  Eigen::VectorXd point_stiffness_N_m_;  // by ring, downward, of a point while all others are held
  Eigen::MatrixXd waves_;                // orthonormal cosines and sines: angles x angles
  Eigen::MatrixXd waves_across_;         // its transpose
};

}  // namespace viscard
