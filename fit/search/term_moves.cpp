#include "fit/search/nnls.h"
#include "fit/search/order_path.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Time of the merged pair (i, i + 1): the mean of ln tau weighted by the moduli.
double merged_ln_tau(const SpectralModel& model, const SpectralState& state, Index i) {
  const double a = std::abs(state.coefficients[model.n_common() + i]);
  const double b = std::abs(state.coefficients[model.n_common() + i + 1]);
  if (!(a + b > 0.0)) return state.ln_tau[i];
  return (a * state.ln_tau[i] + b * state.ln_tau[i + 1]) / (a + b);
}

// Increase of the sum of squares when terms are removed or replaced and the other coefficients are
// solved again. With A = (V^T V)^-1 and coefficients x, removing the columns R costs x_R^T
// (A_RR)^-1 x_R. A new column m then recovers (m^T r)^2/|m outside the rest|^2.
class ReductionCosts {
 public:
  ReductionCosts(const SpectralModel& model, const SpectralState& state)
      : first_(model.n_common()), x_(state.coefficients) {
    const Index n = state.n_terms();
    Eigen::VectorXd times(2 * n - 1);
    times.head(n) = state.ln_tau;
    for (Index i = 0; i + 1 < n; ++i) times[n + i] = merged_ln_tau(model, state, i);
    const Eigen::MatrixXd all = model.columns(times, state.nuisance, /*with_slopes=*/false).values;
    const Eigen::MatrixXd values = all.leftCols(first_ + n);
    const Eigen::MatrixXd offered = all.rightCols(n - 1);
    const Eigen::VectorXd scale = values.colwise().norm().transpose().cwiseMax(1e-300);
    const HouseholderQr qr(values * scale.cwiseInverse().asDiagonal());
    const Eigen::MatrixXd inverse = scale.cwiseInverse().asDiagonal() * qr.upper_inverse();
    inverse_gram_ = inverse * inverse.transpose();
    if (n < 2) return;  // nothing to merge
    const Eigen::MatrixXd rotated = qr.rotated(offered);
    shares_ = inverse * rotated.topRows(values.cols());
    outside_ = rotated.bottomRows(rotated.rows() - values.cols()).colwise().squaredNorm();
    left_ = offered.transpose() * (model.data() - values * x_);
  }

  double of_dropping(Index i) const {
    const double x = x_[first_ + i];
    return x * x / inverse_gram_(first_ + i, first_ + i);
  }

  double of_merging(Index i) const {
    const Eigen::Matrix2d block = inverse_gram_.block<2, 2>(first_ + i, first_ + i).inverse();
    const Eigen::Vector2d x = x_.segment<2>(first_ + i);
    const Eigen::Vector2d c = shares_.block<2, 1>(first_ + i, i);
    const double product = left_[i] + c.dot(block * x);
    const double square = outside_[i] + c.dot(block * c);
    const double taken_back = square > 0.0 ? product * product / square : 0.0;
    return std::max(0.0, x.dot(block * x) - taken_back);
  }

 private:
  Index first_;
  Eigen::VectorXd x_;
  Eigen::MatrixXd inverse_gram_;
  Eigen::MatrixXd shares_;   // coefficients of each merged column in terms of the present ones
  Eigen::VectorXd outside_;  // squared length of their components orthogonal to the present ones
  Eigen::VectorXd left_;     // their products with the residual
};

Offers offers_by_qr(const SpectralModel& model, const Eigen::MatrixXd& present,
                    const Eigen::MatrixXd& offered, const std::vector<bool>& is_free) {
  const SignedLeastSquares fit(present, model.data(), is_free);
  const Eigen::MatrixXd columns = fit.outside(offered);
  const Eigen::VectorXd residual = fit.outside(model.data() - present * fit.x());
  return {columns.transpose() * residual, columns.colwise().squaredNorm().transpose()};
}

}  // namespace

Eigen::VectorXd without(const Eigen::VectorXd& values, Index leave_out) {
  Eigen::VectorXd rest(values.size() - 1);
  rest.head(leave_out) = values.head(leave_out);
  rest.tail(values.size() - 1 - leave_out) = values.tail(values.size() - 1 - leave_out);
  return rest;
}

std::vector<Eigen::VectorXd> reductions(const SpectralModel& model, const SpectralState& state) {
  const ReductionCosts costs(model, state);
  std::vector<std::pair<double, Eigen::VectorXd>> ways;
  for (Index i = 0; i < state.n_terms(); ++i) {
    ways.emplace_back(costs.of_dropping(i), without(state.ln_tau, i));
    if (i + 1 == state.n_terms()) break;
    Eigen::VectorXd merged = without(state.ln_tau, i + 1);
    merged[i] = merged_ln_tau(model, state, i);
    ways.emplace_back(costs.of_merging(i), merged);
  }
  for (auto& way : ways) {  // a nearly dependent pair, whose cost is lost to rounding, comes last
    if (!std::isfinite(way.first)) way.first = std::numeric_limits<double>::max();
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> times;
  for (auto& way : ways) times.push_back(std::move(way.second));
  return times;
}

// From the Gram matrix if it is well conditioned, otherwise by QR.
Offers offers_of(const SpectralModel& model, const Eigen::MatrixXd& present,
                 const Eigen::MatrixXd& offered, const std::vector<bool>& is_free) {
  constexpr double kHidden = 1e-4;
  const Eigen::VectorXd scale = present.colwise().norm().transpose().cwiseMax(1e-300);
  const Eigen::MatrixXd columns = present * scale.cwiseInverse().asDiagonal();
  const Cholesky gram(gram_of(columns));
  const bool is_clear = gram.is_definite() && gram.smallest_pivot() > kHidden;
  if (!is_clear) return offers_by_qr(model, present, offered, is_free);
  const Eigen::VectorXd x = gram.solve(transposed_product(columns, model.data()));
  for (Index j = 0; j < x.size(); ++j) {  // a coefficient of zero would need the sign constraint
    if (!is_free[static_cast<std::size_t>(j)] && !(x[j] > 0.0)) {
      return offers_by_qr(model, present, offered, is_free);
    }
  }
  const Eigen::VectorXd full = offered.colwise().squaredNorm().transpose();
  const Eigen::MatrixXd shared = gram.solve_lower(transposed_product(columns, offered));
  Offers offers{transposed_product(offered, model.data() - columns * x),
                full - shared.colwise().squaredNorm().transpose()};
  if ((offers.length.array() < kHidden * kHidden * full.array()).any()) {
    return offers_by_qr(model, present, offered, is_free);
  }
  return offers;
}

}  // namespace viscard
