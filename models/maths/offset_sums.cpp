#include "models/maths/offset_sums.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr std::size_t kMostPairs = 500;  // points that are summed one by one
constexpr Eigen::Index kMostGaps = 8;    // places of a lattice per point
constexpr double kOnLattice = 1e-6;      // of a step

// The smallest step of a set of coordinates, if all are multiples of it away from the first; 0 if not.
struct Steps {
  double first_m = 0.0, step_m = 0.0;
  Eigen::Index count = 0;
};
Steps steps_of(std::vector<double> at_m, double tiny_m) {
  std::sort(at_m.begin(), at_m.end());
  Steps steps{at_m.front(), 0.0, 1};
  double smallest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < at_m.size(); ++i) {
    const double gap_m = at_m[i] - at_m[i - 1];
    if (gap_m > tiny_m) smallest_m = std::min(smallest_m, gap_m);
  }
  if (std::isinf(smallest_m)) return steps;
  const double whole = std::round((at_m.back() - at_m.front()) / smallest_m);
  steps.step_m = (at_m.back() - at_m.front()) / whole;
  steps.count = static_cast<Eigen::Index>(whole) + 1;
  for (const double one_m : at_m) {
    const double place = (one_m - steps.first_m) / steps.step_m;
    if (std::abs(place - std::round(place)) > kOnLattice) return {at_m.front(), 0.0, 0};
  }
  return steps;
}

}  // namespace

OffsetSums::Lattice OffsetSums::lattice_of(const std::vector<SourcePoint>& points) {
  std::vector<double> x_m, y_m;
  for (const SourcePoint& one : points) {
    x_m.push_back(one.x_m);
    y_m.push_back(one.y_m);
  }
  const auto [left, right] = std::minmax_element(x_m.begin(), x_m.end());
  const auto [low, high] = std::minmax_element(y_m.begin(), y_m.end());
  const double tiny_m = 1e-9 * std::max(*right - *left, *high - *low);
  const Steps x = steps_of(x_m, tiny_m);
  const Steps y = steps_of(y_m, tiny_m);
  const auto count = static_cast<Eigen::Index>(points.size());
  Lattice lattice;
  if (x.count == 0 || y.count == 0 || x.count * y.count < 2 ||
      x.count * y.count > kMostGaps * count + 16) {
    return lattice;
  }
  lattice = {x.first_m, y.first_m, x.step_m, y.step_m, x.count, y.count, x.count == 1, {}, {}};
  for (const SourcePoint& one : points) {
    const auto at_x = x.count > 1 ? std::lround((one.x_m - x.first_m) / x.step_m) : 0;
    const auto at_y = y.count > 1 ? std::lround((one.y_m - y.first_m) / y.step_m) : 0;
    lattice.row.push_back(lattice.is_turned ? at_y : at_x);
    lattice.column.push_back(lattice.is_turned ? at_x : at_y);
  }
  return lattice;
}

bool OffsetSums::can_sum(const std::vector<SourcePoint>& points) {
  return points.size() <= kMostPairs || lattice_of(points).nx > 0;
}

OffsetSums::OffsetSums(const std::vector<SourcePoint>& points, int kinds, const Kernel& kernel,
                       const std::array<KernelMirror, 2>& mirrors)
    : points_(points),
      kinds_(kinds),
      readings_(static_cast<Eigen::Index>(mirrors[0].reading.size())),
      loads_(mirrors[0].load_sign.size()) {
  require(!points.empty(), "sums over points need points");
  if (points.size() > 2) lattice_ = lattice_of(points);
  lattice_.nx > 0 ? set_grids(kernel, mirrors) : set_pairs(kernel);
}

void OffsetSums::set_grids(const Kernel& kernel, const std::array<KernelMirror, 2>& mirrors) {
  const Eigen::Index nx = lattice_.nx, ny = lattice_.ny;
  const Eigen::Index rows = lattice_.is_turned ? ny : nx, columns = lattice_.is_turned ? nx : ny;
  const auto mirrored = [](const Eigen::MatrixXd& K, const KernelMirror& mirror) {
    Eigen::MatrixXd other(K.rows(), K.cols());
    for (Eigen::Index r = 0; r < K.rows(); ++r) {
      other.row(r) = mirror.reading_sign[r] * K.row(mirror.reading[static_cast<std::size_t>(r)]);
    }
    return Eigen::MatrixXd(other * mirror.load_sign.asDiagonal());
  };
  for (int kind = 0; kind < kinds_; ++kind) {
    std::vector<Eigen::MatrixXd> offsets(static_cast<std::size_t>(readings_ * loads_),
                                         Eigen::MatrixXd(2 * rows - 1, 2 * columns - 1));
    const auto set = [&](Eigen::Index x, Eigen::Index y, const Eigen::MatrixXd& K) {
      const Eigen::Index row = rows - 1 + (lattice_.is_turned ? y : x);
      const Eigen::Index column = columns - 1 + (lattice_.is_turned ? x : y);
      for (Eigen::Index r = 0; r < readings_; ++r) {
        for (Eigen::Index l = 0; l < loads_; ++l) {
          offsets[static_cast<std::size_t>(r * loads_ + l)](row, column) = K(r, l);
        }
      }
    };
    for (Eigen::Index x = 0; x < nx; ++x) {
      for (Eigen::Index y = 0; y < ny; ++y) {
        const Eigen::MatrixXd K = kernel(kind, static_cast<double>(x) * lattice_.step_x_m,
                                         static_cast<double>(y) * lattice_.step_y_m);
        set(x, y, K);
        if (x > 0) set(-x, y, mirrored(K, mirrors[0]));
        if (y > 0) set(x, -y, mirrored(K, mirrors[1]));
        if (x > 0 && y > 0) set(-x, -y, mirrored(mirrored(K, mirrors[0]), mirrors[1]));
      }
    }
    for (const Eigen::MatrixXd& one : offsets) {
      grids_.push_back(GridConvolution::of_all_offsets(one));
    }
  }
}

void OffsetSums::set_pairs(const Kernel& kernel) {
  const auto count = static_cast<Eigen::Index>(points_.size());
  pairs_.assign(static_cast<std::size_t>(readings_ * loads_), Eigen::MatrixXd(count, count));
  for (Eigen::Index j = 0; j < count; ++j) {
    const SourcePoint& from = points_[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < count; ++i) {
      const SourcePoint& to = points_[static_cast<std::size_t>(i)];
      const Eigen::MatrixXd K = kernel(from.kind, to.x_m - from.x_m, to.y_m - from.y_m);
      for (Eigen::Index r = 0; r < readings_; ++r) {
        for (Eigen::Index l = 0; l < loads_; ++l) {
          pairs_[static_cast<std::size_t>(r * loads_ + l)](i, j) = K(r, l);
        }
      }
    }
  }
}

Eigen::MatrixXd OffsetSums::apply_grids(const Eigen::MatrixXd& loads) const {
  const Eigen::Index rows = lattice_.is_turned ? lattice_.ny : lattice_.nx;
  const Eigen::Index columns = lattice_.is_turned ? lattice_.nx : lattice_.ny;
  std::vector<Eigen::MatrixXcd> sums(static_cast<std::size_t>(readings_));
  for (int kind = 0; kind < kinds_; ++kind) {
    for (Eigen::Index l = 0; l < loads_; ++l) {
      Eigen::MatrixXd on_grid = Eigen::MatrixXd::Zero(rows, columns);
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (points_[i].kind != kind) continue;
        on_grid(lattice_.row[i], lattice_.column[i]) += loads(static_cast<Eigen::Index>(i), l);
      }
      if (on_grid.isZero(0.0)) continue;
      const auto first = static_cast<std::size_t>(kind * readings_ * loads_ + l);
      const Eigen::MatrixXcd waves = grids_[first].waves_of(on_grid);
      for (Eigen::Index r = 0; r < readings_; ++r) {
        const auto at = static_cast<std::size_t>(r);
        grids_[first + static_cast<std::size_t>(r * loads_)].add_product(waves, sums[at]);
      }
    }
  }
  const auto count = static_cast<Eigen::Index>(points_.size());
  Eigen::MatrixXd readings = Eigen::MatrixXd::Zero(count, readings_);
  for (Eigen::Index r = 0; r < readings_; ++r) {
    if (sums[static_cast<std::size_t>(r)].size() == 0) continue;
    const Eigen::MatrixXd values = grids_.front().values_of(sums[static_cast<std::size_t>(r)]);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      readings(static_cast<Eigen::Index>(i), r) = values(lattice_.row[i], lattice_.column[i]);
    }
  }
  return readings;
}

Eigen::MatrixXd OffsetSums::apply(const Eigen::MatrixXd& loads) const {
  if (lattice_.nx > 0) return apply_grids(loads);
  Eigen::MatrixXd readings = Eigen::MatrixXd::Zero(loads.rows(), readings_);
  for (Eigen::Index j = 0; j < loads.rows(); ++j) {
    for (Eigen::Index r = 0; r < readings_; ++r) {
      for (Eigen::Index l = 0; l < loads_; ++l) {
        if (loads(j, l) == 0.0) continue;
        readings.col(r) += pairs_[static_cast<std::size_t>(r * loads_ + l)].col(j) * loads(j, l);
      }
    }
  }
  return readings;
}

}  // namespace viscard
