#include "fit/search/separable.h"

#include "fit/search/dense_least_squares.h"
#include "fit/search/nnls.h"
#include "fit/search/projection.h"
#include "models/maths/dense.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Factor L of a matrix N = L L^T that may be singular: directions of length zero get a zero column.
Eigen::MatrixXd lower_factor(Eigen::MatrixXd n) {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n.rows(), n.cols());
  const Eigen::VectorXd length = n.diagonal();
  constexpr double kNothing = 1e-14;
  for (Index j = 0; j < n.cols(); ++j) {
    if (!(n(j, j) > kNothing * length[j])) continue;
    const Index left = n.rows() - j;
    lower.col(j).tail(left) = n.col(j).tail(left) / std::sqrt(n(j, j));
    n.bottomRightCorner(left, left) -=
        lower.col(j).tail(left) * lower.col(j).tail(left).transpose();
  }
  return lower;
}

// Residual of variable projection. The solver uses only |r|, J^T r and J^T J, so this passes the
// smallest problem that has the same three.
class ProjectedCost final : public ceres::CostFunction {
 public:
  // The solver's thresholds are absolute; this scaling makes them independent of the data's unit.
  ProjectedCost(const SpectralModel& model, Index n_terms)
      : model_(model), scale_(1e6 / std::max(model.data().norm(), 1e-280)) {
    const int size = static_cast<int>(n_terms + model.n_nuisances());
    mutable_parameter_block_sizes()->push_back(size);
    set_num_residuals(size + 1);
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index size = num_residuals() - 1;
    const Eigen::Map<const Eigen::VectorXd> p(parameters[0], size);
    const Projection at = project(model_, p);
    Eigen::Map<Eigen::VectorXd> out(residuals, size + 1);
    out.setZero();
    out[size] = scale_ * std::sqrt(at.rss);
    if (!std::isfinite(out[size])) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;

    const Eigen::MatrixXd lower = lower_factor(at.normal);
    for (Index j = 0; j < size; ++j) {  // lower * r = gradient
      const double part = at.gradient[j] - lower.row(j).head(j).dot(out.head(j));
      out[j] = lower(j, j) > 0.0 ? part / lower(j, j) : 0.0;
    }
    out[size] = scale_ * std::sqrt(std::max(0.0, at.rss - out.head(size).squaredNorm()));
    out.head(size) *= scale_;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
        jacobians[0], size + 1, size);
    jacobian.topRows(size) = scale_ * lower.transpose();
    jacobian.row(size).setZero();
    return true;
  }

 private:
  const SpectralModel& model_;
  const double scale_;
};

}  // namespace

SpectralState solve_coefficients(const SpectralModel& model, const Eigen::VectorXd& ln_tau,
                                 const Eigen::VectorXd& nuisance) {
  SpectralState state{ln_tau, nuisance, {}, 0.0, true};
  const ModelColumns columns = model.columns(ln_tau, nuisance, /*with_slopes=*/false);
  const Coefficients best =
      best_coefficients(model, columns.values, free_columns(model, ln_tau.size()));
  state.coefficients = best.x;
  state.rss = best.rss + model.prior_residual(nuisance).squaredNorm();
  return state;
}

SpectralState refine(const SpectralModel& model, const SpectralState& start,
                     const RefineOptions& options) {
  const Index n_terms = start.n_terms();
  const Index size = n_terms + model.n_nuisances();
  if (size == 0) return solve_coefficients(model, start.ln_tau, start.nuisance);
  const Box box = search_box(model, n_terms);
  Eigen::VectorXd p =
      search_parameters(model, start.ln_tau, start.nuisance).cwiseMax(box.low).cwiseMin(box.high);
  ceres::Problem problem;
  problem.AddParameterBlock(p.data(), static_cast<int>(size));
  for (Index i = 0; i < size; ++i) {
    problem.SetParameterLowerBound(p.data(), static_cast<int>(i), box.low[i]);
    problem.SetParameterUpperBound(p.data(), static_cast<int>(i), box.high[i]);
  }
  problem.AddResidualBlock(new ProjectedCost(model, n_terms), nullptr, p.data());

  const SearchSummary summary = solve_dense(problem, {.max_iterations = options.max_iterations,
                                                      .function_tolerance = options.tolerance,
                                                      .gradient_tolerance = 1e-30});

  SpectralState state = solve_coefficients(model, p.head(n_terms), nuisance_from(model, p));
  state.is_converged = summary.has_converged;
  return sorted_by_time(std::move(state), model.n_common());
}

Eigen::MatrixXd full_jacobian(const SpectralModel& model, const SpectralState& state) {
  const ModelColumns columns = model.columns(state.ln_tau, state.nuisance, /*with_slopes=*/true);
  const Index linear = columns.values.cols();
  const Index n_terms = state.n_terms();
  Eigen::MatrixXd jacobian(model.n_rows(), linear + n_terms + model.n_nuisances());
  jacobian.leftCols(linear) = columns.values;
  jacobian.rightCols(n_terms + model.n_nuisances()) =
      nonlinear_slopes(model, columns, state.coefficients);
  for (Index k = 0; k < model.n_nuisances(); ++k) {
    jacobian.col(linear + n_terms + k) /= model.nuisances()[static_cast<std::size_t>(k)].scale;
  }
  return jacobian;
}

}  // namespace viscard
