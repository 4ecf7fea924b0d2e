#include "models/array/quadrants/sensed_array.h"

#include "models/maths/near_sums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace viscard {
namespace {

constexpr std::size_t kMostOfPatch = 49;

// Load of each pillar as found from its own voltages.
Eigen::MatrixXd loads_alone_Pa(const std::vector<SourcePoint>& pillars,
                               const std::vector<QuadrantGains>& gains,
                               const Eigen::MatrixXd& quarters_V) {
  Eigen::MatrixXd loads_Pa(quarters_V.rows(), kSensedLoads);
  for (Eigen::Index i = 0; i < quarters_V.rows(); ++i) {
    const auto of_class = static_cast<std::size_t>(pillars[static_cast<std::size_t>(i)].kind);
    loads_Pa.row(i) = (gains[of_class] * quarters_V.row(i).transpose()).transpose();
  }
  return loads_Pa;
}

// The pillar nearest to the middle first, then its neighbours.
std::vector<SourcePoint> middle_patch(const QuadrantArray& array) {
  std::vector<SourcePoint> points = array.pillars;
  double x_m = 0.0, y_m = 0.0;
  for (const SourcePoint& one : points) {
    x_m += one.x_m / static_cast<double>(points.size());
    y_m += one.y_m / static_cast<double>(points.size());
  }
  const auto nearer_to = [](double at_x_m, double at_y_m) {
    return [=](const SourcePoint& a, const SourcePoint& b) {
      return std::hypot(a.x_m - at_x_m, a.y_m - at_y_m) <
             std::hypot(b.x_m - at_x_m, b.y_m - at_y_m);
    };
  };
  const SourcePoint first = *std::min_element(points.begin(), points.end(), nearer_to(x_m, y_m));
  const auto end =
      points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), kMostOfPatch));
  std::partial_sort(points.begin(), end, points.end(), nearer_to(first.x_m, first.y_m));
  points.erase(end, points.end());
  std::erase_if(points, [&](const SourcePoint& one) {
    return std::hypot(one.x_m - first.x_m, one.y_m - first.y_m) > 2.0 * array.reach_m;
  });
  if (!array.by_neighbours) points.resize(1);
  return points;
}

}  // namespace

std::vector<QuadrantGains> gains_by_class(const QuadrantArray& array) {
  std::vector<QuadrantGains> gains;
  for (int c = 0; c < array.classes; ++c)
    gains.push_back(quadrant_gains(array.kernel(c, 0.0, 0.0)));
  return gains;
}

SensedArray sensed_array(const QuadrantArray& array, const std::vector<QuadrantGains>& gains,
                         const Eigen::MatrixXd& quarters_V) {
  SensedArray sensed;
  sensed.alone_Pa = loads_alone_Pa(array.pillars, gains, quarters_V);
  sensed.loads_Pa = sensed.alone_Pa;
  if (array.by_neighbours && array.pillars.size() > 1) {
    const SeemingLoads seeming = [&](const Eigen::MatrixXd& loads_Pa) {
      return loads_alone_Pa(array.pillars, gains, array.voltages_V(loads_Pa));
    };
    sensed.loads_Pa = decouple(seeming, sensed.alone_Pa).loads_Pa;
  }
  sensed.left_V = quarters_V - array.voltages_V(sensed.loads_Pa);
  return sensed;
}

NoiseGrowth growth_in_middle(const QuadrantArray& array, const std::vector<QuadrantGains>& gains) {
  const std::vector<SourcePoint> points = middle_patch(array);
  const auto count = static_cast<Eigen::Index>(points.size());
  const NearSums sums(points, std::vector<bool>(points.size(), true), 5.0 * array.reach_m,
                      array.kernel);
  Eigen::MatrixXd seeming(kSensedLoads * count, kSensedLoads * count);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (int load = 0; load < kSensedLoads; ++load) {
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(count, kSensedLoads);
      unit(j, load) = 1.0;
      const Eigen::MatrixXd seen = loads_alone_Pa(points, gains, sums.apply(unit));
      for (Eigen::Index i = 0; i < count; ++i) {
        seeming.block<kSensedLoads, 1>(kSensedLoads * i, kSensedLoads * j + load) =
            seen.row(i).transpose();
      }
    }
  }
  return noise_growth(seeming, gains[static_cast<std::size_t>(points.front().kind)], 0);
}

}  // namespace viscard
