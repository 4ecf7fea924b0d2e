#include "fit/assembly/kramers_kronig.h"

#include "fit/search/nnls.h"
#include "models/maths/dense.h"
#include "models/maths/distributions.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Times in ln s. The outermost two stand for a dashpot and a plateau: at 1e-9 of the fastest
// measured time a term's storage modulus is 1e-9 of its loss modulus. Then the fitted times.
Eigen::VectorXd wide_grid(const DmaModel& model, const Eigen::VectorXd& fitted) {
  constexpr double kPerDecade = 8.0, kBeyond = 3.0, kFar = 9.0;
  const double ln_10 = std::log(10.0);
  const double low = model.ln_tau_min() - kBeyond * ln_10;
  const double high = model.ln_tau_max() + kBeyond * ln_10;
  const auto inner = static_cast<Index>(std::ceil((high - low) / ln_10 * kPerDecade)) + 1;
  Eigen::VectorXd grid(inner + 2 + fitted.size());
  grid << model.ln_tau_min() - kFar * ln_10, Eigen::VectorXd::LinSpaced(inner, low, high),
      model.ln_tau_max() + kFar * ln_10, fitted;
  return grid;
}

// Columns of unit length, so that no column is lost in the normal equations.
Eigen::MatrixXd normalised(Eigen::MatrixXd columns) {
  for (Index j = 0; j < columns.cols(); ++j) {
    const double length = columns.col(j).norm();
    if (length > 0.0) columns.col(j) /= length;
  }
  return columns;
}

// Least squares with a spectrum without negative terms.
struct SpectrumFit {
  Eigen::MatrixXd basis;  // orthonormal, of the columns in use
  Eigen::VectorXd fitted, residual;
  double rss = 0.0;
  double spare = 0.0;           // degrees of freedom
  double free_coefficient = 0;  // of the last column, if it may have either sign
};

SpectrumFit spectrum_fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                         bool last_is_free) {
  std::vector<bool> is_free(static_cast<std::size_t>(columns.cols()), false);
  is_free.back() = last_is_free;
  const Eigen::VectorXd x = nonnegative_from_normal_equations(columns.transpose() * columns,
                                                              columns.transpose() * data, is_free);
  std::vector<Index> used;
  for (Index j = 0; j < x.size(); ++j) {
    if (x[j] != 0.0) used.push_back(j);
  }
  SpectrumFit fit;
  // None if weights of many decades leave nothing of the others.
  fit.basis = used.empty() ? Eigen::MatrixXd(columns.rows(), 0)
                           : PivotedQr(columns(Eigen::all, used)).basis();
  fit.fitted = fit.basis * (fit.basis.transpose() * data);
  fit.residual = data - fit.fitted;
  fit.rss = fit.residual.squaredNorm();
  // A row that is small against the complex modulus has little weight and little noise: it counts
  // with the square of its weighted value, which is one for all others.
  fit.spare = data.squaredNorm() - static_cast<double>(fit.basis.cols());
  fit.free_coefficient = x[x.size() - 1];
  return fit;
}

struct Range {
  Index first = 0, last = -1;  // rows; none if last < first
  double gain = 0.0;           // decrease of the sum of squares
  double length2 = 0.0;        // of the range's column, orthogonal to the columns in use
};

// The range of one half of the rows whose own factor lowers the sum of squares most: by the sums of
// all rows before each row.
Range best_range(const DmaModel& model, const SpectrumFit& fit, Index begin) {
  const Index count = model.n_frequencies();
  constexpr Index kFewest = 3;
  const double least_ratio = std::pow(10.0, 0.45);
  Eigen::MatrixXd shadow = Eigen::MatrixXd::Zero(count + 1, fit.basis.cols());
  Eigen::VectorXd product = Eigen::VectorXd::Zero(count + 1), length2 = product;
  for (Index i = 0; i < count; ++i) {
    const double value = fit.fitted[begin + i];
    shadow.row(i + 1) = shadow.row(i) + value * fit.basis.row(begin + i);
    product[i + 1] = product[i] + value * fit.residual[begin + i];
    length2[i + 1] = length2[i] + value * value;
  }
  // The spectrum can imitate the factor up to the noise.
  constexpr double kRounding = 1e-6, kOfNoise = 10.0;
  const double hidden = std::max(kRounding, kOfNoise * fit.rss / std::max(1.0, fit.spare));
  // Of many frequencies, ranges begin and end at every second, third ... only: there are a square of their number.
  constexpr Index kMostEnds = 4096;
  const Index step = (count + kMostEnds - 1) / kMostEnds;
  const Index least = (kFewest + step - 1) / step * step;
  Range best;
  for (Index i = 0; i < count; i += step) {
    for (Index j = i + least; j <= count; j += step) {
      if (model.frequency_Hz(j - 1) < least_ratio * model.frequency_Hz(i)) continue;
      const double own = length2[j] - length2[i];
      const double outside = own - (shadow.row(j) - shadow.row(i)).squaredNorm();
      if (!(outside > hidden * own)) continue;
      const double gain = std::pow(product[j] - product[i], 2) / outside;
      if (gain > best.gain) best = {begin + i, begin + j - 1, gain, outside};
    }
  }
  return best;
}

// Variance of the coefficient of `column`, each row with its own scatter: the losses between peaks
// scatter more than their weights state if the noise is relative to the complex modulus. The
// estimator HC3 of MacKinnon and White, J. Econometrics 29 (1985) 305.
double variance_of_rows(const Eigen::VectorXd& column, const SpectrumFit& together,
                        const SpectrumFit& apart) {
  constexpr double kLeastFree = 0.05;  // 1 - leverage; a row that decides its own fit has none
  const Eigen::VectorXd outside = column - together.basis * (together.basis.transpose() * column);
  double sum = 0.0;
  for (Index i = 0; i < column.size(); ++i) {
    const double free = std::max(kLeastFree, 1.0 - apart.basis.row(i).squaredNorm());
    sum += std::pow(outside[i] * apart.residual[i] / free, 2);
  }
  return sum / std::pow(outside.squaredNorm(), 2);
}

}  // namespace

std::optional<KramersKronigBreak> kramers_kronig_break(const DmaModel& model,
                                                       const Eigen::VectorXd& fitted_ln_tau) {
  if (model.may_be_negative()) return std::nullopt;
  const Eigen::VectorXd grid = wide_grid(model, fitted_ln_tau);
  const Eigen::MatrixXd spectrum =
      normalised(model.columns(grid, Eigen::VectorXd(0), /*with_slopes=*/false).values);
  const SpectrumFit together = spectrum_fit(spectrum, model.data(), /*last_is_free=*/false);
  if (together.basis.cols() == 0) return std::nullopt;
  const Index count = model.n_frequencies();
  const Range storage = best_range(model, together, 0);
  const Range loss = best_range(model, together, count);
  const Range& best = loss.gain > storage.gain ? loss : storage;
  if (best.last < best.first) return std::nullopt;

  Eigen::MatrixXd with_factor = Eigen::MatrixXd::Zero(spectrum.rows(), spectrum.cols() + 1);
  with_factor.leftCols(spectrum.cols()) = spectrum;
  const Index size = best.last - best.first + 1;
  with_factor.col(spectrum.cols()).segment(best.first, size) =
      together.fitted.segment(best.first, size);
  const SpectrumFit apart = spectrum_fit(with_factor, model.data(), /*last_is_free=*/true);
  constexpr double kLeastSpare = 4.0, kDigits = 1e-14;
  if (apart.spare < kLeastSpare) return std::nullopt;
  // Rounding of the normal equations limits the sum of squares.
  const double variance = std::max(apart.rss, kDigits * model.data().squaredNorm()) / apart.spare;
  // The 95 % point times 2.6 is five standard errors for many rows, and more for few.
  constexpr double kRanges = 2.6, kVisible = 0.02;
  const double t_95 = student_t_975(apart.spare);
  const double share = apart.free_coefficient;
  const double error =
      std::sqrt(std::max(variance / best.length2,
                         variance_of_rows(with_factor.col(spectrum.cols()), together, apart)));
  const double t = std::min(std::sqrt(std::max(0.0, together.rss - apart.rss) / variance),
                            std::abs(share) / error);
  if (t < kRanges * t_95 || std::abs(share) < kVisible) return std::nullopt;
  const bool is_loss = best.first >= count;
  const Index first = is_loss ? best.first - count : best.first;
  return KramersKronigBreak{is_loss,
                            model.frequency_Hz(first),
                            model.frequency_Hz(first + size - 1),
                            share,
                            {share - t_95 * error, share + t_95 * error}};
}

void add_contradiction(const KramersKronigBreak& found, const std::string& where,
                       FitResult& result) {
  const auto percent = [](double share) { return text_of(100.0 * std::abs(share), 2); };
  const bool is_above = found.excess > 0.0;
  const Interval& range = found.excess_95;
  const double low = is_above ? range.low : range.high, high = is_above ? range.high : range.low;
  result.flags.push_back(
      {"storage-loss-contradict", 0,
       std::string("the ") + (found.is_loss ? "loss" : "storage") + " modulus" + where + " from " +
           text_of(found.from_Hz, 3) + " to " + text_of(found.to_Hz, 3) + " Hz is " +
           percent(found.excess) + " % (" + percent(low) + " to " + percent(high) + ") " +
           (is_above ? "above" : "below") + " what the " + (found.is_loss ? "storage" : "loss") +
           " modulus allows with any spectrum, also one that reaches beyond these frequencies "
           "(Kramers-Kronig): they do not belong to one linear material. Check the shift factors "
           "and the instrument's own loss"});
}

}  // namespace viscard
