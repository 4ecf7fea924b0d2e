#include "fit/samples/clean_data.h"

#include "fit/samples/median.h"
#include "fit/samples/sample_passes.h"
#include "fit/samples/spikes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {

namespace {

bool all_columns_finite(const std::vector<std::span<const double>>& columns) {
  return std::all_of(columns.begin(), columns.end(), all_finite);
}

// Indices of the usable rows in order of time.
std::vector<std::size_t> usable_rows(const std::vector<std::span<const double>>& columns,
                                     const std::vector<std::size_t>& wrong) {
  std::vector<std::size_t> order;
  auto next = wrong.begin();
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
    if (next != wrong.end() && *next == i) {
      ++next;
      continue;
    }
    const bool is_finite = std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
      return std::isfinite(column[i]);
    });
    if (is_finite) order.push_back(i);
  }
  const std::span<const double> time = columns[0];
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return time[a] < time[b]; });
  return order;
}

void check_count(std::size_t usable, std::size_t rows, std::size_t least) {
  if (usable >= least) return;
  throw std::runtime_error("only " + std::to_string(usable) + " of " + std::to_string(rows) +
                           " rows have a number in every column needed; a fit needs at least " +
                           std::to_string(least));
}

}  // namespace

CleanViews::CleanViews(const std::vector<std::span<const double>>& columns, std::size_t least,
                       const std::vector<std::size_t>& wrong)
    : views_(columns) {
  const std::size_t rows = columns.at(0).size();
  for (const std::span<const double> column : columns) {
    if (column.size() != rows) {
      throw std::invalid_argument("columns of " + std::to_string(rows) + " and " +
                                  std::to_string(column.size()) +
                                  " values do not belong to one table");
    }
  }
  if (wrong.empty() && all_columns_finite(columns)) {
    steps_ = step_range(columns[0]);
    if (steps_.shortest >= 0.0) {
      check_count(rows, rows, least);
      return;
    }
  }
  origin_ = usable_rows(columns, wrong);
  const std::vector<std::size_t>& order = origin_;
  n_left_out_ = rows - wrong.size() - order.size();
  check_count(order.size(), rows, least);
  for (std::span<const double>& view : views_) {
    std::vector<double>& target = copies_.emplace_back();
    target.reserve(order.size());
    for (const std::size_t i : order) target.push_back(view[i]);
    view = target;  // the view stays valid when copies_ grows
  }
  steps_ = step_range(views_[0]);
}

void CleanViews::drop_first(std::size_t rows) {
  if (rows == 0) return;
  for (std::span<const double>& view : views_) view = view.subspan(rows);
  if (origin_.empty()) {
    n_first_ += rows;
  } else {
    origin_.erase(origin_.begin(), origin_.begin() + static_cast<std::ptrdiff_t>(rows));
  }
  steps_ = step_range(views_[0]);
}

void CleanViews::drop(const std::vector<std::size_t>& rows) {
  if (rows.empty()) return;
  std::vector<std::size_t> origin;
  auto next = rows.begin();
  for (std::size_t i = 0; i < views_[0].size(); ++i) {
    if (next != rows.end() && *next == i) {
      ++next;
    } else {
      origin.push_back(this->origin(i));
    }
  }
  origin_ = std::move(origin);
  std::vector<std::vector<double>> kept;
  for (const std::span<const double> view : views_) kept.push_back(without_rows(view, rows));
  copies_ = std::move(kept);
  for (std::size_t i = 0; i < views_.size(); ++i) views_[i] = copies_[i];
  steps_ = step_range(views_[0]);
}

void CleanViews::set_times(std::vector<double> time_s) {
  time_s_ = std::move(time_s);
  views_[0] = time_s_;
  steps_ = step_range(time_s_);
}

void check_sign(std::span<const double> values, const std::string& what,
                const std::string& column) {
  if (sum_of(values) > 0.0) return;
  if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; })) {
    throw std::runtime_error("every value of the fitted column is zero, but " + what +
                             " is positive. If it is the wrong column, name the right one: "
                             "--column " +
                             column + "=NAME");
  }
  throw std::runtime_error("the sum of the fitted column is negative or zero, but " + what +
                           " is positive. If the instrument has the other sign, flip the column: "
                           "--column " +
                           column + "=-NAME");
}

void check_loss_sign(std::span<const double> loss_Pa) {
  constexpr double kTimes = 3.0;
  double positive = 0.0, negative = 0.0;
  for (const double loss : loss_Pa) (loss > 0.0 ? positive : negative) += std::abs(loss);
  if (negative > kTimes * positive) check_sign(loss_Pa, "a loss modulus", "loss_modulus_Pa");
}

namespace {

// A step between two that are five times as long is a wrong time stamp: sampling in log time only
// grows, and a change of the rate has long steps on one side.
bool is_odd_step(std::span<const double> time_s, std::size_t i) {
  constexpr double kOdd = 0.2;
  if (i < 2 || i + 1 >= time_s.size()) return false;
  const double step = time_s[i] - time_s[i - 1];
  return step < kOdd * std::min(time_s[i - 1] - time_s[i - 2], time_s[i + 1] - time_s[i]);
}

}  // namespace

double shortest_step_s(std::span<const double> time_s) {
  const StepRange range = step_range(time_s);
  if (!(range.longest > 0.0)) return 0.0;
  if (range.shortest > 0.2 * range.longest) return range.shortest;  // nothing odd or repeated
  double shortest = range.longest;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step = time_s[i] - time_s[i - 1];
    if (step > 0.0 && step < shortest && !is_odd_step(time_s, i)) shortest = step;
  }
  return shortest;
}

double usual_step_s(std::span<const double> time_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) steps.push_back(time_s[i] - time_s[i - 1]);
  return median(std::move(steps));
}

}  // namespace viscard
