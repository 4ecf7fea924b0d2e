#pragma once

#include "models/array/contact/point_exchange.h"
#include "models/array/contact/round_tip.h"
#include "models/array/contact/top_compliance.h"
#include "models/array/contact/top_pressure.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace viscard {

class StickingTop;

// The contact of one kind of top: overlaps to pressures. On a top that is touched everywhere, force and
// moments follow from the mean of the overlap (eq. T2), otherwise from the pressures at the points of a
// grid that must not pull (eq. T3).
class TopContact {
 public:
  explicit TopContact(TopCompliance compliance);
  // press() and follow() are those of a top that sticks.
  TopContact(TopCompliance compliance, std::shared_ptr<const StickingTop> sticking);

  // `last`: forces that the top bore at nearly the same depth, or none; those of this answer after the call.
  TopPressure press(const Overlap& overlap, Eigen::MatrixXd* last = nullptr) const;
  // The same where a round tip touches, whose contact may be smaller than the grid resolves (eq. T11).
  TopPressure press(const Overlap& overlap, const std::optional<RoundTip>& tip,
                    Eigen::MatrixXd* last = nullptr) const;
  // The top follows the surface everywhere, also where it must be pulled (eq. T2).
  TopPressure follow(const Overlap& overlap) const;

  const TopCompliance& compliance() const { return compliance_; }
  double radius_m() const { return radius_m_; }
  // Motion of the points under forces on them, rings x angles (eq. T1); and the forces that give it.
  Eigen::MatrixXd motion(const Eigen::MatrixXd& forces_N) const;
  Eigen::MatrixXd forces(const Eigen::MatrixXd& motion_m) const;
  // Forces that do not pull, where the overlap is reached or less than it (eq. T3). `start` is a guess,
  // `softness_m_N` that of points that a surface covers in part (cut_top.h), or empty.
  Eigen::MatrixXd unilateral_forces(const Eigen::MatrixXd& overlap_m, const Eigen::MatrixXd& start,
                                    const Eigen::MatrixXd& softness_m_N = {}) const;

  // The overlap at the points with the softness of points that it covers in part (or empty), and the forces that it
  // causes there; without a guess if that is empty.
  struct PointOverlap {
    Eigen::MatrixXd overlap_m, softness_m_N, share;
  };
  PointOverlap overlaps(const Overlap& overlap) const;
  Eigen::MatrixXd pushing_forces(const Eigen::MatrixXd& overlap_m, const Eigen::MatrixXd& guess,
                                 const Eigen::MatrixXd& softness_m_N = {}) const;
  TopPressure pressure_of(const Eigen::MatrixXd& forces_N) const;

 private:
  // True, with the forces, if all points push when they all follow the overlap.
  bool is_full(const Eigen::MatrixXd& overlap_m, Eigen::MatrixXd& everywhere) const;
  Eigen::MatrixXd moved_by(const Eigen::MatrixXd& forces_N,
                           const Eigen::MatrixXd& softness_m_N) const;
  // Forces that move the points in the mask by the overlap, to a relative accuracy; f holds a guess.
  void hold(const Eigen::MatrixXd& overlap_m, const PointMask& touches,
            const Eigen::MatrixXd& softness_m_N, double accuracy, Eigen::MatrixXd& f) const;
  void add_resultants(const Eigen::MatrixXd& forces_N, TopPressure& pressure) const;
  Eigen::MatrixXd in_harmonics(const Eigen::MatrixXd& values,
                               const std::vector<Eigen::MatrixXd>& blocks, double factor_of_0,
                               double factor) const;

  TopCompliance compliance_;
  std::vector<Eigen::MatrixXd> stiffness_N_m_;  // inverse of each S_m
  Eigen::MatrixXd waves_;                       // orthonormal cosines and sines: angles x angles
  Eigen::MatrixXd waves_across_;                // its transpose
  Eigen::VectorXd point_stiffness_N_m_;         // by ring, of a point while all others are held
  double radius_m_ = 0.0;
  std::shared_ptr<const StickingTop> sticking_;  // or nothing
};

}  // namespace viscard
