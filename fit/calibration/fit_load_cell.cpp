#include "fit/calibration/fit_load_cell.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

constexpr double kSame = 1e-6;  // relative to the largest load; loads that differ by less are equal

struct Point {
  int load = 0;  // index of the load step, 0: no load
  bool is_up = true;
  int series = 0;
};

void check(const WeightReadings& data) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (data.force_N.size() != data.reading.size() ||
      !std::all_of(data.force_N.begin(), data.force_N.end(), is_finite) ||
      !std::all_of(data.reading.begin(), data.reading.end(), is_finite)) {
    throw std::invalid_argument(
        "a calibration needs one reading for each weight, all finite numbers");
  }
  if (!data.reading_se.empty() && data.reading_se.size() != data.reading.size()) {
    throw std::invalid_argument("the numbers of standard errors and readings differ");
  }
}

// Load step, direction and series of each reading.
std::vector<Point> points_of(const WeightReadings& data, double largest_N) {
  std::vector<double> loads = data.force_N;
  std::sort(loads.begin(), loads.end());
  const auto is_same = [&](double a, double b) { return std::abs(a - b) <= kSame * largest_N; };
  loads.erase(std::unique(loads.begin(), loads.end(), is_same), loads.end());
  if (loads.size() < 3 || !is_same(loads.front(), 0.0)) {
    throw std::invalid_argument(std::string("a calibration needs readings without load and with at "
                                            "least two different weights, but there ") +
                                (loads.size() == 1 ? "is " : "are ") +
                                counted(loads.size(), "load") +
                                ". Add weights, and begin without load");
  }
  std::vector<Point> points;
  int series = 0;
  bool has_load = false;
  bool is_over = false;  // the load returned to zero: the next reading begins a new series
  for (std::size_t i = 0; i < data.force_N.size(); ++i) {
    if (is_over) {
      ++series;
      has_load = false;
    }
    Point point;
    while (!is_same(loads[static_cast<std::size_t>(point.load)], data.force_N[i])) ++point.load;
    point.is_up = i == 0 || data.force_N[i] > data.force_N[i - 1];
    point.series = series;
    has_load = has_load || point.load > 0;
    is_over = has_load && point.load == 0;
    points.push_back(point);
  }
  return points;
}

struct Line {
  double gain = 0.0;
  std::vector<double> zeros;  // of each series
  double sum_xx = 0.0;        // within series
};

Line line_through(const WeightReadings& data, const std::vector<Point>& points) {
  const auto n_series = static_cast<std::size_t>(points.back().series) + 1;
  std::vector<double> mean_x(n_series), mean_y(n_series), count(n_series);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto s = static_cast<std::size_t>(points[i].series);
    mean_x[s] += data.force_N[i];
    mean_y[s] += data.reading[i];
    count[s] += 1.0;
  }
  Line line;
  double sum_xy = 0.0;
  for (std::size_t s = 0; s < n_series; ++s) {
    mean_x[s] /= count[s];
    mean_y[s] /= count[s];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto s = static_cast<std::size_t>(points[i].series);
    const double dx = data.force_N[i] - mean_x[s];
    line.sum_xx += dx * dx;
    sum_xy += dx * (data.reading[i] - mean_y[s]);
  }
  line.gain = sum_xy / line.sum_xx;
  for (std::size_t s = 0; s < n_series; ++s) {
    line.zeros.push_back(mean_y[s] - line.gain * mean_x[s]);
  }
  return line;
}

// Mean and spread of the residuals at one load in one direction.
struct Group {
  double sum = 0.0, squares = 0.0;
  int n = 0;
  double mean() const { return sum / n; }
  double scatter() const { return std::max(0.0, squares - sum * sum / n); }
};
using Groups = std::map<std::pair<int, bool>, Group>;

void describe(const Groups& groups, LoadCellFit& fit) {
  double scatter = 0.0;
  int freedom = 0;
  double worst = 0.0, loop = 0.0;
  for (const auto& [key, group] : groups) {
    scatter += group.scatter();
    freedom += group.n - 1;
    if (key.first == 0) continue;
    const auto other = groups.find({key.first, !key.second});
    const bool is_pair = other != groups.end();
    const double middle = is_pair ? 0.5 * (group.mean() + other->second.mean()) : group.mean();
    worst = std::max(worst, std::abs(middle));
    if (!is_pair) continue;
    fit.has_hysteresis = true;
    loop = std::max(loop, std::abs(group.mean() - other->second.mean()));
  }
  fit.nonlinearity = worst / std::abs(fit.full_reading);
  fit.hysteresis = loop / std::abs(fit.full_reading);
  // The zeros at the ends of one series give no repeatability of the loads in between.
  fit.has_repeatability = freedom > 0 && fit.n_series > 1;
  if (fit.has_repeatability)
    fit.repeatability = std::sqrt(scatter / freedom) / std::abs(fit.full_reading);
}

// Standard error of one mean reading: from the repeatability or, without it, from its own noise or
// the residual of the line.
double reading_u(const WeightReadings& data, const LoadCellFit& fit) {
  double noise = 0.0;
  for (const double se : data.reading_se) {
    noise += se * se / static_cast<double>(data.reading_se.size());
  }
  const double repeated = fit.repeatability * std::abs(fit.full_reading);
  if (fit.has_repeatability) return std::max(repeated, std::sqrt(noise));
  double squares = 0.0;
  for (const double residual : fit.residual) squares += residual * residual;
  const double freedom = static_cast<double>(fit.residual.size()) - 1.0 - fit.n_series;
  return std::sqrt(std::max(noise, freedom > 0.0 ? squares / freedom : 0.0));
}

void add_budget(const WeightReadings& data, double sum_xx, LoadCellFit& fit) {
  const double u = reading_u(data, fit);
  const double full = std::abs(fit.full_reading);
  fit.budget = {
      {"weights", data.force_relative_u, "masses and local gravity, as stated"},
      {"regression", u / std::sqrt(sum_xx) / std::abs(fit.gain),
       fit.has_repeatability ? "repeatability of the readings through the line"
                             : "scatter about the line; one series shows no repeatability"},
      {"nonlinearity", fit.nonlinearity / std::sqrt(3.0), "largest deviation, rectangular"},
      {"hysteresis", 0.5 * fit.hysteresis / std::sqrt(3.0),
       fit.has_hysteresis ? "half the largest difference, rectangular"
                          : "not measured: no weight was removed"},
      {"resolution", data.resolution / full / std::sqrt(12.0), "one digit of a reading"}};
  double squares = 0.0;
  for (const UncertaintyRow& row : fit.budget) squares += row.relative_u * row.relative_u;
  fit.gain_u = std::sqrt(squares) * std::abs(fit.gain);
}

}  // namespace

LoadCellFit fit_load_cell(const WeightReadings& data) {
  check(data);
  LoadCellFit fit;
  for (const double force_N : data.force_N) {
    fit.largest_force_N = std::max(fit.largest_force_N, force_N);
  }
  const std::vector<Point> points = points_of(data, fit.largest_force_N);
  const Line line = line_through(data, points);
  fit.gain = line.gain;
  fit.n_series = static_cast<int>(line.zeros.size());
  fit.full_reading = line.gain * fit.largest_force_N;
  if (!(std::abs(fit.full_reading) > 0.0)) {
    throw std::invalid_argument(
        "the readings do not change with the weights. Is the load cell "
        "connected, and do the weights hang on it?");
  }
  Groups groups;
  for (const double zero : line.zeros) fit.zero += zero / fit.n_series;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    const double residual = data.reading[i] - line.gain * data.force_N[i] -
                            line.zeros[static_cast<std::size_t>(point.series)];
    fit.residual.push_back(residual);
    Group& group = groups[{point.load, point.is_up || point.load == 0}];
    group.sum += residual;
    group.squares += residual * residual;
    ++group.n;
  }
  // The largest load is reached from below only, so it has no pair for the hysteresis.
  describe(groups, fit);
  add_budget(data, line.sum_xx, fit);
  return fit;
}

double weight_N_from_mass_kg(double mass_kg, double gravity_m_s2) {
  return mass_kg * gravity_m_s2 * (1.0 - 1.2 / 8000.0);
}

}  // namespace viscard
