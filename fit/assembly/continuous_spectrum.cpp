#include "fit/assembly/continuous_spectrum.h"

#include "fit/intervals/uncertainty.h"
#include "fit/search/nnls.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPerDecade = 12;  // times of the grid
constexpr int kHalfWidth =
    3;  // of the means, in steps of the grid: seven of them, about half a decade
constexpr int kStep = kHalfWidth;  // from one row to the next
constexpr double kPerStep = std::numbers::ln10 / kPerDecade;

// min |R x - q|^2 with x >= 0 where it must be: columns are common ones, terms of the grid, nuisances.
class SpectrumFamily {
 public:
  SpectrumFamily(const SpectralModel& model, const SpectralFit& fit)
      : ln_tau_(grid_of(model)), n_common_(model.n_common()) {
    const ModelColumns grid = model.columns(ln_tau_, fit.state.nuisance, /*with_slopes=*/false);
    const ModelColumns own =
        model.columns(fit.state.ln_tau, fit.state.nuisance, /*with_slopes=*/true);
    const Index n_nuisances = model.n_nuisances();
    is_free_ = free_columns(model, ln_tau_.size());
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
    if (rows.rows() > rows.cols()) {
      // |rows z| = |R z|.
      const MatrixXd rotated = HouseholderQr(rows).rotated(rows).topRows(rows.cols());
      rows = rotated.triangularView<Eigen::Upper>();
    }
    columns_ = rows.leftCols(rows.cols() - 1);
    data_ = rows.rightCols(1);
    gram_ = columns_.transpose() * columns_;
    right_ = columns_.transpose() * data_;
    best_ = nonnegative_from_normal_equations(gram_, right_, is_free_);
    least_ = misfit(best_);
  }

  const VectorXd& ln_tau() const { return ln_tau_; }
  Index n_columns() const { return columns_.cols(); }
  Index first_term() const { return n_common_; }

  // Smallest and largest c.x of the family.
  Interval bounds(const VectorXd& c) const { return {lowest(c), -lowest(-c)}; }

  // The member with the least sum of squared second differences of the terms.
  VectorXd smoothest() const {
    const Index n = ln_tau_.size();
    MatrixXd bend = MatrixXd::Zero(n_columns(), n_columns());
    for (Index i = 0; i < n; ++i) {  // beyond its ends the spectrum is zero
      VectorXd row = VectorXd::Zero(n_columns());
      row[n_common_ + i] = -2.0;
      if (i > 0) row[n_common_ + i - 1] = 1.0;
      if (i + 1 < n) row[n_common_ + i + 1] = 1.0;
      bend += row * row.transpose();
    }
    const double size = gram_.diagonal().segment(n_common_, n).maxCoeff();
    double low = -16.0, high = 6.0;  // decimal logarithms of the weight
    const auto at = [&](double weight) {
      return nonnegative_from_normal_equations(gram_ + std::pow(10.0, weight) * size * bend, right_,
                                               is_free_);
    };
    for (int i = 0; i < 24; ++i) {
      const double middle = 0.5 * (low + high);
      (misfit(at(middle)) - least_ > kChiSquare95 ? high : low) = middle;
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

  // With lambda the root of the rise grows about linearly; past the largest rise c.x does not fall further.
  double lowest(const VectorXd& c) const {
    const auto at = [&](double lambda) {
      return nonnegative_from_normal_equations(gram_, right_ - lambda * c, is_free_);
    };
    const double root = std::sqrt(kChiSquare95);
    const VectorXd ratio =
        c.cwiseAbs().cwiseQuotient(gram_.diagonal().cwiseSqrt().cwiseMax(1e-300));
    double lambda = root / std::max(ratio.maxCoeff(), 1e-300);  // of one column alone
    double low = 0.0, low_root = 0.0, high = 0.0, high_root = 0.0;
    double value = c.dot(best_);
    constexpr int kMostSteps = 60;
    for (int i = 0; i < kMostSteps && high == 0.0; ++i) {
      const VectorXd x = at(lambda);
      const double rise = std::sqrt(std::max(0.0, misfit(x) - least_));
      if (rise >= root) {
        high = lambda;
        high_root = rise;
        break;
      }
      value = std::min(value, c.dot(x));
      low = lambda;
      low_root = rise;
      lambda *= rise > 0.5 * root ? 2.0 : 8.0;
    }
    if (high == 0.0) return value;
    constexpr double kClose = 1e-3;
    for (int i = 0; i < kMostSteps && high - low > kClose * high; ++i) {
      const double share = (root - low_root) / (high_root - low_root);
      const double next = low + std::clamp(share, 0.1, 0.9) * (high - low);
      const VectorXd x = at(next);
      const double rise = std::sqrt(std::max(0.0, misfit(x) - least_));
      const bool is_member = rise <= root;
      (is_member ? low : high) = next;
      (is_member ? low_root : high_root) = rise;
      if (is_member) value = std::min(value, c.dot(x));
      if (std::abs(rise - root) < kClose * root) break;
    }
    return value;
  }

  VectorXd ln_tau_;
  Index n_common_ = 0;
  std::vector<bool> is_free_;
  MatrixXd columns_, gram_;
  VectorXd data_, right_, best_;
  double least_ = 0.0;
};

}  // namespace

std::optional<ContinuousSpectrum> continuous_spectrum(const SpectralModel& model,
                                                      const SpectralFit& fit) {
  if (model.may_be_negative() || !(fit.variance > 0.0)) return std::nullopt;
  const SpectrumFamily family(model, fit);
  const Index n = family.ln_tau().size(), first = family.first_term();
  const double spacing = n > 1 ? family.ln_tau()[1] - family.ln_tau()[0] : kPerStep;
  const VectorXd smooth = family.smoothest();
  ContinuousSpectrum out;
  out.from_s = std::exp(family.ln_tau()[0]);
  out.to_s = std::exp(family.ln_tau()[n - 1]);
  for (Index middle = 0; middle < n; middle += kStep) {
    const Index begin = std::max<Index>(0, middle - kHalfWidth);
    const Index count = std::min<Index>(n - 1, middle + kHalfWidth) - begin + 1;
    VectorXd mean = VectorXd::Zero(family.n_columns());
    mean.segment(first + begin, count).setConstant(1.0 / (static_cast<double>(count) * spacing));
    out.rows.push_back({std::exp(family.ln_tau()[middle]), mean.dot(smooth), family.bounds(mean)});
  }
  VectorXd all = VectorXd::Zero(family.n_columns());
  all.segment(first, n).setOnes();
  const bool has_equilibrium =
      model.n_common() > 0 && model.common()[0].name.rfind("E_inf", 0) == 0;
  if (has_equilibrium) {
    VectorXd rest = VectorXd::Zero(family.n_columns());
    rest[0] = 1.0;
    out.E_inf_95 = family.bounds(rest);
    all[0] = 1.0;
  }
  out.E0_95 = family.bounds(all);
  return out;
}

}  // namespace viscard
