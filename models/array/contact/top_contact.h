#pragma once

#include "models/array/contact/top_compliance.h"

#include <Eigen/Core>

#include <functional>

namespace viscard {

// What a rigid surface does to the top of one pillar, without friction.
struct TopPressure {
  double force_N = 0.0;      // down
  double moment_x_Nm = 0.0;  // int p x dA: turns the top toward +x
  double moment_y_Nm = 0.0;
  double share = 0.0;  // of the top's area that is touched
  // Of the share: half a ring along the rim of the touched area, whose points touch or do not.
  double share_error = 0.0;
  double largest_Pa = 0.0;  // pressure at a point of the grid
  bool is_partial = false;  // some of the top, but not all, is touched
};

// How far the surface reaches below the unloaded top at a point of it, m; negative where it stays above,
// and -infinity where there is no surface.
using Overlap = std::function<double(double x_m, double y_m)>;

// The contact of one kind of top: overlaps to pressures. On a top that is touched everywhere, force and
// moments follow from the mean of the overlap (eq. T2), otherwise from the pressures at the points of a
// grid that must not pull (eq. T3).
class TopContact {
 public:
  explicit TopContact(TopCompliance compliance);

  TopPressure press(const Overlap& overlap) const;
  // The top follows the surface everywhere, also where it must be pulled (eq. T2).
  TopPressure follow(const Overlap& overlap) const;

  const TopCompliance& compliance() const { return compliance_; }
  // Motion of the points under forces on them, rings x angles (eq. T1); and the forces that give it.
  Eigen::MatrixXd motion(const Eigen::MatrixXd& forces_N) const;
  Eigen::MatrixXd forces(const Eigen::MatrixXd& motion_m) const;
  // Forces that do not pull, where the overlap is reached or less than it (eq. T3). `start` is a guess.
  Eigen::MatrixXd unilateral_forces(const Eigen::MatrixXd& overlap_m,
                                    const Eigen::MatrixXd& start) const;

  // The overlap at the points, and the forces that it causes there; without a guess if that is empty.
  Eigen::MatrixXd overlaps(const Overlap& overlap) const;
  Eigen::MatrixXd pushing_forces(const Eigen::MatrixXd& overlap_m,
                                 const Eigen::MatrixXd& guess) const;
  TopPressure pressure_of(const Eigen::MatrixXd& forces_N) const;

 private:
  // True, with the forces, if all points push when they all follow the overlap.
  bool is_full(const Eigen::MatrixXd& overlap_m, Eigen::MatrixXd& everywhere) const;
  void add_resultants(const Eigen::MatrixXd& forces_N, TopPressure& pressure) const;
  Eigen::MatrixXd in_harmonics(const Eigen::MatrixXd& values,
                               const std::vector<Eigen::MatrixXd>& blocks) const;

  TopCompliance compliance_;
  std::vector<Eigen::MatrixXd> stiffness_N_m_;  // inverse of each S_m
  Eigen::MatrixXd waves_;                       // orthonormal cosines and sines: angles x angles
  std::vector<int> harmonic_of_;                // of each column of waves_
  double radius_m_ = 0.0;
};

}  // namespace viscard
