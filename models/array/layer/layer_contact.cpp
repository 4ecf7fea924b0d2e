#include "models/array/layer/layer_contact.h"

#include "models/array/contact/press_array.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Cells = Eigen::ArrayXXd;  // a value of each cell of a grid

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

// Polonsky & Keer, Wear 231 (1999) 206, with the depth given: conjugate gradients on the cells that are
// pressed; cells that would be pulled are let go, cells that overlap are taken in. A face that follows the
// shape is solved on all cells that the shape covers.
class PressureIteration {
 public:
  PressureIteration(const GridConvolution& sinking, Cells wanted_m, Cells covered, bool follows)
      : sinking_(&sinking),
        wanted_m_(std::move(wanted_m)),
        covered_(std::move(covered)),
        follows_(follows),
        scale_m_(follows ? wanted_m_.abs().maxCoeff() : wanted_m_.maxCoeff()),
        p_(Cells::Zero(wanted_m_.rows(), wanted_m_.cols())),
        direction_(p_) {}

  const Cells& pressure() const { return p_; }
  bool is_out_of_reach() const { return !(scale_m_ > 0.0); }

  void begin(const Eigen::MatrixXd& guess_Pa) {
    if (guess_Pa.size() > 0) p_ = guess_Pa.array() * covered_;
    if (!follows_) p_ = p_.max(0.0);
    // Without a guess, any positive pressure on what overlaps.
    if (p_.abs().maxCoeff() == 0.0) p_ = (wanted_m_ > 0.0).cast<double>();
    gap_m_ = sinking_->apply(p_.matrix()).array() - wanted_m_;
  }

  bool is_done() const {
    if (!is_same_) return false;
    const Cells on = touched();
    const double open_m = follows_ ? 0.0 : -((1.0 - on) * covered_ * gap_m_).minCoeff();
    return std::max((gap_m_ * on).abs().maxCoeff(), open_m) <= kResidual * scale_m_;
  }

  void step() {
    const Cells on = touched();
    const Cells left = gap_m_ * on;
    const double square = left.square().sum();
    const double turn = is_same_ && before_ > 0.0 ? square / before_ : 0.0;
    direction_ = left + turn * direction_ * on;
    before_ = square;
    const Cells moved = sinking_->apply(direction_.matrix()).array();
    const double curvature = (moved * direction_).sum();
    const double length = curvature > 0.0 ? (left * direction_).sum() / curvature : 0.0;
    p_ -= length * direction_;
    gap_m_ -= length * moved;
    is_same_ = true;
    if (!follows_) exchange(on, length);
  }

 private:
  Cells touched() const { return follows_ ? covered_ : Cells((p_ > 0.0).cast<double>()); }

  void exchange(const Cells& on, double length) {
    const Cells taken = (1.0 - on) * covered_ * (gap_m_ < -kResidual * scale_m_).cast<double>();
    if (p_.minCoeff() >= 0.0 && taken.maxCoeff() == 0.0) return;
    p_ = p_.max(0.0) - std::abs(length) * taken * gap_m_;
    gap_m_ = sinking_->apply(p_.matrix()).array() - wanted_m_;
    is_same_ = taken.maxCoeff() == 0.0;
  }

  const GridConvolution* sinking_;
  Cells wanted_m_, covered_;
  bool follows_;
  double scale_m_;
  Cells p_, gap_m_, direction_;
  double before_ = 1.0;
  bool is_same_ = false;  // the touched cells did not change in the last step
};

}  // namespace

Eigen::Index LayerGrid::cell_at(double middle_m, double at_m) const {
  constexpr double kRounding = 1e-6;  // of a cell
  const double from_middle = (at_m - middle_m) / cell_m();
  const double half = 0.5 * count;
  if (std::abs(from_middle) > half + kRounding) return -1;
  const double at = from_middle > 0.0 ? std::ceil(half + from_middle - kRounding) - 1.0
                                      : std::floor(half + from_middle + kRounding);
  return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(at), 0, count - 1);
}

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

LayerPressure LayerContact::to_depth(double depth_m, const Eigen::MatrixXd& guess_Pa) const {
  const Cells overlap_m = depth_m - height_m_.array();
  const Cells covered = (overlap_m > -std::numeric_limits<double>::infinity()).cast<double>();
  PressureIteration iteration(sinking_, (covered > 0.0).select(overlap_m, 0.0), covered,
                              press_.follows);
  LayerPressure answer;
  answer.grid = grid_;
  answer.depth_m = depth_m;
  if (!iteration.is_out_of_reach()) {
    iteration.begin(guess_Pa);
    for (; !iteration.is_done(); ++answer.iterations) {
      if (answer.iterations >= kMostIterations) {
        throw std::runtime_error("the pressure under the shape did not converge in " +
                                 std::to_string(kMostIterations) + " iterations");
      }
      iteration.step();
    }
  }
  answer.pressure_Pa = iteration.pressure().matrix();
  const double cell_m2 = is_plane_ ? grid_.cell_m() : grid_.cell_m() * grid_.cell_m();
  answer.force_N = answer.pressure_Pa.sum() * cell_m2;
  answer.contact_m2 = (iteration.pressure() != 0.0).cast<double>().sum() * cell_m2;
  return answer;
}

LayerPressure LayerContact::with_force(double force_N, double depth_m, double step_m,
                                       const Eigen::MatrixXd& guess_Pa) const {
  constexpr int kMostSteps = 80;
  LayerPressure best = to_depth(depth_m, guess_Pa);
  const auto excess_N_at = [&](double at_m) {
    best = to_depth(at_m, best.pressure_Pa);
    return best.force_N - force_N;
  };
  DepthBracket at{depth_m, depth_m};
  at.below_N = at.above_N = best.force_N - force_N;
  for (int step = 0; step < kMostSteps && at.below_N > 0.0; ++step, step_m *= 4.0) {
    at.above_N = at.below_N;
    at.high_m = at.low_m;
    at.low_m -= step_m;
    at.below_N = excess_N_at(at.low_m);
  }
  for (int step = 0; step < kMostSteps && at.above_N < 0.0; ++step, step_m *= 4.0) {
    at.below_N = at.above_N;
    at.low_m = at.high_m;
    at.high_m += step_m;
    at.above_N = excess_N_at(at.high_m);
  }
  narrow_depths(at, best.force_N - force_N, kResidual * force_N, excess_N_at);
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
