#include "rig/run/rise_watch.h"

#include <algorithm>

namespace viscard {
namespace {

constexpr double kStretch = 0.1;            // of the way
constexpr double kFewestStepsOfRise = 4.0;  // of the motor
constexpr double kStopped = 0.1;            // of the rise before

}  // namespace

void RiseWatch::begin(double contact_m, double way_m, double step_m, double least_N) {
  contact_m_ = contact_m;
  stretch_m_ = way_m > 0.0 ? std::max(kStretch * way_m, kFewestStepsOfRise * step_m) : 0.0;
  least_N_ = least_N;
  points_.clear();
  suspicion_.reset();
}

const RiseWatch::Point* RiseWatch::last_until(double position_m) const {
  const auto behind = std::upper_bound(
      points_.begin(), points_.end(), position_m,
      [](double limit_m, const Point& point) { return limit_m < point.position_m; });
  return behind == points_.begin() ? nullptr : &*(behind - 1);
}

std::optional<RiseWatch::Stretch> RiseWatch::take(double position_m, double force_N) {
  if (!(stretch_m_ > 0.0) || position_m <= contact_m_) return std::nullopt;
  if (!points_.empty() && position_m <= points_.back().position_m) return std::nullopt;
  points_.push_back({position_m, force_N});
  const Point* from = last_until(position_m - stretch_m_);
  if (from == nullptr) return std::nullopt;
  const double now_N_m = (force_N - from->force_N) / (position_m - from->position_m);
  if (!suspicion_) {
    const Point* end = last_until(from->position_m - stretch_m_);
    const Point* start = end == nullptr ? nullptr : last_until(end->position_m - stretch_m_);
    if (start == nullptr || end->force_N - start->force_N < least_N_) return std::nullopt;
    const double usual_N_m =
        (end->force_N - start->force_N) / (end->position_m - start->position_m);
    if (now_N_m < kStopped * usual_N_m) suspicion_ = Suspicion{usual_N_m, *from, position_m};
    return std::nullopt;
  }
  const Point& stopped = suspicion_->from;
  const double since_N_m = (force_N - stopped.force_N) / (position_m - stopped.position_m);
  if (std::max(now_N_m, since_N_m) >= kStopped * suspicion_->usual_N_m) {
    suspicion_.reset();
    return std::nullopt;
  }
  if (position_m < suspicion_->noticed_m + stretch_m_) return std::nullopt;
  return Stretch{stopped.position_m, position_m, force_N - stopped.force_N};
}

}  // namespace viscard
