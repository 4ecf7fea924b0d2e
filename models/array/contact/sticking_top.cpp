#include "models/array/contact/sticking_top.h"

#include "models/array/contact/cut_top.h"
#include "models/array/contact/point_waves.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr double kNoSurface_m = -1.0;  // far above anything

// Of three rows of blocks, those of the points in the mask.
PointVectors held_part(const PointVectors& values, const PointMask& mask) {
  PointVectors part(values.rows(), values.cols());
  const Eigen::Index n = mask.rows();
  for (Eigen::Index d = 0; d < 3; ++d)
    part.middleRows(d * n, n) = mask.select(values.middleRows(d * n, n), 0.0);
  return part;
}

}  // namespace

StickingTop::StickingTop(StickingCompliance compliance)
    : compliance_(std::move(compliance)),
      waves_(unit_waves(compliance_.angles)),
      waves_across_(waves_.transpose()) {
  const Eigen::Index n = rings();
  for (std::size_t m = 0; m < compliance_.harmonic_m_N.size(); ++m) {
    Eigen::MatrixXd block =
        compliance_.harmonic_m_N[m] * ((m == 0 ? 1.0 : 0.5) * compliance_.angles);
    if (2 * static_cast<int>(m) == compliance_.angles) {  // sin(m theta) = 0 at all points
      block.middleRows(n, n).leftCols(n).setZero();
      block.middleRows(n, n).rightCols(n).setZero();
      block.middleCols(n, n).topRows(n).setZero();
      block.middleCols(n, n).bottomRows(n).setZero();
    }
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(3 * n, 3 * n);
    inverse_N_m_.push_back(Cholesky(block).solve(identity));
    on_waves_m_N_.push_back(std::move(block));
  }
  point_stiffness_N_m_ = Eigen::VectorXd::Zero(n);
  for (Eigen::Index column = 0; column < waves_.cols(); ++column) {
    point_stiffness_N_m_ +=
        std::pow(waves_(0, column), 2) *
        inverse_N_m_[static_cast<std::size_t>((column + 1) / 2)].diagonal().tail(n);
  }
}

// Of each harmonic, (r cos, theta sin, down cos) and (r sin, -theta cos, down sin).
PointVectors StickingTop::in_harmonics(const PointVectors& values, const Blocks& blocks) const {
  const Eigen::Index n = rings();
  PointVectors by_wave = transposed_product(values.transpose(), waves_);
  by_wave.col(0) = transposed_product(blocks[0], by_wave.leftCols(1));
  for (std::size_t m = 1; m < blocks.size(); ++m) {
    const auto cosine = 2 * static_cast<Eigen::Index>(m) - 1, sine = cosine + 1;
    if (sine >= by_wave.cols()) {
      by_wave.col(cosine) = transposed_product(blocks[m], by_wave.middleCols(cosine, 1));
      continue;
    }
    Eigen::MatrixXd pair(3 * n, 2);
    pair << by_wave.col(cosine), by_wave.col(sine);
    pair.block(n, 0, n, 1) = by_wave.block(n, sine, n, 1);
    pair.block(n, 1, n, 1) = -by_wave.block(n, cosine, n, 1);
    const Eigen::MatrixXd answer = transposed_product(blocks[m], pair);  // blocks are symmetric
    by_wave.col(cosine) = answer.col(0);
    by_wave.col(sine) = answer.col(1);
    by_wave.block(n, sine, n, 1) = answer.block(n, 0, n, 1);
    by_wave.block(n, cosine, n, 1) = -answer.block(n, 1, n, 1);
  }
  return transposed_product(by_wave.transpose(), waves_across_);
}

PointVectors StickingTop::motion(const PointVectors& forces_N) const {
  return in_harmonics(forces_N, on_waves_m_N_);
}
PointVectors StickingTop::forces(const PointVectors& motion_m) const {
  return in_harmonics(motion_m, inverse_N_m_);
}

// Conjugate gradients on the points that touch, from the given forces; the stiffness of a top that is held everywhere
// is the preconditioner.
void StickingTop::hold(const Eigen::MatrixXd& overlap_m, const PointMask& touches,
                       const PointVectors& softness_m_N, double accuracy, PointVectors& f) const {
  const auto moved_by = [&](const PointVectors& forces_N) -> PointVectors {
    if (softness_m_N.size() == 0) return motion(forces_N);
    return motion(forces_N) + softness_m_N.cwiseProduct(forces_N);
  };
  constexpr int kMostSteps = 1000;
  PointVectors wanted = PointVectors::Zero(f.rows(), f.cols());
  wanted.bottomRows(rings()) = overlap_m;
  f = held_part(f, touches);
  PointVectors residual = held_part(wanted - moved_by(f), touches);
  PointVectors towards = held_part(forces(residual), touches);
  PointVectors direction = towards;
  double work = inner(residual, towards);
  const double size_m = touches.select(overlap_m, 0.0).cwiseAbs().maxCoeff();
  const double enough = std::pow(accuracy * size_m, 2) * static_cast<double>(f.size());
  for (int step = 0; step < kMostSteps && inner(residual, residual) > enough; ++step) {
    const PointVectors moved = held_part(moved_by(direction), touches);
    const double along = work / inner(direction, moved);
    f += along * direction;
    residual -= along * moved;
    towards = held_part(forces(residual), touches);
    const double next = inner(residual, towards);
    direction = towards + (next / work) * direction;
    work = next;
  }
}

PointVectors StickingTop::pushing_forces(const Eigen::MatrixXd& overlap_m, const PointMask& start,
                                         const Eigen::MatrixXd& softness_m_N,
                                         const PointVectors& start_N) const {
  constexpr int kMostSets = 500, kMostReleases = 3;
  constexpr double kRough = 1e-4, kResidual = 1e-12;
  const Eigen::Index n = rings();
  const double size_m = overlap_m.maxCoeff();
  PointVectors f = PointVectors::Zero(3 * n, overlap_m.cols());
  if (!(size_m > 0.0)) return f;
  PointMask touches = overlap_m.array() > 0.0;
  if (overlap_m.minCoeff() > -size_m) {
    PointVectors all = f;
    all.bottomRows(n) = overlap_m;
    all = forces(all);
    if (all.bottomRows(n).minCoeff() >= 0.0) return all;
    touches = all.bottomRows(n).array() > 0.0;
    f = all;
  }
  if (start.size() > 0 && start.any()) touches = start;
  if (start_N.size() > 0 && (start_N.bottomRows(n).array() > 0.0).any()) {
    f = start_N;
    touches = f.bottomRows(n).array() > 0.0;
  }
  PointVectors softness;  // in all directions
  if (softness_m_N.size() > 0) softness = softness_m_N.replicate(3, 1);
  PointExchange exchange;
  // Near the edge of a sticking contact the pressure changes its sign without end, so that a point may pull when it is
  // held and overlap when it is not. One that was let go this often stays free.
  Eigen::ArrayXXi releases = Eigen::ArrayXXi::Zero(n, overlap_m.cols());
  double accuracy = kRough;  // most sets are given up at once
  for (int set = 0; set < kMostSets; ++set) {
    hold(overlap_m, touches, softness, accuracy, f);
    const double slack = std::max(1e-9, accuracy);
    const Eigen::MatrixXd down = f.bottomRows(n);
    const PointMask pulls = touches && down.array() < -slack * down.maxCoeff();
    Eigen::MatrixXd left_m = overlap_m - motion(f).bottomRows(n);
    if (softness_m_N.size() > 0) left_m -= softness_m_N.cwiseProduct(down);
    const PointMask overlaps =
        !touches && left_m.array() > slack * size_m && releases < kMostReleases;
    const PointMask wrong = pulls || overlaps;
    if (!wrong.any() && accuracy == kResidual) {
      f.bottomRows(n) = down.cwiseMax(0.0);
      return f;
    }
    if (!wrong.any()) {
      accuracy = kResidual;
      exchange = {};
      continue;
    }
    const PointMask changes = exchange.next(wrong);
    releases += (pulls && changes).cast<int>();
    touches = (touches && !changes) || (overlaps && changes);
  }
  throw std::runtime_error(
      "the contact of a top that sticks did not settle; change the depth a little");
}

TopPressure StickingTop::pressure_of(const PointVectors& forces_N) const {
  TopPressure pressure;
  const Eigen::Index n = rings();
  const double area_m2 = compliance_.ring_area_m2.sum();
  bool touches_all = true;
  for (Eigen::Index ring = 0; ring < n; ++ring) {
    const double point_m2 = compliance_.ring_area_m2[ring] / compliance_.angles;
    const double r_m = compliance_.radius_m[static_cast<std::size_t>(ring)];
    for (int a = 0; a < compliance_.angles; ++a) {
      const double angle = point_angle(a, compliance_.angles);
      const double x = std::cos(angle), y = std::sin(angle);
      const double along_r = forces_N(ring, a), round = forces_N(n + ring, a);
      const double down = forces_N(2 * n + ring, a);
      pressure.force_N += down;
      pressure.moment_x_Nm += down * r_m * x;
      pressure.moment_y_Nm += down * r_m * y;
      pressure.shear_x_N += along_r * x - round * y;
      pressure.shear_y_N += along_r * y + round * x;
      pressure.torque_Nm += round * r_m;
      pressure.largest_Pa = std::max(pressure.largest_Pa, down / point_m2);
      touches_all = touches_all && down != 0.0;
      if (down != 0.0) pressure.share += point_m2 / area_m2;
    }
  }
  pressure.is_partial = pressure.share > 0.0 && !touches_all;
  if (pressure.is_partial)
    pressure.share_error = std::sqrt(pressure.share) / static_cast<double>(n);
  if (touches_all) pressure.share = 1.0;
  return pressure;
}

TopPressure StickingTop::press(const Overlap& overlap, const PointMask& start,
                               PointVectors* last) const {
  const PointCover cover = point_cover(overlap, compliance_.radius_m, compliance_.angles);
  const Eigen::MatrixXd overlap_m = cover.overlap_m.cwiseMax(kNoSurface_m);
  const PointVectors start_N = last != nullptr ? *last : PointVectors();
  const PointVectors forces_N = pushing_forces(
      overlap_m, start,
      cover.is_cut ? softness_m_N(cover, point_stiffness_N_m_) : Eigen::MatrixXd(), start_N);
  if (last != nullptr) *last = forces_N;
  TopPressure pressure = pressure_of(forces_N);
  if (!cover.is_cut) return pressure;
  pressure.is_partial = pressure.is_cut = true;
  pressure.share = share_of(forces_N.bottomRows(rings()), cover.share, compliance_.ring_area_m2);
  return pressure;
}

TopPressure StickingTop::follow(const Overlap& overlap) const {
  PointVectors motion_m = PointVectors::Zero(3 * rings(), compliance_.angles);
  motion_m.bottomRows(rings()) =
      point_cover(overlap, compliance_.radius_m, compliance_.angles).overlap_m;
  return pressure_of(forces(motion_m));
}

}  // namespace viscard
