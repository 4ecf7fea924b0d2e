#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace viscard {

// Finds which of many points in the plane lie within a distance of a place, in time independent of their
// number: the points are sorted into square cells as wide as the distance.
class Neighbours {
 public:
  // Points with members x_m and y_m; they must outlive this.
  template <typename Point>
  Neighbours(const std::vector<Point>& points, double distance_m) : distance_m_(distance_m) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      cells_[key(cell(points[i].x_m), cell(points[i].y_m))].push_back(
          {points[i].x_m, points[i].y_m, i});
    }
  }

  // Calls found(index) for each point within the distance, itself included.
  template <typename Found>
  void visit(double x_m, double y_m, const Found& found) const {
    for (std::int64_t row = cell(y_m) - 1; row <= cell(y_m) + 1; ++row) {
      for (std::int64_t column = cell(x_m) - 1; column <= cell(x_m) + 1; ++column) {
        const auto here = cells_.find(key(column, row));
        if (here == cells_.end()) continue;
        for (const Entry& entry : here->second) {
          const double dx_m = entry.x_m - x_m, dy_m = entry.y_m - y_m;
          if (dx_m * dx_m + dy_m * dy_m <= distance_m_ * distance_m_) found(entry.index);
        }
      }
    }
  }

 private:
  struct Entry {
    double x_m, y_m;
    std::size_t index;
  };
  std::int64_t cell(double at_m) const {
    return static_cast<std::int64_t>(std::floor(at_m / distance_m_));
  }
  static std::uint64_t key(std::int64_t column, std::int64_t row) {
    return (static_cast<std::uint64_t>(column) << 32U) ^
           (static_cast<std::uint64_t>(row) & 0xffffffffULL);
  }

  double distance_m_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

// Smallest distance between two of the points, which are searched from this distance on; infinite for a single one.
template <typename Point>
double nearest_distance_m(const std::vector<Point>& points, double from_m) {
  double nearest_m = HUGE_VAL;
  for (double within_m = from_m; points.size() > 1 && std::isinf(nearest_m); within_m *= 2.0) {
    const Neighbours near(points, within_m);
    for (std::size_t i = 0; i < points.size(); ++i) {
      near.visit(points[i].x_m, points[i].y_m, [&](std::size_t j) {
        if (j == i) return;
        nearest_m = std::min(
            nearest_m, std::hypot(points[j].x_m - points[i].x_m, points[j].y_m - points[i].y_m));
      });
    }
  }
  return nearest_m;
}

}  // namespace viscard
