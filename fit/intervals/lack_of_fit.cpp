#include "fit/intervals/lack_of_fit.h"

#include "fit/intervals/flags.h"
#include "fit/samples/noise_model.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Cheap test of the rows' residuals against independence, by neighbours and by sums of eight rows.
// It is passed by white noise; anything else is examined.
bool may_have_structure(const Eigen::VectorXd& residual) {
  const Index n = residual.size();
  const double total = residual.squaredNorm();
  if (!(total > 0.0)) return false;
  constexpr double kDeviations = 2.5;
  const auto count = static_cast<double>(n);
  const double neighbours = residual.head(n - 1).dot(residual.tail(n - 1));
  if (neighbours > kDeviations / std::sqrt(count) * total) return true;
  constexpr Index kRun = 8;
  constexpr double kFar = 5.0;  // for one sum
  const double variance = total / count * static_cast<double>(kRun);
  const Index whole_runs = n / kRun;
  const auto n_runs = static_cast<double>(whole_runs);
  double square = 0.0;
  for (Index begin = 0; begin + kRun <= n; begin += kRun) {
    const double sum = residual.segment(begin, kRun).sum();
    if (sum * sum > kFar * kFar * variance) return true;
    square += sum * sum;
  }
  return square > variance * (n_runs + kDeviations * std::sqrt(2.0 * n_runs));
}

Eigen::VectorXd grid_of_times(const SpectralModel& model, Index most) {
  constexpr double kPerDecade = 4.0;
  const double low = model.ln_tau_min(), high = model.ln_tau_max() + std::log(10.0 / 3.0);
  const auto wanted = static_cast<Index>(kPerDecade * (high - low) / std::log(10.0)) + 2;
  return Eigen::VectorXd::LinSpaced(std::clamp<Index>(wanted, 2, std::max<Index>(2, most)), low,
                                    high);
}

// Orthonormal columns that follow smooth curves, at most `most` of them, from the model's columns.
Eigen::MatrixXd smooth_basis(const SpectralModel& model, const SpectralState& state, Index most) {
  Eigen::MatrixXd columns =
      model.columns(grid_of_times(model, 2 * most), state.nuisance, /*with_slopes=*/false).values;
  for (Index j = 0; j < columns.cols(); ++j) {
    const double norm = columns.col(j).norm();
    if (norm > 0.0) columns.col(j) /= norm;
  }
  constexpr double kSmallest = 1e-8;  // of the largest eigenvalue; below it curves are not smooth
  const EigenSystem system = symmetric_eigen(gram_of(columns));
  const Index size = system.values.size();
  Index kept = 0;
  while (kept < std::min(size, most) &&
         system.values[size - 1 - kept] > kSmallest * system.values[size - 1]) {
    ++kept;
  }
  const Eigen::VectorXd scale = system.values.tail(kept).cwiseSqrt().cwiseInverse();
  return columns * (system.vectors.rightCols(kept) * scale.asDiagonal());
}

constexpr double kSmallStructure = 5e-3;  // of the data

// The stretch of rows, of a third of a decade or more, where the structure is largest.
void find_worst(const Eigen::VectorXd& structure, const Eigen::VectorXd& fitted,
                const std::vector<std::size_t>& begins, const std::vector<double>& row_time_s,
                double chance, LackOfFit& lack) {
  constexpr std::size_t kFewestRows = 5;
  constexpr double kRatio = 2.15;
  constexpr double kTimesNoise = 4.0;
  // The first few of many samples often show the settling of the instrument.
  constexpr double kLeastShare = 2e-4;
  double most = 0.0;
  for (std::size_t first = 0; first < row_time_s.size();) {
    double square = 0.0, size = 0.0;
    std::size_t end = first;
    while (end < row_time_s.size() &&
           (end < first + kFewestRows || row_time_s[end] < kRatio * row_time_s[first]) &&
           (end == first || row_time_s[end] >= row_time_s[end - 1])) {
      const auto row = static_cast<Index>(end);
      square += structure[row] * structure[row];
      size += fitted[row] * fitted[row];
      ++end;
    }
    const auto count = static_cast<double>(begins[end] - begins[first]);
    if (square <= chance) {
      first = end;
      continue;
    }
    const double relative = std::sqrt(square / std::max(size, 1e-300));
    // The last few storage moduli of a sweep are no stretch.
    const bool is_stretch = end - first >= kFewestRows || end == row_time_s.size();
    lack.is_far_above_noise |=
        is_stretch && count >= kLeastShare * static_cast<double>(begins.back()) &&
        square > std::pow(kTimesNoise * lack.noise, 2) * count && relative > kSmallStructure;
    if (square / count > most) {
      most = square / count;
      lack.worst = std::sqrt(most);
      lack.worst_relative = relative;
      lack.worst_from_s = row_time_s[first];
      lack.worst_to_s = row_time_s[end - 1];
    }
    first = end;
  }
}

// The largest rise of the smooth curve above its lowest value before, without the drift.
double rise_of(const Eigen::VectorXd& smooth, const std::vector<std::size_t>& begins,
               const std::vector<double>& row_time_s, double drift_per_s) {
  double lowest = std::numeric_limits<double>::infinity(), rise = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < row_time_s.size(); ++i) {
    const double root = std::sqrt(static_cast<double>(begins[i + 1] - begins[i]));
    const double value = smooth[static_cast<Index>(i)] / root - drift_per_s * row_time_s[i];
    lowest = std::min(lowest, value);
    rise = std::max(rise, value - lowest);
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0.0 ? rise / largest : 0.0;
}

// The last samples of a record without a curve that is known at its rows, which are averages:
// linear between their middles.
Eigen::VectorXd without_curve(Eigen::VectorXd series, const Eigen::VectorXd& curve,
                              const std::vector<std::size_t>& begins) {
  const auto middle = [&](std::size_t row) {
    return 0.5 * static_cast<double>(begins[row] + begins[row + 1] - 1);
  };
  const auto height = [&](std::size_t row) {
    return curve[static_cast<Index>(row)] /
           std::sqrt(static_cast<double>(begins[row + 1] - begins[row]));
  };
  const std::size_t n_rows = begins.size() - 1;
  const auto first = static_cast<double>(begins.back()) - static_cast<double>(series.size());
  std::size_t row = 0;
  for (Index i = 0; i < series.size(); ++i) {
    const double at = first + static_cast<double>(i);
    while (row + 2 < n_rows && middle(row + 1) < at) ++row;
    const double width = middle(row + 1) - middle(row);
    const double share = std::clamp((at - middle(row)) / width, 0.0, 1.0);
    series[i] -= (1.0 - share) * height(row) + share * height(row + 1);
  }
  return series;
}

// Standard deviation of one value about its neighbours, from differences.
double neighbours_noise(const Eigen::VectorXd& series) {
  const Index n = series.size();
  if (n < 2) return 0.0;
  return std::sqrt(0.5 * (series.tail(n - 1) - series.head(n - 1)).squaredNorm() /
                   static_cast<double>(n - 1));
}

// What is left beside the smooth curve is structure too if it is far above the noise between
// neighbours, and the memory of the residual is longer than the record or leaves fewer independent
// values than the fit has parameters.
struct Rest {
  double rms = 0.0, noise = 0.0;  // of one sample
  double n_independent = 0.0;
  double memory = 0.0;  // in records
};

bool is_structure(const Rest& rest, double n_parameters, double rms_of_data) {
  constexpr double kTimesNoise = 2.0;
  const bool is_remembered = rest.n_independent < n_parameters || rest.memory > 1.0;
  return is_remembered && rest.rms > kTimesNoise * rest.noise &&
         rest.rms > kSmallStructure * rms_of_data;
}

double drift_in(const SpectralModel& model, const SpectralState& state) {
  for (Index j = 0; j < model.n_common(); ++j) {
    if (model.common()[static_cast<std::size_t>(j)].name == kDriftName) {
      return state.coefficients[j];
    }
  }
  return 0.0;
}

std::string shown(double value) {
  return text_of(value, 3);
}

}  // namespace

std::optional<LackOfFit> lack_of_fit(const SpectralModel& model, const SpectralState& state,
                                     const std::vector<double>& row_time_s, double rss) {
  constexpr Index kFewestRows = 12;
  const Index n_rows = model.n_rows();
  const Index n_parameters = model.n_common() + 2 * state.n_terms() + model.n_nuisances();
  const Index most = (n_rows - n_parameters) / 2;
  if (n_rows < kFewestRows || most < 4) return std::nullopt;
  const Eigen::VectorXd fitted = model.fitted(state);
  const Eigen::VectorXd residual = model.data() - fitted;
  const double n_samples = model.n_samples();
  LackOfFit lack;
  lack.noise = std::sqrt(rss / std::max(1.0, n_samples - static_cast<double>(n_parameters)));
  if (!may_have_structure(residual)) return lack;

  const Eigen::MatrixXd basis = smooth_basis(model, state, most);
  const auto n_basis = static_cast<double>(basis.cols());
  const Eigen::VectorXd shares = basis.transpose() * residual;
  const Eigen::VectorXd structure = basis * shares;
  const Eigen::VectorXd rest = residual - structure;
  const double square = shares.squaredNorm();
  const double used = static_cast<double>(n_parameters) + n_basis;
  const double variance = (rss - square) / std::max(1.0, n_samples - used);
  const double of_rows = rest.squaredNorm() / std::max(1.0, static_cast<double>(n_rows) - used);
  const std::vector<std::size_t> begins = model.row_begins();
  const Eigen::VectorXd series = without_curve(model.residual_series(state), structure, begins);
  const double inflation = autoregression(series).inflation();
  const double chance = std::max(variance * inflation, of_rows);
  const double rms_of_data = fitted.norm() / std::sqrt(n_samples);
  const Rest left{std::sqrt(std::max(0.0, rss - square) / n_samples), neighbours_noise(series),
                  n_samples / inflation,
                  autoregression(model.residual_series(state)).memory() / n_samples};
  if (is_structure(left, static_cast<double>(n_parameters), rms_of_data)) {
    lack.structure = std::sqrt(rss / n_samples);
    lack.noise = left.noise;
    lack.relative = lack.structure / rms_of_data;
    lack.is_significant = lack.is_far_above_noise = true;
    return lack;
  }
  constexpr double kDeviations = 5.0;
  constexpr double kRounding = 1e-6;  // of the data; a smaller structure is that of rounded numbers
  lack.structure = std::sqrt(square / n_samples);
  lack.is_significant = square > chance * (n_basis + kDeviations * std::sqrt(2.0 * n_basis)) &&
                        square > kRounding * kRounding * fitted.squaredNorm();
  if (!lack.is_significant) return lack;
  lack.noise = std::sqrt(std::max(0.0, variance));
  lack.relative = std::sqrt(square / std::max(fitted.squaredNorm(), 1e-300));
  constexpr double kTimesNoise = 2.0;
  lack.is_far_above_noise =
      lack.structure > kTimesNoise * lack.noise && lack.relative > kSmallStructure;
  find_worst(structure, fitted, begins, row_time_s, kDeviations * kDeviations * chance, lack);
  lack.rise = rise_of(fitted + structure, begins, row_time_s, drift_in(model, state));
  return lack;
}

void flag_lack_of_fit(const LackOfFitWords& words, FitResult& result) {
  if (!result.lack_of_fit || !result.lack_of_fit->is_significant) return;
  const LackOfFit& lack = *result.lack_of_fit;
  const auto size = [&](double value) { return shown(words.scale * value) + " " + words.unit; };
  std::string text = "the residual is not noise: a smooth curve of " + size(lack.structure) +
                     " rms is left over, beside noise of " + size(lack.noise) +
                     " between neighbours";
  if (lack.worst > 0.0) {
    text += " (worst from " + words.at + " = " + shown(lack.worst_from_s) + " to " +
            shown(lack.worst_to_s) + " " + words.at_unit + ": " + size(lack.worst) + ")";
  }
  if (lack.is_far_above_noise) {
    add_defect(
        result, "misfit",
        text + ". The model does not describe this record. Look at the curve: " + words.advice);
    return;
  }
  result.flags.push_back({"lack-of-fit", 0, text + "; no interval includes it"});
}

void flag_rise(double largest, FitResult& result) {
  constexpr double kShare = 0.1;
  constexpr double kTimesNoise = 6.0;
  if (!result.lack_of_fit || !result.lack_of_fit->is_significant) return;
  const LackOfFit& lack = *result.lack_of_fit;
  if (lack.rise <= kShare || lack.rise * largest <= kTimesNoise * lack.noise) return;
  add_defect(result, "modulus-rises",
             "the modulus rises by " + shown(100.0 * lack.rise) +
                 " % of its largest value, but a relaxation never rises. Is this the time of "
                 "loading (--time-zero; --crop auto leaves it out), or another test than a "
                 "relaxation (--kind)?");
}

}  // namespace viscard
