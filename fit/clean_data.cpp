#include "fit/clean_data.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace viscard {

CleanColumns clean_columns(std::vector<std::vector<double>> columns, std::size_t least) {
  CleanColumns clean;
  const std::size_t rows = columns.at(0).size();
  for (const std::vector<double>& column : columns) {
    if (column.size() != rows) {
      throw std::invalid_argument("columns of " + std::to_string(rows) + " and " +
                                  std::to_string(column.size()) + " values belong to no one table");
    }
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rows; ++i) {
    const bool is_finite = std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
      return std::isfinite(column[i]);
    });
    if (is_finite) order.push_back(i);
  }
  clean.n_left_out = rows - order.size();
  if (order.size() < least) {
    throw std::runtime_error(
        "only " + std::to_string(order.size()) + " of " + std::to_string(rows) +
        " rows hold numbers in every column needed; a fit takes at least " + std::to_string(least));
  }
  const std::vector<double>& time = columns[0];
  const auto earlier = [&](std::size_t a, std::size_t b) { return time[a] < time[b]; };
  const bool is_ordered = std::is_sorted(order.begin(), order.end(), earlier);
  if (is_ordered && clean.n_left_out == 0) {
    clean.columns = std::move(columns);
    return clean;
  }
  if (!is_ordered) std::stable_sort(order.begin(), order.end(), earlier);
  for (const std::vector<double>& column : columns) {
    std::vector<double>& target = clean.columns.emplace_back();
    target.reserve(order.size());
    for (const std::size_t i : order) target.push_back(column[i]);
  }
  return clean;
}

double shortest_step_s(const std::vector<double>& time_s) {
  double shortest = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step = time_s[i] - time_s[i - 1];
    if (step > 0.0 && (shortest == 0.0 || step < shortest)) shortest = step;
  }
  return shortest;
}

}  // namespace viscard
