#include "models/array/inverse/read_array.h"

#include "models/maths/neighbours.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kSameOffset = 1e-6;  // of the pitch

double reach_of(const ReadArray& array) {
  require(!array.pillars.empty(), "an array that is read has pillars");
  require(array.reach_m > 0.0, "the reach of a reading must be positive");
  return array.reach_m;
}

}  // namespace

double usual_pitch_m(const ReadArray& array) {
  const std::vector<SourcePoint>& pillars = array.pillars;
  const double from_m = nearest_distance_m(pillars, 0.5 * reach_of(array));
  if (std::isinf(from_m)) return array.reach_m;
  const Neighbours near(pillars, 4.0 * from_m);
  std::vector<double> nearest_m(pillars.size(), 4.0 * from_m);
  for (std::size_t i = 0; i < pillars.size(); ++i) {
    near.visit(pillars[i].x_m, pillars[i].y_m, [&](std::size_t j) {
      const double away_m =
          std::hypot(pillars[j].x_m - pillars[i].x_m, pillars[j].y_m - pillars[i].y_m);
      if (j != i) nearest_m[i] = std::min(nearest_m[i], away_m);
    });
  }
  const auto middle = nearest_m.begin() + static_cast<std::ptrdiff_t>(nearest_m.size() / 2);
  std::nth_element(nearest_m.begin(), middle, nearest_m.end());
  return *middle;
}

WholeOffset whole_offset(const ReadArray& array, std::size_t from, std::size_t to, double pitch_m) {
  const SourcePoint &a = array.pillars[from], &b = array.pillars[to];
  const double unit_m = kSameOffset * pitch_m;
  return {static_cast<std::int32_t>(std::lround((b.x_m - a.x_m) / unit_m)),
          static_cast<std::int32_t>(std::lround((b.y_m - a.y_m) / unit_m))};
}

OffsetKernels::OffsetKernels(const ReadArray& array)
    : array_(&array),
      pitch_m_(usual_pitch_m(array)),
      of_class_(static_cast<std::size_t>(array.classes)) {
  const Eigen::MatrixXd own = array.kernel(array.pillars.front().kind, 0.0, 0.0);
  require(own.rows() == array.readings && own.cols() >= array.loads,
          "a kernel has a row for each reading and a column for each load");
  scale_V2_Pa2_ = own.leftCols(array.loads).squaredNorm() / static_cast<double>(array.loads);
  require(scale_V2_Pa2_ > 0.0, "the electrodes read nothing of the loads on their pillars");
}

const Eigen::MatrixXd* OffsetKernels::between(std::size_t from, std::size_t to) {
  const SourcePoint &a = array_->pillars[from], &b = array_->pillars[to];
  const double x_m = b.x_m - a.x_m, y_m = b.y_m - a.y_m;
  if (x_m * x_m + y_m * y_m > array_->reach_m * array_->reach_m) return nullptr;
  auto& known = of_class_[static_cast<std::size_t>(a.kind)];
  const std::uint64_t key = whole_offset(*array_, from, to, pitch_m_).key();
  const auto found = known.find(key);
  if (found != known.end()) return &found->second;
  return &known.emplace(key, array_->kernel(a.kind, x_m, y_m)).first->second;
}

}  // namespace viscard
