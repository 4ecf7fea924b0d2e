#include "fit/samples/rounded_times.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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

// The distances between rows in steps; empty if a row is not on the grid or time goes back.
std::vector<double> steps_between(std::span<const double> time_s, double step_s) {
  constexpr double kOff = 1e-3;  // of a step, as decimal digits leave
  std::vector<double> steps;
  double last = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double place = (time_s[i] - time_s[0]) / step_s;
    const double at = std::round(place);
    if (!(std::abs(place - at) < kOff) || at < last) return {};
    steps.push_back(at - last);
    last = at;
  }
  return steps;
}

// True for distances as rounding makes them from nearly even ones, or for shared times.
bool are_rounded(const std::vector<double>& steps, std::size_t n_missing) {
  constexpr double kLeastShare = 0.05, kMostShare = 0.95, kLongest = 4.0;
  constexpr std::size_t kFewest = 6;
  std::size_t n_zero = 0, n_short = 0, n_changes = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    n_zero += steps[i] == 0.0 ? 1 : 0;
    n_short += steps[i] <= kLongest ? 1 : 0;
    n_changes += i > 0 && steps[i] != steps[i - 1] ? 1 : 0;
  }
  const auto least =
      std::max(kFewest, static_cast<std::size_t>(kLeastShare * static_cast<double>(steps.size())));
  if (n_zero >= least) return true;
  // One missing row makes two changes.
  const bool is_mixed = n_changes >= 2 * (least + n_missing);
  return is_mixed && static_cast<double>(n_short) > kMostShare * static_cast<double>(steps.size());
}

// The shortest distance of two rows with different times; 0 if all distances at the begin are equal.
double shortest_if_uneven(std::span<const double> time_s) {
  constexpr std::size_t kLook = 2000;
  constexpr double kEqual = 1e-6;
  double least_s = 0.0, most_s = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step_s = time_s[i] - time_s[i - 1];
    most_s = std::max(most_s, step_s);
    if (step_s > 0.0 && (least_s == 0.0 || step_s < least_s)) least_s = step_s;
    const bool has_shared = time_s[1] == time_s[0] || step_s == 0.0;
    if (i == kLook && !has_shared && most_s - least_s < kEqual * most_s) return 0.0;
  }
  return least_s;
}

}  // namespace

std::optional<double> rounding_step_s(std::span<const double> time_s, std::size_t n_missing) {
  constexpr std::size_t kFewestRows = 20;
  if (time_s.size() < kFewestRows) return std::nullopt;
  const double least_s = shortest_if_uneven(time_s);
  if (!(least_s > 0.0)) return std::nullopt;
  for (const double part : {1.0, 2.0, 3.0}) {
    const std::vector<double> steps = steps_between(time_s, least_s / part);
    if (steps.empty()) continue;
    return are_rounded(steps, n_missing) ? std::optional(least_s / part) : std::nullopt;
  }
  return std::nullopt;
}

namespace {

// Evenly spread times at_s of rounded or cut times. Those of a record that begins at the load or after it do so
// again. True times differ from the rounded ones by half a step at most, and are up to one step after those that
// were cut off; that all rows keep this bounds how far they can be moved together.
TimeRounding spread_times(std::span<const double> time_s, std::vector<double> at_s, double step_s) {
  const double early_s = time_s[0] >= 0.0 ? std::min(0.0, at_s[0]) : 0.0;
  double least_s = time_s[0] - at_s[0] + early_s, most_s = least_s;
  for (std::size_t i = 0; i < at_s.size(); ++i) {
    at_s[i] -= early_s;
    least_s = std::min(least_s, time_s[i] - at_s[i]);
    most_s = std::max(most_s, time_s[i] - at_s[i]);
  }
  const double earliest_s = most_s - 0.5 * step_s, latest_s = least_s + step_s;
  constexpr double kTilt = 0.05;  // of the step: the line through saw teeth is a little inclined
  const double unsure_s = std::max(std::abs(earliest_s), std::abs(latest_s)) + kTilt * step_s;
  return {step_s, unsure_s, std::move(at_s)};
}

// A straight line through the times, if all are within one step of each other about it.
std::optional<std::vector<double>> straight_line(std::span<const double> time_s, double step_s) {
  const auto n = static_cast<double>(time_s.size());
  double mean_s = 0.0, product = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) mean_s += (time_s[i] - time_s[0]) / n;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    product += (static_cast<double>(i) - 0.5 * (n - 1.0)) * (time_s[i] - time_s[0] - mean_s);
  }
  const double between_s = product / (n * (n * n - 1.0) / 12.0);
  std::vector<double> even_s;
  double least_s = 0.0, most_s = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double at_s = time_s[0] + mean_s + between_s * (static_cast<double>(i) - 0.5 * (n - 1.0));
    even_s.push_back(at_s);
    least_s = std::min(least_s, time_s[i] - at_s);
    most_s = std::max(most_s, time_s[i] - at_s);
  }
  constexpr double kWithin = 1.05;
  if (!(between_s > 0.0) || most_s - least_s > kWithin * step_s) return std::nullopt;
  return even_s;
}

// Rows that share each time, spread about it. The whole runs, without the first and the last, determine the
// distance between rows.
std::optional<TimeRounding> shared_times(std::span<const double> time_s) {
  constexpr std::size_t kFewestRuns = 6;
  const std::vector<std::size_t> begins = runs_of(time_s);
  if (begins.size() < kFewestRuns || !are_even(time_s, begins)) return std::nullopt;
  const double step_s = time_s[begins[1]] - time_s[0];
  const std::size_t n_whole = begins.size() - 3;
  const auto n_rows = static_cast<double>(begins[n_whole + 1] - begins[1]);
  const double between_s = step_s * static_cast<double>(n_whole) / n_rows;
  const double middle_s = 0.5 * (time_s[begins[1]] + time_s[begins[n_whole]]);
  const double middle = static_cast<double>(begins[1]) + 0.5 * (n_rows - 1.0);
  std::vector<double> at_s;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    at_s.push_back(middle_s + between_s * (static_cast<double>(i) - middle));
  }
  return spread_times(time_s, std::move(at_s), step_s);
}

// The step of even times in which rows are missing at equal distances, one at a time.
std::optional<double> step_of_regular_gaps(std::span<const double> time_s, std::size_t n_missing) {
  constexpr std::size_t kFewestGaps = 8;  // as regular by chance once in four hundred records
  const double step_s = shortest_if_uneven(time_s);
  if (!(step_s > 0.0)) return std::nullopt;
  const std::vector<double> steps = steps_between(time_s, step_s);
  if (steps.empty()) return std::nullopt;
  std::size_t n_gaps = 0;
  for (const double step : steps) {
    if (step < 1.0 || step > 2.0) return std::nullopt;
    n_gaps += step > 1.0 ? 1 : 0;
  }
  if (n_gaps < kFewestGaps + n_missing || !straight_line(time_s, step_s)) return std::nullopt;
  return step_s;
}

}  // namespace

std::optional<TimeRounding> time_rounding(std::span<const double> time_s, std::size_t n_missing) {
  constexpr std::size_t kFewestRows = 12;
  if (time_s.size() < kFewestRows) return std::nullopt;
  if (time_s[0] == time_s[1] || time_s[1] == time_s[2]) {
    if (auto shared = shared_times(time_s)) return shared;
  }
  if (const std::optional<double> step_s = rounding_step_s(time_s, n_missing)) {
    if (auto even_s = straight_line(time_s, *step_s)) {
      return spread_times(time_s, std::move(*even_s), *step_s);
    }
    return TimeRounding{*step_s, 0.5 * *step_s, {}};
  }
  const std::optional<double> gaps_s = step_of_regular_gaps(time_s, n_missing);
  return gaps_s ? std::optional(TimeRounding{*gaps_s, *gaps_s, {}}) : std::nullopt;
}

}  // namespace viscard
