#include "io/flow/live_history.h"

namespace viscard {

void LiveHistory::add(double time_s, double force_N, double depth_m) {
  if (n_seen_++ % keep_every_ != 0) return;
  time_s_.push_back(time_s);
  force_N_.push_back(force_N);
  depth_m_.push_back(depth_m);
  if (time_s_.size() < most_) return;
  for (std::vector<double>* values : {&time_s_, &force_N_, &depth_m_}) {
    for (std::size_t i = 0; i < most_ / 2; ++i) (*values)[i] = (*values)[2 * i];
    values->resize(most_ / 2);
  }
  keep_every_ *= 2;
}

LivePoints LiveHistory::since(std::size_t from, std::size_t keep_every) const {
  LivePoints points;
  points.keep_every = keep_every_;
  points.from = keep_every == keep_every_ && from <= time_s_.size() ? from : 0;
  const auto tail = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(points.from),
                               values.end());
  };
  points.time_s = tail(time_s_);
  points.force_N = tail(force_N_);
  points.depth_m = tail(depth_m_);
  return points;
}

}  // namespace viscard
