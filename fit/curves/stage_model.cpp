#include "fit/curves/stage_model.h"

#include "fit/curves/stage_response.h"
#include "fit/samples/clean_data.h"
#include "fit/samples/contact_onset.h"
#include "fit/samples/median.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// A stage with a crystal keeps its speed within 0.01 %, GRBL's timer within 0.1 % (it rounds a
// period of a thousand cycles or more up by at most one), and a ceramic resonator within 0.5 %
// (Murata CSTCE, tolerance and temperature together).
constexpr double kSpeedSd = 2e-3;
constexpr double kLargestSpeedError = 1e-2;

double median_force_N(const IndentationData& data, double from_s, double to_s, double otherwise) {
  std::vector<double> values;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] >= from_s && data.time_s[i] <= to_s) values.push_back(data.force_N[i]);
  }
  return values.empty() ? otherwise : median(std::move(values));
}

// First time after from_s at which the force crosses a level, by linear interpolation.
double crossing_s(const IndentationData& data, double from_s, double level_N, bool rising) {
  for (std::size_t i = 1; i < data.time_s.size(); ++i) {
    if (data.time_s[i] < from_s) continue;
    const double before = data.force_N[i - 1] - level_N;
    const double after = data.force_N[i] - level_N;
    if (rising ? (before < 0.0 && after >= 0.0) : (before > 0.0 && after <= 0.0)) {
      const double share = before / (before - after);
      return data.time_s[i - 1] + share * (data.time_s[i] - data.time_s[i - 1]);
    }
  }
  throw std::runtime_error(
      "the force does not follow the " + std::string(rising ? "ramp" : "unloading") +
      ": it never passes half its change. Check the clock of the amplifier and "
      "the moves in the capture");
}

// When the punch meets the surface: at its position of rest, or where a touch has left it.
double contact_time_s(const StageMove& ramp, double contact_m, const Course& touch) {
  if (touch.empty()) return time_at_position_s(ramp, contact_m);
  double low = ramp.start_time_s, high = ramp.start_time_s + duration_s(ramp);
  const double direction = ramp.to_m >= ramp.from_m ? 1.0 : -1.0;
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    const double depth_m = direction * (position_m(ramp, middle) - contact_m);
    (depth_m < value_at(touch, middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

bool is_correction(const StageMove& move, const StageMove& ramp, double contact_m) {
  constexpr double kShareOfWay = 0.05;
  return std::abs(move.to_m - move.from_m) < kShareOfWay * std::abs(ramp.to_m - contact_m);
}

StageMove timed(StageMove move, double shift_s, double ln_speed) {
  const double speed = std::exp(ln_speed);
  move.start_time_s += shift_s;
  move.speed_m_s *= speed;
  move.acceleration_m_s2 *= speed * speed;
  return move;
}

Eigen::VectorXd nuisance_start(const IndentationData& data) {
  const auto n_moves = static_cast<Index>(data.moves.size());
  Eigen::VectorXd start = Eigen::VectorXd::Zero(n_moves + 2);
  const StageMove& ramp = data.moves.front();
  const double after_s = std::max(5.0 * usual_step_s(data.time_s), 0.02 * duration_s(ramp));
  const ContactOnset onset = contact_onset(data);
  start[n_moves] = onset.contact_m;
  start[0] = onset.shift_s;
  for (Index m = 1; m < n_moves; ++m) {
    const StageMove& move = data.moves[static_cast<std::size_t>(m)];
    if (is_correction(move, ramp, onset.contact_m)) {
      start[m] = onset.shift_s;
      continue;
    }
    const double begin_s = move.start_time_s - data.start_early_s;
    const double end_s = move.start_time_s + duration_s(move) + data.start_late_s;
    const double before_N = median_force_N(data, begin_s - 10.0 * after_s, begin_s, 0.0);
    const double after_N = median_force_N(data, end_s, end_s + after_s, 0.0);
    const double half_s = crossing_s(data, begin_s, 0.5 * (before_N + after_N), after_N > before_N);
    start[m] = half_s - time_at_position_s(move, 0.5 * (move.from_m + move.to_m));
    // A start that differs from that of the ramp by more than the uncertainty of two starts shows
    // that relaxation has shifted the middle of the force.
    const double unknown_s =
        data.start_early_s + data.start_late_s + 2.0 * usual_step_s(data.time_s);
    if (std::abs(start[m] - onset.shift_s) > unknown_s) start[m] = onset.shift_s;
  }
  return start;
}

StageModel::StageModel(const IndentationData& data, const Eigen::VectorXd& start,
                       const StageNoise& noise, const FitOptions& options, Course touch)
    : time_s_(data.time_s), moves_(data.moves), touch_(std::move(touch)) {
  set_up(data, usual_step_s(time_s_), start, noise, options);
}

StageModel::StageModel(const AveragedRun& run, const IndentationData& readings,
                       const Eigen::VectorXd& start, const StageNoise& noise,
                       const FitOptions& options, Course touch)
    : time_s_(run.rows.time_s), moves_(run.rows.moves), touch_(std::move(touch)) {
  if (run.has_averages()) {
    run_ = &run;
    readings_ = &readings;
  }
  set_up(run.rows, usual_step_s(readings.time_s), start, noise, options);
}

void StageModel::set_up(const IndentationData& data, double dt_s, const Eigen::VectorXd& start,
                        const StageNoise& noise, const FitOptions& options) {
  const std::size_t count = time_s_.size();
  const auto n_moves = static_cast<Index>(moves_.size());
  root_count_ = Eigen::VectorXd::Ones(static_cast<Index>(count));
  if (run_ != nullptr) {
    for (Index row = 0; row < root_count_.size(); ++row) {
      root_count_[row] = std::sqrt(run_->count(row));
    }
  }
  with_equilibrium_ = !options.is_liquid;
  may_be_negative_ = options.allow_negative;

  is_moving_.assign(count, false);
  is_out_of_contact_.assign(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    is_out_of_contact_[i] = time_s_[i] < data.contact_from_s || time_s_[i] > data.contact_to_s;
    for (Index m = 0; m < n_moves; ++m) {
      const StageMove move =
          timed(moves_[static_cast<std::size_t>(m)], start[m], start[n_moves + 1]);
      is_moving_[i] = is_moving_[i] || (time_s_[i] > move.start_time_s - dt_s &&
                                        time_s_[i] < move.start_time_s + duration_s(move) + dt_s);
    }
  }
  data_.resize(static_cast<Index>(count));
  sigma_N_.resize(static_cast<Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Index>(i);
    sigma_N_[row] = is_moving_[i] ? noise.moving_N : noise.resting_N;
    if (noise.of_stamps_N.size() > 0) {
      sigma_N_[row] = std::hypot(sigma_N_[row], noise.of_stamps_N[row]);
    }
    data_[row] = root_count_[row] * data.force_N[i] / sigma_N_[row];
  }

  if (with_equilibrium_) common_.push_back({"E_inf", false});
  common_.push_back({"offset_N", true});
  // Without samples out of contact after the test, drift and slow relaxation cannot be separated.
  with_drift_ = options.with_drift && !time_s_.empty() && time_s_.back() > data.contact_to_s;
  if (with_drift_) common_.push_back({"drift_N_s", true});
  if (with_drift_) common_.push_back({"creep_N_m_s", true});
  ramp_s_ = data.contact_from_s;

  // The delays of two moves differ by at most the start uncertainty of each.
  const double delay_sd_s = std::max(data.start_late_s / std::sqrt(6.0), 0.1 * dt_s);
  const StageMove& ramp = moves_.front();
  for (Index m = 0; m < n_moves; ++m) {
    nuisances_.push_back({"start_" + std::to_string(m + 1) + "_s", start[m], start[m] - 10.0 * dt_s,
                          start[m] + 10.0 * dt_s, dt_s});
    if (m == 0 || !is_correction(moves_[static_cast<std::size_t>(m)], ramp, start[n_moves]))
      continue;
    nuisances_.back().prior = start[0];
    nuisances_.back().prior_sd = delay_sd_s;
  }
  const double way_m = ramp.to_m - ramp.from_m;
  const double step_m = std::min(std::abs(way_m), ramp.speed_m_s * dt_s);
  // Contact may lie anywhere on the ramp, independent of the surface position that the rig assumed,
  // but not at its very end, which would leave no ramp.
  const double last_m = ramp.to_m - 1e-3 * way_m;
  nuisances_.push_back({"contact_m", start[n_moves], std::min(ramp.from_m, last_m),
                        std::max(ramp.from_m, last_m), step_m});
  nuisances_.push_back({"ln_speed", start[n_moves + 1], -kLargestSpeedError, kLargestSpeedError,
                        1e-3, /*prior=*/0.0, kSpeedSd});

  ln_tau_min_ = std::log(dt_s / 3.0);
  ln_tau_max_ = std::log(3.0 * (data.contact_to_s - data.contact_from_s));
}

// The moves with the nuisances applied, and the response of each branch to each move.
struct StageModel::Drive {
  std::vector<StageMove> moves;
  std::vector<StageResponse> responses;
  std::vector<std::vector<StageResponse::Branch>> branches;
  std::vector<double> tau_s;
  std::vector<BranchState> touch;  // of each branch, at contact
  double contact_m = 0.0, contact_s = 0.0;
  double direction = 1.0;
};

StageModel::Drive StageModel::drive(const Eigen::VectorXd& ln_tau,
                                    const Eigen::VectorXd& nuisance) const {
  const auto n_moves = static_cast<Index>(moves_.size());
  Drive drive;
  drive.contact_m = nuisance[n_moves];
  for (Index m = 0; m < n_moves; ++m) {
    drive.moves.push_back(
        timed(moves_[static_cast<std::size_t>(m)], nuisance[m], nuisance[n_moves + 1]));
    const StageMove& move = drive.moves.back();
    if (m == 0) drive.contact_s = contact_time_s(move, drive.contact_m, touch_);
    drive.responses.emplace_back(move, m == 0 ? drive.contact_s : move.start_time_s);
    std::vector<StageResponse::Branch>& branches = drive.branches.emplace_back();
    for (Index i = 0; i < ln_tau.size(); ++i) {
      branches.push_back(drive.responses.back().branch(std::exp(ln_tau[i])));
    }
  }
  for (Index i = 0; i < ln_tau.size(); ++i) {
    drive.tau_s.push_back(std::exp(ln_tau[i]));
    if (touch_.empty()) continue;
    drive.touch.push_back(left_by(touch_, drive.contact_s, drive.tau_s.back()));
  }
  drive.direction = drive.moves[0].to_m >= drive.moves[0].from_m ? 1.0 : -1.0;
  return drive;
}

// Adds a depth to the columns that are proportional to it: E_inf and creep.
void StageModel::add_depth(Eigen::MatrixXd& matrix, Index row, double depth_m) const {
  const Index offset = with_equilibrium_ ? 1 : 0;
  if (with_equilibrium_) matrix(row, 0) += depth_m;
  if (with_drift_) {
    matrix(row, offset + 2) += depth_m * (time_s_[static_cast<std::size_t>(row)] - ramp_s_);
  }
}

// Adds the effect of one move, which began before the sample, to the sample's row.
void StageModel::add_move(const Drive& drive, std::size_t m, Index row, bool with_slopes,
                          ModelColumns& out) const {
  const double t = time_s_[static_cast<std::size_t>(row)];
  const StageMove& move = drive.moves[m];
  const double from_m = m == 0 ? drive.contact_m : move.from_m;
  add_depth(out.values, row, drive.direction * (position_m(move, t) - from_m));
  Eigen::MatrixXd* shift = with_slopes ? &out.nuisance_slopes[m] : nullptr;
  Eigen::MatrixXd* speed = with_slopes ? &out.nuisance_slopes.back() : nullptr;
  const double since_s = t - move.start_time_s;
  if (with_slopes) {
    const double velocity = drive.direction * velocity_m_s(move, t);
    add_depth(*shift, row, -velocity);
    add_depth(*speed, row, since_s * velocity);
  }
  for (std::size_t i = 0; i < drive.branches[m].size(); ++i) {
    const BranchResponse response = drive.responses[m].at(drive.branches[m][i], t);
    const auto term = static_cast<Index>(i);
    out.values(row, n_common() + term) += drive.direction * response.value;
    if (shift == nullptr) continue;
    out.term_slopes(row, term) += drive.direction * response.slope;
    (*shift)(row, n_common() + term) -= drive.direction * response.rate_m_s;
    // A faster move is the same move on another scale of time, for which tau is longer.
    (*speed)(row, n_common() + term) +=
        drive.direction * (since_s * response.rate_m_s + response.slope);
  }
}

// Adds what the touch has left in the branches. The punch meets the surface with a continuous depth, so a change of
// contact, start or speed changes the branches as it does without a touch.
void StageModel::add_touch(const Drive& drive, Index row, bool with_slopes,
                           ModelColumns& out) const {
  const double since_s = time_s_[static_cast<std::size_t>(row)] - drive.contact_s;
  for (std::size_t i = 0; i < drive.touch.size(); ++i) {
    const double x = since_s / drive.tau_s[i], decay = std::exp(-x);
    const BranchState& left = drive.touch[i];
    const auto term = static_cast<Index>(i);
    out.values(row, n_common() + term) += decay * left.value;
    if (with_slopes) out.term_slopes(row, term) += decay * (x * left.value + left.slope);
  }
}

ModelColumns StageModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                                 bool with_slopes) const {
  const Index n_terms = ln_tau.size();
  const Index rows = n_rows();
  ModelColumns out;
  out.values = Eigen::MatrixXd::Zero(rows, n_common() + n_terms);
  if (with_slopes) {
    out.term_slopes = Eigen::MatrixXd::Zero(rows, n_terms);
    out.nuisance_slopes.assign(static_cast<std::size_t>(n_nuisances()),
                               Eigen::MatrixXd::Zero(rows, n_common() + n_terms));
  }
  const Drive moved = drive(ln_tau, nuisance);
  const Index offset = with_equilibrium_ ? 1 : 0;
  for (Index row = 0; row < rows; ++row) {
    const auto k = static_cast<std::size_t>(row);
    const double t = time_s_[k];
    out.values(row, offset) = 1.0;
    if (with_drift_) out.values(row, offset + 1) = t - ramp_s_;
    if (is_out_of_contact_[k] || !(t > moved.contact_s)) continue;
    for (std::size_t m = 0; m < moved.moves.size(); ++m) {
      if (t > moved.responses[m].from_s()) add_move(moved, m, row, with_slopes, out);
    }
    add_touch(moved, row, with_slopes, out);
    if (!with_slopes) continue;
    Eigen::MatrixXd& contact = out.nuisance_slopes[moved.moves.size()];
    add_depth(contact, row, -moved.direction);
    for (Index i = 0; i < n_terms; ++i) {
      contact(row, n_common() + i) =
          -moved.direction *
          std::exp(-(t - moved.contact_s) / moved.tau_s[static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::VectorXd weights = root_count_.cwiseQuotient(sigma_N_);
  const auto weight = weights.asDiagonal();
  out.values = weight * out.values;
  if (with_slopes) {
    out.term_slopes = weight * out.term_slopes;
    for (Eigen::MatrixXd& slopes : out.nuisance_slopes) slopes = weight * slopes;
  }
  return out;
}

std::vector<std::size_t> StageModel::row_begins() const {
  return run_ == nullptr ? SpectralModel::row_begins() : run_->begins;
}

double StageModel::n_samples() const {
  return static_cast<double>(run_ == nullptr ? time_s_.size() : run_->n_readings());
}

// By differences of neighbouring averages; the fitted force is smooth where there are any.
Eigen::VectorXd StageModel::slopes_N_s(const Eigen::VectorXd& fitted_N) const {
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(fitted_N.size());
  const auto is_average = [&](Index row) {
    return row >= 0 && row < slopes.size() && root_count_[row] > 1.0;
  };
  for (Index row = 0; row < slopes.size(); ++row) {
    if (!is_average(row)) continue;
    const auto is_beside = [&](Index other) {
      return is_average(other) && is_out_of_contact_[static_cast<std::size_t>(other)] ==
                                      is_out_of_contact_[static_cast<std::size_t>(row)];
    };
    const Index low = is_beside(row - 1) ? row - 1 : row, high = is_beside(row + 1) ? row + 1 : row;
    const double apart_s =
        time_s_[static_cast<std::size_t>(high)] - time_s_[static_cast<std::size_t>(low)];
    if (apart_s > 0.0) slopes[row] = (fitted_N[high] - fitted_N[low]) / apart_s;
  }
  return slopes;
}

Eigen::VectorXd StageModel::squares_within(const SpectralState& state) const {
  if (run_ == nullptr) return Eigen::VectorXd::Zero(n_rows());
  const Eigen::VectorXd slope = slopes_N_s(fitted(state).cwiseProduct(row_sigma()));
  const Eigen::ArrayXd mean = run_->force_square.array() -
                              2.0 * slope.array() * run_->product.array() +
                              slope.array().square() * run_->time_square.array();
  return (root_count_.array().square() * mean.max(0.0)).matrix();
}

double StageModel::hidden_rss(const SpectralState& state) const {
  return squares_within(state).cwiseQuotient(sigma_N_.cwiseAbs2()).sum();
}

double StageModel::hidden_rss_in_unit(const SpectralState& state) const {
  return squares_within(state).sum();
}

Eigen::VectorXd StageModel::reading_residuals_N(const SpectralState& state) const {
  const Eigen::VectorXd mean_N = (data() - fitted(state)).cwiseProduct(row_sigma());
  if (run_ == nullptr) return mean_N;
  const Eigen::VectorXd within = squares_within(state).cwiseQuotient(root_count_.cwiseAbs2());
  Eigen::VectorXd residual = (mean_N.cwiseAbs2() + within).cwiseSqrt();
  for (Index row = 0; row < residual.size(); ++row) {
    if (root_count_[row] == 1.0) residual[row] = mean_N[row];
  }
  return residual;
}

Eigen::VectorXd StageModel::residual_series(const SpectralState& state) const {
  if (run_ == nullptr) return SpectralModel::residual_series(state);
  // The last readings of the longest rest in contact, where the sampling is even.
  constexpr std::size_t kLongest = 16384;
  std::size_t first_row = 0, end_row = 0, begin = 0;
  for (std::size_t row = 0; row <= time_s_.size(); ++row) {
    const bool rests = row < time_s_.size() && !is_out_of_contact_[row] && !is_moving_[row];
    if (rests) continue;
    if (run_->begins[row] - run_->begins[begin] > run_->begins[end_row] - run_->begins[first_row]) {
      first_row = begin;
      end_row = row;
    }
    begin = row + 1;
    if (begin > time_s_.size()) break;
  }
  if (end_row == first_row) return SpectralModel::residual_series(state);
  const Eigen::VectorXd fitted_N = fitted(state).cwiseProduct(row_sigma());
  const Eigen::VectorXd slope = slopes_N_s(fitted_N);
  const std::size_t last = run_->begins[end_row];
  const std::size_t from = std::max(run_->begins[first_row], last > kLongest ? last - kLongest : 0);
  std::vector<double> left;
  for (std::size_t row = first_row; row < end_row; ++row) {
    const auto at = static_cast<Index>(row);
    for (std::size_t i = std::max(from, run_->begins[row]); i < run_->begins[row + 1]; ++i) {
      const double expected_N = fitted_N[at] + slope[at] * (readings_->time_s[i] - time_s_[row]);
      left.push_back((readings_->force_N[i] - expected_N) / sigma_N_[at]);
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(left.data(), static_cast<Index>(left.size()));
}

}  // namespace viscard
