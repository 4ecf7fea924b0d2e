#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/cli/rig/calibrate_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/tables/column_map.h"
#include "io/tables/csv_table.h"
#include "models/experiment/calibration_check.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/weigh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

namespace viscard {
namespace {

// Gravity varies by 0.26 % to either side over the Earth; used as a rectangular distribution if its
// value was not given.
constexpr double kGravityHalfWidth = 0.0026;

// Up and down again with one weight at a time, once for each series.
std::vector<double> sequence_kg(std::vector<double> masses_kg, int series) {
  masses_kg.push_back(0.0);
  std::sort(masses_kg.begin(), masses_kg.end());
  masses_kg.erase(std::unique(masses_kg.begin(), masses_kg.end()), masses_kg.end());
  std::vector<double> sequence{0.0};
  for (int i = 0; i < series; ++i) {
    sequence.insert(sequence.end(), masses_kg.begin() + 1, masses_kg.end());
    sequence.insert(sequence.end(), masses_kg.rbegin() + 1, masses_kg.rend());
  }
  return sequence;
}

double weights_relative_u(const CalibrateWords& words) {
  return std::hypot(words.mass_relative_u,
                    words.is_gravity_given ? 0.0 : kGravityHalfWidth / std::sqrt(3.0));
}

// A table has mass_kg or force_N, and volts_V, in the order in which the readings were taken.
WeightReadings readings_from_table(const CalibrateWords& words) {
  if (looks_like_capture(*words.data_file)) {
    throw std::runtime_error(
        *words.data_file +
        " is a capture of a test, not a table of weights. Give a CSV file with "
        "mass_kg (or force_N) and volts_V; a capture of a rigid block goes with "
        "--compliance");
  }
  const CsvTable table = read_csv(*words.data_file);
  WeightReadings readings;
  readings.reading = column_SI(table, "volts_V");
  readings.force_relative_u = weights_relative_u(words);
  if (find_column(table, "mass_kg")) {
    for (const double mass_kg : column_SI(table, "mass_kg")) {
      readings.force_N.push_back(weight_N_from_mass_kg(mass_kg, words.gravity_m_s2));
    }
  } else {
    readings.force_N = column_SI(table, "force_N");
    readings.force_relative_u = words.mass_relative_u;
  }
  return readings;
}

bool ask_for_weight(double mass_kg, std::ostream& err) {
  if (mass_kg > 0.0) {
    err << fmt::format("Put {:g} g on the load cell and nothing else, and press Enter (q ends): ",
                       mass_kg * 1e3);
  } else {
    err << "Take everything off the load cell and press Enter (q ends): ";
  }
  err.flush();
  std::string answer;
  return std::getline(std::cin, answer) && answer.rfind('q', 0) != 0;
}

WeightReadings weigh_on(RigConfig rig, const CalibrateWords& words, EmulatedRig* emulated,
                        Streams& streams) {
  const StopOnSignal on_signal;
  if (emulated != nullptr) rig = emulated->config();
  const RigClock clock = emulated != nullptr ? emulated->clock() : RigClock(rig.clock_speed);
  SerialLine line(rig.load_cell.port, rig.load_cell.baud, clock, rig.load_cell.framing);
  const auto load_cell = make_load_cell(line, rig.load_cell, clock, [](const RunRecord&) {});
  std::vector<double> masses_kg = words.masses_kg;
  if (masses_kg.empty()) masses_kg = {0.05, 0.1, 0.15, 0.2};
  const std::vector<double> sequence = sequence_kg(masses_kg, words.series);
  std::vector<double> forces_N;
  for (const double mass_kg : sequence) {
    forces_N.push_back(weight_N_from_mass_kg(mass_kg, words.gravity_m_s2));
  }
  std::size_t next = 0;
  WeighOptions options;
  options.settle_s = words.settle_s;
  options.mean_s = words.mean_s;
  options.stop = &StopOnSignal::is_asked();
  options.put_on = [&](double force_N) {
    const double mass_kg = sequence[next++];
    if (emulated == nullptr) return ask_for_weight(mass_kg, streams.err);
    emulated->hang_weight(force_N);
    return true;
  };
  WeightReadings readings;
  readings.force_relative_u = weights_relative_u(words);
  readings.resolution =
      has_converter(rig.load_cell) ? std::abs(rig.load_cell.volts_per_count) : 0.0;
  for (const WeighedLoad& load : weigh(*load_cell, rig, clock, forces_N, options)) {
    readings.force_N.push_back(load.force_N);
    readings.reading.push_back(load.reading);
    readings.reading_se.push_back(load.sd / std::sqrt(static_cast<double>(load.n)));
  }
  return readings;
}

CalibrationRecord record_from(const LoadCellFit& fit, const CalibrateWords& words) {
  LoadCellCalibration calibration = fit.calibration;
  calibration.id = words.id;
  calibration.date = today();
  calibration.valid_until = words.valid_until;
  calibration.valid_until = last_valid_day(calibration);
  return {calibration, std::nullopt, fit.budget};
}

// Forces at which the uncertainty is reported: some of the range, its end, and the capacity.
std::vector<double> reported_forces_N(const LoadCellCalibration& calibration) {
  const double largest_N = calibration.largest_force_N;
  std::vector<double> forces_N{0.1 * largest_N, 0.5 * largest_N, largest_N};
  if (calibration.capacity_N > largest_N) forces_N.push_back(calibration.capacity_N);
  return forces_N;
}

void print_text(const LoadCellFit& fit, const CalibrationRecord& record, const std::string& file,
                std::ostream& out) {
  const double relative_u = fit.gain_u / std::abs(fit.gain);
  out << fmt::format("gain           {:.6g} V/N, +-{:.3f} % (k = 2) at {:.4g} N\n", fit.gain,
                     200.0 * relative_u, fit.in_use_N);
  for (const double force_N : reported_forces_N(fit.calibration)) {
    out << fmt::format("  at {:<10}+-{:.3f} %\n", fmt::format("{:.3g} N", force_N),
                       200.0 * gain_relative_u(fit.calibration, force_N));
  }
  out << fmt::format("range          0 to {:.4g} N; a test above {:.4g} N is a doubt\n",
                     fit.largest_force_N, 1.2 * fit.largest_force_N)
      << fmt::format("zero           {:.6g} V\n", fit.zero)
      << fmt::format("nonlinearity   {:.4f} % of the reading at {:.4f} N\n",
                     100.0 * fit.nonlinearity, fit.largest_force_N)
      << fmt::format("hysteresis     {}\n", fit.has_hysteresis
                                                ? fmt::format("{:.4f} %", 100.0 * fit.hysteresis)
                                                : "not measured: take the weights off one by one")
      << fmt::format("repeatability  {}\n", fit.has_repeatability
                                                ? fmt::format("{:.4f} %", 100.0 * fit.repeatability)
                                                : "not measured: go up and down more than once")
      << "budget         standard uncertainty, relative\n";
  for (const UncertaintyRow& row : fit.budget) {
    out << fmt::format("  {:<13}{:.5f} %  {}\n", row.source, 100.0 * row.relative_u, row.how);
  }
  out << fmt::format("  {:<13}{:.5f} %\n", "together", 100.0 * relative_u)
      << fmt::format("{}: '{}', valid until {}\n", file, record.calibration->id,
                     record.calibration->valid_until);
}

void show_load_cell(ResultVisitor& v, const LoadCellFit& fit,
                    const LoadCellCalibration& calibration, const std::string& file) {
  v("file", file, "the record that was written");
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

WeightReadings readings_on_rig(const RigConfig& rig, const CalibrateWords& words, double capacity_N,
                               Streams& streams) {
  if (!words.is_emulated && words.masses_kg.empty()) {
    throw UsageError("calibrate needs --weights, such as \"20 g, 50 g, 100 g, 200 g\"");
  }
  for (const double mass_kg : words.masses_kg) {
    if (mass_kg * words.gravity_m_s2 <= capacity_N) continue;
    throw UsageError(fmt::format("--weights: {:g} g is more than the load cell's {:.4f} N",
                                 mass_kg * 1e3, capacity_N));
  }
  std::unique_ptr<EmulatedRig> emulated;
  if (words.is_emulated) {
    emulated = std::make_unique<EmulatedRig>(
        EmulatedRigOptions{.truth = calibrate_truth(words), .config = rig});
  }
  return weigh_on(rig, words, emulated.get(), streams);
}

}  // namespace

DescribedResult result_of_load_cell() {
  return {
      "calibrate", "viscard calibrate", {[](ResultVisitor& v) { show_load_cell(v, {}, {}, ""); }}};
}

int calibrate_load_cell(const CalibrateWords& words, Streams& streams) {
  const bool has_rig = words.rig_file || !words.data_file;
  const RigConfig rig = has_rig ? calibrate_rig(words) : RigConfig{};
  const double capacity_N = words.capacity_N.value_or(rig.calibration.capacity_N);
  if (!(capacity_N > 0.0)) {
    throw UsageError("calibrate needs --capacity, the rated load of the cell, such as \"250 gf\"");
  }
  ReadingSpan span = has_rig ? reading_span(rig.load_cell) : ReadingSpan{};
  if (words.span_V && !span.is_in_newton) span = {.largest = *words.span_V, .is_known = true};
  WeightReadings readings = words.data_file ? readings_from_table(words)
                                            : readings_on_rig(rig, words, capacity_N, streams);
  readings.capacity_N = capacity_N;
  readings.nonlinearity = words.nonlinearity;
  const std::string where = words.data_file ? *words.data_file + ": " : std::string();
  check_readings(readings, span, where);
  LoadCellFit fit = fit_load_cell(readings);
  check_line(fit, readings);
  // Weights that press a cell whose compression is negative lower its reading.
  if (has_rig && fit.gain < 0.0 && !rig.load_cell.compression_is_positive) {
    for (double& reading : readings.reading) reading = -reading;
    fit = fit_load_cell(readings);
    fit.zero = -fit.zero;
    fit.calibration.zero_volts = fit.zero;
  }
  if (const auto fault = calibration_fault(fit.calibration, span)) {
    throw std::runtime_error(where + fault->text + ". Nothing was written");
  }
  const CalibrationRecord record = record_from(fit, words);
  write_file(words.out_file, toml_from_calibration(record), words.overwrite);
  if (words.as_json) {
    const auto show = [&](ResultVisitor& v) {
      show_load_cell(v, fit, *record.calibration, words.out_file);
    };
    print_result({"viscard-calibrate/1", inputs_of(words)}, show, streams, -1);
  } else {
    print_text(fit, record, words.out_file, FittedText(streams));
  }
  return kDone;
}

}  // namespace viscard
