#pragma once

#include <cstddef>
#include <vector>

namespace viscard {

// Points of the live curves.
struct LivePoints {
  std::size_t keep_every = 1;
  std::size_t from = 0;  // number of the first one in the history
  std::vector<double> time_s, force_N, depth_m;
};

// Force and depth against time during a run, thinned out to a fixed number of points however long
// the run is.
class LiveHistory {
 public:
  static constexpr std::size_t kMost = 2000;

  LiveHistory() = default;
  explicit LiveHistory(std::size_t most) : most_(most) {}

  void add(double time_s, double force_N, double depth_m = 0.0);
  const std::vector<double>& time_s() const { return time_s_; }
  const std::vector<double>& force_N() const { return force_N_; }
  const std::vector<double>& depth_m() const { return depth_m_; }
  // Only every n-th value is kept. While n stays the same, points are only appended.
  std::size_t keep_every() const { return keep_every_; }
  // The points from number `from` on for a reader who has the others with this keep_every; all of
  // them if they were thinned out since.
  LivePoints since(std::size_t from, std::size_t keep_every) const;

 private:
  std::size_t most_ = kMost;
  std::vector<double> time_s_, force_N_, depth_m_;
  std::size_t keep_every_ = 1;
  std::size_t n_seen_ = 0;
};

}  // namespace viscard
