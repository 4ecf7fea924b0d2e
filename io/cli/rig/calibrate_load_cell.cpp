#include "io/basics/atomic_file.h"
#include "io/basics/option_use.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/cli/rig/calibrate_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/calibrate.h"
#include "io/flow/damaged_table.h"
#include "io/tables/column_map.h"
#include "io/tables/csv_table.h"
#include "models/experiment/calibration_check.h"
#include "models/maths/text_of_number.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/weigh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <string_view>

namespace viscard {
namespace {

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

CsvTable table_of_weights(const CalibrateWords& words) {
  const std::string& path = *words.data_file;
  if (looks_like_capture(path)) {
    throw std::runtime_error(
        path +
        " is a capture of a test, not a table of weights. Give a CSV file with "
        "mass_kg (or force_N) and volts_V; a capture of a rigid block goes with "
        "--compliance");
  }
  CsvTable table = read_csv(path);
  refuse_unverified(table, words);
  (void)accepted_damage(table, words.accepts_unverified);
  return table;
}

WeightReadings readings_of_table(const CalibrateWords& words, const CalibrationRequest& request,
                                 Streams& streams) {
  const CsvTable table = complete_rows(table_of_weights(words), false, streams);
  refuse_idle({{request.where + "--gravity", request.gravity_m_s2.has_value(),
                find_column(table, "mass_kg").has_value(),
                "masses (mass_kg), and this table states forces"}});
  return readings_from_table(table, request);
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
  const auto line = open_line(rig.load_cell.port, rig.load_cell.baud, clock, rig.load_cell.framing);
  const auto load_cell = make_load_cell(*line, rig.load_cell, clock, [](const RunRecord&) {});
  const std::vector<double> sequence = sequence_kg(words.masses_kg, words.series);
  std::vector<double> forces_N;
  for (const double mass_kg : sequence) {
    forces_N.push_back(weight_N(mass_kg, words.request));
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
  readings.force_relative_u = weights_relative_u(words.request);
  readings.resolution =
      has_converter(rig.load_cell) ? std::abs(rig.load_cell.volts_per_count) : 0.0;
  for (const WeighedLoad& load : weigh(*load_cell, rig, clock, forces_N, options)) {
    readings.force_N.push_back(load.force_N);
    readings.reading.push_back(load.reading);
    readings.reading_se.push_back(load.sd / std::sqrt(static_cast<double>(load.n)));
  }
  return readings;
}

void print_text(const CellCalibration& cell, const std::string& file, std::ostream& out) {
  const LoadCellFit& fit = cell.fit;
  const CalibrationRecord& record = cell.record;
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

// Refuses weights with which no calibration can succeed, before anyone puts them on.
void check_weights(const CalibrateWords& words, double capacity_N) {
  if (words.masses_kg.empty()) {
    throw UsageError("calibrate needs --weights, such as \"20 g, 50 g, 100 g, 200 g\"");
  }
  const std::vector<std::string_view> typed = split(words.weights, ',');
  for (std::size_t i = 0; i < words.masses_kg.size(); ++i) {
    const double mass_kg = words.masses_kg[i];
    constexpr double kRounding = 1e-3;  // 250 g on a cell of 250 gf
    if (weight_N(mass_kg, words.request) <= (1.0 + kRounding) * capacity_N) continue;
    const std::string mass(trimmed(typed[i]));
    const bool has_unit = !number_from_text(mass);
    throw UsageError(fmt::format("--weights: {}{} is more than the load cell's {:.4f} N{}", mass,
                                 has_unit ? "" : " without a unit, in kg,", capacity_N,
                                 has_unit ? "; omit it" : "; write \"" + mass + " g\""));
  }
  std::vector<double> loads = sequence_kg(words.masses_kg, 1);
  std::sort(loads.begin(), loads.end());
  const auto is_same = [&](double a, double b) { return b - a <= 1e-6 * loads.back(); };
  loads.erase(std::unique(loads.begin(), loads.end(), is_same), loads.end());
  constexpr std::size_t kFewest = 3;  // no load, and two weights
  if (loads.size() < kFewest) {
    throw UsageError("--weights \"" + words.weights +
                     "\" has fewer than two different weights, which a calibration needs; add one, "
                     "such as \"20 g, 50 g\"");
  }
}

WeightReadings readings_on_rig(const RigConfig& rig, const CalibrateWords& asked, double capacity_N,
                               Streams& streams) {
  CalibrateWords words = asked;
  if (words.is_emulated && words.masses_kg.empty()) {
    words.weights = "50 g, 100 g, 150 g, 200 g";
    words.masses_kg = {0.05, 0.1, 0.15, 0.2};
  }
  check_weights(words, capacity_N);
  std::unique_ptr<EmulatedRig> emulated;
  if (words.is_emulated) {
    emulated = std::make_unique<EmulatedRig>(
        EmulatedRigOptions{.truth = calibrate_truth(words), .config = rig});
  }
  return weigh_on(rig, words, emulated.get(), streams);
}

}  // namespace

DescribedResult result_of_load_cell() {
  return {"calibrate", "viscard calibrate", {[](ResultVisitor& v) {
            show_keys(v, CellCalibration{}, "");
          }}};
}

int calibrate_load_cell(const CalibrateWords& words, Streams& streams) {
  const bool has_rig = words.rig_file || !words.data_file;
  const RigConfig rig = has_rig ? calibrate_rig(words) : RigConfig{};
  CalibrationRequest request = words.request;
  if (request.capacity_N == 0.0) request.capacity_N = rig.calibration.capacity_N;
  if (!(request.capacity_N > 0.0)) {
    throw UsageError("calibrate needs --capacity, the rated load of the cell, such as \"250 gf\"");
  }
  if (words.data_file) request.where = *words.data_file + ": ";
  const bool reads_volts = !has_rig || !reading_span(rig.load_cell).is_in_newton;
  refuse_idle<UsageError>(
      {{"--span", request.span_V.has_value(), reads_volts, "a load cell that is read in volts"}});
  const WeightReadings readings = words.data_file
                                      ? readings_of_table(words, request, streams)
                                      : readings_on_rig(rig, words, request.capacity_N, streams);
  const CellCalibration cell = calibrated_cell(readings, request, has_rig ? &rig : nullptr);
  write_file(words.out_file, toml_from_calibration(cell.record), words.overwrite);
  if (words.as_json) {
    const auto show = [&](ResultVisitor& v) { show_keys(v, cell, words.out_file); };
    print_result({"viscard-calibrate/1", inputs_of(words)}, show, streams, -1);
  } else {
    print_text(cell, words.out_file, FittedText(streams));
  }
  return kDone;
}

}  // namespace viscard
