#include "fit/clean_data.h"

#include "fit/spikes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace viscard {

namespace {

bool is_ready(const std::vector<std::span<const double>>& columns) {
  for (const std::span<const double> column : columns) {
    // A sum of finite numbers times 0 is 0; anything else makes it NaN. No branch in the loop.
    // Four sums, so that one addition need not wait for the last.
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    std::size_t i = 0;
    for (; i + 4 <= column.size(); i += 4) {
      for (std::size_t k = 0; k < 4; ++k) sums[k] += 0.0 * column[i + k];
    }
    for (; i < column.size(); ++i) sums[0] += 0.0 * column[i];
    if (sums[0] + sums[1] + sums[2] + sums[3] != 0.0) return false;
  }
  return std::is_sorted(columns[0].begin(), columns[0].end());
}

// Numbers of the rows that can be used, in order of time.
std::vector<std::size_t> usable_rows(const std::vector<std::span<const double>>& columns) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
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
                           " rows hold numbers in every column needed; a fit takes at least " +
                           std::to_string(least));
}

}  // namespace

CleanViews::CleanViews(const std::vector<std::span<const double>>& columns, std::size_t least)
    : views_(columns) {
  const std::size_t rows = columns.at(0).size();
  for (const std::span<const double> column : columns) {
    if (column.size() != rows) {
      throw std::invalid_argument("columns of " + std::to_string(rows) + " and " +
                                  std::to_string(column.size()) + " values belong to no one table");
    }
  }
  if (is_ready(columns)) {
    check_count(rows, rows, least);
    return;
  }
  const std::vector<std::size_t> order = usable_rows(columns);
  n_left_out_ = rows - order.size();
  check_count(order.size(), rows, least);
  for (std::span<const double>& view : views_) {
    std::vector<double>& target = copies_.emplace_back();
    target.reserve(order.size());
    for (const std::size_t i : order) target.push_back(view[i]);
    view = target;  // keeps its memory when copies_ grows
  }
}

void CleanViews::drop_first(std::size_t rows) {
  for (std::span<const double>& view : views_) view = view.subspan(rows);
}

void CleanViews::drop(const std::vector<std::size_t>& rows) {
  if (rows.empty()) return;
  std::vector<std::vector<double>> kept;
  for (const std::span<const double> view : views_) kept.push_back(without_rows(view, rows));
  copies_ = std::move(kept);
  for (std::size_t i = 0; i < views_.size(); ++i) views_[i] = copies_[i];
}

CleanColumns clean_columns(const std::vector<std::span<const double>>& columns, std::size_t least) {
  const CleanViews views(columns, least);
  CleanColumns clean;
  clean.n_left_out = views.n_left_out();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    clean.columns.emplace_back(views.column(i).begin(), views.column(i).end());
  }
  return clean;
}

double shortest_step_s(std::span<const double> time_s) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step = time_s[i] - time_s[i - 1];
    shortest = step > 0.0 && step < shortest ? step : shortest;
  }
  return std::isfinite(shortest) ? shortest : 0.0;
}

}  // namespace viscard
