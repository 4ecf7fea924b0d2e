#include "fit/search/projection.h"

#include "fit/search/nnls.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Columns closer than this (relative) to the span of the others lose all digits in the normal
// equations; use QR instead.
constexpr double kNearlyDependent = 1e-5;

std::vector<Index> used_columns(const Eigen::VectorXd& x, const std::vector<bool>& is_free) {
  std::vector<Index> used;
  for (Index j = 0; j < x.size(); ++j) {
    if (is_free[static_cast<std::size_t>(j)] || x[j] > 0.0) used.push_back(j);
  }
  return used;
}

bool has_wrong_sign(const Eigen::VectorXd& x, const std::vector<bool>& is_free) {
  for (Index j = 0; j < x.size(); ++j) {
    if (!is_free[static_cast<std::size_t>(j)] && x[j] < 0.0) return true;
  }
  return false;
}

// Least squares by the normal equations of the scaled columns in use.
class NormalSolution {
 public:
  NormalSolution(const Eigen::MatrixXd& values, const Eigen::MatrixXd& gram,
                 const Eigen::VectorXd& right, std::vector<Index> used)
      : used_(std::move(used)), scale_(gram.diagonal()(used_).cwiseSqrt().cwiseInverse()) {
    cholesky_ = Cholesky(scale_.asDiagonal() * gram(used_, used_) * scale_.asDiagonal());
    is_good_ = cholesky_.is_definite() && scale_.allFinite() &&
               cholesky_.smallest_pivot() > kNearlyDependent;
    x_ = Eigen::VectorXd::Zero(values.cols());
    if (is_good_) x_(used_) = solve(right);
  }

  bool is_good() const { return is_good_; }
  const Eigen::VectorXd& x() const { return x_; }
  // One step of iterative refinement with the residual y - V x.
  void refine(const Eigen::VectorXd& right) { x_(used_) += solve(right); }
  // Gram matrix of the projections of other columns D onto the used columns, from products = V^T D.
  Eigen::MatrixXd shared(const Eigen::MatrixXd& products) const {
    if (used_.empty() || products.cols() == 0) {
      return Eigen::MatrixXd::Zero(products.cols(), products.cols());
    }
    const Eigen::MatrixXd half =
        cholesky_.solve_lower(Eigen::MatrixXd(scale_.asDiagonal() * products(used_, Eigen::all)));
    return half.transpose() * half;
  }

 private:
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    return scale_.cwiseProduct(cholesky_.solve(Eigen::VectorXd(scale_.cwiseProduct(right(used_)))));
  }

  std::vector<Index> used_;
  Eigen::VectorXd scale_, x_;
  Cholesky cholesky_;
  bool is_good_ = false;
};

Projection by_qr(const SpectralModel& model, const ModelColumns& columns,
                 const std::vector<bool>& is_free) {
  Projection at;
  const SignedLeastSquares solution(columns.values, model.data(), is_free);
  at.coefficients = solution.x();
  const Eigen::VectorXd residual = columns.values * at.coefficients - model.data();
  at.rss = residual.squaredNorm();
  const Eigen::MatrixXd slopes = nonlinear_slopes(model, columns, at.coefficients);
  const Eigen::MatrixXd outside = solution.outside(slopes);
  at.normal = outside.transpose() * outside;
  at.gradient = outside.transpose() * solution.outside(residual);
  return at;
}

// Solution by normal equations with one refinement step; none if they are ill-conditioned.
std::optional<NormalSolution> normal_solution(const SpectralModel& model,
                                              const Eigen::MatrixXd& values,
                                              const std::vector<bool>& is_free) {
  const Eigen::MatrixXd gram = gram_of(values);
  const Eigen::VectorXd right = transposed_product(values, model.data());
  std::vector<Index> used(static_cast<std::size_t>(values.cols()));
  std::iota(used.begin(), used.end(), Index{0});
  NormalSolution solution(values, gram, right, used);
  if (solution.is_good() && has_wrong_sign(solution.x(), is_free)) {
    const Eigen::VectorXd guess = nonnegative_from_normal_equations(gram, right, is_free);
    solution = NormalSolution(values, gram, right, used_columns(guess, is_free));
  }
  if (!solution.is_good()) return std::nullopt;
  solution.refine(transposed_product(values, model.data() - values * solution.x()));
  if (has_wrong_sign(solution.x(), is_free)) return std::nullopt;
  return solution;
}

}  // namespace

Eigen::VectorXd search_parameters(const SpectralModel& model, const Eigen::VectorXd& ln_tau,
                                  const Eigen::VectorXd& nuisance) {
  Eigen::VectorXd p(ln_tau.size() + nuisance.size());
  p << ln_tau, nuisance.cwiseQuotient(model.of_nuisances(&Nuisance::scale));
  return p;
}

Eigen::VectorXd nuisance_from(const SpectralModel& model, const Eigen::VectorXd& p) {
  return p.tail(model.n_nuisances()).cwiseProduct(model.of_nuisances(&Nuisance::scale));
}

Eigen::MatrixXd nonlinear_slopes(const SpectralModel& model, const ModelColumns& columns,
                                 const Eigen::VectorXd& coefficients) {
  const Index n_terms = columns.term_slopes.cols();
  Eigen::MatrixXd slopes(model.n_rows(), n_terms + model.n_nuisances());
  slopes.leftCols(n_terms) =
      columns.term_slopes * coefficients.segment(model.n_common(), n_terms).asDiagonal();
  for (Index k = 0; k < model.n_nuisances(); ++k) {
    const auto slot = static_cast<std::size_t>(k);
    slopes.col(n_terms + k) =
        columns.nuisance_slopes[slot] * coefficients * model.nuisances()[slot].scale;
  }
  return slopes;
}

Coefficients best_coefficients(const SpectralModel& model, const Eigen::MatrixXd& values,
                               const std::vector<bool>& is_free) {
  Coefficients best;
  const auto solution = values.allFinite() ? normal_solution(model, values, is_free) : std::nullopt;
  best.x = solution ? solution->x() : least_squares_with_signs(values, model.data(), is_free);
  best.rss = (values * best.x - model.data()).squaredNorm();
  return best;
}

namespace {

Projection project_data(const SpectralModel& model, const Eigen::VectorXd& p) {
  const Index n_terms = p.size() - model.n_nuisances();
  const ModelColumns columns =
      model.columns(p.head(n_terms), nuisance_from(model, p), /*with_slopes=*/true);
  const Eigen::MatrixXd& values = columns.values;
  Projection at;
  at.rss = std::numeric_limits<double>::infinity();
  if (!values.allFinite()) return at;
  const std::vector<bool> is_free = free_columns(model, n_terms);
  const auto solution = normal_solution(model, values, is_free);
  if (!solution) return by_qr(model, columns, is_free);
  at.coefficients = solution->x();
  const Eigen::VectorXd residual = values * at.coefficients - model.data();
  at.rss = residual.squaredNorm();
  const Eigen::MatrixXd slopes = nonlinear_slopes(model, columns, at.coefficients);
  at.normal = gram_of(slopes) - solution->shared(transposed_product(values, slopes));
  at.gradient = transposed_product(slopes, residual);
  return at;
}

}  // namespace

Projection project(const SpectralModel& model, const Eigen::VectorXd& p) {
  Projection at = project_data(model, p);
  const Index n = model.n_nuisances();
  if (n == 0 || !std::isfinite(at.rss)) return at;
  // Priors are further residuals, which depend on their nuisance alone.
  const Eigen::VectorXd distance = model.prior_residual(nuisance_from(model, p));
  const Eigen::VectorXd slope =
      model.prior_weight().cwiseProduct(model.of_nuisances(&Nuisance::scale));
  at.rss += distance.squaredNorm();
  at.gradient.tail(n) += slope.cwiseProduct(distance);
  at.normal.diagonal().tail(n) += slope.cwiseAbs2();
  return at;
}

Box search_box(const SpectralModel& model, Index n_terms) {
  const Index size = n_terms + model.n_nuisances();
  Box box{Eigen::VectorXd::Constant(size, model.ln_tau_min()),
          Eigen::VectorXd::Constant(size, model.ln_tau_max())};
  const Eigen::VectorXd scale = model.of_nuisances(&Nuisance::scale);
  box.low.tail(scale.size()) = model.of_nuisances(&Nuisance::low).cwiseQuotient(scale);
  box.high.tail(scale.size()) = model.of_nuisances(&Nuisance::high).cwiseQuotient(scale);
  return box;
}

}  // namespace viscard
