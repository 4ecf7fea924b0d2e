#include "fit/curves/step_model.h"

#include "fit/samples/clean_data.h"
#include "fit/samples/decay.h"
#include "fit/samples/sample_passes.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The autocorrelation is estimated from at most this many consecutive samples.
constexpr std::size_t kLongSeries = 8192;
// Averages in log time for long records, otherwise one bin per sample.
std::vector<LogBin> bins_for(std::span<const double> time_s, std::span<const double> value,
                             const FitOptions& options) {
  const bool is_alone = time_s.size() <= kSmallRecord || options.full_data;
  return log_bins(time_s, value, is_alone ? 0.0 : kBinsPerDecade);
}

// The bins with the noise of their values.
std::vector<LogBin> weighed(std::vector<LogBin> bins, const ReadingNoise& noise) {
  if (!noise.grows) return bins;
  std::vector<double> values, counts;
  for (const LogBin& bin : bins) {
    values.push_back(bin.value);
    counts.push_back(bin.count);
  }
  const std::vector<double> sigmas = relative_sigmas(noise, values, counts);
  for (std::size_t i = 0; i < bins.size(); ++i) bins[i].sigma = sigmas[i];
  return bins;
}

}  // namespace

// Buffers for some samples, few enough to stay in the cache.
struct StepModel::SampleChunk {
  static constexpr std::size_t kMost = 1024;
  explicit SampleChunk(Index n_terms)
      : residual(kMost), decays(kMost, n_terms), n_decays(static_cast<std::size_t>(n_terms)) {}

  Eigen::VectorXd residual;
  Eigen::MatrixXd decays;             // exponentials of each term ...
  std::vector<std::size_t> n_decays;  // ... and how many of them are above zero
};

StepModel::StepModel(std::span<const double> time_s, std::span<const double> value, StepShape shape,
                     const FitOptions& options, const ReadingNoise& noise,
                     const std::optional<Cycle>& cycle)
    : time_s_(time_s),
      value_(value),
      shape_(shape),
      bins_(weighed(bins_for(time_s, value, options), noise)),
      arrays_(bins_),
      shapes_(bins_),
      sample_variance_(variance_within(bins_)),
      is_weighed_(noise.grows),
      is_liquid_(options.is_liquid),
      cycle_(cycle) {
  set_rows();
  with_constant_ = shape == StepShape::kCreep || !is_liquid_;
  if (with_constant_) common_.push_back({shape == StepShape::kCreep ? "J_g" : "E_inf", false});
  const bool has_fluidity = shape == StepShape::kCreep && is_liquid_;
  const bool has_drift = shape == StepShape::kRelaxation && options.drift == TableDrift::kFitted;
  if (has_fluidity) common_.push_back({"fluidity", false});
  if (has_drift) common_.push_back({kDriftName, true});
  if (has_fluidity || has_drift) line_ = n_common() - 1;
  if (cycle_) {
    first_cycle_ = n_common();
    for (const char* name : {"cycle_cos", "cycle_sin", "cycle_frequency"}) {
      common_.push_back({name, true});
    }
  }
  may_be_negative_ = options.allow_negative;

  // Times may lie outside sampling and record by a factor of three. The lower end keeps exp(-3) of
  // a term at the first sample; the modulus of a faster term would be undetermined.
  sampling_s_ = shortest_step_s(time_s_);
  ln_tau_min_ = std::log(std::max(time_s_.front(), sampling_s_) / 3.0);
  ln_tau_max_ = std::log(time_s_.back() * 3.0);
}

// The same model with wider bins. The information within these bins is dropped.
StepModel::StepModel(const StepModel& fine, double bins_per_decade)
    : SpectralModel(fine),
      time_s_(fine.time_s_),
      value_(fine.value_),
      sampling_s_(fine.sampling_s_),
      shape_(fine.shape_),
      bins_(merged_bins(fine.bins_, bins_per_decade)),
      arrays_(bins_),
      shapes_({}),
      sample_variance_(fine.sample_variance_),
      is_weighed_(fine.is_weighed_),
      is_liquid_(fine.is_liquid_),
      with_constant_(fine.with_constant_),
      cycle_(fine.cycle_),
      first_cycle_(fine.first_cycle_),
      line_(fine.line_) {
  set_rows();
}

void StepModel::set_rows() {
  data_.resize(static_cast<Index>(bins_.size()));
  for (Index i = 0; i < data_.size(); ++i) {
    data_[i] = arrays_.weight[i] * bins_[static_cast<std::size_t>(i)].value;
  }
  has_averages_ = bins_.size() < time_s_.size();
  if (!cycle_) return;
  const double w = 2.0 * std::numbers::pi * cycle_->frequency_Hz;
  const double amplitude = cycle_->amplitude(), last_s = time_s_.back();
  cycle_rows_ = Eigen::MatrixXd::Zero(data_.size(), 3);
  for (Index row = 0; row < data_.size(); ++row) {
    const LogBin& bin = bins_[static_cast<std::size_t>(row)];
    for (std::size_t i = bin.begin; i < bin.end; ++i) {
      const double t = time_s_[i], c = std::cos(w * t), s = std::sin(w * t);
      const double turned = (cycle_->sine * c - cycle_->cosine * s) / amplitude;
      cycle_rows_.row(row) += Eigen::RowVector3d(c, s, t / last_s * turned);
    }
    cycle_rows_.row(row) *= arrays_.weight[row] / bin.count;
  }
}

ModelColumns StepModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                                bool with_slopes) const {
  const Index n_terms = ln_tau.size();
  const bool is_creep = shape_ == StepShape::kCreep;
  ModelColumns out;
  out.values.resize(n_rows(), n_common() + n_terms);
  if (with_slopes) out.term_slopes.resize(n_rows(), n_terms);
  if (with_constant_) out.values.col(0) = arrays_.weight.matrix();
  if (line_ >= 0) out.values.col(line_) = (arrays_.weight * arrays_.time_s).matrix();
  if (first_cycle_ >= 0) out.values.middleCols(first_cycle_, 3) = cycle_rows_;
  const DecayPlaces places = arrays_.places(has_averages_);
  for (Index i = 0; i < n_terms; ++i) {
    auto value = out.values.col(n_common() + i);
    decay_column(places, std::exp(-ln_tau[i]), value.data(),
                 with_slopes ? out.term_slopes.col(i).data() : nullptr);
    if (is_creep) value = arrays_.weight.matrix() - value;  // 1 - exp
  }
  if (is_creep && with_slopes) out.term_slopes *= -1.0;
  return out;
}

std::vector<std::size_t> StepModel::row_begins() const {
  std::vector<std::size_t> begins;
  for (const LogBin& bin : bins_) begins.push_back(bin.begin);
  begins.push_back(time_s_.size());
  return begins;
}

Eigen::VectorXd StepModel::relative_sigma() const {
  Eigen::VectorXd sigma(n_rows());
  for (Index i = 0; i < sigma.size(); ++i) sigma[i] = bins_[static_cast<std::size_t>(i)].sigma;
  return sigma;
}

Eigen::VectorXd StepModel::row_sigma() const {
  if (!is_weighed_) return {};
  return arrays_.weight.inverse().matrix();
}

Eigen::VectorXd StepModel::in_unit_of_samples(const Eigen::VectorXd& rows) const {
  return rows.cwiseProduct(relative_sigma());
}

double StepModel::hidden_rss(const SpectralState& state) const {
  return squares_within(state, /*in_unit=*/false);
}

double StepModel::hidden_rss_in_unit(const SpectralState& state) const {
  return squares_within(state, /*in_unit=*/true);
}

double StepModel::squares_within(const SpectralState& state, bool in_unit) const {
  double within = 0.0;
  for (const LogBin& bin : bins_) {
    within += bin.count * bin.value_m2 / (in_unit ? 1.0 : bin.sigma * bin.sigma);
  }
  const Index n = shapes_.n_rows();
  if (n == 0) return within;
  // The known shapes contribute their residual; the rest of the variation within bins is unchanged.
  Eigen::VectorXd residual = shapes_.data(), column(n);
  const bool is_creep = shape_ == StepShape::kCreep;
  if (line_ >= 0) residual -= state.coefficients[line_] * shapes_.line();
  for (Index i = 0; i < state.n_terms(); ++i) {
    shapes_.decay(std::exp(-state.ln_tau[i]), column, nullptr);
    residual -= (is_creep ? -1.0 : 1.0) * state.coefficients[n_common() + i] * column;
  }
  if (!in_unit || !is_weighed_) {
    return within - shapes_.data().squaredNorm() + residual.squaredNorm();
  }
  // The rows of shapes are those of the bins with more than one sample, three times.
  std::vector<double> sigma;
  for (const LogBin& bin : bins_) {
    if (bin.m2 > 0.0) sigma.push_back(bin.sigma);
  }
  for (Index i = 0; i < n; ++i) {
    const double one = sigma[static_cast<std::size_t>(i) % sigma.size()];
    within += one * one * (residual[i] * residual[i] - std::pow(shapes_.data()[i], 2));
  }
  return within;
}

SpectralModel::HiddenRows StepModel::hidden_rows(const Eigen::VectorXd& ln_tau) const {
  const Index n = shapes_.n_rows();
  HiddenRows out;
  out.data = shapes_.data();
  out.columns.values = Eigen::MatrixXd::Zero(n, n_common() + ln_tau.size());
  out.columns.term_slopes.resize(n, ln_tau.size());
  const bool is_creep = shape_ == StepShape::kCreep;
  if (line_ >= 0) out.columns.values.col(line_) = shapes_.line();
  Eigen::VectorXd slope;
  for (Index i = 0; i < ln_tau.size(); ++i) {
    shapes_.decay(std::exp(-ln_tau[i]), out.columns.values.col(n_common() + i), &slope);
    out.columns.term_slopes.col(i) = slope;
  }
  if (is_creep) {
    out.columns.values.rightCols(ln_tau.size()) *= -1.0;
    out.columns.term_slopes *= -1.0;
  }
  return out;
}

std::optional<SpectralModel::SampleSums> StepModel::sample_sums(const SpectralState& state) const {
  if (!has_averages_ || is_weighed_ || cycle_) return std::nullopt;
  SampleSums sums{0.0, Eigen::VectorXd::Zero(state.coefficients.size() + state.n_terms())};
  SampleChunk chunk(state.n_terms());
  for (std::size_t begin = 0; begin < time_s_.size(); begin += SampleChunk::kMost) {
    const std::size_t count = std::min(SampleChunk::kMost, time_s_.size() - begin);
    add_samples(begin, count, state, chunk, sums);
  }
  return sums;
}

void StepModel::add_samples(std::size_t begin, std::size_t count, const SpectralState& state,
                            SampleChunk& chunk, SampleSums& sums) const {
  const double* time_s = time_s_.data() + begin;
  const Eigen::Map<const Eigen::VectorXd> time(time_s, static_cast<Index>(count));
  const bool is_creep = shape_ == StepShape::kCreep;
  const double sign = is_creep ? -1.0 : 1.0;  // of an exponential
  const auto moduli = state.coefficients.tail(state.n_terms());
  double constant = with_constant_ ? state.coefficients[0] : 0.0;
  if (is_creep) constant += moduli.sum();
  auto residual = chunk.residual.head(static_cast<Index>(count));
  residual =
      Eigen::Map<const Eigen::VectorXd>(value_.data() + begin, residual.size()).array() - constant;
  if (line_ >= 0) residual -= state.coefficients[line_] * time;
  for (Index i = 0; i < state.n_terms(); ++i) {
    chunk.n_decays[static_cast<std::size_t>(i)] =
        subtract_and_keep_decay(time_s, count, std::exp(-state.ln_tau[i]), sign * moduli[i],
                                residual.data(), chunk.decays.col(i).data());
  }
  const std::span<const double> left(residual.data(), count);
  const double sum = sum_of(left);
  sums.rss += dot_of(left, left);
  if (with_constant_) sums.descent[0] += sum;
  if (line_ >= 0) sums.descent[line_] += residual.dot(time);
  for (Index i = 0; i < state.n_terms(); ++i) {
    const DecayProducts products =
        decay_products(residual.data(), chunk.decays.col(i).data(), time_s,
                       chunk.n_decays[static_cast<std::size_t>(i)]);
    sums.descent[n_common() + i] += (is_creep ? sum : 0.0) + sign * products.plain;
    sums.descent[n_common() + state.n_terms() + i] +=
        sign * moduli[i] * std::exp(-state.ln_tau[i]) * products.with_time;
  }
}

std::unique_ptr<SpectralModel> StepModel::coarse() const {
  constexpr double kCoarsePerDecade = 20.0;
  constexpr std::size_t kFew = 120;
  if (!has_averages_ || bins_.size() < kFew) return nullptr;
  return std::unique_ptr<SpectralModel>(new StepModel(*this, kCoarsePerDecade));
}

Eigen::VectorXd StepModel::residual_series(const SpectralState& state) const {
  // The end of a long record, where the model is smooth and the sampling is even.
  const std::size_t count = std::min(time_s_.size(), kLongSeries);
  const std::size_t first = time_s_.size() - count;
  const double* time_s = time_s_.data() + first;
  Eigen::VectorXd series =
      Eigen::Map<const Eigen::VectorXd>(value_.data() + first, static_cast<Index>(count));
  const bool is_creep = shape_ == StepShape::kCreep;
  double constant = with_constant_ ? state.coefficients[0] : 0.0;
  if (is_creep) constant += state.coefficients.tail(state.n_terms()).sum();
  series.array() -= constant;
  if (line_ >= 0) {
    series -= state.coefficients[line_] * Eigen::Map<const Eigen::VectorXd>(time_s, series.size());
  }
  for (Index i = 0; i < state.n_terms(); ++i) {
    const double modulus = state.coefficients[n_common() + i];
    subtract_decay(time_s, count, std::exp(-state.ln_tau[i]), is_creep ? -modulus : modulus,
                   series.data());
  }
  if (!is_weighed_) return series;
  for (const LogBin& bin : bins_) {
    for (std::size_t i = std::max(bin.begin, first); i < bin.end; ++i) {
      series[static_cast<Index>(i - first)] /= bin.sigma;
    }
  }
  return series;
}

}  // namespace viscard
