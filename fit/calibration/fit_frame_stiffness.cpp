#include "fit/calibration/fit_frame_stiffness.h"

#include "models/experiment/motion_profile.h"
#include "models/experiment/sample_force.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace viscard {

FrameStiffnessFit fit_frame_stiffness(const BlockPoints& points, double gain_relative_u) {
  const std::size_t n = points.force_N.size();
  if (n < 3 || points.position_m.size() != n) {
    throw std::invalid_argument(
        "a frame stiffness needs at least three points of position and "
        "force in contact, but there are " +
        std::to_string(n));
  }
  const auto count = static_cast<double>(n);
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += points.force_N[i] / count;
    mean_y += points.position_m[i] / count;
  }
  double sum_xx = 0.0, sum_xy = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = points.force_N[i] - mean_x;
    sum_xx += dx * dx;
    sum_xy += dx * (points.position_m[i] - mean_y);
  }
  if (!(sum_xx > 0.0) || !(sum_xy > 0.0)) {
    throw std::invalid_argument(
        "the position does not grow with the force. Does the punch press on the block, and is "
        "toward_specimen of the rig file right?");
  }
  const double compliance_m_N = sum_xy / sum_xx;
  FrameStiffnessFit fit;
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double residual_m =
        points.position_m[i] - mean_y - compliance_m_N * (points.force_N[i] - mean_x);
    squares += residual_m * residual_m;
    fit.curvature_m = std::max(fit.curvature_m, std::abs(residual_m));
  }
  double noise_m2 = squares / (count - 2.0);
  for (const double se_N : points.force_se_N) {
    noise_m2 = std::max(noise_m2, compliance_m_N * se_N * compliance_m_N * se_N);
  }
  const double regression = std::sqrt(noise_m2 / sum_xx) / compliance_m_N;
  fit.stiffness_N_m = 1.0 / compliance_m_N;
  fit.relative_u = std::hypot(regression, gain_relative_u);
  fit.low_N_m = fit.stiffness_N_m * (1.0 - 2.0 * fit.relative_u);
  fit.high_N_m = fit.stiffness_N_m * (1.0 + 2.0 * fit.relative_u);
  fit.n_points = static_cast<int>(n);
  return fit;
}

BlockPoints block_points_from_capture(const CapturedRun& run) {
  constexpr double kFirstPart = 0.25;  // share of each hold to leave out: motion ends, frame rings
  std::vector<StageMove> moves;
  for (const CommandedMove& move : run.moves) moves.push_back(move.move);
  BlockPoints points;
  for (std::size_t e = 0; e + 1 < run.events.size(); ++e) {
    const RunEvent& event = run.events[e];
    if (event.name != "phase" || event.value.rfind("hold", 0) != 0) continue;
    double end_s = event.host_time_s;
    for (std::size_t next = e + 1; next < run.events.size(); ++next) {
      if (run.events[next].name != "phase") continue;
      end_s = run.events[next].host_time_s;
      break;
    }
    const double from_s = event.host_time_s + kFirstPart * (end_s - event.host_time_s);
    double sum = 0.0, squares = 0.0;
    int n = 0;
    for (const LoadSample& sample : run.load_samples) {
      if (sample.host_time_s < from_s || sample.host_time_s > end_s) continue;
      const auto force_N = force_N_from_sample(sample, run.rig);
      if (sample.is_glitch || sample.is_saturated || !force_N) continue;
      sum += *force_N;
      squares += *force_N * *force_N;
      ++n;
    }
    if (n < 5 || moves.empty()) continue;
    const double variance = std::max(0.0, squares - sum * sum / n) / (n - 1);
    points.force_N.push_back(sum / n);
    points.force_se_N.push_back(std::sqrt(variance / n));
    points.position_m.push_back(position_m(moves, 0.5 * (from_s + end_s)));
  }
  if (points.force_N.empty()) {
    throw std::runtime_error(
        "the run has no 'hold' phases with readings, so it is not a compliance run");
  }
  return points;
}

}  // namespace viscard
