#include "models/array/contact/strip_contact.h"

#include "models/array/contact/point_exchange.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

// The forces that hold some nodes at their overlap.
StripForces held_nodes(const StripCompliance& strip, const StripPress& press,
                       const PointMask& held) {
  const Eigen::Index n = strip.nodes();
  std::vector<Eigen::Index> at;
  if (press.friction == Friction::kStick) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (held(i, 0)) at.push_back(i);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (held(i, 0)) at.push_back(n + i);
  }
  if (at.empty()) return {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  Eigen::VectorXd motion(static_cast<Eigen::Index>(at.size()));
  for (Eigen::Index k = 0; k < motion.size(); ++k) {
    const Eigen::Index i = at[static_cast<std::size_t>(k)];
    motion[k] = i < n ? press.along_m[i] : press.overlap_m[i - n];
  }
  const Eigen::MatrixXd motion_m2_N = strip.motion_m2_N(at, at);
  const Eigen::VectorXd force = Cholesky(motion_m2_N).solve(motion);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(2 * n);
  for (Eigen::Index k = 0; k < force.size(); ++k) all[at[static_cast<std::size_t>(k)]] = force[k];
  return {all.head(n), all.tail(n)};
}

Eigen::VectorXd sinking_m(const StripCompliance& strip, const StripForces& forces) {
  const Eigen::Index n = strip.nodes();
  return strip.motion_m2_N.bottomLeftCorner(n, n) * forces.along +
         strip.motion_m2_N.bottomRightCorner(n, n) * forces.down;
}

}  // namespace

StripForces strip_forces(const StripCompliance& strip, const StripPress& press) {
  constexpr int kMostSets = 1000;
  constexpr double kPull = 1e-11, kOverlap = 1e-10;  // of the largest force and overlap
  const Eigen::Index n = strip.nodes();
  if (press.bond == TopBond::kFollows) {
    return held_nodes(strip, press, PointMask::Constant(n, 1, true));
  }
  const double size_m = press.overlap_m.maxCoeff();
  if (!(size_m > 0.0)) return {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  PointMask touches = press.overlap_m.array() > 0.0;
  PointExchange exchange;
  // The pressure of a sticking contact changes its sign without end towards its edge, so that a node there may pull when
  // it is held and overlap when it is not. One that was let go this often stays free.
  constexpr int kMostReleases = 3;
  Eigen::ArrayXi releases = Eigen::ArrayXi::Zero(n);
  for (int set = 0; set < kMostSets; ++set) {
    StripForces forces = held_nodes(strip, press, touches);
    const double pull = kPull * forces.down.cwiseAbs().maxCoeff();
    const Eigen::VectorXd left_m = press.overlap_m - sinking_m(strip, forces);
    const PointMask pulls = touches && forces.down.array() < -pull;
    PointMask overlaps = !touches && left_m.array() > kOverlap * size_m;
    if (press.friction == Friction::kStick) overlaps = overlaps && releases < kMostReleases;
    const PointMask wrong = pulls || overlaps;
    if (!wrong.any()) {
      forces.down = forces.down.cwiseMax(0.0);
      return forces;
    }
    const PointMask changes = exchange.next(wrong);
    releases += (pulls && changes).cast<int>();
    touches = (touches && !changes) || (overlaps && changes);
  }
  throw std::runtime_error(
      "the contact of a strip's top did not settle; change the depth a little");
}

}  // namespace viscard
