#include "models/pillar/time/transient_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// A time at which a step must end.
struct Stop {
  double time_s = 0.0;
  bool is_output = false;
};

std::vector<Stop> stops_of(const TransientRequest& r) {
  const double spacing_s = r.spacing_s();
  std::vector<Stop> stops;
  for (int i = 1; i <= r.outputs; ++i) stops.push_back({spacing_s * i, true});
  for (const CoursePoint& corner : r.history) {
    const double corner_s = corner.time_s;
    const double nearest_s = spacing_s * std::round(corner_s / spacing_s);
    const bool is_new = corner_s > 0.0 && corner_s < r.end_s;
    if (is_new && std::abs(corner_s - nearest_s) > 1e-9 * spacing_s) {
      stops.push_back({corner_s, false});
    }
  }
  std::sort(stops.begin(), stops.end(),
            [](const Stop& a, const Stop& b) { return a.time_s < b.time_s; });
  return stops;
}

}  // namespace

std::vector<TransientPiece> pieces_of(const TransientRequest& r) {
  const double spacing_s = r.spacing_s();
  std::vector<TransientPiece> pieces;
  double at_s = 0.0;
  for (const Stop& stop : stops_of(r)) {
    double length_s = stop.time_s - at_s;
    if (length_s <= 0.0) continue;  // a jump between outputs appears twice
    if (std::abs(length_s - spacing_s) <= 1e-9 * spacing_s) length_s = spacing_s;
    pieces.push_back({length_s, value_at(r.history, at_s * (1.0 + 1e-12)),
                      value_at(r.history, stop.time_s * (1.0 - 1e-12), false), stop.is_output});
    at_s = stop.time_s;
  }
  return pieces;
}

TransientMotion empty_motion(const std::vector<TransientPiece>& pieces, Eigen::Index observers) {
  TransientMotion motion;
  motion.time_s.push_back(0.0);
  for (const TransientPiece& piece : pieces) {
    motion.time_s.push_back(motion.time_s.back() + piece.length_s);
  }
  motion.values = Eigen::MatrixXd::Zero(observers, std::ssize(motion.time_s));
  motion.rates = motion.values;
  return motion;
}

TransientResult result_of(const TransientRequest& r, const std::vector<TransientPiece>& pieces,
                          TransientMotion motion) {
  TransientResult result;
  result.values = Eigen::MatrixXd::Zero(motion.values.rows(), r.outputs + 1);
  for (int i = 0; i <= r.outputs; ++i) result.time_s.push_back(r.spacing_s() * i);
  Eigen::Index output = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!pieces[i].ends_with_output) continue;
    motion.time_s[i + 1] = result.time_s[static_cast<std::size_t>(++output)];  // without rounding
    result.values.col(output) = motion.values.col(static_cast<Eigen::Index>(i + 1));
  }
  result.motion = std::move(motion);
  return result;
}

}  // namespace viscard
