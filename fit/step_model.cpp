#include "fit/step_model.h"

#include "fit/clean_data.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Below this many samples averaging gains nothing.
constexpr std::size_t kSmallRecord = 2000;
constexpr double kBinsPerDecade = 60.0;
// Autocorrelation is taken from at most this many consecutive samples.
constexpr std::size_t kLongSeries = 8192;
constexpr double kGone = 100.0;  // exp(-100) is nothing

// exp(-x) of ascending x, computed only where it is neither 1 nor nothing beside 1.
void decays(const Eigen::ArrayXd& x, Eigen::ArrayXd& value) {
  constexpr double kNotYet = 1e-17;
  constexpr double kNegligible = 80.0;  // exp(-80) = 2e-35
  const Index begin = std::upper_bound(x.begin(), x.end(), kNotYet) - x.begin();
  const Index end = std::lower_bound(x.begin() + begin, x.end(), kNegligible) - x.begin();
  value.head(begin).setOnes();
  value.segment(begin, end - begin) = (-x.segment(begin, end - begin)).exp();
  value.tail(x.size() - end).setZero();
}

// Of d^2 - m2 - d m3/m2, d = t - mean: what is left of d^2 beside a mean and a slope. Two samples
// have none.
double norm_of_bend(const LogBin& bin) {
  const double square = bin.m4 - bin.m2 * bin.m2 - bin.m3 * bin.m3 / bin.m2;
  return square > 1e-9 * bin.m4 ? std::sqrt(square) : 0.0;
}

// Scatter within bins about a parabola; a smooth curve adds nothing to it.
double variance_within(const std::vector<LogBin>& bins) {
  double square = 0.0, freedom = 0.0;
  for (const LogBin& bin : bins) {
    if (bin.count < 6.0 || !(bin.m2 > 0.0)) continue;
    const double norm = norm_of_bend(bin);
    const double bend = norm > 0.0 ? (bin.c2 - bin.c1 * bin.m3 / bin.m2) / norm : 0.0;
    square += bin.count * (bin.value_m2 - bin.c1 * bin.c1 / bin.m2 - bend * bend);
    freedom += bin.count - 3.0;
  }
  return freedom > 0.0 ? std::max(0.0, square / freedom) : 0.0;
}

}  // namespace

StepModel::StepModel(std::span<const double> time_s, std::span<const double> value, StepShape shape,
                     const FitOptions& options)
    : time_s_(time_s), value_(value), shape_(shape), is_liquid_(options.is_liquid) {
  const bool is_small = time_s_.size() <= kSmallRecord;
  bins_ = log_bins(time_s_, value_, is_small || options.full_data ? 0.0 : kBinsPerDecade);
  sample_variance_ = variance_within(bins_);
  keep_arrays();
  with_constant_ = shape == StepShape::kCreep || !is_liquid_;
  if (with_constant_) common_.push_back({shape == StepShape::kCreep ? "J_g" : "E_inf", false});
  if (shape == StepShape::kCreep && is_liquid_) common_.push_back({"fluidity", false});
  may_be_negative_ = options.allow_negative;

  // Times below the sampling or beyond the record are still allowed by a factor of three, but none
  // of which less than exp(-3) is left at the first sample: its modulus could be anything.
  sampling_s_ = shortest_step_s(time_s_);
  ln_tau_min_ = std::log(std::max(time_s_.front(), sampling_s_) / 3.0);
  ln_tau_max_ = std::log(time_s_.back() * 3.0);
}

void StepModel::keep_arrays() {
  const auto count = static_cast<Index>(bins_.size());
  for (Eigen::ArrayXd* array : {&bin_time_s_, &m2_, &m3_, &m4_, &weight_}) array->resize(count);
  data_.resize(count);
  for (Index i = 0; i < count; ++i) {
    const LogBin& bin = bins_[static_cast<std::size_t>(i)];
    bin_time_s_[i] = bin.time_s;
    m2_[i] = bin.m2;
    m3_[i] = bin.m3;
    m4_[i] = bin.m4;
    weight_[i] = std::sqrt(bin.count);
    data_[i] = weight_[i] * bin.value;
  }
  has_averages_ = bins_.size() < time_s_.size();
}

ModelColumns StepModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                                bool with_slopes) const {
  const Index n_terms = ln_tau.size();
  const bool is_creep = shape_ == StepShape::kCreep;
  ModelColumns out;
  out.values.resize(n_rows(), n_common() + n_terms);
  if (with_slopes) out.term_slopes.resize(n_rows(), n_terms);
  if (with_constant_) out.values.col(0) = weight_.matrix();
  if (is_creep && is_liquid_) out.values.col(1) = (weight_ * bin_time_s_).matrix();
  Eigen::ArrayXd x(n_rows()), value(n_rows()), slope = Eigen::ArrayXd::Zero(n_rows());
  for (Index i = 0; i < n_terms; ++i) {
    // As average_exponential(), for all bins at once.
    const double u = std::exp(-ln_tau[i]);
    x = u * bin_time_s_;
    decays(x, value);
    value *= weight_;
    if (has_averages_) {
      const double uu = u * u;
      if (with_slopes) {
        slope = x + uu * (0.5 * x * m2_ - m2_) - uu * u * (x * m3_ / 6.0 - 0.5 * m3_) +
                uu * uu * (x * m4_ / 24.0 - m4_ / 6.0);
        slope *= value;
      }
      value *= 1.0 + uu * (0.5 * m2_) - uu * u * (m3_ / 6.0) + uu * uu * (m4_ / 24.0);
    } else if (with_slopes) {
      slope = x * value;
    }
    if (is_creep) {  // 1 - exp
      value = weight_ - value;
      slope = -slope;
    }
    out.values.col(n_common() + i) = value.matrix();
    if (with_slopes) out.term_slopes.col(i) = slope.matrix();
  }
  return out;
}

std::vector<std::size_t> StepModel::row_begins() const {
  std::vector<std::size_t> begins;
  for (const LogBin& bin : bins_) begins.push_back(bin.begin);
  begins.push_back(time_s_.size());
  return begins;
}

double StepModel::hidden_rss(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                             const Eigen::VectorXd& coefficients) const {
  double within = 0.0;
  for (const LogBin& bin : bins_) within += bin.count * bin.value_m2;
  const HiddenRows hidden = hidden_rows(ln_tau);
  // What is in the shapes that hidden_rows() knows goes by its residual, the rest as it is.
  return within - hidden.data.squaredNorm() +
         (hidden.data - hidden.columns.values * coefficients).squaredNorm();
}

SpectralModel::HiddenRows StepModel::hidden_rows(const Eigen::VectorXd& ln_tau) const {
  // Data and model within a bin against its first two orthogonal polynomials,
  //   P1 = d/sqrt(m2), P2 = (d^2 - m2 - d m3/m2)/norm, d = t - mean;  <exp P1> to third order in d.
  const double sign = shape_ == StepShape::kCreep ? -1.0 : 1.0;
  const auto n_bins =
      std::count_if(bins_.begin(), bins_.end(), [](const LogBin& bin) { return bin.m2 > 0.0; });
  HiddenRows out;
  out.data = Eigen::VectorXd::Zero(2 * n_bins);
  out.columns.values = Eigen::MatrixXd::Zero(2 * n_bins, n_common() + ln_tau.size());
  out.columns.term_slopes = Eigen::MatrixXd::Zero(2 * n_bins, ln_tau.size());
  Index row = 0;
  for (const LogBin& bin : bins_) {
    if (!(bin.m2 > 0.0)) continue;
    const double root = std::sqrt(bin.m2);
    const double norm = norm_of_bend(bin);
    const double weight = std::sqrt(bin.count);
    out.data[row] = weight * bin.c1 / root;
    if (norm > 0.0) out.data[row + 1] = weight * (bin.c2 - bin.c1 * bin.m3 / bin.m2) / norm;
    if (shape_ == StepShape::kCreep && is_liquid_) out.columns.values(row, 1) = weight * root;
    for (Index i = 0; i < ln_tau.size(); ++i) {
      const double u = std::exp(-ln_tau[i]);
      const double x = u * bin.time_s;
      const double e = sign * weight * std::exp(-x);
      const double a = 0.5 * bin.m3 / bin.m2, b = bin.m4 / (6.0 * bin.m2);
      const double first = e * root * u * (-1.0 + u * (a - u * b));
      const double second = 0.5 * e * u * u * norm;
      const Index column = n_common() + i;
      out.columns.values(row, column) = first;
      out.columns.values(row + 1, column) = second;
      out.columns.term_slopes(row, i) =
          x * first + e * root * u * (1.0 - u * (2.0 * a - 3.0 * u * b));
      out.columns.term_slopes(row + 1, i) = (x - 2.0) * second;
    }
    row += 2;
  }
  return out;
}

std::unique_ptr<SpectralModel> StepModel::coarse() const {
  constexpr double kCoarsePerDecade = 20.0;
  constexpr std::size_t kFew = 120;
  if (!has_averages_ || bins_.size() < kFew) return nullptr;
  auto model = std::make_unique<StepModel>(*this);
  model->bins_ = merged_bins(bins_, kCoarsePerDecade);
  model->keep_arrays();
  return model;
}

Eigen::VectorXd StepModel::residual_series(const Eigen::VectorXd& ln_tau,
                                           const Eigen::VectorXd& /*nuisance*/,
                                           const Eigen::VectorXd& coefficients) const {
  // The end of a long record, where the model is smooth and the sampling even.
  const std::size_t count = std::min(time_s_.size(), kLongSeries);
  const std::size_t first = time_s_.size() - count;
  const Eigen::Map<const Eigen::ArrayXd> time(time_s_.data() + first, static_cast<Index>(count));
  const Eigen::Map<const Eigen::ArrayXd> value(value_.data() + first, static_cast<Index>(count));
  Eigen::ArrayXd series = value;
  if (with_constant_) series -= coefficients[0];
  const bool is_creep = shape_ == StepShape::kCreep;
  if (is_creep && is_liquid_) series -= coefficients[1] * time;
  for (Index i = 0; i < ln_tau.size(); ++i) {
    const double modulus = coefficients[n_common() + i];
    const double rate_1_s = std::exp(-ln_tau[i]);
    if (is_creep) {
      series -= modulus * (1.0 - (-rate_1_s * time).exp());
    } else if (rate_1_s * time[0] < kGone) {
      series -= modulus * (-rate_1_s * time).exp();
    }
  }
  return series.matrix();
}

}  // namespace viscard
