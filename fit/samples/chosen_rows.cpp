#include "fit/samples/chosen_rows.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// A stretch of rows within a band about its first row.
struct Rest {
  std::size_t begin = 0, end = 0;
};

// Way of the input in steps of the band, so that noise does not count.
double way_of(std::span<const double> input, double band) {
  double way = 0.0, last = input.front();
  for (const double value : input) {
    if (std::abs(value - last) <= band) continue;
    way += std::abs(value - last);
    last = value;
  }
  return way;
}

constexpr double kBand = 0.02;  // of the range of the input

std::vector<Rest> rests_of(std::span<const double> time_s, std::span<const double> input,
                           double band) {
  constexpr double kSlow = 0.2;  // of the mean speed
  constexpr std::size_t kFewest = 10;
  const double least_s =
      band * (time_s.back() - time_s.front()) / (kSlow * std::max(band, way_of(input, band)));
  std::vector<Rest> rests;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= input.size(); ++i) {
    if (i < input.size() && std::abs(input[i] - input[begin]) <= band) continue;
    const bool is_long = time_s[i - 1] - time_s[begin] >= least_s && i - begin >= kFewest;
    // A hold that drifts is one hold.
    const bool continues = is_long && !rests.empty() && rests.back().end == begin;
    if (continues) {
      rests.back().end = i;
    } else if (is_long) {
      rests.push_back({begin, i});
    }
    begin = i;
  }
  return rests;
}

}  // namespace

std::vector<RowRange> holds_of(std::span<const double> time_s, std::span<const double> input) {
  constexpr double kLow = 0.1;
  std::vector<RowRange> holds;
  if (input.size() < 2) return holds;
  const auto [low, high] = std::minmax_element(input.begin(), input.end());
  const double range = *high - *low;
  if (!(range > 0.0)) return holds;
  std::size_t from = 0;
  for (const Rest& rest : rests_of(time_s, input, kBand * range)) {
    const bool is_low = input[rest.begin] - *low < kLow * range;
    // A rest out of contact belongs to the next hold, as its baseline.
    if (!is_low) holds.push_back({from, rest.end});
    from = is_low ? rest.begin : rest.end;
  }
  return holds;
}

double moving_s(std::span<const double> time_s, std::span<const double> input, std::size_t first,
                std::size_t last) {
  if (last <= first) return 0.0;
  double moving = time_s[last] - time_s[first];
  const auto [low, high] = std::minmax_element(input.begin(), input.end());
  if (!(*high > *low)) return moving;
  for (const Rest& rest : rests_of(time_s, input, kBand * (*high - *low))) {
    const std::size_t from = std::max(first, rest.begin), to = std::min(last, rest.end - 1);
    if (from < to) moving -= time_s[to] - time_s[from];
  }
  return std::max(0.0, moving);
}

RowRange up_to_longest_hold(std::span<const double> time_s, std::span<const double> input) {
  constexpr double kLonger = 1.05;
  RowRange part{0, input.size()};
  double longest_s = 0.0;
  std::size_t last = 0;
  for (const RowRange& hold : holds_of(time_s, input)) {
    const double duration_s = time_s[hold.end - 1] - time_s[std::max(hold.begin, last)];
    if (duration_s > kLonger * longest_s) {  // the first of several that are alike
      part.end = hold.end;
      longest_s = duration_s;
    }
    last = hold.end;
  }
  return part;
}

RowRange from_largest(std::span<const double> values) {
  const auto largest = std::max_element(values.begin(), values.end());
  return {static_cast<std::size_t>(largest - values.begin()), values.size()};
}

// The logarithm of a completely monotone relaxation is convex, so that from a tenth of its first
// value on it falls in a fifth of the time elapsed at most by 1 - 0.1^0.2 = 37 %.
std::size_t end_of_relaxation(std::span<const double> time_s, std::span<const double> values,
                              std::size_t peak) {
  constexpr double kLow = 0.1, kSpan = 0.2, kFall = 0.5;
  std::vector<double> largest_from(values.begin(), values.end());
  for (std::size_t i = values.size() - 1; i-- > peak;) {
    largest_from[i] = std::max(largest_from[i], largest_from[i + 1]);
  }
  std::size_t after = peak;
  for (std::size_t i = peak + 1; i + 1 < values.size(); ++i) {
    if (values[i] < kLow * values[peak]) continue;
    after = std::max(after, i + 1);
    while (after < values.size() && largest_from[after] >= kFall * values[i]) ++after;
    if (after == values.size()) return after;
    if (time_s[after] - time_s[i] > kSpan * (time_s[i] - time_s[peak])) continue;
    // The corner is the row farthest above the straight line between both.
    const double slope = (values[after] - values[i]) / (time_s[after] - time_s[i]);
    const auto above = [&](std::size_t k) { return values[k] - slope * time_s[k]; };
    std::size_t corner = i;
    for (std::size_t k = i; k < after; ++k) {
      if (above(k) > above(corner)) corner = k;
    }
    return corner + 1;
  }
  return values.size();
}

std::optional<std::size_t> begin_of_rise(std::span<const double> values, std::size_t peak) {
  constexpr double kRisen = 0.05;
  if (peak == 0 || !(values[peak] > 0.0)) return std::nullopt;
  const double least = std::min(
      0.0, *std::min_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(peak)));
  const double limit = least + kRisen * (values[peak] - least);
  for (std::size_t i = peak; i-- > 0;) {
    if (values[i] <= limit) return i;
  }
  return std::nullopt;
}

}  // namespace viscard
