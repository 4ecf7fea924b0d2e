#include "fit/calibration/fit_load_cell.h"

#include "fit/calibration/cell_shape.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

constexpr double kMostSpread = 0.01;    // largest minus smallest gain of the series, relative
constexpr double kWholeSeries = 0.25;   // of the widest series: one that shows its gain, too
constexpr double kLeastReading = 1e-9;  // of the largest one: a smaller change is rounding
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
  std::vector<double> gains;  // of each series with enough weights
  std::vector<double> zeros;  // of each series
  double sum_xx = 0.0;        // within series
  // Force from the mean of its series, and what a line through the readings leaves of its square.
  std::vector<double> centred, square;
  double square_slope = 0.0;  // of that line, N: where a parabola has the gain of the line
};

Line line_through(const WeightReadings& data, const std::vector<Point>& points) {
  const auto n_series = static_cast<std::size_t>(points.back().series) + 1;
  std::vector<double> mean_x(n_series), mean_y(n_series), mean_xx(n_series), count(n_series);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto s = static_cast<std::size_t>(points[i].series);
    mean_x[s] += data.force_N[i];
    mean_y[s] += data.reading[i];
    mean_xx[s] += data.force_N[i] * data.force_N[i];
    count[s] += 1.0;
  }
  Line line;
  std::vector<double> sum_xy(n_series), sum_xx(n_series);
  for (std::size_t s = 0; s < n_series; ++s) {
    mean_x[s] /= count[s];
    mean_y[s] /= count[s];
    mean_xx[s] /= count[s];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto s = static_cast<std::size_t>(points[i].series);
    const double dx = data.force_N[i] - mean_x[s];
    line.sum_xx += dx * dx;
    sum_xx[s] += dx * dx;
    sum_xy[s] += dx * (data.reading[i] - mean_y[s]);
    line.centred.push_back(dx);
    line.square.push_back(data.force_N[i] * data.force_N[i] - mean_xx[s]);
    line.square_slope += dx * line.square.back();
  }
  line.square_slope /= line.sum_xx;
  for (std::size_t i = 0; i < points.size(); ++i) {
    line.square[i] -= line.square_slope * line.centred[i];
  }
  line.gain = std::accumulate(sum_xy.begin(), sum_xy.end(), 0.0) / line.sum_xx;
  const double widest = *std::max_element(sum_xx.begin(), sum_xx.end());
  for (std::size_t s = 0; s < n_series; ++s) {
    if (sum_xx[s] > kWholeSeries * widest) line.gains.push_back(sum_xy[s] / sum_xx[s]);
  }
  for (std::size_t s = 0; s < n_series; ++s) {
    line.zeros.push_back(mean_y[s] - line.gain * mean_x[s]);
  }
  return line;
}

// Standard deviation of the gains of the series, relative. The readings of one series share what
// changes between series, so their number does not reduce it.
double reproducibility_of(const Line& line) {
  if (line.gains.size() < 2) return 0.0;
  const auto n = static_cast<double>(line.gains.size());
  const double mean = std::accumulate(line.gains.begin(), line.gains.end(), 0.0) / n;
  double squares = 0.0;
  for (const double gain : line.gains) squares += (gain - mean) * (gain - mean);
  return std::sqrt(squares / (n - 1.0)) / std::abs(line.gain);
}

void refuse_spread(const Line& line) {
  const auto [low, high] = std::minmax_element(line.gains.begin(), line.gains.end());
  const double spread = (*high - *low) / std::abs(line.gain);
  if (spread <= kMostSpread) return;
  std::string gains;
  for (std::size_t s = 0; s < std::min<std::size_t>(line.gains.size(), 6); ++s) {
    gains += (s == 0 ? "" : ", ") + text_of(line.gains[s], 5);
  }
  throw std::runtime_error(
      "the gain differs by " + text_of(100.0 * spread, 2) + " % between the series (" + gains +
      " per N); at most " + text_of(100.0 * kMostSpread, 2) +
      " % is allowed. Is a weight of one series wrong, or did the amplifier still warm up? Repeat "
      "all series with the same weights, after half an hour with everything switched on");
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

// Standard error of one mean reading: from its own noise, the repeatability, and the scatter about
// parabola and loop.
double reading_u(const WeightReadings& data, const CellShape& shape, const LoadCellFit& fit) {
  double noise = 0.0;
  for (const double se : data.reading_se) {
    noise += se * se / static_cast<double>(data.reading_se.size());
  }
  return std::max(
      {shape.scatter, std::sqrt(noise), fit.repeatability * std::abs(fit.full_reading)});
}

CellShape shape_of(const WeightReadings& data, const std::vector<Point>& points) {
  std::vector<CellReading> readings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double branch = points[i].load == 0 ? 0.0 : points[i].is_up ? 1.0 : -1.0;
    readings.push_back(
        {data.force_N[i], data.reading[i], branch, static_cast<std::size_t>(points[i].series)});
  }
  return cell_shape(readings);
}

// The readings decide if they determine the parabola better than the data sheet does, or if they show more
// than it says. Where noise hides it, the data sheet stands.
double allowed_parabola(const LoadCellFit& fit, double stated) {
  const double size = std::abs(fit.parabola);
  if (size + 2.0 * fit.parabola_se <= stated) return size + 2.0 * fit.parabola_se;
  return size <= fit.parabola_se ? stated : std::max(stated, size + fit.parabola_se);
}

// Largest departure of the mean of both directions from the parabola, relative to full_reading.
double departure_from_parabola(const Groups& groups, const Line& line,
                               const std::vector<Point>& points, const LoadCellFit& fit) {
  const double per_N2 = -4.0 * fit.gain / fit.calibration.capacity_N * fit.parabola;
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].load == 0) continue;
    const auto up = groups.find({points[i].load, true});
    const auto down = groups.find({points[i].load, false});
    if (up == groups.end()) continue;
    const double middle =
        down == groups.end() ? up->second.mean() : 0.5 * (up->second.mean() + down->second.mean());
    worst = std::max(worst, std::abs(middle - per_N2 * line.square[i]));
  }
  return worst / std::abs(fit.full_reading);
}

void add_budget(const WeightReadings& data, const Groups& groups, const Line& line,
                const std::vector<Point>& points, LoadCellFit& fit) {
  const double root3 = std::sqrt(3.0);
  const CellShape shape = shape_of(data, points);
  const double per_parabola = -4.0 * fit.gain / fit.calibration.capacity_N;
  fit.parabola = shape.per_N2 / per_parabola;
  fit.parabola_se = shape.per_N2_se / std::abs(per_parabola);
  fit.parabola_allowed = allowed_parabola(fit, data.nonlinearity.value_or(kUsualNonlinearity));
  const double of_readings =
      reading_u(data, shape, fit) / std::sqrt(line.sum_xx) / std::abs(fit.gain);
  const double of_series = reproducibility_of(line);
  const double regression = std::max(of_readings, of_series);
  const double departure = departure_from_parabola(groups, line, points, fit) / root3;
  const double resolution = data.resolution / std::abs(fit.full_reading) / std::sqrt(12.0);
  LoadCellCalibration& cell = fit.calibration;
  cell.largest_force_N = fit.largest_force_N;
  const double closed = fit.hysteresis / 3.0 / root3;  // in gain_relative_u() at every force
  const double open = std::abs(shape.of_loop / fit.gain) / std::sqrt(2.0);  // of known size
  cell.common_u = std::hypot(data.force_relative_u, regression,
                             std::sqrt(std::max(0.0, open * open - closed * closed)));
  cell.shape_u = std::hypot(departure, resolution);
  // A parabola that the readings show has a known size; otherwise any smaller one is as likely.
  const bool is_shown = std::abs(fit.parabola) > 2.0 * fit.parabola_se;
  cell.curvature_u = 4.0 * fit.parabola_allowed / (is_shown ? std::sqrt(2.0) : root3);
  cell.curvature_at_N = std::max(0.0, line.square_slope);
  const double at_largest = gain_relative_u(cell, fit.largest_force_N);
  const double at_capacity = gain_relative_u(cell, cell.capacity_N);
  fit.in_use_N = at_capacity >= at_largest ? cell.capacity_N : fit.largest_force_N;
  fit.gain_u = gain_relative_u_in_use(cell) * std::abs(fit.gain);
  cell.volts_per_newton_u = fit.gain_u;
  const double curvature =
      cell.curvature_u * std::abs(fit.in_use_N - cell.curvature_at_N) / cell.capacity_N;
  fit.budget = {
      {"weights", data.force_relative_u, "masses and local gravity, as stated"},
      {"regression", regression,
       of_series > of_readings ? "reproducibility: the series differ in their gain"
       : fit.has_repeatability ? "repeatability of the readings through the line"
                               : "scatter about the line; one series shows no repeatability"},
      {"nonlinearity", std::hypot(curvature, departure),
       "parabola of up to " + text_of(100.0 * fit.parabola_allowed, 2) + " % of the capacity, at " +
           text_of(fit.in_use_N, 3) + (is_shown ? " N; U-shaped" : " N; rectangular")},
      {"hysteresis", std::max(closed, open),
       fit.has_hysteresis
           ? (open > closed ? "a loop that the largest weight does not close, U-shaped"
                            : "a third of the largest difference, rectangular")
           : "not measured: no weight was removed"},
      {"resolution", resolution, "one digit of a reading"}};
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
  const auto [lowest, highest] = std::minmax_element(data.reading.begin(), data.reading.end());
  const double largest = std::max(std::abs(*lowest), std::abs(*highest));
  if (!(std::abs(fit.full_reading) > kLeastReading * largest)) {
    throw std::invalid_argument(
        "the readings do not change with the weights. Is the load cell "
        "connected, and do the weights hang on it?");
  }
  refuse_spread(line);
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
  fit.calibration.volts_per_newton = fit.gain;
  fit.calibration.zero_volts = fit.zero;
  fit.calibration.capacity_N = data.capacity_N > 0.0 ? data.capacity_N : fit.largest_force_N;
  fit.calibration.nonlinearity = fit.nonlinearity;
  fit.calibration.hysteresis = fit.hysteresis;
  fit.calibration.repeatability = fit.repeatability;
  add_budget(data, groups, line, points, fit);
  return fit;
}

double weight_N_from_mass_kg(double mass_kg, double gravity_m_s2) {
  return mass_kg * gravity_m_s2 * (1.0 - 1.2 / 8000.0);
}

}  // namespace viscard
