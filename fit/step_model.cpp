#include "fit/step_model.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Below this many samples averaging gains nothing.
constexpr std::size_t kSmallRecord = 2000;
constexpr double kBinsPerDecade = 60.0;
// Autocorrelation is taken from at most this many consecutive samples.
constexpr std::size_t kLongSeries = 16384;

}  // namespace

StepModel::StepModel(const std::vector<double>& time_s, const std::vector<double>& value,
                     StepShape shape, const FitOptions& options)
    : time_s_(time_s), value_(value), shape_(shape), is_liquid_(options.is_liquid) {
  const bool is_small = time_s_.size() <= kSmallRecord;
  bins_ = log_bins(time_s_, value_, is_small || options.full_data ? 0.0 : kBinsPerDecade);
  data_.resize(static_cast<Index>(bins_.size()));
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    data_[static_cast<Index>(i)] = std::sqrt(bins_[i].count) * bins_[i].value;
  }
  with_constant_ = shape == StepShape::kCreep || !is_liquid_;
  if (with_constant_) common_.push_back({shape == StepShape::kCreep ? "J_g" : "E_inf", false});
  if (shape == StepShape::kCreep && is_liquid_) common_.push_back({"fluidity", false});
  may_be_negative_ = options.allow_negative;

  // Times below the first sample or beyond the record are still allowed by a factor of three.
  const double longest_s = time_s_.back();
  double shortest_s = longest_s;
  for (std::size_t i = 0; i < time_s_.size(); ++i) {
    const double step_s = i == 0 ? time_s_[0] : time_s_[i] - time_s_[i - 1];
    if (step_s > 0.0) shortest_s = std::min(shortest_s, step_s);
  }
  ln_tau_min_ = std::log(shortest_s / 3.0);
  ln_tau_max_ = std::log(longest_s * 3.0);
}

ModelColumns StepModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                                bool with_slopes) const {
  const Index n_terms = ln_tau.size();
  ModelColumns out;
  out.values.resize(n_rows(), n_common() + n_terms);
  if (with_slopes) out.term_slopes.resize(n_rows(), n_terms);
  const bool is_creep = shape_ == StepShape::kCreep;
  std::vector<double> tau_s;
  for (const double ln : ln_tau) tau_s.push_back(std::exp(ln));
  for (Index row = 0; row < n_rows(); ++row) {
    const LogBin& bin = bins_[static_cast<std::size_t>(row)];
    const double weight = std::sqrt(bin.count);
    if (with_constant_) out.values(row, 0) = weight;
    if (is_creep && is_liquid_) out.values(row, 1) = weight * bin.time_s;
    for (Index i = 0; i < n_terms; ++i) {
      const BinExponential e = average_exponential(bin, tau_s[static_cast<std::size_t>(i)]);
      out.values(row, n_common() + i) = weight * (is_creep ? 1.0 - e.value : e.value);
      if (with_slopes) out.term_slopes(row, i) = weight * (is_creep ? -e.slope : e.slope);
    }
  }
  return out;
}

std::vector<std::size_t> StepModel::row_begins() const {
  std::vector<std::size_t> begins;
  for (const LogBin& bin : bins_) begins.push_back(bin.begin);
  begins.push_back(time_s_.size());
  return begins;
}

double StepModel::value_at(double time_s, const Eigen::VectorXd& ln_tau,
                           const Eigen::VectorXd& coefficients) const {
  double value = with_constant_ ? coefficients[0] : 0.0;
  if (shape_ == StepShape::kCreep && is_liquid_) value += coefficients[1] * time_s;
  for (Index i = 0; i < ln_tau.size(); ++i) {
    const double decay = std::exp(-time_s / std::exp(ln_tau[i]));
    value += coefficients[n_common() + i] * (shape_ == StepShape::kCreep ? 1.0 - decay : decay);
  }
  return value;
}

double StepModel::hidden_rss(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                             const Eigen::VectorXd& coefficients) const {
  const double sign = shape_ == StepShape::kCreep ? -1.0 : 1.0;
  double sum = 0.0;
  for (const LogBin& bin : bins_) {
    if (bin.count == 1.0) continue;
    // The model about its mean in the bin: slope * d + bend * (d^2 - m2).
    double slope = shape_ == StepShape::kCreep && is_liquid_ ? coefficients[1] : 0.0;
    double bend = 0.0;
    for (Index i = 0; i < ln_tau.size(); ++i) {
      const double u = std::exp(-ln_tau[i]);
      const double e = sign * coefficients[n_common() + i] * std::exp(-bin.time_s * u);
      slope -= e * u;
      bend += 0.5 * e * u * u;
    }
    sum += bin.count *
           (bin.value_m2 - 2.0 * (slope * bin.c1 + bend * bin.c2) + slope * slope * bin.m2 +
            2.0 * slope * bend * bin.m3 + bend * bend * (bin.m4 - bin.m2 * bin.m2));
  }
  return sum;
}

Eigen::VectorXd StepModel::residual_series(const Eigen::VectorXd& ln_tau,
                                           const Eigen::VectorXd& /*nuisance*/,
                                           const Eigen::VectorXd& coefficients) const {
  // The end of a long record, where the model is smooth and the sampling even.
  const std::size_t count = std::min(time_s_.size(), kLongSeries);
  const std::size_t first = time_s_.size() - count;
  Eigen::VectorXd series(static_cast<Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    series[static_cast<Index>(i)] =
        value_[first + i] - value_at(time_s_[first + i], ln_tau, coefficients);
  }
  return series;
}

}  // namespace viscard
