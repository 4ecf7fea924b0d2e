#include "models/array/contact/top_contact.h"

#include "models/array/contact/cut_top.h"
#include "models/array/contact/point_waves.h"
#include "models/array/contact/sticking_top.h"
#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Far above anything: stands for "no surface here".
constexpr double kAbove_m = -1.0;

Eigen::MatrixXd masked(const Eigen::MatrixXd& values, const PointMask& mask) {
  return mask.select(values, 0.0);
}

}  // namespace

TopContact::TopContact(TopCompliance compliance)
    : compliance_(std::move(compliance)),
      waves_(unit_waves(compliance_.angles)),
      waves_across_(waves_.transpose()) {
  const int angles = compliance_.angles;
  for (const Eigen::MatrixXd& block : compliance_.harmonic_m_N) {
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(block.rows(), block.cols());
    stiffness_N_m_.push_back(Cholesky(block).solve(identity));
  }
  radius_m_ = compliance_.radius_m.back();
  point_stiffness_N_m_ = Eigen::VectorXd::Zero(compliance_.ring_area_m2.size());
  for (int column = 0; column < angles; ++column) {
    const int m = (column + 1) / 2;
    point_stiffness_N_m_ += std::pow(waves_(0, column), 2) / ((m == 0 ? 1.0 : 0.5) * angles) *
                            stiffness_N_m_[static_cast<std::size_t>(m)].diagonal();
  }
}

TopContact::TopContact(TopCompliance compliance, std::shared_ptr<const StickingTop> sticking)
    : TopContact(std::move(compliance)) {
  sticking_ = std::move(sticking);
}

// The compliance is a circulant over the angles: its eigenvalue is angles S_0 or angles/2 S_m. S_m is symmetric, and a
// cosine and its sine share it.
Eigen::MatrixXd TopContact::in_harmonics(const Eigen::MatrixXd& values,
                                         const std::vector<Eigen::MatrixXd>& blocks,
                                         double factor_of_0, double factor) const {
  Eigen::MatrixXd by_wave = transposed_product(values.transpose(), waves_);
  by_wave.col(0) = factor_of_0 * transposed_product(blocks[0], by_wave.leftCols(1));
  for (std::size_t m = 1; m < blocks.size(); ++m) {
    const auto first = 2 * static_cast<Eigen::Index>(m) - 1;
    const Eigen::Index count = std::min<Eigen::Index>(2, by_wave.cols() - first);
    by_wave.middleCols(first, count) =
        factor * transposed_product(blocks[m], by_wave.middleCols(first, count));
  }
  return transposed_product(by_wave.transpose(), waves_across_);
}

Eigen::MatrixXd TopContact::motion(const Eigen::MatrixXd& forces_N) const {
  return in_harmonics(forces_N, compliance_.harmonic_m_N, compliance_.angles,
                      0.5 * compliance_.angles);
}

Eigen::MatrixXd TopContact::forces(const Eigen::MatrixXd& motion_m) const {
  return in_harmonics(motion_m, stiffness_N_m_, 1.0 / compliance_.angles, 2.0 / compliance_.angles);
}

// Conjugate gradients on the points that touch, with the stiffness of a top that is held everywhere as preconditioner.
void TopContact::hold(const Eigen::MatrixXd& overlap_m, const PointMask& touches,
                      const Eigen::MatrixXd& softness_m_N, double accuracy,
                      Eigen::MatrixXd& f) const {
  constexpr int kMostSteps = 2000;
  Eigen::MatrixXd residual = masked(overlap_m - moved_by(f, softness_m_N), touches);
  const double size_m = std::max(overlap_m.maxCoeff(), 0.0);
  const double enough = std::pow(accuracy * size_m, 2) * static_cast<double>(f.size());
  if (!(residual.squaredNorm() > enough)) return;
  Eigen::MatrixXd towards = masked(forces(residual), touches);
  Eigen::MatrixXd direction = towards;
  double work = inner(residual, towards);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd moved = masked(moved_by(direction, softness_m_N), touches);
    const double along = work / inner(direction, moved);
    f += along * direction;
    residual -= along * moved;
    if (!(residual.squaredNorm() > enough)) return;
    towards = masked(forces(residual), touches);
    const double next = inner(residual, towards);
    direction = towards + (next / work) * direction;
    work = next;
  }
}

Eigen::MatrixXd TopContact::moved_by(const Eigen::MatrixXd& forces_N,
                                     const Eigen::MatrixXd& softness_m_N) const {
  if (softness_m_N.size() == 0) return motion(forces_N);
  return motion(forces_N) + softness_m_N.cwiseProduct(forces_N);
}

// Points that pull are let go, points that overlap are taken in, until neither happens: at first roughly, because most
// sets are given up at once.
Eigen::MatrixXd TopContact::unilateral_forces(const Eigen::MatrixXd& overlap_m,
                                              const Eigen::MatrixXd& start,
                                              const Eigen::MatrixXd& softness_m_N) const {
  constexpr int kMostSets = 2000;
  constexpr double kRough = 1e-4, kResidual = 1e-13;
  const double size_m = std::max(overlap_m.maxCoeff(), 0.0);
  Eigen::MatrixXd f = start.cwiseMax(0.0);
  if (size_m == 0.0) return Eigen::MatrixXd::Zero(f.rows(), f.cols());
  PointMask touches = f.array() > 0.0;
  if (!touches.any()) touches = overlap_m.array() > 0.0;
  f = masked(f, touches);
  PointExchange exchange;
  double accuracy = kRough;
  for (int set = 0; set < kMostSets; ++set) {
    hold(overlap_m, touches, softness_m_N, accuracy, f);
    const double pull_N = std::max(1e-10, accuracy) * f.maxCoeff();
    const PointMask pulls = touches && f.array() < -pull_N;
    const Eigen::MatrixXd left_m =
        overlap_m - moved_by(masked(f.cwiseMax(0.0), touches), softness_m_N);
    const PointMask overlaps = !touches && left_m.array() > std::max(1e-9, accuracy) * size_m;
    const PointMask wrong = pulls || overlaps;
    if (!wrong.any() && accuracy == kResidual) return f.cwiseMax(0.0);
    if (!wrong.any()) {
      accuracy = kResidual;
      exchange = {};
      continue;
    }
    const PointMask changes = exchange.next(wrong);
    touches = (touches && !changes) || (overlaps && changes);
    f = masked(f.cwiseMax(0.0), touches);
  }
  throw std::runtime_error(
      "the contact of a pillar's top did not settle; change the depth a little");
}

void TopContact::add_resultants(const Eigen::MatrixXd& forces_N, TopPressure& pressure) const {
  const int angles = compliance_.angles;
  const double area_m2 = compliance_.ring_area_m2.sum();
  for (Eigen::Index ring = 0; ring < forces_N.rows(); ++ring) {
    const double point_m2 = compliance_.ring_area_m2[ring] / angles;
    const double r_m = compliance_.radius_m[static_cast<std::size_t>(ring)];
    for (int a = 0; a < angles; ++a) {
      const double f = forces_N(ring, a);
      pressure.force_N += f;
      pressure.moment_x_Nm += f * r_m * std::cos(point_angle(a, angles));
      pressure.moment_y_Nm += f * r_m * std::sin(point_angle(a, angles));
      if (f > 0.0) pressure.share += point_m2 / area_m2;
      pressure.largest_Pa = std::max(pressure.largest_Pa, f / point_m2);
    }
  }
}

TopPressure TopContact::follow(const Overlap& overlap) const {
  if (sticking_) return sticking_->follow(overlap);
  constexpr int kRings = 10, kAngles = 24;
  const QuadratureRule rule = gauss_legendre(kRings);
  double mean_m = 0.0, first_x_m2 = 0.0, first_y_m2 = 0.0;
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    const double r_m = radius_m_ * std::sqrt(rule.points[i]);  // equal areas for equal weights
    for (int a = 0; a < kAngles; ++a) {
      const double x_m = r_m * std::cos(point_angle(a, kAngles));
      const double y_m = r_m * std::sin(point_angle(a, kAngles));
      const double part_m = rule.weights[i] / kAngles * overlap(x_m, y_m);
      mean_m += part_m;
      first_x_m2 += part_m * x_m;
      first_y_m2 += part_m * y_m;
    }
  }
  TopPressure pressure;
  pressure.force_N = mean_m / compliance_.sinking_m_N();
  // The slope of a plane with the same first moments: 4/R^2 times the mean of g x.
  const double of_slope = 4.0 / (radius_m_ * radius_m_) / compliance_.turning_rad_Nm();
  pressure.moment_x_Nm = of_slope * first_x_m2;
  pressure.moment_y_Nm = of_slope * first_y_m2;
  pressure.share = 1.0;
  return pressure;
}

TopContact::PointOverlap TopContact::overlaps(const Overlap& overlap) const {
  PointCover cover = point_cover(overlap, compliance_.radius_m, compliance_.angles);
  PointOverlap points{
      .overlap_m = cover.overlap_m.cwiseMax(kAbove_m), .softness_m_N = {}, .share = {}};
  if (!cover.is_cut) return points;
  points.softness_m_N = viscard::softness_m_N(cover, point_stiffness_N_m_);
  points.share = std::move(cover.share);
  return points;
}

bool TopContact::is_full(const Eigen::MatrixXd& overlap_m, Eigen::MatrixXd& everywhere) const {
  if (!(overlap_m.minCoeff() > -overlap_m.maxCoeff())) return false;
  everywhere = forces(overlap_m);
  return everywhere.minCoeff() >= 0.0;
}

Eigen::MatrixXd TopContact::pushing_forces(const Eigen::MatrixXd& overlap_m,
                                           const Eigen::MatrixXd& guess,
                                           const Eigen::MatrixXd& softness_m_N) const {
  if (!(overlap_m.maxCoeff() > 0.0)) {
    return Eigen::MatrixXd::Zero(overlap_m.rows(), overlap_m.cols());
  }
  Eigen::MatrixXd everywhere;
  if (is_full(overlap_m, everywhere)) return everywhere;
  if (guess.size() > 0) return unilateral_forces(overlap_m, guess, softness_m_N);
  if (everywhere.size() > 0) return unilateral_forces(overlap_m, everywhere, softness_m_N);
  return unilateral_forces(
      overlap_m,
      overlap_m.cwiseMax(0.0) / compliance_.sinking_m_N() / static_cast<double>(overlap_m.size()),
      softness_m_N);
}

TopPressure TopContact::pressure_of(const Eigen::MatrixXd& forces_N) const {
  TopPressure pressure;
  add_resultants(forces_N, pressure);
  pressure.is_partial = pressure.share > 0.0 && forces_N.minCoeff() == 0.0;
  if (pressure.is_partial) {
    pressure.share_error = std::sqrt(pressure.share) / static_cast<double>(forces_N.rows());
  }
  return pressure;
}

TopPressure TopContact::press(const Overlap& overlap, const std::optional<RoundTip>& tip,
                              Eigen::MatrixXd* last) const {
  if (tip && !sticking_) {
    const auto small = press_round_tip(
        *tip, compliance_, [this](const Eigen::MatrixXd& forces_N) { return motion(forces_N); });
    if (small) return *small;
  }
  return press(overlap, last);
}

TopPressure TopContact::press(const Overlap& overlap, Eigen::MatrixXd* last) const {
  const PointOverlap points = overlaps(overlap);
  if (!(points.overlap_m.maxCoeff() > 0.0)) return {};
  Eigen::MatrixXd everywhere;
  const bool fills = points.share.size() == 0 && is_full(points.overlap_m, everywhere);
  // The points that touch without friction are nearly those that touch with it.
  if (fills && sticking_) return sticking_->press(overlap);
  if (fills) {
    TopPressure pressure = follow(overlap);
    pressure.largest_Pa = pressure_of(everywhere).largest_Pa;
    return pressure;
  }
  const bool has_last = last != nullptr && last->size() > 0;
  if (sticking_ && has_last) return sticking_->press(overlap, {}, last);
  const Eigen::MatrixXd forces_N =
      pushing_forces(points.overlap_m, has_last ? *last : everywhere, points.softness_m_N);
  if (sticking_) return sticking_->press(overlap, forces_N.array() > 0.0, last);
  if (last != nullptr) *last = forces_N;
  TopPressure pressure = pressure_of(forces_N);
  pressure.is_partial = true;
  if (points.share.size() == 0) return pressure;
  pressure.is_cut = true;
  pressure.share = share_of(forces_N, points.share, compliance_.ring_area_m2);
  return pressure;
}

}  // namespace viscard
