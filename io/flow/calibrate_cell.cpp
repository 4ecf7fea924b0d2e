#include "io/basics/timestamp.h"
#include "io/flow/calibrate.h"
#include "io/flow/damaged_table.h"
#include "io/tables/column_map.h"
#include "models/experiment/calibration_check.h"
#include "models/maths/result_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Gravity varies by 0.26 % to either side over the Earth; used as a rectangular distribution if its
// value was not given.
constexpr double kGravityHalfWidth = 0.0026;

constexpr double kUsualGravity_m_s2 = 9.80665;  // CGPM 1901

void require(bool is_right, const std::string& what) {
  if (!is_right) throw std::invalid_argument(what);
}

void check_valid_until(const std::string& day) {
  constexpr std::size_t kDay = 10;  // the record states no time
  require(day.empty() || (day.size() == kDay && is_iso_day(day)),
          "--valid-until '" + day + "' is not a day of the calendar such as 2027-11-21");
  require(day.empty() || day >= today(),
          "--valid-until " + day + " is in the past; the record would be refused at once");
}

// Weights and readings that no such cell can have had.
void check_readings(const WeightReadings& readings, const ReadingSpan& span,
                    const std::string& where) {
  constexpr double kRounding = 1e-3;  // 250 g on a cell of 250 gf
  for (std::size_t i = 0; i < readings.force_N.size(); ++i) {
    const std::string which =
        fmt::format("{}reading {} of {}: ", where, i + 1, readings.force_N.size());
    if (readings.force_N[i] > (1.0 + kRounding) * readings.capacity_N) {
      throw std::runtime_error(
          which + fmt::format("a weight of {:.4g} N is above the capacity of the cell, {:.4g} N. "
                              "Are the masses in g where the column says kg? Otherwise use smaller "
                              "weights, or correct the capacity",
                              readings.force_N[i], readings.capacity_N));
    }
    if (span.is_in_newton || std::abs(readings.reading[i]) <= span.largest) continue;
    throw std::runtime_error(
        which +
        fmt::format("{:.4g} V is beyond the span of the converter, {:.4g} V. Are the "
                    "readings in mV where the column says V? Otherwise state it with --span",
                    readings.reading[i], span.largest));
  }
}

// Load cells are linear within some thousandths. A deviation ten times larger means that a weight
// was mixed up or that something touches the load cell, so no record is written.
void check_line(const LoadCellFit& fit, const WeightReadings& readings) {
  constexpr double kWorst = 0.05;
  const double worst = std::max({fit.nonlinearity, fit.hysteresis, fit.repeatability});
  if (worst <= kWorst) return;
  std::size_t furthest = 0;
  double largest_N = 0.0;
  for (std::size_t i = 0; i < readings.force_N.size(); ++i) {
    const double off_N =
        std::abs((readings.reading[i] - fit.zero) / fit.gain - readings.force_N[i]);
    if (off_N <= largest_N) continue;
    largest_N = off_N;
    furthest = i;
  }
  throw std::runtime_error(fmt::format(
      "the readings do not lie on a line: they deviate by {:.0f} % of the largest force, at most 5 "
      "% is allowed. The largest deviation is at reading {} of {} ({:.4f} N), by {:.4f} N. Was a "
      "weight mixed up, or did something touch the load cell? Nothing was written; weigh again",
      100.0 * worst, furthest + 1, readings.force_N.size(), readings.force_N[furthest], largest_N));
}

CalibrationRecord record_from(const LoadCellFit& fit, const CalibrationRequest& request) {
  LoadCellCalibration calibration = fit.calibration;
  calibration.id = request.id.empty() ? "load cell " + today() : request.id;
  calibration.date = today();
  calibration.valid_until = request.valid_until;
  calibration.valid_until = last_valid_day(calibration);
  return {calibration, std::nullopt, fit.budget};
}

}  // namespace

void check_request(const CalibrationRequest& request) {
  if (const auto gravity = request.gravity_m_s2) {
    require(*gravity > 9.7 && *gravity < 9.9,
            fmt::format("--gravity {} m/s2 does not occur on Earth, where it lies between 9.76 and "
                        "9.84 m/s2",
                        *gravity));
  }
  require(request.mass_relative_u >= 0.0 && request.mass_relative_u < 0.1,
          "--mass-u is outside 0 to 0.1");
  require(request.capacity_N >= 0.0, "--capacity must be positive");
  require(!request.span_V || *request.span_V > 0.0, "--span must be positive");
  require(!request.nonlinearity || (*request.nonlinearity > 0.0 && *request.nonlinearity <= 0.05),
          "--nonlinearity is outside 0 to 0.05; it is a share of the capacity, 0.0005 for 0.05 %");
  check_valid_until(request.valid_until);
}

double weight_N(double mass_kg, const CalibrationRequest& request) {
  return weight_N_from_mass_kg(mass_kg, request.gravity_m_s2.value_or(kUsualGravity_m_s2));
}

double weights_relative_u(const CalibrationRequest& request) {
  return std::hypot(request.mass_relative_u,
                    request.gravity_m_s2 ? 0.0 : kGravityHalfWidth / std::sqrt(3.0));
}

void refuse_readings_of_test(const CsvTable& table) {
  const auto has = [&](const char* name) {
    return std::any_of(table.columns.begin(), table.columns.end(),
                       [&](const CsvColumn& column) { return column.name == name; });
  };
  // The head goes when somebody saves the table in a spreadsheet.
  if (!is_exported(table) && !(has("phase") && has("host_time_s"))) return;
  throw std::runtime_error(
      table.file +
      " is a table of viscard export: all readings of a test, and forces that follow from the "
      "voltages by the calibration it had. For the load cell give a table of mass_kg and volts_V; "
      "for the frame give the capture on a rigid block itself: --compliance --data RUN.viscap");
}

CsvTable complete_rows(CsvTable table, bool is_block, std::size_t& n_left_out) {
  refuse_readings_of_test(table);
  const char* load = !is_block && find_column(table, "mass_kg") ? "mass_kg" : "force_N";
  return rows_without_gaps(std::move(table), {load, is_block ? "position_m" : "volts_V"}, {},
                           n_left_out);
}

WeightReadings readings_from_table(const CsvTable& table, const CalibrationRequest& request) {
  WeightReadings readings;
  readings.reading = column_SI(table, "volts_V");
  readings.force_relative_u = weights_relative_u(request);
  if (find_column(table, "mass_kg")) {
    for (const double mass_kg : column_SI(table, "mass_kg"))
      readings.force_N.push_back(weight_N(mass_kg, request));
  } else {
    readings.force_N = column_SI(table, "force_N");
    readings.force_relative_u = request.mass_relative_u;
  }
  return readings;
}

// Forces at which the uncertainty is reported: some of the range, its end, and the capacity.
std::vector<double> reported_forces_N(const LoadCellCalibration& calibration) {
  const double largest_N = calibration.largest_force_N;
  std::vector<double> forces_N{0.1 * largest_N, 0.5 * largest_N, largest_N};
  if (calibration.capacity_N > largest_N) forces_N.push_back(calibration.capacity_N);
  return forces_N;
}

CellCalibration calibrated_cell(WeightReadings readings, const CalibrationRequest& request,
                                const RigConfig* rig) {
  readings.capacity_N = request.capacity_N;
  readings.nonlinearity = request.nonlinearity;
  ReadingSpan span = rig == nullptr ? ReadingSpan{} : reading_span(rig->load_cell);
  if (request.span_V && !span.is_in_newton) span = {.largest = *request.span_V, .is_known = true};
  check_readings(readings, span, request.where);
  LoadCellFit fit = fit_load_cell(readings);
  check_line(fit, readings);
  // Weights that press a cell whose compression is negative lower its reading.
  if (rig != nullptr && fit.gain < 0.0 && !rig->load_cell.compression_is_positive) {
    for (double& reading : readings.reading) reading = -reading;
    fit = fit_load_cell(readings);
    fit.zero = -fit.zero;
    fit.calibration.zero_volts = fit.zero;
  }
  if (const auto fault = calibration_fault(fit.calibration, span)) {
    throw std::runtime_error(request.where + fault->text + ". Nothing was written");
  }
  const CalibrationRecord record = record_from(fit, request);
  return {std::move(fit), record};
}

void show_keys(ResultVisitor& v, const CellCalibration& cell, const std::string& file) {
  const LoadCellFit& fit = cell.fit;
  const LoadCellCalibration calibration = cell.record.calibration.value_or(LoadCellCalibration{});
  v("file", file, "the record that was written; empty: none");
  v("id", calibration.id, "name of the record");
  v("date", calibration.date, "day of the calibration");
  v("valid_until", calibration.valid_until, "last day of validity");
  v("gain_V_N", fit.gain, "volts for a newton");
  v("gain_u_V_N", fit.gain_u, "its standard uncertainty at in_use_N");
  v("gain_interval_95", Interval{fit.gain - 2.0 * fit.gain_u, fit.gain + 2.0 * fit.gain_u},
    "gain plus and minus twice its uncertainty, [low, high]");
  v("zero_V", fit.zero, "reading without a force");
  v("largest_force_N", fit.largest_force_N, "largest force that was put on");
  v("nonlinearity", fit.nonlinearity,
    "largest deviation from the line, relative to the largest force");
  v("hysteresis", fit.hysteresis, "largest difference between up and down, likewise");
  v("repeatability", fit.repeatability,
    "standard deviation between series, likewise; null: one series");
  v("n_series", fit.n_series, "number of times up and down");
  v("parabola", fit.parabola, "curvature that the points show, share of the capacity");
  v("parabola_allowed", fit.parabola_allowed, "curvature that the points or the data sheet allow");
  v("in_use_N", fit.in_use_N, "force up to which the gain's uncertainty above holds");
  v.list("gain_at", "relative uncertainty of the gain by force", reported_forces_N(calibration),
         [&](double force_N) {
           v("force_N", force_N, "force");
           v("relative_u", gain_relative_u(calibration, force_N), "standard uncertainty there");
         });
  v.list("budget", "the budget of uncertainty", fit.budget, [&](const UncertaintyRow& row) {
    v("source", row.source, "name");
    v("relative_u", row.relative_u, "relative standard uncertainty");
    v("how", row.how, "how it was found");
  });
}

}  // namespace viscard
