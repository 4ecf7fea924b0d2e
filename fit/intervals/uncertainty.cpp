#include "fit/intervals/uncertainty.h"

#include "models/maths/dense.h"
#include "models/maths/failure_text.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// E_inf, E_i, ln tau_i of a series.
Eigen::VectorXd vector_from(const PronySeries& series) {
  const auto n = static_cast<Index>(series.terms.size());
  Eigen::VectorXd vector(1 + 2 * n);
  vector[0] = series.equilibrium_modulus_Pa;
  for (Index i = 0; i < n; ++i) {
    vector[1 + i] = series.terms[static_cast<std::size_t>(i)].modulus_Pa;
    vector[1 + n + i] = std::log(series.terms[static_cast<std::size_t>(i)].relaxation_time_s);
  }
  return vector;
}

// d(E_inf, E_i, ln tau_i)/d(parameters of the state), by central differences.
Eigen::MatrixXd series_slopes(const SpectralModel& model, const SpectralState& state,
                              const SeriesFromState& series_from_state) {
  const Index linear = state.coefficients.size();
  const Index n_terms = state.n_terms();
  const Index total = linear + n_terms + model.n_nuisances();
  const Eigen::VectorXd here = vector_from(series_from_state(state));
  const Index size = here.size();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(size, total);
  constexpr double kStep = 1e-5;
  for (Index j = 0; j < linear + n_terms; ++j) {
    if (j < model.n_common() && model.common()[static_cast<std::size_t>(j)].is_free) {
      continue;  // offset and drift are not parameters of the material
    }
    SpectralState up = state;
    SpectralState down = state;
    double step = kStep;
    if (j < linear && state.coefficients[j] == 0.0) {  // on its bound: one-sided difference
      step = 0.5 * kStep * state.coefficients.cwiseAbs().maxCoeff();
      if (!(step > 0.0)) continue;
      up.coefficients[j] = 2.0 * step;
    } else if (j < linear) {
      step = kStep * std::abs(state.coefficients[j]);
      up.coefficients[j] += step;
      down.coefficients[j] -= step;
    } else {
      up.ln_tau[j - linear] += step;
      down.ln_tau[j - linear] -= step;
    }
    // In creep a term that almost vanishes may be one of the series on one side only.
    Eigen::VectorXd above = vector_from(series_from_state(up));
    Eigen::VectorXd below = vector_from(series_from_state(down));
    int n_steps = 2;
    for (Eigen::VectorXd* side : {&above, &below}) {
      if (side->size() == size) continue;
      *side = here;
      --n_steps;
    }
    if (n_steps > 0) slopes.col(j) = (above - below) / (n_steps * step);
  }
  return slopes;
}

// For two nearly equal terms the covariance has huge entries that should cancel in the sum. The
// rounding error that remains counts as part of the error, so the error is never zero.
double error_of(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& gradient) {
  constexpr double kRounding = 1e-15;
  const Eigen::VectorXd size = gradient.cwiseAbs();
  const double lost = kRounding * size.dot(covariance.cwiseAbs() * size);
  return std::sqrt(std::max(lost, gradient.dot(covariance * gradient)));
}

Interval symmetric(double value, double error) {
  return {value - kNormal95 * error, value + kNormal95 * error};
}

}  // namespace

std::optional<PronySeries> possible_series(const SpectralModel& model, const SpectralState& state,
                                           const SeriesFromState& series_from_state) {
  const std::vector<bool> is_free = free_columns(model, state.n_terms());
  for (Index j = 0; j < state.coefficients.size(); ++j) {
    if (!is_free[static_cast<std::size_t>(j)] && !(state.coefficients[j] >= 0.0)) {
      return std::nullopt;
    }
  }
  try {
    return series_from_state(state);
  } catch (const std::exception& error) {
    if (!is_refusal(error))
      throw;  // a lack of memory or a request to stop is no property of the state
    return std::nullopt;
  }
}

void add_slow_part(Eigen::MatrixXd& covariance, const Eigen::VectorXd& white,
                   const Autoregression& noise) {
  if (noise.slow_factor <= 1.0) return;
  const double of_phi = noise.inflation() / noise.slow_factor;
  for (Index j = 0; j < covariance.rows(); ++j) {
    const double share = std::clamp(covariance(j, j) / (white[j] * of_phi), 0.0, 1.0);
    const double factor = std::sqrt(1.0 + share * (noise.slow_factor - 1.0));
    covariance.row(j) *= factor;
    covariance.col(j) *= factor;
  }
}

Eigen::MatrixXd scaled_rows(const Eigen::MatrixXd& rows, const Eigen::VectorXd& row_scale) {
  if (row_scale.size() == 0) return rows;
  return row_scale.asDiagonal() * rows;
}

Eigen::MatrixXd parameter_covariance(const SpectralModel& model, const SpectralState& state,
                                     double variance, const Autoregression& noise,
                                     const Eigen::VectorXd& row_scale) {
  return covariance_from_jacobian(model, full_jacobian(model, state), variance, noise, row_scale);
}

Eigen::MatrixXd covariance_from_jacobian(const SpectralModel& model, Eigen::MatrixXd jacobian,
                                         double variance, const Autoregression& noise,
                                         const Eigen::VectorXd& row_scale) {
  const Index count = jacobian.cols(), priors = model.n_nuisances();
  jacobian.conservativeResize(model.n_rows() + priors, Eigen::NoChange);
  jacobian.bottomRows(priors).setZero();
  jacobian.bottomRightCorner(priors, priors).diagonal() =
      std::sqrt(variance) * model.prior_weight();
  std::vector<Index> seen;
  Eigen::MatrixXd scaled(jacobian.rows(), count);
  Eigen::VectorXd norm(count);
  for (Index j = 0; j < count; ++j) {
    norm[j] = jacobian.col(j).norm();
    if (!(norm[j] > 0.0)) continue;
    scaled.col(static_cast<Index>(seen.size())) = jacobian.col(j) / norm[j];
    seen.push_back(j);
  }
  const auto used = static_cast<Index>(seen.size());
  const HouseholderQr qr(scaled.leftCols(used));
  const Eigen::MatrixXd inverse = qr.upper_inverse();
  Eigen::MatrixXd part = variance * inverse * inverse.transpose();
  if (!noise.phi.empty() || row_scale.size() > 0) {
    // (J^T J)^-1 J^T = R^-1 Q^T; the middle is Q^T S C S Q.
    const Eigen::MatrixXd q = qr.basis();
    const Eigen::MatrixXd of_priors = q.bottomRows(priors);
    const Eigen::MatrixXd of_rows = scaled_rows(q.topRows(model.n_rows()), row_scale);
    Eigen::MatrixXd middle = of_rows.transpose() * of_rows + of_priors.transpose() * of_priors;
    const Eigen::VectorXd white = (variance * inverse * middle * inverse.transpose()).diagonal();
    if (!noise.phi.empty()) {
      middle = of_rows.transpose() * correlated_rows(of_rows, model.row_begins(), noise) +
               of_priors.transpose() * of_priors;
    }
    part = variance * inverse * middle * inverse.transpose();
    add_slow_part(part, white, noise);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  for (Index a = 0; a < used; ++a) {
    for (Index b = 0; b < used; ++b) {
      const Index i = seen[static_cast<std::size_t>(a)];
      const Index j = seen[static_cast<std::size_t>(b)];
      covariance(i, j) = part(a, b) / (norm[i] * norm[j]);
    }
  }
  return covariance;
}

namespace {

// A series with the covariance of (E_inf, E_i, ln tau_i).
struct KnownSeries {
  PronySeries series;
  Eigen::MatrixXd covariance;
  double E0 = 0.0;
  Eigen::VectorXd of_E0;  // gradient of E0

  Index n_terms() const { return static_cast<Index>(series.terms.size()); }
  Eigen::VectorXd unit(Index parameter) const {
    return Eigen::VectorXd::Unit(covariance.rows(), parameter);
  }
  // Standard error of value/E0, from the gradient of the value.
  double relative_error(const Eigen::VectorXd& gradient, double value) const {
    return error_of(covariance, (gradient - of_E0 * (value / E0)) / E0);
  }
};

KnownSeries known_series(const SpectralModel& model, const SpectralState& state,
                         const Eigen::MatrixXd& covariance,
                         const SeriesFromState& series_from_state) {
  const Eigen::MatrixXd slopes = series_slopes(model, state, series_from_state);
  // The product of an infinite variance with no influence would be 0 * inf; set such entries to 0.
  Eigen::MatrixXd finite = covariance;
  for (Index j = 0; j < finite.rows(); ++j) {
    if (!std::isfinite(finite(j, j))) finite(j, j) = 0.0;
  }
  KnownSeries known{series_from_state(state), slopes * finite * slopes.transpose(), 0.0, {}};
  known.E0 = instantaneous_modulus_Pa(known.series);
  known.of_E0 = Eigen::VectorXd::Zero(known.covariance.rows());
  known.of_E0.head(1 + known.n_terms()).setOnes();
  return known;
}

FittedTerm fitted_term(const KnownSeries& known, Index i) {
  const MaxwellTerm& from = known.series.terms[static_cast<std::size_t>(i)];
  const Index modulus = 1 + i, time = 1 + known.n_terms() + i;
  FittedTerm term;
  term.modulus_Pa = from.modulus_Pa;
  term.g = from.modulus_Pa / known.E0;
  term.tau_s = from.relaxation_time_s;
  term.modulus_se_Pa = std::sqrt(std::max(0.0, known.covariance(modulus, modulus)));
  term.ln_tau_se = std::sqrt(std::max(0.0, known.covariance(time, time)));
  term.modulus_Pa_95 = symmetric(term.modulus_Pa, term.modulus_se_Pa);
  term.g_95 = symmetric(term.g, known.relative_error(known.unit(modulus), term.modulus_Pa));
  term.tau_s_95 = {term.tau_s * std::exp(-kNormal95 * term.ln_tau_se),
                   term.tau_s * std::exp(kNormal95 * term.ln_tau_se)};
  return term;
}

std::vector<std::string> parameter_names(Index n_terms, bool is_stiffness) {
  const std::string unit = is_stiffness ? "_N_m" : "_Pa";
  std::vector<std::string> names{"E_inf" + unit};
  for (Index i = 1; i <= n_terms; ++i) names.push_back("E_" + std::to_string(i) + unit);
  for (Index i = 1; i <= n_terms; ++i) names.push_back("ln_tau_" + std::to_string(i));
  return names;
}

}  // namespace

void fill_parameters(const SpectralModel& model, const SpectralState& state,
                     const Eigen::MatrixXd& covariance, const SeriesFromState& series_from_state,
                     FitResult& result) {
  const KnownSeries known = known_series(model, state, covariance, series_from_state);
  result.E_inf_Pa = known.series.equilibrium_modulus_Pa;
  result.E0_Pa = known.E0;
  result.E0_se_Pa = error_of(known.covariance, known.of_E0);
  result.E_inf_se_Pa = std::sqrt(std::max(0.0, known.covariance(0, 0)));
  result.E0_interval_95 = symmetric(result.E0_Pa, result.E0_se_Pa);
  result.E_inf_interval_95 = symmetric(result.E_inf_Pa, result.E_inf_se_Pa);
  if (!model.may_be_negative()) {
    result.E_inf_interval_95.low = std::max(0.0, result.E_inf_interval_95.low);
  }
  result.sum_g = 1.0 - result.E_inf_Pa / known.E0;
  result.sum_g_95 = symmetric(result.sum_g, known.relative_error(known.unit(0), result.E_inf_Pa));
  result.terms.clear();
  for (Index i = 0; i < known.n_terms(); ++i) result.terms.push_back(fitted_term(known, i));
  result.covariance = known.covariance;
  result.covariance_parameters = parameter_names(known.n_terms(), result.is_stiffness);
}

}  // namespace viscard
