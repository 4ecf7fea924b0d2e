#pragma once

#include "rig/run/run_control.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// Force against time during a run, thinned out to at most kMost points however long the run is.
class LiveHistory {
 public:
  static constexpr std::size_t kMost = 2000;

  void add(double time_s, double force_N);
  const std::vector<double>& time_s() const { return time_s_; }
  const std::vector<double>& force_N() const { return force_N_; }

 private:
  std::vector<double> time_s_, force_N_;
  std::size_t keep_every_ = 1;
  std::size_t n_seen_ = 0;
};

// Draws each value as one of eight blocks, scaled from the smallest to the largest value. If there
// are more values than width, each block shows the largest value of its share.
std::string sparkline(const std::vector<double>& values, std::size_t width);

// "hold     0.843 N  34 % of the cell  128.3 um  [sparkline]  1:23 left", shortened to fit columns.
std::string line_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           std::size_t columns);

// "1:23" or "2:01:07".
std::string clock_from_s(double seconds);

// An HTML page that reloads itself every second until the run is over.
std::string page_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           double limit_N, const std::string& title, bool is_over);

}  // namespace viscard
