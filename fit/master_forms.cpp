#include "fit/master_forms.h"

#include "fit/assembly/assemble_result.h"
#include "fit/intervals/uncertainty.h"
#include "fit/samples/noise_model.h"
#include "fit/search/separable.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

}  // namespace

std::unique_ptr<MasterModel> Forms::model(const MasterShape& shape,
                                          const Eigen::VectorXd& ln_a) const {
  const std::vector<double> start(ln_a.begin(), ln_a.end());
  return std::make_unique<MasterModel>(segments_, start_.reference, start, options_, shape);
}

FormFit Forms::fit(const MasterShape& shape, const Eigen::VectorXd& ln_tau,
                   const Eigen::VectorXd& ln_a) const {
  FormFit out{shape, model(shape, ln_a), {}, 0.0, 0.0};
  SpectralState near;
  near.ln_tau = ln_tau;
  near.nuisance = out.model->nuisance_start();
  out.state = quick_search(*out.model, near, {.max_iterations = 200, .tolerance = 1e-9});
  out.rss =
      (out.model->fitted(out.state) - out.model->data()).squaredNorm() * shape.noise * shape.noise;
  out.parameters = determined(out);
  return out;
}

// A parameter whose prior the data do not narrow is not counted.
double Forms::determined(const FormFit& fit) const {
  const auto all = static_cast<double>(fit.model->n_nuisances());
  const Eigen::VectorXd weight = fit.model->prior_weight();
  if (weight.size() == 0 || weight.maxCoeff() == 0.0) return all;
  const Eigen::MatrixXd covariance = parameter_covariance(*fit.model, fit.state, 1.0);
  const Eigen::VectorXd variance = covariance.diagonal().tail(weight.size());
  double held = 0.0;
  for (Index j = 0; j < weight.size(); ++j) {
    if (weight[j] > 0.0) held += std::min(1.0, variance[j] * weight[j] * weight[j]);
  }
  return all - held;
}

// Sum of squared errors of predicting each block of rows from all others, by one linearised step:
// e_b = (1 - H_bb)^-1 r_b, where H is the hat matrix of all parameters and priors. A block that
// alone determines a parameter counts as ten times its residual.
double Forms::predicted_error(const FormFit& fit) const {
  Eigen::MatrixXd jacobian = full_jacobian(*fit.model, fit.state);
  const Index priors = fit.model->n_nuisances();
  Eigen::VectorXd penalty = Eigen::VectorXd::Zero(jacobian.cols());
  penalty.tail(priors) = fit.model->prior_weight().cwiseAbs2();
  const Eigen::VectorXd scale =
      (jacobian.colwise().squaredNorm().transpose() + penalty).cwiseMax(1e-300).cwiseSqrt();
  jacobian = jacobian * scale.cwiseInverse().asDiagonal();
  Eigen::MatrixXd gram = gram_of(jacobian);
  constexpr double kRidge = 1e-10;
  gram.diagonal() += penalty.cwiseQuotient(scale.cwiseAbs2());
  gram.diagonal().array() += kRidge;
  const Cholesky factor(gram);
  if (!factor.is_definite()) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd basis = factor.over_upper(jacobian);
  const Eigen::VectorXd residual = fit.model->data() - fit.model->fitted(fit.state);
  double sum = 0.0;
  constexpr double kAlone = 0.1;
  for (Index from = 0; from < residual.size();) {
    Index to = from;
    while (to < residual.size() &&
           blocks_[static_cast<std::size_t>(to)] == blocks_[static_cast<std::size_t>(from)]) {
      ++to;
    }
    const Eigen::MatrixXd q = basis.middleRows(from, to - from);
    const Eigen::MatrixXd left =
        (1.0 + kAlone) * Eigen::MatrixXd::Identity(q.rows(), q.rows()) - q * q.transpose();
    sum += SymmetricFactor(left)
               .solve(Eigen::VectorXd(residual.segment(from, to - from)))
               .squaredNorm();
    from = to;
  }
  return sum;
}

FormFit Forms::smooth(const FormFit& first) const {
  FormFit best, last;
  double least = std::numeric_limits<double>::infinity();
  for (const double factor : {0.03, 0.125, 0.5, 2.0, 8.0}) {
    MasterShape shape = first.shape;
    shape.curvature_sd *= factor;
    const FormFit& from = last.model ? last : first;
    FormFit next = fit(shape, from.state.ln_tau, from.model->ln_a(from.state.nuisance));
    const double error = predicted_error(next);
    constexpr double kAsGood = 0.99;  // prefer the smoother form unless the other is visibly better
    if (error < kAsGood * least) {
      least = error;
      best = next;
    }
    last = std::move(next);
  }
  return best;
}

SpectralFit Forms::at_fixed(const Eigen::VectorXd& ln_a, const std::vector<double>& ln_b) const {
  const auto fixed = model({.form = ShiftFormKind::kFixed, .fixed_ln_b = ln_b}, ln_a);
  return fit_spectrum(*fixed, blocks_, options_);
}

bool Forms::prefers_vertical(const FormFit& plain, const FormFit& vertical) const {
  constexpr double kVeryStrong = 10.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  const Yardstick yard = yardstick_of(vertical, vertical, options_);
  return yard.bic(vertical) < yard.bic(plain) - kVeryStrong;
}

bool Yardstick::is_worse(const FormFit& form) const {
  constexpr double kVisible = 1.2;
  const double spare = std::max(0.5, parameters - form.parameters);
  const double rise = (form.rss - rss) / (variance * inflation);
  return rise > spare + 4.0 * std::sqrt(2.0 * spare) && form.rss > kVisible * kVisible * rss;
}

double Yardstick::bic(const FormFit& form) const {
  const double n = rows / inflation;
  return n * std::log(std::max(form.rss, 1e-12 * rows)) + form.parameters * std::log(n);
}

Yardstick yardstick_of(const FormFit& free, const FormFit& smooth, const FitOptions& options) {
  Yardstick yard;
  yard.rows = static_cast<double>(free.model->n_rows());
  yard.rss = free.rss;
  yard.parameters = free.parameters;
  const auto spectrum =
      static_cast<double>(free.model->n_common() + 2 * free.state.n_terms()) + free.parameters;
  constexpr double kVisible = 1e-6;  // relative, of a value
  yard.variance = std::max(free.rss / std::max(1.0, yard.rows - spectrum), kVisible * kVisible);
  if (!options.white_noise) {
    yard.inflation =
        std::max(1.0, autoregression(smooth.model->residual_series(smooth.state)).inflation());
  }
  return yard;
}

}  // namespace viscard
