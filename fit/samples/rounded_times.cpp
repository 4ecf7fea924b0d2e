#include "fit/samples/rounded_times.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace viscard {
namespace {

// First rows of the runs of equal times, and one past the last row.
std::vector<std::size_t> runs_of(std::span<const double> time_s) {
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] != time_s[i - 1]) begins.push_back(i);
  }
  begins.push_back(time_s.size());
  return begins;
}

bool are_even(std::span<const double> time_s, const std::vector<std::size_t>& begins) {
  constexpr double kRounding = 1e-6;  // of the step
  const double step_s = time_s[begins[1]] - time_s[begins[0]];
  std::size_t fewest = time_s.size(), most = 0;
  for (std::size_t run = 0; run + 2 < begins.size(); ++run) {
    const double next_s = time_s[begins[run + 1]] - time_s[begins[run]];
    if (!(std::abs(next_s - step_s) <= kRounding * std::abs(step_s))) return false;
    if (run == 0) continue;
    fewest = std::min(fewest, begins[run + 1] - begins[run]);
    most = std::max(most, begins[run + 1] - begins[run]);
  }
  const std::size_t first = begins[1], last = begins.back() - begins[begins.size() - 2];
  return step_s > 0.0 && fewest >= 2 && most <= fewest + 1 && std::max(first, last) <= most;
}

}  // namespace

std::optional<RoundedTimes> rounded_times(std::span<const double> time_s) {
  constexpr std::size_t kFewestRuns = 6;
  if (time_s.size() < 2 * kFewestRuns) return std::nullopt;
  const bool repeats = time_s[0] == time_s[1] || time_s[1] == time_s[2];
  if (!repeats) return std::nullopt;  // most records
  const std::vector<std::size_t> begins = runs_of(time_s);
  if (begins.size() < kFewestRuns || !are_even(time_s, begins)) return std::nullopt;
  RoundedTimes rounded{time_s[begins[1]] - time_s[0], {}};
  // The whole runs, without the first and the last, determine the distance between rows.
  const std::size_t n_whole = begins.size() - 3;
  const auto n_rows = static_cast<double>(begins[n_whole + 1] - begins[1]);
  const double between_s = rounded.step_s * static_cast<double>(n_whole) / n_rows;
  const double middle_s = 0.5 * (time_s[begins[1]] + time_s[begins[n_whole]]);
  const double middle = static_cast<double>(begins[1]) + 0.5 * (n_rows - 1.0);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    rounded.time_s.push_back(middle_s + between_s * (static_cast<double>(i) - middle));
  }
  return rounded;
}

}  // namespace viscard
