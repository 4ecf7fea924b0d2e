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

}  // namespace viscard
