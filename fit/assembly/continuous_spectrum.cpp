#include "fit/assembly/continuous_spectrum.h"

#include "fit/intervals/uncertainty.h"
#include "fit/search/nnls.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kGridPerDecade = 12;  // times of the grid
constexpr int kHalfWidth =
    3;  // of the means, in steps of the grid: seven of them, about half a decade
constexpr int kStep = kHalfWidth;  // from one row to the next
constexpr double kPerStep = std::numbers::ln10 / kGridPerDecade;

// min |R x - q|^2 with x >= 0 where it must be: columns are common ones, terms of the grid, nuisances.
class SpectrumFamily {
 public:
  SpectrumFamily(const SpectralModel& model, const SpectralFit& fit)
      : ln_tau_(grid_of(model)), n_common_(model.n_common()) {
    // The times of the series as well: a narrow peak between two times of the grid is neither of them.
    own_ = fit.state.ln_tau;
    VectorXd all(ln_tau_.size() + own_.size());
    all << ln_tau_, own_;
    const ModelColumns grid = model.columns(all, fit.state.nuisance, /*with_slopes=*/false);
    const ModelColumns own =
        model.columns(fit.state.ln_tau, fit.state.nuisance, /*with_slopes=*/true);
    const Index n_nuisances = model.n_nuisances();
    is_free_ = free_columns(model, all.size());
    is_free_.resize(is_free_.size() + static_cast<std::size_t>(n_nuisances), true);
    // Rows in standard deviations; averages of noise with memory scatter more by its inflation.
    VectorXd scale =
        VectorXd::Constant(model.n_rows(), std::sqrt(fit.variance * fit.noise.inflation()));
    if (fit.row_scale.size() > 0) scale = scale.cwiseProduct(fit.row_scale);
    MatrixXd rows =
        MatrixXd::Zero(model.n_rows() + n_nuisances, grid.values.cols() + n_nuisances + 1);
    rows.topLeftCorner(model.n_rows(), grid.values.cols()) = grid.values;
    for (Index k = 0; k < n_nuisances; ++k) {
      const VectorXd slope =
          own.nuisance_slopes[static_cast<std::size_t>(k)] * fit.state.coefficients;
      rows.col(grid.values.cols() + k).head(model.n_rows()) = slope;
    }
    rows.rightCols(1).topRows(model.n_rows()) = model.data();
    rows.topRows(model.n_rows()).array().colwise() /= scale.array();
    // A change of a nuisance counts from its fitted value.
    rows.block(model.n_rows(), grid.values.cols(), n_nuisances, n_nuisances).diagonal() =
        model.prior_weight();
    rows.rightCols(1).bottomRows(n_nuisances) = -model.prior_residual(fit.state.nuisance);
    // Directions that the columns do not reach add a constant; most of the others lie below the rounding.
    const MatrixXd columns = rows.leftCols(rows.cols() - 1);
    const PivotedQr qr(columns);
    columns_ = qr.rotated(columns).topRows(qr.rank());
    data_ = qr.rotated(rows.rightCols(1)).topRows(qr.rank());
    gram_ = columns_.transpose() * columns_;
    right_ = columns_.transpose() * data_;
    best_ = nonnegative_by_qr(columns_, data_, is_free_);
    least_ = misfit(best_);
    // That of the series, without what no column reaches.
    const VectorXd left = (model.fitted(fit.state) - model.data()).cwiseQuotient(scale);
    const double series = left.squaredNorm() +
                          model.prior_residual(fit.state.nuisance).squaredNorm() -
                          (rows.rightCols(1).squaredNorm() - data_.squaredNorm());
    allowed_rise_ = std::max(0.0, series - least_) + kChiSquare95;
  }

  const VectorXd& ln_tau() const { return ln_tau_; }

  // The sum of all terms with times within this range; with_equilibrium: and E_inf, the first column.
  VectorXd sum_over(double from, double to, bool with_equilibrium = false) const {
    VectorXd c = VectorXd::Zero(columns_.cols());
    const auto take = [&](const VectorXd& times, Index first) {
      for (Index i = 0; i < times.size(); ++i) {
        if (times[i] >= from && times[i] <= to) c[first + i] = 1.0;
      }
    };
    take(ln_tau_, n_common_);
    take(own_, n_common_ + ln_tau_.size());
    if (with_equilibrium) c[0] = 1.0;
    return c;
  }

  // Smallest and largest c.x of the family.
  Interval bounds(const VectorXd& c) const { return {end_of(c, -1.0), end_of(c, 1.0)}; }

  // The member with the least sum of squared second differences of the terms of the grid.
  VectorXd smoothest() const {
    const Index n = ln_tau_.size();
    MatrixXd bend = MatrixXd::Zero(columns_.cols(), columns_.cols());
    for (Index i = 0; i < n; ++i) {  // beyond its ends the spectrum is zero
      VectorXd row = VectorXd::Zero(columns_.cols());
      row[n_common_ + i] = -2.0;
      if (i > 0) row[n_common_ + i - 1] = 1.0;
      if (i + 1 < n) row[n_common_ + i + 1] = 1.0;
      bend += row * row.transpose();
    }
    // Without the single times of the series, which are no smooth spectrum.
    MatrixXd gram = gram_;
    VectorXd right = right_;
    const Index single = n_common_ + n;
    gram.middleRows(single, own_.size()).setZero();
    gram.middleCols(single, own_.size()).setZero();
    gram.diagonal().segment(single, own_.size()).setOnes();
    right.segment(single, own_.size()).setZero();
    const double size = gram_.diagonal().segment(n_common_, n).maxCoeff();
    double low = -16.0, high = 6.0;  // decimal logarithms of the weight
    const auto at = [&](double weight) {
      return nonnegative_from_normal_equations(gram + std::pow(10.0, weight) * size * bend, right,
                                               is_free_);
    };
    for (int i = 0; i < 24; ++i) {
      const double middle = 0.5 * (low + high);
      (misfit(at(middle)) - least_ > allowed_rise_ ? high : low) = middle;
    }
    return at(low);
  }

 private:
  static VectorXd grid_of(const SpectralModel& model) {
    const double steps = std::ceil((model.ln_tau_max() - model.ln_tau_min()) / kPerStep);
    return VectorXd::LinSpaced(static_cast<Index>(std::clamp(steps, 2.0, 600.0)) + 1,
                               model.ln_tau_min(), model.ln_tau_max());
  }

  double misfit(const VectorXd& x) const { return (columns_ * x - data_).squaredNorm(); }

  // The best member with its own value of c.x: the wanted value counts as one more reading, about as certain as all
  // others together. (A far larger weight would hide the misfit below the rounding.)
  VectorXd member_at(const VectorXd& c, double value) const {
    const double weight = columns_.colwise().norm().maxCoeff() / c.cwiseAbs().maxCoeff();
    MatrixXd rows(columns_.rows() + 1, columns_.cols());
    rows << columns_, weight * c.transpose();
    VectorXd right(data_.size() + 1);
    right << data_, weight * value;
    return nonnegative_by_qr(rows, right, is_free_);
  }

  // From the best value downwards (sign -1) or upwards: the root of the rise grows about linearly.
  double end_of(const VectorXd& c, double sign) const {
    const double root = std::sqrt(allowed_rise_), best = c.dot(best_);
    const double scale =
        std::max(std::abs(best), 1e-3 * std::abs(c.cwiseProduct(best_).cwiseAbs().sum()));
    constexpr double kClose = 2e-3;  // of the root of the rise
    double near = 0.0, near_root = 0.0, far = 0.0, far_root = 0.0, value = best;
    const auto take = [&](double distance) {
      const VectorXd x = member_at(c, best + sign * distance);
      const double rise = std::sqrt(std::max(0.0, misfit(x) - least_));
      if (rise <= (1.0 + kClose) * root)
        value = sign < 0.0 ? std::min(value, c.dot(x)) : std::max(value, c.dot(x));
      return rise;
    };
    const bool is_positive = c.minCoeff() >= 0.0;  // then c.x is not below 0
    double distance = 1e-3 * (scale > 0.0 ? scale : 1e-6 * best_.cwiseAbs().maxCoeff());
    constexpr int kMostSteps = 40;
    for (int i = 0; i < kMostSteps && far == 0.0; ++i) {
      const bool is_end = sign < 0.0 && is_positive && distance >= best;
      if (is_end) distance = best;
      const double rise = take(distance);
      if (rise > root) {
        far = distance;
        far_root = rise;
      } else if (is_end) {
        return value;
      } else {
        near = distance;
        near_root = rise;
        distance *= rise > 0.4 * root ? 2.0 : 4.0;
      }
    }
    if (far == 0.0) return value;  // nothing bounds it
    for (int i = 0; i < kMostSteps && far - near > kClose * far; ++i) {
      const double share = (root - near_root) / (far_root - near_root);
      const double next = near + std::clamp(share, 0.05, 0.95) * (far - near);
      const double rise = take(next);
      (rise <= root ? near : far) = next;
      (rise <= root ? near_root : far_root) = rise;
      if (std::abs(rise - root) < kClose * root) break;
    }
    return value;
  }

  VectorXd ln_tau_, own_;
  Index n_common_ = 0;
  std::vector<bool> is_free_;
  MatrixXd columns_, gram_;
  VectorXd data_, right_, best_;
  double least_ = 0.0, allowed_rise_ = kChiSquare95;
};

}  // namespace

std::optional<ContinuousSpectrum> continuous_spectrum(const SpectralModel& model,
                                                      const SpectralFit& fit) {
  if (model.may_be_negative() || !(fit.variance > 0.0)) return std::nullopt;
  const SpectrumFamily family(model, fit);
  const VectorXd& ln_tau = family.ln_tau();
  const Index n = ln_tau.size();
  const double spacing = n > 1 ? ln_tau[1] - ln_tau[0] : kPerStep;
  const VectorXd smooth = family.smoothest();
  ContinuousSpectrum out;
  out.from_s = std::exp(ln_tau[0]);
  out.to_s = std::exp(ln_tau[n - 1]);
  for (Index middle = 0; middle < n; middle += kStep) {
    const Index begin = std::max<Index>(0, middle - kHalfWidth);
    const Index end = std::min<Index>(n - 1, middle + kHalfWidth);
    const VectorXd mean =
        family.sum_over(ln_tau[begin] - 0.5 * spacing, ln_tau[end] + 0.5 * spacing) /
        (static_cast<double>(end - begin + 1) * spacing);
    out.rows.push_back({std::exp(ln_tau[middle]), mean.dot(smooth), family.bounds(mean)});
  }
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const bool has_equilibrium =
      model.n_common() > 0 && model.common()[0].name.rfind("E_inf", 0) == 0;
  if (has_equilibrium) out.E_inf_95 = family.bounds(family.sum_over(kAll, kAll, true));
  out.E0_95 = family.bounds(family.sum_over(-kAll, kAll, has_equilibrium));
  return out;
}

}  // namespace viscard
