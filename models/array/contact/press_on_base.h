#pragma once

#include "models/array/contact/press_array.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// By pillar: its force on the base (down, N) and its moments (int p x dA and int p y dA, N m). And how the
// base moves under its foot by them: it sinks by (0) + (1) x + (2) y, m and rad.
using BaseForces = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using BaseMotions = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// The motions under some of the pillars, which alone bear forces. Symmetric and positive.
using YieldingBase = std::function<BaseMotions(const BaseForces&)>;
using BaseUnder = std::function<YieldingBase(const std::vector<std::size_t>& pillars)>;

// Presses a shape on pillars whose base yields, so that they feel each other (eq. T5). The forces of the
// last answer are where the next one starts.
class PressOnBase {
 public:
  PressOnBase(const std::vector<TouchedPillar>& pillars, const RigidShape& shape, BaseUnder base)
      : pillars_(&pillars), shape_(&shape), base_under_(std::move(base)) {}

  PressedArray to_depth(const std::vector<TopContact>& classes, double depth_m);
  // Throws std::invalid_argument unless the force is positive and there is a pillar under the shape.
  PressedArray with_force(const std::vector<TopContact>& classes, double force_N);

 private:
  struct Tops;
  void set_candidates(const std::vector<TopContact>& classes, double depth_m);
  Tops press(const std::vector<TopContact>& classes, double depth_m, const BaseMotions& base) const;
  Eigen::MatrixXd step(const Eigen::MatrixXd& stiffness, const BaseForces& missing,
                       double tolerance) const;

  const std::vector<TouchedPillar>* pillars_;
  const RigidShape* shape_;
  BaseUnder base_under_;
  double candidate_depth_m_ = -1.0;      // pillars that the shape may touch down to this depth
  std::vector<std::size_t> candidates_;  // their places among the pillars
  YieldingBase base_;
  BaseForces forces_;  // on the base, by candidate
};

}  // namespace viscard
