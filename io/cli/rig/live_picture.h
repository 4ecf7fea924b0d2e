#pragma once

#include "rig/run/run_control.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// Force against time as it comes in, thinned so that it never holds more than kMost points however
// long the run.
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

// The values as one of eight blocks each, the lowest to the highest of them; more values than width
// are reduced to the largest within each share.
std::string sparkline(const std::vector<double>& values, std::size_t width);

// "hold     0.843 N  34 % of the cell  128.3 um  [sparkline]  1:23 left", cut to fit the columns.
std::string line_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           std::size_t columns);

// "1:23" or "2:01:07".
std::string clock_from_s(double seconds);

// A page of its own that reloads itself every second while the run goes on.
std::string page_from_live(const RunProgress& now, const LiveHistory& history, double capacity_N,
                           double limit_N, const std::string& title, bool is_over);

}  // namespace viscard
