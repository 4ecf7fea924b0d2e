#include "fit/large_strain/load_cycles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace viscard {
namespace {

// Indices of the extremes of a series, in order, each further than `least` from the one before.
std::vector<std::size_t> turning_points(const std::vector<double>& values, double least) {
  std::vector<std::size_t> points{0};
  std::size_t extreme = 0;
  int direction = 0;  // of the branch after the last point; 0: not known yet
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double from_last = values[i] - values[points.back()];
    if (direction == 0) {
      if (std::abs(from_last) <= least) continue;
      direction = from_last > 0.0 ? 1 : -1;
      extreme = i;
    } else if (direction * (values[i] - values[extreme]) >= 0.0) {
      extreme = i;
    } else if (direction * (values[extreme] - values[i]) > least) {
      points.push_back(extreme);
      direction = -direction;
      extreme = i;
    }
  }
  if (direction != 0) points.push_back(extreme);
  return points;
}

// The stress while loading at a strain, by linear interpolation; nothing outside the branch.
std::optional<double> loading_stress(const LargeStrainTest& test, const LoadCycle& cycle,
                                     double strain) {
  for (std::size_t i = cycle.first + 1; i <= cycle.peak; ++i) {
    const double before = std::abs(std::log(test.stretch[i - 1]));
    const double after = std::abs(std::log(test.stretch[i]));
    if (before > strain || after < strain || !(after > before)) continue;
    const double share = (strain - before) / (after - before);
    return test.nominal_stress_Pa[i - 1] +
           share * (test.nominal_stress_Pa[i] - test.nominal_stress_Pa[i - 1]);
  }
  return std::nullopt;
}

// True if the stretch goes one way from compression to tension, or from tension to compression.
bool runs_through_rest(const std::vector<double>& stretch) {
  const bool is_one_way = std::is_sorted(stretch.begin(), stretch.end()) ||
                          std::is_sorted(stretch.rbegin(), stretch.rend());
  return is_one_way && (stretch.front() - 1.0) * (stretch.back() - 1.0) < 0.0;
}

// True for two tests below each other, one in compression and one in tension, each away from rest: nothing is unloaded.
bool leaves_rest_twice(const std::vector<double>& stretch) {
  const bool begins_above = stretch.front() > 1.0;
  const auto change = std::find_if(stretch.begin(), stretch.end(),
                                   [&](double s) { return s != 1.0 && (s > 1.0) != begins_above; });
  if (change == stretch.begin() || change == stretch.end()) return false;
  const auto goes_away = [](auto from, auto to) {
    return std::is_sorted(from, to, [](double one, double next) {
      return std::abs(std::log(one)) < std::abs(std::log(next));
    });
  };
  const bool stays =
      std::all_of(change, stretch.end(), [&](double s) { return (s > 1.0) != begins_above; });
  return stays && goes_away(stretch.begin(), change) && goes_away(change, stretch.end());
}

}  // namespace

std::vector<LoadCycle> load_cycles(const std::vector<double>& stretch) {
  if (stretch.size() < 2) return {};
  if (runs_through_rest(stretch) || leaves_rest_twice(stretch))
    return {{0, stretch.size() - 1, stretch.size() - 1}};
  std::vector<double> strain;
  for (const double s : stretch) strain.push_back(std::abs(std::log(s)));
  const auto [low, high] = std::minmax_element(strain.begin(), strain.end());
  constexpr double kLeastShare = 0.05;
  const std::vector<std::size_t> points = turning_points(strain, kLeastShare * (*high - *low));
  std::vector<LoadCycle> cycles;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (strain[points[k]] < strain[points[k - 1]]) {
      if (!cycles.empty()) cycles.back().last = points[k];
      continue;
    }
    cycles.push_back({points[k - 1], points[k], points[k]});
  }
  return cycles;
}

LargeStrainTest sorted_by_stretch(const LargeStrainTest& test) {
  std::vector<std::size_t> order(test.stretch.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return test.stretch[a] < test.stretch[b]; });
  LargeStrainTest out = test;
  for (std::size_t i = 0; i < order.size(); ++i) {
    out.stretch[i] = test.stretch[order[i]];
    out.nominal_stress_Pa[i] = test.nominal_stress_Pa[order[i]];
    if (has_times(test)) out.time_s[i] = test.time_s[order[i]];
    if (!test.lateral_stretch.empty()) out.lateral_stretch[i] = test.lateral_stretch[order[i]];
  }
  return out;
}

bool is_unsorted_curve(const LargeStrainTest& test) {
  const std::vector<double>& stretch = test.stretch;
  if (has_times(test) || std::is_sorted(stretch.begin(), stretch.end()) ||
      std::is_sorted(stretch.rbegin(), stretch.rend()))
    return false;
  const LargeStrainTest sorted = sorted_by_stretch(test);
  return std::adjacent_find(sorted.stretch.begin(), sorted.stretch.end()) == sorted.stretch.end() &&
         std::is_sorted(sorted.nominal_stress_Pa.begin(), sorted.nominal_stress_Pa.end());
}

double share_of_turns(const std::vector<double>& stretch) {
  if (stretch.size() < 3) return 0.0;
  std::size_t turns = 0;
  for (std::size_t i = 1; i + 1 < stretch.size(); ++i)
    turns += (stretch[i] - stretch[i - 1]) * (stretch[i + 1] - stretch[i]) < 0.0 ? 1 : 0;
  return static_cast<double>(turns) / static_cast<double>(stretch.size() - 2);
}

std::optional<double> softening(const LargeStrainTest& test, const std::vector<LoadCycle>& cycles) {
  if (cycles.size() < 2) return std::nullopt;
  const auto peak_of = [&](const LoadCycle& cycle) {
    return std::abs(std::log(test.stretch[cycle.peak]));
  };
  const double strain = std::min(peak_of(cycles.front()), peak_of(cycles.back()));
  const auto first = loading_stress(test, cycles.front(), strain);
  const auto last = loading_stress(test, cycles.back(), strain);
  if (!first || !last || *first == 0.0) return std::nullopt;
  return 1.0 - *last / *first;
}

LargeStrainTest loading_of(const LargeStrainTest& test, const LoadCycle& cycle) {
  LargeStrainTest out{test.name, test.deformation, {}, {}};
  out.foam_test = test.foam_test;
  for (std::size_t i = cycle.first; i <= cycle.peak; ++i) {
    out.stretch.push_back(test.stretch[i]);
    if (!test.lateral_stretch.empty()) out.lateral_stretch.push_back(test.lateral_stretch[i]);
    out.nominal_stress_Pa.push_back(test.nominal_stress_Pa[i]);
    if (has_times(test)) out.time_s.push_back(test.time_s[i]);
  }
  if (!has_times(test)) return out;
  const auto rows_before = [&](const std::vector<double>& column) {
    return std::span(column).first(cycle.first);
  };
  out.before = course_from_columns(rows_before(test.time_s), rows_before(test.stretch));
  return out;
}

}  // namespace viscard
