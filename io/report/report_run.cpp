#include "io/report/report_figures.h"
#include "models/experiment/sample_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr double kLatency_s = 0.5;  // every controller begins a move within this time
constexpr double kClear_m = 5e-6;   // at this distance the punch does not touch

// Position of the stage over time: from its moves, or else interpolated between its reports.
class StagePath {
 public:
  StagePath(const CapturedRun& run, const std::vector<double>& motion_start_s)
      : reports_(run.stage_reports) {
    for (const CommandedMove& move : run.moves) moves_.push_back(move.move);
    for (const double start_s : motion_start_s) put_nearest_at(start_s);
  }

  double at(double time_s) const {
    if (!moves_.empty()) return position_m(moves_, time_s);
    if (reports_.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto later = std::upper_bound(
        reports_.begin(), reports_.end(), time_s,
        [](double t, const StageReport& report) { return t < report.host_time_s; });
    if (later == reports_.begin()) return later->position_m;
    const StageReport& before = *std::prev(later);
    if (later == reports_.end()) return before.position_m;
    const double span_s = later->host_time_s - before.host_time_s;
    const double share = span_s > 0.0 ? (time_s - before.host_time_s) / span_s : 1.0;
    return before.position_m + share * (later->position_m - before.position_m);
  }

 private:
  void put_nearest_at(double start_s) {
    const auto apart_s = [&](const StageMove& move) {
      return std::abs(move.start_time_s - start_s);
    };
    const auto nearest = std::min_element(
        moves_.begin(), moves_.end(),
        [&](const StageMove& a, const StageMove& b) { return apart_s(a) < apart_s(b); });
    if (nearest != moves_.end() && apart_s(*nearest) < kLatency_s) nearest->start_time_s = start_s;
  }

  const std::vector<StageReport>& reports_;
  std::vector<StageMove> moves_;
};

std::vector<double> depths(const CapturedRun& run, const RunSeries& series, double contact_m,
                           const std::vector<double>& motion_start_s) {
  const StagePath path(run, motion_start_s);
  std::vector<double> above_m;
  double sum_V = 0.0;
  std::size_t n_clear = 0;
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    above_m.push_back(path.at(series.time_s[i]) - contact_m);
    if (!(above_m.back() < -kClear_m)) continue;
    sum_V += series.volts[i];
    ++n_clear;
  }
  const LoadCellCalibration& calibration = run.rig.calibration;
  const double zero_V = n_clear > 0 ? sum_V / static_cast<double>(n_clear) : calibration.zero_volts;
  const double stiffness_N_m = run.rig.frame.stiffness_N_m;
  const double gain_V_N =
      (run.rig.load_cell.compression_is_positive ? 1.0 : -1.0) * calibration.volts_per_newton;
  std::vector<double> depth_m;
  for (std::size_t i = 0; i < above_m.size(); ++i) {
    const double force_N = (series.volts[i] - zero_V) / gain_V_N;
    const bool is_yielding = stiffness_N_m > 0.0 && std::isfinite(force_N);
    depth_m.push_back(above_m[i] - (is_yielding ? force_N / stiffness_N_m : 0.0));
  }
  return depth_m;
}

}  // namespace

double volts_of(const LoadSample& sample, const RigConfig& rig) {
  if (const auto reading = reading_from_sample(sample, rig.load_cell)) return *reading;
  return std::numeric_limits<double>::quiet_NaN();
}

RunSeries series_from_run(const CapturedRun& run, std::optional<double> contact_position_m,
                          const std::vector<double>& motion_start_s) {
  RunSeries series;
  for (const LoadSample& sample : run.load_samples) {
    const double volts = volts_of(sample, run.rig);
    if (!std::isfinite(volts)) continue;
    series.is_force = series.is_force || sample.force_N.has_value();
    const bool is_flagged = sample.is_saturated || sample.is_glitch;
    (is_flagged ? series.flagged_s : series.time_s).push_back(sample.host_time_s);
    (is_flagged ? series.flagged_V : series.volts).push_back(volts);
  }
  for (const StageReport& report : run.stage_reports) {
    series.report_s.push_back(report.host_time_s);
    series.position_m.push_back(report.position_m);
  }
  if (contact_position_m) series.depth_m = depths(run, series, *contact_position_m, motion_start_s);
  for (const RunEvent& event : run.events) {
    if (event.name == "phase") series.phases.push_back({event.host_time_s, event.value});
  }
  return series;
}

}  // namespace viscard
