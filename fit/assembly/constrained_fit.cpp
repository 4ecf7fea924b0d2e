#include "fit/assembly/constraints.h"
#include "fit/assembly/parametrisation.h"
#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/level_noise.h"
#include "fit/search/projection.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Stem = ParameterStem;

Box box_of(const Parametrisation& form, const std::vector<ParameterConstraint>& constraints) {
  Box box{form.lower(), form.upper()};
  for (const ParameterConstraint& one : constraints) {
    const ParameterName name = parameter_name(one.name);
    const Index at = form.position(name);
    const bool is_time = name.stem == Stem::kTime;
    // The signs may raise a lower bound; the upper bound of a share or time is the user's.
    const double low = is_time ? std::log(one.low) : one.low;
    box.low[at] = is_time || one.low == one.high ? low : std::max(box.low[at], low);
    box.high[at] = is_time ? std::log(one.high) : one.high;
  }
  return box;
}

// A time that the record cannot resolve leaves its modulus undetermined, unless the modulus is held
// too.
void check_times(const SpectralModel& model, const std::vector<ParameterConstraint>& constraints) {
  for (const ParameterConstraint& one : constraints) {
    const ParameterName name = parameter_name(one.name);
    if (name.stem != Stem::kTime) continue;
    const bool is_held =
        std::any_of(constraints.begin(), constraints.end(), [&](const ParameterConstraint& other) {
          const ParameterName of_other = parameter_name(other.name);
          return of_other.term == name.term && of_other.stem != Stem::kTime &&
                 other.low == other.high;
        });
    const double shortest_s = std::exp(model.ln_tau_min()),
                 longest_s = std::exp(model.ln_tau_max());
    constexpr double kRounding = 1e-9;
    if (is_held ||
        (one.high > shortest_s * (1.0 - kRounding) && one.low < longest_s * (1.0 + kRounding))) {
      continue;
    }
    throw std::invalid_argument(range_text(one) +
                                " is outside the times that the record can show (" +
                                text_of(shortest_s, 3) + " to " + text_of(longest_s, 3) +
                                " s); hold the modulus of the term too");
  }
}

// Refuses solutions that no data could make possible.
void check_solution(const SpectralState& state, const std::vector<ParameterConstraint>& constraints,
                    bool may_be_negative) {
  std::string all;
  for (const ParameterConstraint& one : constraints) {
    all += (all.empty() ? "" : ", ") + range_text(one);
  }
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("with " + all + " " + why);
  };
  if (!state.coefficients.allFinite() || !state.ln_tau.allFinite() || !std::isfinite(state.rss)) {
    refuse("no finite fit exists; loosen the constraints");
  }
  if (!may_be_negative && state.coefficients[0] < 0.0) {
    refuse(
        "the fitted shares sum to more than one (a negative E_inf); loosen the "
        "constraints, or use --liquid");
  }
  for (Index i = 1; i < state.n_terms(); ++i) {
    if (state.ln_tau[i] >= state.ln_tau[i - 1]) continue;
    refuse("term " + std::to_string(i + 1) + " comes out faster than term " + std::to_string(i) +
           "; terms are numbered by ascending time, so swap their numbers");
  }
}

// Adds a note if the residual of the constrained fit is larger than that of the free fit.
void flag_contradiction(double free_rss, double free_variance, double inflation, int n_held,
                        SpectralFit& fit) {
  const double rise = (fit.rss - free_rss) / std::max(free_variance * inflation, 1e-300);
  // Holding n parameters at their true values raises the residual sum by n +- sqrt(2 n) variances
  // by chance.
  const double by_chance = n_held + 5.0 * std::sqrt(2.0 * n_held);
  if (!(rise > by_chance)) return;
  constexpr double kPlain = 2.0;  // a factor that is visible without statistics
  fit.notes.push_back({fit.rss > kPlain * free_rss ? kContradictsData : "constraints-strained", 0,
                       "the constraints contradict the data: the residual sum of squares is " +
                           text_of(fit.rss / std::max(free_rss, 1e-300), 4) +
                           " times that of the free fit, " + text_of(rise, 3) +
                           " variances of the noise more"});
}

// Times to start from: the constrained times, with the others spread over the range or taken from a
// smaller free fit that has as many.
SpectralState spread_start(const SpectralModel& model, const Parametrisation& form, const Box& box,
                           const SpectralFit& fit, Index n_terms) {
  Eigen::VectorXd ln_tau(n_terms);
  std::vector<Index> open;
  for (Index i = 0; i < n_terms; ++i) {
    const Index at = form.position({Stem::kTime, static_cast<int>(i) + 1});
    const bool is_pinned = box.high[at] - box.low[at] < 1e-12;
    ln_tau[i] = 0.5 * (box.low[at] + box.high[at]);
    if (!is_pinned) open.push_back(i);
  }
  const auto n_open = static_cast<Index>(open.size());
  const auto smaller = std::find_if(fit.path.begin(), fit.path.end(),
                                    [&](const SpectralState& s) { return s.n_terms() == n_open; });
  for (Index k = 0; k < n_open; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(n_open);
    const double spread = model.ln_tau_min() + share * (model.ln_tau_max() - model.ln_tau_min());
    const Index at =
        form.position({Stem::kTime, static_cast<int>(open[static_cast<std::size_t>(k)]) + 1});
    const double wanted = smaller != fit.path.end() ? smaller->ln_tau[k] : spread;
    ln_tau[open[static_cast<std::size_t>(k)]] = std::clamp(wanted, box.low[at], box.high[at]);
  }
  return solve_coefficients(model, ln_tau, fit.state.nuisance);
}

// The parameters of theta that are neither held nor on a bound, and all nuisances.
std::vector<Index> free_parameters(const Parametrisation& form, const Box& box,
                                   const Eigen::VectorXd& theta) {
  const Index first_nuisance = theta.size() - form.model().n_nuisances();
  std::vector<Index> free;
  for (Index i = 0; i < theta.size(); ++i) {
    const double reach = 1e-9 * (1.0 + std::abs(theta[i]));
    const bool is_inside = theta[i] > box.low[i] + reach && theta[i] < box.high[i] - reach;
    if (is_inside || i >= first_nuisance) free.push_back(i);
  }
  return free;
}

// Covariances of the free parameters, extended to all: fixed ones and those on a bound have none.
class FreeCovariance {
 public:
  FreeCovariance(const Parametrisation& form, const Box& box, const SpectralFit& fit)
      : model_(form.model()), fit_(fit) {
    const Eigen::VectorXd theta = form.theta_of(fit.state);
    slopes_ = form.slopes(theta)(Eigen::all, free_parameters(form, box, theta));
    jacobian_ = full_jacobian(model_, fit.state) * slopes_;
  }

  // Covariance for noise with this autoregression; without coefficients it is white noise.
  Eigen::MatrixXd of(const Autoregression& noise) const {
    if (slopes_.cols() == 0) return Eigen::MatrixXd::Zero(slopes_.rows(), slopes_.rows());
    Eigen::MatrixXd covariance =
        covariance_from_jacobian(model_, jacobian_, fit_.variance, noise, fit_.row_scale);
    // A parameter without influence on the data keeps its value.
    covariance = covariance.array().isFinite().select(covariance, 0.0);
    return slopes_ * covariance * slopes_.transpose();
  }

 private:
  const SpectralModel& model_;
  const SpectralFit& fit_;
  Eigen::MatrixXd slopes_, jacobian_;
};

// Noise and covariance of the constrained fit, whose state is set.
void take_noise(const Parametrisation& form, const Box& box, SpectralFit& fit) {
  const SpectralModel& model = form.model();
  fit.noise = {};
  if (!fit.options.white_noise) fit.noise = autoregression(model.residual_series(fit.state));
  fit.row_scale = level_noise(model, fit.state, fit.noise.inflation()).row_scale;
  const FreeCovariance covariance(form, box, fit);
  fit.covariance = covariance.of(fit.noise);
  if (fit.options.white_noise) return;
  fit.slow = slow_noise(model, fit.state, fit.variance, fit.noise);
  const bool is_doubtful = !fit.slow.doubt.empty();
  fit.covariance =
      widened(fit.covariance, is_doubtful ? covariance.of({}) : fit.covariance, fit.slow);
}

// The row of the table of orders shows the fit that was made. Held parameters do not follow the rows, so that the
// error at rows that are left out rises by what the residual rises.
void take_row(const SpectralModel& model, Index n_terms, Index n_free, SpectralFit& fit) {
  OrderScores& scores = fit.scores;
  OrderRow& row = scores.rows[scores.chosen];
  const OrderRow free = row;
  const double noise = std::max(scores.rows.back().rss, std::max(scores.least_rss, 1e-300));
  row = scored_order(static_cast<int>(n_terms), static_cast<double>(n_free), fit.rss,
                     model.n_samples(), scores);
  row.cv = free.cv + (fit.rss - free.rss) / noise;
  row.is_chosen = true;
}

}  // namespace

void constrain(const SpectralModel& model, const FitOptions& options, SpectralFit& fit) {
  const Index n_terms = options.n_terms.value_or(static_cast<int>(fit.state.n_terms()));
  validate(options.constraints, static_cast<int>(n_terms), options.allow_negative);
  const bool by_shares = uses_shares(options.constraints);
  if (model.n_common() == 0 || model.common()[0].is_free) {
    throw std::invalid_argument("parameters of a liquid cannot be constrained");
  }
  check_times(model, options.constraints);
  const Parametrisation form(model, n_terms, by_shares);
  const Box box = box_of(form, options.constraints);
  const Index n_free = (box.high.array() > box.low.array()).count();
  if (n_free >= model.n_rows()) {
    throw std::invalid_argument(counted(static_cast<std::size_t>(model.n_rows()), "value") +
                                " cannot determine " +
                                counted(static_cast<std::size_t>(n_free), "free parameter") +
                                " and the noise; hold more of them, or use fewer terms");
  }
  SpectralState best =
      solve_in_box(form, box.low, box.high, spread_start(model, form, box, fit, n_terms));
  if (fit.state.n_terms() == n_terms) {
    const SpectralState other = solve_in_box(form, box.low, box.high, fit.state);
    if (other.rss < best.rss) best = other;
  }
  check_solution(best, options.constraints, options.allow_negative);
  const double free_rss = fit.rss, free_variance = fit.variance;
  const double free_inflation = fit.noise.inflation();
  fit.state = best;
  fit.rss = best.rss + model.hidden_rss(best);
  fit.variance = fit.rss / std::max(1.0, model.n_samples() - static_cast<double>(n_free));
  take_noise(form, box, fit);
  take_row(model, n_terms, n_free, fit);
  for (const ParameterConstraint& one : options.constraints) {
    fit.notes.push_back(
        {"constrained", 0, range_text(one) + (one.low == one.high ? " was held" : " was applied")});
  }
  flag_contradiction(free_rss, free_variance, free_inflation,
                     static_cast<int>(options.constraints.size()), fit);
}

}  // namespace viscard
