#include "models/maths/near_sums.h"

#include "models/maths/neighbours.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

namespace viscard {
namespace {

constexpr double kSameOffset = 1e-8;  // of the reach

}  // namespace

NearSums::NearSums(const std::vector<SourcePoint>& points, const std::vector<bool>& acts,
                   double reach_m, const OffsetSums::Kernel& kernel) {
  using Key = std::tuple<int, long, long>;
  std::map<Key, std::uint32_t> known;
  const Neighbours near(points, reach_m);
  const double unit_m = kSameOffset * reach_m;
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (!acts[j]) continue;
    const SourcePoint& from = points[j];
    near.visit(from.x_m, from.y_m, [&](std::size_t i) {
      const double x_m = points[i].x_m - from.x_m, y_m = points[i].y_m - from.y_m;
      const Key key{from.kind, std::lround(x_m / unit_m), std::lround(y_m / unit_m)};
      const auto [found, is_new] = known.emplace(key, static_cast<std::uint32_t>(kernels_.size()));
      if (is_new) kernels_.push_back(kernel(from.kind, x_m, y_m));
      pairs_.push_back(
          {static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(i), found->second});
    });
  }
  readings_ = (kernels_.empty() ? kernel(points.front().kind, 0.0, 0.0) : kernels_.front()).rows();
}

Eigen::MatrixXd NearSums::apply(const Eigen::MatrixXd& loads) const {
  // Readings of a point side by side.
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(readings_, loads.rows());
  const Eigen::MatrixXd of_point = loads.transpose();
  for (const Pair& pair : pairs_) {
    const Eigen::MatrixXd& K = kernels_[pair.kernel];
    for (Eigen::Index l = 0; l < K.cols(); ++l) {
      const double load = of_point(l, static_cast<Eigen::Index>(pair.from));
      if (load == 0.0) continue;
      const auto to = static_cast<Eigen::Index>(pair.to);
      for (Eigen::Index r = 0; r < readings_; ++r) sums(r, to) += K(r, l) * load;
    }
  }
  return sums.transpose();
}

}  // namespace viscard
