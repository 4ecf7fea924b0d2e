#include "fit/samples/end_rows.h"

#include "fit/samples/median.h"
#include "fit/samples/noise_model.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kFewestForEnds = 10, kRowsBeside = 4;
constexpr double kEndDeviations = 8.0, kLeastShareAtEnd = 0.02;

double sign_of(StepRecord record) {
  return record == StepRecord::kRelaxation ? 1.0 : -1.0;
}

// The rows of one end, from the end inwards, as those of a decreasing convex curve (at the last row
// the time is counted backwards, and the curve increases).
struct EndOfRecord {
  std::vector<double> time_s, value;

  EndOfRecord(std::span<const double> times, std::span<const double> values, StepRecord record,
              bool is_last) {
    constexpr std::size_t kMost = 32;
    const std::size_t n = values.size();
    const double sign = sign_of(record);
    for (std::size_t k = 0; k < std::min(n, kMost); ++k) {
      const std::size_t i = is_last ? n - 1 - k : k;
      time_s.push_back(std::abs(times[i] - times[is_last ? n - 1 : 0]));
      value.push_back(sign * values[i]);
    }
  }
};

// Standard deviation of the noise at a row of about this value, from the rows beside the one in
// doubt and its neighbour: absolute, or in proportion to the value if that gives more (a melt loses
// most of its modulus within these rows, and its noise with it).
double noise_at(const EndOfRecord& end, double value) {
  const std::vector<double> rest(end.value.begin() + 2, end.value.end());
  std::vector<double> relative;
  for (std::size_t i = 3; i < rest.size(); ++i) {
    const double third = rest[i] - 3.0 * rest[i - 1] + 3.0 * rest[i - 2] - rest[i - 3];
    const double sum = std::abs(rest[i] + rest[i - 1] + rest[i - 2] + rest[i - 3]);
    relative.push_back(sum > 0.0 ? 4.0 * std::abs(third) / sum : 0.0);
  }
  const double of_value =
      std::abs(value) * median(std::move(relative)) / (kMedianOfNormal * std::sqrt(20.0));
  return std::max(sigma_from_differences(rest), of_value);
}

// Four rows beside row `at`: their mean, and their straight line at that row.
struct Neighbours {
  double mean = 0.0, line = 0.0, highest = 0.0;
  double change = 0.0;  // of the line, from the first of the four rows to row `at`
  double mean_margin = 0.0, line_margin = 0.0;

  Neighbours(const EndOfRecord& end, std::size_t at, double least) {
    const auto count = static_cast<double>(kRowsBeside);
    const double* time_s = end.time_s.data() + at + 1;
    const double* value = end.value.data() + at + 1;
    double mean_s = 0.0, square = 0.0, product = 0.0;
    for (std::size_t k = 0; k < kRowsBeside; ++k) {
      mean += value[k] / count;
      mean_s += time_s[k] / count;
    }
    for (std::size_t k = 0; k < kRowsBeside; ++k) {
      square += (time_s[k] - mean_s) * (time_s[k] - mean_s);
      product += (time_s[k] - mean_s) * (value[k] - mean);
    }
    const double slope = square > 0.0 ? product / square : 0.0;
    const double away_s = end.time_s[at] - mean_s;
    line = mean + slope * away_s;
    change = slope * (end.time_s[at] - time_s[0]);
    highest = *std::max_element(value, value + kRowsBeside);
    const double sigma = noise_at(end, mean);
    const double leverage = square > 0.0 ? away_s * away_s / square : 0.0;
    // The neighbour of the row in doubt counts as wrong earlier, and then neither is dropped.
    const double share = at == 0 ? 1.0 : 0.5;
    const auto margin = [&](double variance) {
      return share * std::max(kEndDeviations * std::sqrt(variance) * sigma, least);
    };
    mean_margin = margin(1.0 + 1.0 / count);
    line_margin = margin(1.0 + 1.0 / count + leverage);
  }

  bool is_below_line(double value) const { return value < line - line_margin; }
  bool is_below_mean(double value) const { return value < mean - mean_margin; }
};

bool is_first_wrong(const EndOfRecord& end, std::size_t at, bool is_creep) {
  const double value = end.value[at];
  double size = 0.0;
  for (std::size_t k = 1; k <= kRowsBeside; ++k) size = std::max(size, std::abs(end.value[at + k]));
  const Neighbours next(end, at, kLeastShareAtEnd * size);
  if (next.is_below_line(value) || next.is_below_mean(value)) return true;
  // Zero compliance, from which the next rows do not come (their line would lead there).
  constexpr double kTimesChange = 2.0;
  const double gap = value - next.line;
  return is_creep && at == 0 && (value == 0.0 || value > next.mean_margin) &&
         gap > next.line_margin && gap > kTimesChange * std::abs(next.change);
}

bool is_last_wrong(const EndOfRecord& end, std::size_t at, double largest) {
  const double value = end.value[at];
  const Neighbours next(end, at, kLeastShareAtEnd * largest);
  // Convex, and not above the rows before it.
  return next.is_below_line(value) || value > next.highest + next.mean_margin;
}

EndRow judged(const EndOfRecord& end, bool is_wrong, double time_s, StepRecord record) {
  const double sign = sign_of(record);
  return {is_wrong, time_s, sign * end.value[0], sign * Neighbours(end, 0, 0.0).line};
}

}  // namespace

EndRow first_row(std::span<const double> time_s, std::span<const double> value, StepRecord record) {
  if (value.size() < kFewestForEnds) return {};
  const bool is_creep = record == StepRecord::kCreep;
  const EndOfRecord end(time_s, value, record, /*is_last=*/false);
  const bool is_wrong = is_first_wrong(end, 0, is_creep) && !is_first_wrong(end, 1, is_creep);
  return judged(end, is_wrong, time_s.front(), record);
}

EndRow last_row(std::span<const double> time_s, std::span<const double> value, StepRecord record) {
  if (value.size() < kFewestForEnds) return {};
  const EndOfRecord end(time_s, value, record, /*is_last=*/true);
  // A larger value widens the margin, so a row that these few do not doubt is right.
  const auto largest_of = [](std::span<const double> values) {
    double largest = 0.0;
    for (const double one : values) largest = std::max(largest, std::abs(one));
    return largest;
  };
  bool is_wrong = is_last_wrong(end, 0, largest_of(end.value));
  if (is_wrong) {
    const double largest = largest_of(value);
    is_wrong = is_last_wrong(end, 0, largest) && !is_last_wrong(end, 1, largest);
  }
  return judged(end, is_wrong, time_s.back(), record);
}

EndRows drop_end_rows(CleanViews& clean, StepRecord record) {
  const std::size_t n = clean.column(0).size();
  const EndRows ends{first_row(clean.column(0), clean.column(1), record),
                     last_row(clean.column(0), clean.column(1), record)};
  std::vector<std::size_t> rows;
  if (ends.first.is_wrong) rows.push_back(0);
  if (ends.last.is_wrong) rows.push_back(n - 1);
  clean.drop(rows);
  return ends;
}

}  // namespace viscard
