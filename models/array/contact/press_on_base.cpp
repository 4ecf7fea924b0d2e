#include "models/array/contact/press_on_base.h"

#include "models/array/contact/point_waves.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr double kSettled =
    1e-12;  // of the largest force: what the base and the tops may disagree by
// A film beside a load rises by less than this share of the overlap.
constexpr double kRise = 0.1;

}  // namespace

// What the tops bear while the base has moved, and how much less they bear where it moves on.
struct PressOnBase::Tops {
  PressedArray pressed;  // tops of the candidates only
  BaseForces forces;
  Eigen::MatrixXd stiffness;  // candidates x 3
};

void PressOnBase::set_candidates(const std::vector<TopContact>& classes, double depth_m) {
  if (depth_m <= candidate_depth_m_) return;
  std::vector<double> lowest_m;
  double first_m = std::numeric_limits<double>::infinity();
  for (const TouchedPillar& one : *pillars_) {
    const double radius_m = classes[static_cast<std::size_t>(one.of_class)].radius_m();
    lowest_m.push_back(least_height_m(*shape_, one.x_m, one.y_m, radius_m) - one.above_m);
    first_m = std::min(first_m, lowest_m.back());
  }
  const double reach_m = depth_m + kRise * std::max(depth_m - first_m, 0.0);
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < lowest_m.size(); ++i) {
    if (lowest_m[i] <= reach_m) candidates.push_back(i);
  }
  BaseForces forces = BaseForces::Zero(static_cast<Eigen::Index>(candidates.size()), 3);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const auto at = std::lower_bound(candidates.begin(), candidates.end(), candidates_[i]);
    if (at == candidates.end() || *at != candidates_[i]) continue;
    forces.row(at - candidates.begin()) = forces_.row(static_cast<Eigen::Index>(i));
  }
  candidate_depth_m_ = depth_m;
  forces_ = std::move(forces);
  if (candidates != candidates_ && !candidates.empty()) base_ = base_under_(candidates);
  candidates_ = std::move(candidates);
}

PressOnBase::Tops PressOnBase::press(const std::vector<TopContact>& classes, double depth_m,
                                     const BaseMotions& base) const {
  Tops tops;
  const auto count = static_cast<Eigen::Index>(candidates_.size());
  tops.forces.resize(count, 3);
  tops.stiffness = Eigen::MatrixXd::Zero(count, 3);
  tops.pressed.depth_m = depth_m;
  for (Eigen::Index i = 0; i < count; ++i) {
    const TouchedPillar& one = (*pillars_)[candidates_[static_cast<std::size_t>(i)]];
    const TopContact& contact = classes[static_cast<std::size_t>(one.of_class)];
    auto tip = round_tip(*shape_, one.x_m, one.y_m, contact.radius_m(), HUGE_VAL);
    const auto overlap_m = [&](double x_m, double y_m) {
      return depth_m + one.above_m - height_m(*shape_, one.x_m + x_m, one.y_m + y_m) - base(i, 0) -
             base(i, 1) * x_m - base(i, 2) * y_m;
    };
    if (tip) tip->overlap_m = overlap_m(tip->x_m, tip->y_m);
    if (tip && !(tip->overlap_m > 0.0)) tip.reset();
    const TopPressure top = contact.press(overlap_m, tip);
    tops.forces.row(i) << top.force_N, top.moment_x_Nm, top.moment_y_Nm;
    if (top.share > 0.0) {
      // A top that is touched in part yields more; that only changes the number of steps.
      const double turning = top.share * top.share / contact.compliance().turning_rad_Nm();
      const double sinking = (top.is_partial ? std::sqrt(top.share) : 1.0);
      tops.stiffness.row(i) << sinking / contact.compliance().sinking_m_N(), turning, turning;
    }
    tops.pressed.add(top);
  }
  return tops;
}

// The step of the forces towards (1 + W K) d = W missing in the motions d, by conjugate gradients in
// K^1/2 d, for which the matrix is symmetric.
Eigen::MatrixXd PressOnBase::step(const Eigen::MatrixXd& stiffness, const BaseForces& missing,
                                  double tolerance) const {
  constexpr int kMostSteps = 500;
  const Eigen::MatrixXd root = stiffness.cwiseSqrt();
  Eigen::MatrixXd residual = root.cwiseProduct(base_(missing));
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(residual.rows(), 3);
  Eigen::MatrixXd direction = residual;
  double square = inner(residual, residual);
  const double enough = tolerance * tolerance * square;
  for (int i = 0; i < kMostSteps && square > enough; ++i) {
    const Eigen::MatrixXd moved =
        direction + root.cwiseProduct(base_(root.cwiseProduct(direction)));
    const double along = square / inner(direction, moved);
    y += along * direction;
    residual -= along * moved;
    const double next = inner(residual, residual);
    direction = residual + (next / square) * direction;
    square = next;
  }
  return missing - root.cwiseProduct(y);
}

// The base's energy and that of the tops are convex in the motions, and their sum is least where both have
// the same forces: Newton steps, shortened where the sum would rise.
PressedArray PressOnBase::to_depth(const std::vector<TopContact>& classes, double depth_m) {
  constexpr int kMostSteps = 100;
  set_candidates(classes, depth_m);
  PressedArray all{.depth_m = depth_m};
  all.tops.resize(pillars_->size());
  if (candidates_.empty()) return all;
  BaseMotions base = base_(forces_);
  Tops tops = press(classes, depth_m, base);
  bool is_settled = false;
  for (int i = 0; i < kMostSteps && !is_settled; ++i) {
    const BaseForces missing = tops.forces - forces_;
    const double largest_N =
        std::max(tops.forces.col(0).cwiseAbs().maxCoeff(), forces_.col(0).cwiseAbs().maxCoeff());
    const double left_N = missing.col(0).cwiseAbs().maxCoeff();
    is_settled = left_N <= kSettled * largest_N;
    if (is_settled) break;
    const double tolerance = std::clamp(left_N / largest_N, 1e-8, 0.05);
    const BaseForces change = step(tops.stiffness, missing, tolerance);
    const BaseMotions moved = base_(change);
    const double falls = inner(moved, missing);
    double length = 1.0;
    for (int cut = 0; cut < 10; ++cut) {
      Tops next = press(classes, depth_m, base + length * moved);
      const double rises = inner(moved, forces_ + length * change - next.forces);
      tops = std::move(next);
      if (rises <= 0.9 * falls) break;
      length *= std::max(0.1, falls / (falls + rises));
    }
    forces_ += length * change;
    base += length * moved;
  }
  if (!is_settled) {
    throw std::runtime_error(
        "the contact on the yielding base did not settle; change the depth a little");
  }
  all.force_N = tops.pressed.force_N;
  all.contacts = tops.pressed.contacts;
  all.has_partial = tops.pressed.has_partial;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    all.tops[candidates_[i]] = tops.pressed.tops[i];
  }
  return all;
}

PressedArray PressOnBase::with_force(const std::vector<TopContact>& classes, double force_N) {
  constexpr double kForce = 1e-12;
  PressedArray best = press_with_force(*pillars_, classes, *shape_, force_N);
  const auto excess_N_at = [&](double depth_m) {
    best = to_depth(classes, depth_m);
    return best.force_N - force_N;
  };
  double step_m = 0.0;
  for (const TopContact& one : classes) {
    step_m = std::max(step_m, 0.1 * force_N * one.compliance().sinking_m_N());
  }
  DepthBracket at{best.depth_m, best.depth_m};
  at.below_N = at.above_N = excess_N_at(at.low_m);
  while (at.above_N < 0.0) {
    at.low_m = at.high_m;
    at.below_N = at.above_N;
    // A secant where there is one, with some excess, so that the root is passed.
    at.high_m += step_m;
    at.above_N = excess_N_at(at.high_m);
    step_m =
        at.above_N < 0.0 && at.above_N > at.below_N
            ? std::clamp(-1.2 * at.above_N * (at.high_m - at.low_m) / (at.above_N - at.below_N),
                         0.5 * step_m, 10.0 * step_m)
            : 2.0 * step_m;
  }
  narrow_depths(at, at.above_N, kForce * force_N, excess_N_at);
  return best;
}

}  // namespace viscard
