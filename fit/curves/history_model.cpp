#include "fit/curves/history_model.h"

#include "fit/samples/clean_data.h"
#include "fit/samples/log_bins.h"
#include "models/maths/branch_step.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr Index kLongHistory = 16384;

// Depth from contact, to the power of the tip.
double powered(double depth, double power) {
  if (power == 1.0) return depth;
  return depth > 0.0 ? std::pow(depth, power) : 0.0;
}
double powered_slope(double depth, double power) {
  if (power == 1.0) return 1.0;
  return depth > 0.0 ? power * std::pow(depth, power - 1.0) : 0.0;
}

}  // namespace

std::size_t end_of_loading(const std::vector<double>& input) {
  const auto [low, high] = std::minmax_element(input.begin(), input.end());
  const double nearly = *high - 0.02 * (*high - *low);
  return static_cast<std::size_t>(
      std::find_if(input.begin(), input.end(), [&](double x) { return x >= nearly; }) -
      input.begin());
}

HistoryModel::HistoryModel(HistoryInput input, const FitOptions& options) : in_(std::move(input)) {
  const std::size_t count = in_.time_s.size();
  with_equilibrium_ = in_.is_creep || !options.is_liquid;
  with_flow_ = in_.is_creep && options.is_liquid;
  may_be_negative_ = options.allow_negative;
  const bool is_small = count <= kSmallRecord || options.full_data;
  const double ratio = std::pow(10.0, 1.0 / kBinsPerDecade);
  const double zero_s = in_.step_s.value_or(in_.time_s[in_.contact]);
  // Samples of loading, and the first ones after it, are rows of their own.
  if (!in_.loaded) in_.loaded = end_of_loading(in_.input);
  const double loaded_s = zero_s + 1.5 * (in_.time_s[*in_.loaded] - zero_s);
  const auto has_moved = [&](std::size_t i) { return !in_.has_moved.empty() && in_.has_moved[i]; };
  double clock_s = zero_s;
  for (std::size_t begin = 0; begin < count;) {
    std::size_t end = begin + 1;
    if (has_moved(begin)) clock_s = in_.time_s[begin];
    if (!is_small && in_.time_s[begin] > loaded_s) {
      const double limit_s = clock_s + (in_.time_s[begin] - clock_s) * ratio;
      while (end < count && in_.time_s[end] < limit_s && !has_moved(end)) ++end;
    }
    row_begin_.push_back(begin);
    begin = end;
  }
  row_begin_.push_back(count);
  const std::size_t n_rows = row_begin_.size() - 1;
  data_.resize(static_cast<Index>(n_rows));
  for (std::size_t r = 0; r < n_rows; ++r) {
    const auto n = static_cast<double>(row_begin_[r + 1] - row_begin_[r]);
    double time = 0.0;
    double mean = 0.0;
    for (std::size_t i = row_begin_[r]; i < row_begin_[r + 1]; ++i) {
      time += in_.time_s[i] / n;
      mean += in_.output[i] / n;
    }
    row_time_s_.push_back(time);
    data_[static_cast<Index>(r)] = std::sqrt(n) * mean;
  }
  if (with_equilibrium_) common_.push_back({in_.is_creep ? "J_g" : "E_inf", false});
  if (with_flow_) common_.push_back({"fluidity", false});
  if (in_.with_offset) common_.push_back({"offset", true});
  if (in_.with_drift) common_.push_back({kDriftName, true});
  if (in_.contact_input) {
    const double width = in_.contact_half_width;
    nuisances_.push_back({"contact_m", *in_.contact_input, *in_.contact_input - width,
                          *in_.contact_input + width, 0.1 * width});
  }
  const double longest_s = in_.time_s.back() - zero_s;
  const double shortest_s = shortest_step_s(std::span(in_.time_s).subspan(in_.contact));
  ln_tau_min_ = std::log((shortest_s > 0.0 ? shortest_s : longest_s) / 3.0);
  ln_tau_max_ = std::log(longest_s * 3.0);
}

double loading_s(const HistoryInput& input) {
  if (input.step_s) return 0.0;
  const std::size_t end = end_of_loading(input.input);
  double fastest = 0.0;
  for (std::size_t i = input.contact + 1; i <= end; ++i) {
    const double dt_s = input.time_s[i] - input.time_s[i - 1];
    if (dt_s > 0.0) fastest = std::max(fastest, (input.input[i] - input.input[i - 1]) / dt_s);
  }
  const double whole_s = input.time_s[end] - input.time_s[std::min(input.contact, end)];
  const double rise = input.input[end] - input.input[std::min(input.contact, end)];
  return fastest > 0.0 ? std::min(whole_s, rise / fastest) : whole_s;
}

bool begins_under_load(double first, std::span<const double> input) {
  constexpr double kLoaded = 0.5;
  double largest = 0.0;
  for (const double one : input) {
    if (std::isfinite(one)) largest = std::max(largest, std::abs(one));
  }
  return largest > 0.0 && std::abs(first) >= kLoaded * largest;
}

std::optional<double> step_before(const std::vector<double>& time_s,
                                  const std::vector<double>& input) {
  if (time_s.size() < 2 || input.front() == 0.0 || !(time_s.front() > 0.0)) return std::nullopt;
  if (time_s.front() > kLatestStep * (time_s.back() - time_s.front())) return std::nullopt;
  // A ramp that the record shows from its first sample on is not a step.
  if (!begins_under_load(input.front(), input)) return std::nullopt;
  return 0.0;
}

double sharpest_jump_s(const HistoryInput& input) {
  constexpr double kLarge = 0.5, kAlone = 0.2;
  double largest = 0.0, shortest_s = 0.0;
  const auto change = [&](std::size_t i) {  // into row i
    return i > 0 && i < input.input.size() ? std::abs(input.input[i] - input.input[i - 1]) : 0.0;
  };
  for (std::size_t i = 1; i < input.input.size(); ++i) largest = std::max(largest, change(i));
  for (std::size_t i = 1; i < input.input.size(); ++i) {
    if (change(i) == 0.0 || change(i) < kLarge * largest) continue;
    if (std::max(change(i - 1), change(i + 1)) > kAlone * change(i)) continue;
    const double jump_s = input.time_s[i] - input.time_s[i - 1];
    if (shortest_s == 0.0 || jump_s < shortest_s) shortest_s = jump_s;
  }
  return shortest_s;
}

HistoryModel::Onset HistoryModel::onset_at(double contact_input) const {
  if (!in_.contact_input) {
    return {in_.contact, in_.step_s.value_or(in_.time_s[in_.contact]), 0.0};
  }
  // The last crossing of the contact position before the input stays above it.
  Onset onset{*in_.loaded, 0.0, contact_input};
  const auto surface = [&](std::size_t k) {
    return contact_input + value_at(in_.touch, in_.time_s[k]);
  };
  while (onset.first > 0 && in_.input[onset.first - 1] > surface(onset.first - 1)) --onset.first;
  const std::size_t first = onset.first;
  onset.time_s = in_.time_s[first];
  if (first > 0 && in_.input[first] > in_.input[first - 1]) {
    const double before = surface(first - 1) - in_.input[first - 1];
    const double share =
        before / (in_.input[first] - in_.input[first - 1] - surface(first) + surface(first - 1));
    onset.time_s = in_.time_s[first - 1] + share * (in_.time_s[first] - in_.time_s[first - 1]);
  }
  onset.depth = value_at(in_.touch, onset.time_s);
  return onset;
}

void HistoryModel::fill_equilibrium(const Onset& onset, Column into) const {
  for (std::size_t k = onset.first; k < in_.time_s.size(); ++k) {
    if (is_free(k)) continue;  // the columns are zero
    const double depth = in_.input[k] - onset.input;
    into.value[k] = in_.factor * powered(depth, in_.power);
    if (into.by_contact != nullptr) {
      into.by_contact[k] = -in_.factor * powered_slope(depth, in_.power);
    }
  }
}

// The integral of the input over time.
void HistoryModel::fill_flow(const Onset& onset, double* value) const {
  double previous_s = onset.time_s, sum = 0.0;
  double previous = in_.step_s ? in_.input[onset.first] : 0.0;
  for (std::size_t k = onset.first; k < in_.time_s.size(); ++k) {
    sum += 0.5 * (previous + in_.input[k]) * (in_.time_s[k] - previous_s);
    previous_s = in_.time_s[k];
    previous = in_.input[k];
    value[k] = sum;
  }
}

// Recursion over the samples, optionally with the derivatives with respect to ln tau and contact
// position.
void HistoryModel::fill_term(const Onset& onset, double tau_s, Column into) const {
  const double c = in_.factor;
  StepsOfBranch steps(tau_s, into.by_ln_tau != nullptr);
  BranchState q;
  double q_by_contact = 0.0;  // used for spheres and cones
  double previous_s = onset.time_s, previous = onset.depth, previous_slope = 0.0;
  if (!in_.touch.empty()) q = left_by(in_.touch, onset.time_s, tau_s);
  if (in_.step_s) q.value = previous = powered(in_.input[onset.first] - onset.input, in_.power);
  for (std::size_t k = onset.first; k < in_.time_s.size(); ++k) {
    const BranchStep& step = steps.of(in_.time_s[k] - previous_s);
    const double depth = in_.input[k] - onset.input;
    const double value = powered(depth, in_.power);
    q.advance(step, value - previous);
    if (into.by_ln_tau != nullptr) into.by_ln_tau[k] = is_free(k) ? 0.0 : c * q.slope;
    previous_s = in_.time_s[k];
    previous = value;
    if (is_free(k)) continue;
    into.value[k] = c * q.value;
    if (into.by_contact == nullptr) continue;
    if (in_.power == 1.0) {
      into.by_contact[k] = -c * std::exp(-(in_.time_s[k] - onset.time_s) / tau_s);
      continue;
    }
    const double next_slope = -powered_slope(depth, in_.power);
    q_by_contact = step.decay * q_by_contact + step.gain * (next_slope - previous_slope);
    previous_slope = next_slope;
    into.by_contact[k] = c * q_by_contact;
  }
}

ModelColumns HistoryModel::sample_columns(const Eigen::VectorXd& ln_tau,
                                          const Eigen::VectorXd& nuisance, bool with_slopes) const {
  const auto count = static_cast<Index>(in_.time_s.size());
  const Index n_terms = ln_tau.size();
  ModelColumns out;
  out.values = Eigen::MatrixXd::Zero(count, n_common() + n_terms);
  if (with_slopes) {
    out.term_slopes = Eigen::MatrixXd::Zero(count, n_terms);
    out.nuisance_slopes.assign(static_cast<std::size_t>(n_nuisances()),
                               Eigen::MatrixXd::Zero(count, n_common() + n_terms));
  }
  const auto by_contact = [&](Index column) {
    return out.nuisance_slopes.empty() ? nullptr : out.nuisance_slopes[0].col(column).data();
  };
  const Onset onset = onset_at(in_.contact_input ? nuisance[0] : 0.0);
  Index column = 0;
  if (with_equilibrium_) {
    fill_equilibrium(onset, {out.values.col(column).data(), nullptr, by_contact(column)});
    ++column;
  }
  if (with_flow_) fill_flow(onset, out.values.col(column++).data());
  if (in_.with_offset) out.values.col(column++).setOnes();
  if (in_.with_drift) {
    for (Index k = 0; k < count; ++k) {
      out.values(k, column) = in_.time_s[static_cast<std::size_t>(k)] - in_.time_s[in_.contact];
    }
  }
  for (Index i = 0; i < n_terms; ++i) {
    const Index of_term = n_common() + i;
    fill_term(onset, std::exp(ln_tau[i]),
              {out.values.col(of_term).data(),
               with_slopes ? out.term_slopes.col(i).data() : nullptr, by_contact(of_term)});
    if (in_.is_creep) out.values.col(of_term) = out.values.col(0) - out.values.col(of_term);
  }
  if (in_.is_creep && with_slopes) out.term_slopes *= -1.0;
  return out;
}

Eigen::MatrixXd HistoryModel::averaged(const Eigen::MatrixXd& samples) const {
  Eigen::MatrixXd rows(n_rows(), samples.cols());
  for (Index r = 0; r < n_rows(); ++r) {
    const auto begin = static_cast<Index>(row_begin_[static_cast<std::size_t>(r)]);
    const auto size = static_cast<Index>(row_begin_[static_cast<std::size_t>(r) + 1]) - begin;
    rows.row(r) =
        samples.middleRows(begin, size).colwise().sum() / std::sqrt(static_cast<double>(size));
  }
  return rows;
}

ModelColumns HistoryModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                                   bool with_slopes) const {
  ModelColumns out = sample_columns(ln_tau, nuisance, with_slopes);
  if (static_cast<std::size_t>(n_rows()) == in_.time_s.size()) return out;
  out.values = averaged(out.values);
  if (with_slopes) {
    out.term_slopes = averaged(out.term_slopes);
    for (Eigen::MatrixXd& slopes : out.nuisance_slopes) slopes = averaged(slopes);
  }
  return out;
}

Eigen::VectorXd HistoryModel::fitted_samples(const SpectralState& state) const {
  return sample_columns(state.ln_tau, state.nuisance, /*with_slopes=*/false).values *
         state.coefficients;
}

Eigen::VectorXd HistoryModel::residual(const SpectralState& state) const {
  const Eigen::Map<const Eigen::VectorXd> output(in_.output.data(),
                                                 static_cast<Index>(in_.output.size()));
  return output - fitted_samples(state);
}

double HistoryModel::hidden_rss(const SpectralState& state) const {
  if (static_cast<std::size_t>(n_rows()) == in_.time_s.size()) return 0.0;
  const Eigen::VectorXd left = residual(state);
  return left.squaredNorm() - averaged(left).squaredNorm();
}

Eigen::VectorXd HistoryModel::residual_series(const SpectralState& state) const {
  const Eigen::VectorXd left = residual(state);
  return left.tail(std::min(kLongHistory, left.size()));
}

}  // namespace viscard
