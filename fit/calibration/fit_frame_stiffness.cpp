#include "fit/calibration/fit_frame_stiffness.h"

#include "models/experiment/motion_profile.h"
#include "models/experiment/sample_force.h"
#include "models/maths/distributions.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

constexpr std::size_t kFewestForSeating = 5;
constexpr double kLongestSeating = 0.5;  // F_s over the largest force
constexpr double kSeatingStep = 1.15;    // of F_s in its search
constexpr double kWorst = 0.2;           // half of the interval of 1/k, relative
constexpr double kBentShare = 0.1;       // largest deviation from the line over the whole motion
constexpr double kSeatedShare = 0.1;     // seating over the whole motion
constexpr double kMostSeating_m = 10e-6;
constexpr double kStiffening = 0.03;  // change of the compliance over the upper half of the forces

// Position over force, from a least-squares fit with or without a settling part.
struct Compliance {
  double per_N = 0.0;     // m/N
  double variance = 0.0;  // of per_N, for a variance of 1 of each position
  double squares = 0.0;   // of the residuals
  double seating_m = 0.0, seating_variance = 0.0;
  double largest_residual_m = 0.0;
};

// seating: its shape at each force, or empty.
Compliance compliance_of(const BlockPoints& points, const std::vector<double>& seating) {
  const std::size_t n = points.force_N.size();
  const auto count = static_cast<double>(n);
  const bool has_seating = !seating.empty();
  double mean_x = 0.0, mean_y = 0.0, mean_z = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += points.force_N[i] / count;
    mean_y += points.position_m[i] / count;
    if (has_seating) mean_z += seating[i] / count;
  }
  double xx = 0.0, xy = 0.0, xz = 0.0, zz = 0.0, zy = 0.0;
  const auto x = [&](std::size_t i) { return points.force_N[i] - mean_x; };
  const auto y = [&](std::size_t i) { return points.position_m[i] - mean_y; };
  const auto z = [&](std::size_t i) { return has_seating ? seating[i] - mean_z : 0.0; };
  for (std::size_t i = 0; i < n; ++i) {
    xx += x(i) * x(i);
    xy += x(i) * y(i);
    xz += x(i) * z(i);
    zz += z(i) * z(i);
    zy += z(i) * y(i);
  }
  Compliance found;
  const double determinant = has_seating ? xx * zz - xz * xz : xx;
  found.seating_m = has_seating ? (xx * zy - xz * xy) / determinant : 0.0;
  found.per_N = (xy - xz * found.seating_m) / xx;
  found.variance = has_seating ? zz / determinant : 1.0 / xx;
  found.seating_variance = has_seating ? xx / determinant : 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double rest = y(i) - found.per_N * x(i) - found.seating_m * z(i);
    found.squares += rest * rest;
    found.largest_residual_m = std::max(found.largest_residual_m, std::abs(rest));
  }
  return found;
}

// The line and every settling part that is not negative.
std::vector<Compliance> candidates(const BlockPoints& points) {
  std::vector<Compliance> all{compliance_of(points, {})};
  if (points.force_N.size() < kFewestForSeating) return all;
  const auto [low, high] = std::minmax_element(points.force_N.begin(), points.force_N.end());
  const double range_N = *high - *low;
  const double longest_N = kLongestSeating * std::max(*high, range_N);
  for (double scale_N = 0.02 * range_N; scale_N <= longest_N; scale_N *= kSeatingStep) {
    std::vector<double> seating;
    for (const double force_N : points.force_N) {
      seating.push_back(-std::exp(-(force_N - *low) / scale_N));
    }
    const Compliance found = compliance_of(points, seating);
    if (found.seating_m >= 0.0 && std::isfinite(found.per_N)) all.push_back(found);
  }
  return all;
}

}  // namespace

namespace {

// A frame on a rigid block gives way in proportion to the force; a soft specimen, or a way in air, does not.
// The settling part follows the course of a round or tilted contact, too, so a large one is none.
void refuse_bent(const Compliance& line, double seating_m, double motion_m) {
  const bool is_seated = seating_m > std::min(kSeatedShare * motion_m, kMostSeating_m);
  if (!is_seated && line.largest_residual_m <= kBentShare * motion_m) return;
  const auto um = [](double length_m) { return text_of(1e6 * length_m, 3) + " um"; };
  throw std::runtime_error(
      (is_seated ? "the block settled by " + um(seating_m) + " (seating)"
                 : "the positions leave a straight line by " + um(line.largest_residual_m)) +
      " of a motion of " + um(motion_m) + "; at most " +
      text_of(100.0 * (is_seated ? kSeatedShare : kBentShare), 2) + " %" +
      (is_seated ? " and " + um(kMostSeating_m) : "") +
      " is allowed: this is no frame on a rigid block. Clamp a block that rocks or is not seated; "
      "is a soft or round specimen under the punch, or do the readings begin out of contact? Give "
      "positions and forces in contact with a block of steel or glass");
}

// Settling ends under the first forces; a contact that stiffens does so to the largest one.
// noise_m2: variance of a position; t: how many standard errors count.
void refuse_stiffening(const BlockPoints& points, double noise_m2, double t) {
  const auto [low, high] = std::minmax_element(points.force_N.begin(), points.force_N.end());
  const double half_N = 0.5 * (*high - *low);
  BlockPoints upper;
  std::vector<double> square;
  for (std::size_t i = 0; i < points.force_N.size(); ++i) {
    const double above_N = points.force_N[i] - *high + half_N;
    if (above_N < 0.0) continue;
    upper.force_N.push_back(points.force_N[i]);
    upper.position_m.push_back(points.position_m[i]);
    square.push_back((above_N - 0.5 * half_N) * (above_N - 0.5 * half_N));
  }
  if (upper.force_N.size() < 3) return;
  const Compliance bent = compliance_of(upper, square);
  const double change = -2.0 * half_N * bent.seating_m;
  const double u = 2.0 * half_N * std::sqrt(bent.seating_variance * noise_m2);
  if (!(change - 2.0 * t * u > kStiffening * bent.per_N)) return;
  throw std::runtime_error(
      "the contact stiffens by " + text_of(100.0 * change / bent.per_N, 2) +
      " % over the upper half of the forces; at most " + text_of(100.0 * kStiffening, 2) +
      " % is allowed: the block is not seated (its seating does not end), or it is no stiff block. "
      "Clamp it, press it once with the full force, and measure again");
}

}  // namespace

FrameStiffnessFit fit_frame_stiffness(const BlockPoints& points, double gain_relative_u) {
  const std::size_t n = points.force_N.size();
  if (n < 3 || points.position_m.size() != n) {
    throw std::invalid_argument(
        "a frame stiffness needs at least three points of position and "
        "force in contact, but there are " +
        std::to_string(n));
  }
  const auto range = std::minmax_element(points.force_N.begin(), points.force_N.end());
  if (!(*range.second > *range.first)) {
    throw std::invalid_argument(
        "the force is the same at every position, so the points show no stiffness. Does the punch "
        "press on the block, and does the load cell measure?");
  }
  const std::vector<Compliance> all = candidates(points);
  const Compliance& line = all.front();
  if (!(line.per_N > 0.0) || !std::isfinite(line.per_N)) {
    throw std::invalid_argument(
        "the position does not grow with the force. Does the punch press on the block, and is "
        "toward_specimen of the rig file right?");
  }
  const Compliance& best = *std::min_element(
      all.begin(), all.end(),
      [](const Compliance& a, const Compliance& b) { return a.squares < b.squares; });
  const auto count = static_cast<double>(n);
  const double freedom = std::max(1.0, count - (&best == &line ? 2.0 : 4.0));
  const auto [low_m, high_m] =
      std::minmax_element(points.position_m.begin(), points.position_m.end());
  const double rounding_m = 1e-9 * (*high_m - *low_m);
  double noise_m2 = std::max(best.squares / freedom, rounding_m * rounding_m);
  for (const double se_N : points.force_se_N) {
    noise_m2 = std::max(noise_m2, line.per_N * se_N * line.per_N * se_N);
  }
  const double t = student_t_975(freedom);
  const auto rise = [&](const Compliance& one) { return (one.squares - best.squares) / noise_m2; };
  double low = best.per_N, high = best.per_N;
  for (const Compliance& one : all) {
    if (rise(one) > t * t) continue;
    const double half = std::sqrt((t * t - rise(one)) * noise_m2 * one.variance);
    low = std::min(low, one.per_N - half);
    high = std::max(high, one.per_N + half);
  }
  FrameStiffnessFit fit;
  fit.seating_m = rise(line) > t * t ? best.seating_m : 0.0;
  refuse_bent(line, fit.seating_m, *high_m - *low_m);
  refuse_stiffening(points, noise_m2, t);
  const double middle = 0.5 * (low + high);
  const double half_width = 0.5 * (high - low) / middle;
  if (!(half_width < kWorst && middle > 0.0)) {
    throw std::runtime_error(
        (fit.seating_m > 0.0 ? "the block settled by about " + text_of(1e6 * fit.seating_m, 2) +
                                   " um under the first forces (seating)"
                             : "the positions leave a straight line by up to " +
                                   text_of(1e6 * line.largest_residual_m, 2) +
                                   " um (seating of the block, or a stage with coarse steps)") +
        ", so the stiffness is unknown by " + text_of(100.0 * half_width, 2) +
        " %; at most 20 % is allowed. Clean block and table, press the block once with the full "
        "force, and measure again with more steps");
  }
  fit.stiffness_N_m = 1.0 / middle;
  fit.relative_u = std::hypot(0.5 * half_width, gain_relative_u);
  fit.low_N_m = fit.stiffness_N_m * (1.0 - 2.0 * fit.relative_u);
  fit.high_N_m = fit.stiffness_N_m * (1.0 + 2.0 * fit.relative_u);
  fit.curvature_m = line.largest_residual_m;
  fit.n_points = static_cast<int>(n);
  return fit;
}

BlockPoints block_points_from_capture(const CapturedRun& run) {
  if (run.plan.protocol != "compliance") {
    throw std::runtime_error("this is a run with protocol '" + run.plan.protocol +
                             "' on the specimen '" + run.specimen.id +
                             "', not one on a rigid block (protocol 'compliance'). Measure with: "
                             "viscard calibrate --compliance --rig FILE");
  }
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
