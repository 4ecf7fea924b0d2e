#include "models/array/layer/layer_contact.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Residual of the conjugate gradients over the largest overlap.
constexpr double kResidual = 1e-11;
constexpr int kMostIterations = 3000;

Eigen::MatrixXd heights_m(const LayerPress& press, const LayerGrid& grid, bool is_plane) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double half_m = press.width_m > 0.0 ? 0.5 * press.width_m : kNone;
  Eigen::MatrixXd heights(grid.count, is_plane ? 1 : grid.count);
  for (Eigen::Index j = 0; j < heights.cols(); ++j) {
    const double y_m = is_plane ? 0.0 : grid.place_m(grid.y_m, j);
    for (Eigen::Index i = 0; i < heights.rows(); ++i) {
      const double x_m = grid.place_m(grid.x_m, i);
      const bool is_covered = std::abs(x_m) < half_m && std::abs(y_m) < half_m;
      heights(i, j) = is_covered ? height_m(press.shape, x_m, y_m) : kNone;
    }
  }
  return heights;
}

}  // namespace

bool LayerPressure::touches_rim() const {
  const Eigen::Index last = pressure_Pa.rows() - 1;
  bool touches = pressure_Pa.row(0).maxCoeff() > 0.0 || pressure_Pa.row(last).maxCoeff() > 0.0;
  if (pressure_Pa.cols() > 1) {
    touches =
        touches || pressure_Pa.col(0).maxCoeff() > 0.0 || pressure_Pa.col(last).maxCoeff() > 0.0;
  }
  return touches;
}

LayerContact::LayerContact(const LayerKernel& kernel, LayerPress press, const LayerGrid& grid)
    : is_plane_(kernel.is_plane()),
      press_(std::move(press)),
      grid_(grid),
      height_m_(heights_m(press_, grid, is_plane_)),
      sinking_(kernel.sinking_m_Pa(grid.count, grid.cell_m())) {}

// Polonsky & Keer, Wear 231 (1999) 206, with the depth given: conjugate gradients on the cells that are
// pressed; cells that would be pulled are let go, cells that overlap are taken in.
LayerPressure LayerContact::to_depth(double depth_m, const Eigen::MatrixXd& guess_Pa) const {
  using Array = Eigen::ArrayXXd;
  const Array overlap = depth_m - height_m_.array();
  const Array covered = (overlap > -std::numeric_limits<double>::infinity()).cast<double>();
  const Array wanted = (covered > 0.0).select(overlap, 0.0);
  LayerPressure answer;
  answer.grid = grid_;
  answer.depth_m = depth_m;
  Array p =
      guess_Pa.size() > 0 ? Array(guess_Pa.array()) : Array::Zero(wanted.rows(), wanted.cols());
  p *= covered;
  if (!press_.follows) p = p.max(0.0);
  const double scale_m = press_.follows ? wanted.abs().maxCoeff() : wanted.maxCoeff();
  const auto touched = [&]() -> Array {
    return press_.follows ? covered : Array((p > 0.0).cast<double>());
  };
  if (!(scale_m > 0.0)) p.setZero();
  if (scale_m > 0.0) {
    if (p.abs().maxCoeff() == 0.0) {
      // Any positive pressure on what overlaps.
      p = (wanted > 0.0).cast<double>();
    }
    Array gap = sinking_.apply(p.matrix()).array() - wanted;
    Array direction = Array::Zero(p.rows(), p.cols());
    double before = 1.0;
    bool is_same = false;  // the touched cells did not change
    for (;; ++answer.iterations) {
      const Array on = touched();
      const Array left = gap * on;
      const double open = press_.follows ? 0.0 : -((1.0 - on) * covered * gap).minCoeff();
      if (is_same && std::max(left.abs().maxCoeff(), open) <= kResidual * scale_m) break;
      if (answer.iterations >= kMostIterations) {
        throw std::runtime_error("the pressure under the shape did not converge in " +
                                 std::to_string(kMostIterations) + " iterations");
      }
      const double square = left.square().sum();
      direction = left + (is_same && before > 0.0 ? square / before : 0.0) * direction * on;
      before = square;
      const Array moved = sinking_.apply(direction.matrix()).array();
      const double curvature = (moved * direction).sum();
      const double step = curvature > 0.0 ? (left * direction).sum() / curvature : 0.0;
      p -= step * direction;
      gap -= step * moved;
      is_same = true;
      if (press_.follows) continue;
      const Array pulled = (p < 0.0).cast<double>();
      const Array taken = ((1.0 - on) * covered * (gap < -kResidual * scale_m).cast<double>());
      if (pulled.maxCoeff() > 0.0 || taken.maxCoeff() > 0.0) {
        p = p.max(0.0) - std::abs(step) * taken * gap;
        gap = sinking_.apply(p.matrix()).array() - wanted;
        is_same = taken.maxCoeff() == 0.0;
      }
    }
  }
  answer.pressure_Pa = p.matrix();
  const double cell_m2 = is_plane_ ? grid_.cell_m() : grid_.cell_m() * grid_.cell_m();
  answer.force_N = p.sum() * cell_m2;
  answer.contact_m2 = (p != 0.0).cast<double>().sum() * cell_m2;
  return answer;
}

// Secant between depths on either side, halved at the end that stays (Illinois method: Dowell & Jarratt,
// BIT 11 (1971) 168). The force grows with the depth.
LayerPressure LayerContact::with_force(double force_N, double depth_m, double step_m,
                                       const Eigen::MatrixXd& guess_Pa) const {
  constexpr int kMostSteps = 80;
  const double enough_N = kResidual * force_N;
  LayerPressure best = to_depth(depth_m, guess_Pa);
  double low_m = depth_m, high_m = depth_m;
  double below_N = best.force_N - force_N, above_N = below_N;
  for (int step = 0; step < kMostSteps && below_N > 0.0; ++step, step_m *= 4.0) {
    above_N = below_N;
    high_m = low_m;
    low_m -= step_m;
    best = to_depth(low_m, best.pressure_Pa);
    below_N = best.force_N - force_N;
  }
  for (int step = 0; step < kMostSteps && above_N < 0.0; ++step, step_m *= 4.0) {
    below_N = above_N;
    low_m = high_m;
    high_m += step_m;
    best = to_depth(high_m, best.pressure_Pa);
    above_N = best.force_N - force_N;
  }
  int side = 0;  // of the last point: 1 above, -1 below
  for (int step = 0; step < kMostSteps && std::abs(best.force_N - force_N) > enough_N; ++step) {
    const double at_m = (low_m * above_N - high_m * below_N) / (above_N - below_N);
    if (!(at_m > low_m && at_m < high_m)) break;  // rounding
    best = to_depth(at_m, best.pressure_Pa);
    const double beyond_N = best.force_N - force_N;
    (beyond_N > 0.0 ? high_m : low_m) = at_m;
    (beyond_N > 0.0 ? above_N : below_N) = beyond_N;
    const int now = beyond_N > 0.0 ? 1 : -1;
    if (now == side) (now == 1 ? below_N : above_N) *= 0.5;
    side = now;
  }
  return best;
}

Eigen::MatrixXd pressure_on(const LayerPressure& pressure, const LayerGrid& grid, bool is_plane) {
  const LayerGrid& from = pressure.grid;
  const auto index = [&](double place_m, double middle_m) {
    return static_cast<Eigen::Index>(
        std::floor((place_m - middle_m + 0.5 * from.width_m) / from.cell_m()));
  };
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(grid.count, is_plane ? 1 : grid.count);
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    const Eigen::Index b = is_plane ? 0 : index(grid.place_m(grid.y_m, j), from.y_m);
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const Eigen::Index a = index(grid.place_m(grid.x_m, i), from.x_m);
      const bool is_inside = a >= 0 && b >= 0 && a < from.count && b < pressure.pressure_Pa.cols();
      if (is_inside) values(i, j) = pressure.pressure_Pa(a, b);
    }
  }
  return values;
}

double potential_V(const LayerPressure& pressure, const LayerKernel& kernel, double x_m, double y_m,
                   std::size_t reading) {
  const LayerGrid& grid = pressure.grid;
  const bool is_plane = kernel.is_plane();
  const double cell_m2 = is_plane ? grid.cell_m() : grid.cell_m() * grid.cell_m();
  double sum = 0.0;
  for (Eigen::Index j = 0; j < pressure.pressure_Pa.cols(); ++j) {
    const double dy_m = is_plane ? 0.0 : y_m - grid.place_m(grid.y_m, j);
    for (Eigen::Index i = 0; i < pressure.pressure_Pa.rows(); ++i) {
      const double p_Pa = pressure.pressure_Pa(i, j);
      if (p_Pa == 0.0) continue;
      sum += p_Pa * kernel.potential_V_N(x_m - grid.place_m(grid.x_m, i), dy_m, reading);
    }
  }
  return sum * cell_m2;
}

}  // namespace viscard
