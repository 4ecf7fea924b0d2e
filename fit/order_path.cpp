#include "fit/order_path.h"

#include "fit/nnls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Index = Eigen::Index;

Eigen::VectorXd grid_of_times(const SpectralModel& model, double per_decade) {
  const double decades = (model.ln_tau_max() - model.ln_tau_min()) / std::log(10.0);
  const Index count = std::max<Index>(4, static_cast<Index>(std::ceil(decades * per_decade)) + 1);
  return Eigen::VectorXd::LinSpaced(count, model.ln_tau_min(), model.ln_tau_max());
}

Eigen::VectorXd without(const Eigen::VectorXd& values, Index leave_out) {
  Eigen::VectorXd rest(values.size() - 1);
  rest.head(leave_out) = values.head(leave_out);
  rest.tail(values.size() - 1 - leave_out) = values.tail(values.size() - 1 - leave_out);
  return rest;
}

Eigen::VectorXd with(const Eigen::VectorXd& values, double added) {
  Eigen::VectorXd more(values.size() + 1);
  more.head(values.size()) = values;
  more[values.size()] = added;
  std::sort(more.begin(), more.end());
  return more;
}

// Terms whose modulus came out zero say nothing.
SpectralState without_zero_terms(const SpectralModel& model, SpectralState state) {
  if (model.may_be_negative()) return state;
  for (Index i = state.n_terms(); i-- > 0;) {
    if (state.coefficients[model.n_common() + i] > 0.0) continue;
    state.ln_tau = without(state.ln_tau, i);
    state.coefficients = without(state.coefficients, model.n_common() + i);
  }
  return state;
}

// Non-negative spectrum on a grid; peaks on neighbouring grid points become one term at their mean
// time weighted by what they carry.
Eigen::VectorXd spectrum_peaks(const SpectralModel& model, const Eigen::VectorXd& nuisance,
                               double per_decade) {
  const Eigen::VectorXd grid = grid_of_times(model, per_decade);
  const ModelColumns columns = model.columns(grid, nuisance, /*with_slopes=*/false);
  const Eigen::VectorXd x = nonnegative_from_normal_equations(
      columns.values.transpose() * columns.values, columns.values.transpose() * model.data(),
      free_columns(model, grid.size()));
  std::vector<double> peaks;
  double weight = 0.0;
  double weighted_ln_tau = 0.0;
  for (Index i = 0; i <= grid.size(); ++i) {
    const double modulus = i < grid.size() ? x[model.n_common() + i] : 0.0;
    if (modulus > 0.0) {
      const double energy = modulus * columns.values.col(model.n_common() + i).norm();
      weight += energy;
      weighted_ln_tau += energy * grid[i];
    } else if (weight > 0.0) {
      peaks.push_back(weighted_ln_tau / weight);
      weight = weighted_ln_tau = 0.0;
    }
  }
  return Eigen::Map<Eigen::VectorXd>(peaks.data(), static_cast<Index>(peaks.size()));
}

// One term fewer: the cheapest of all drops and merges of neighbours, refined.
SpectralState with_one_less_term(const SpectralModel& model, const SpectralState& state,
                                 const RefineOptions& options) {
  std::vector<SpectralState> candidates;
  for (Index i = 0; i < state.n_terms(); ++i) {
    candidates.push_back(solve_coefficients(model, without(state.ln_tau, i), state.nuisance));
    if (i + 1 == state.n_terms()) break;
    const double a = std::abs(state.coefficients[model.n_common() + i]);
    const double b = std::abs(state.coefficients[model.n_common() + i + 1]);
    Eigen::VectorXd merged = without(state.ln_tau, i + 1);
    merged[i] = a + b > 0.0 ? (a * state.ln_tau[i] + b * state.ln_tau[i + 1]) / (a + b) : merged[i];
    candidates.push_back(solve_coefficients(model, merged, state.nuisance));
  }
  const auto cheapest = std::min_element(
      candidates.begin(), candidates.end(),
      [](const SpectralState& a, const SpectralState& b) { return a.rss < b.rss; });
  return refine(model, *cheapest, options);
}

void keep_better(std::vector<SpectralState>& path, SpectralState state) {
  const auto slot = static_cast<std::size_t>(state.n_terms());
  if (path.size() <= slot) path.resize(slot + 1, SpectralState{{}, {}, {}, -1.0, false});
  if (path[slot].rss < 0.0 || state.rss < path[slot].rss) path[slot] = std::move(state);
}

bool is_filled(const SpectralState& state) {
  return state.rss >= 0.0;
}

void descend(const SpectralModel& model, SpectralState state, const OrderPathOptions& options,
             std::vector<SpectralState>& path) {
  const Index least = model.n_common() > 0 && !model.common()[0].is_free ? 0 : 1;
  while (true) {
    keep_better(path, state);
    if (state.n_terms() <= least) return;
    state = without_zero_terms(model, with_one_less_term(model, state, options.refine));
  }
}

}  // namespace

SpectralState with_one_more_term(const SpectralModel& model, const SpectralState& state,
                                 const OrderPathOptions& options) {
  const Eigen::VectorXd grid = grid_of_times(model, 0.5 * options.grid_per_decade);
  SpectralState best = state;
  for (const double ln_tau : grid) {
    SpectralState trial = solve_coefficients(model, with(state.ln_tau, ln_tau), state.nuisance);
    if (trial.rss < best.rss) best = std::move(trial);
  }
  return best.n_terms() == state.n_terms() ? state : refine(model, best, options.refine);
}

std::vector<SpectralState> order_path(const SpectralModel& model, const OrderPathOptions& options) {
  std::vector<SpectralState> path;
  const bool has_elastic = model.n_common() > 0 && !model.common()[0].is_free;
  Eigen::VectorXd nuisance = model.nuisance_start();
  if (has_elastic) {
    const SpectralState elastic =
        refine(model, solve_coefficients(model, Eigen::VectorXd(0), nuisance), options.refine);
    keep_better(path, elastic);
    nuisance = elastic.nuisance;
  }
  if (!model.may_be_negative() && options.max_terms > 0) {
    SpectralState start = solve_coefficients(
        model, spectrum_peaks(model, nuisance, options.grid_per_decade), nuisance);
    start = without_zero_terms(model, std::move(start));
    while (start.n_terms() > options.max_terms) {
      start = with_one_less_term(model, start, {.max_iterations = 0});
    }
    if (start.n_terms() > 0 || has_elastic) {
      descend(model, without_zero_terms(model, refine(model, start, options.refine)), options,
              path);
    }
  }
  // Upwards, as far as it helps.
  const std::size_t known = path.size();
  for (std::size_t n = 0; n < static_cast<std::size_t>(options.max_terms); ++n) {
    if (n >= path.size()) break;
    if (n > 0 && !is_filled(path[n])) continue;
    SpectralState below = path[n];
    if (n == 0 && !is_filled(below))
      below = solve_coefficients(model, Eigen::VectorXd(0), nuisance);
    const SpectralState above =
        without_zero_terms(model, with_one_more_term(model, below, options));
    const bool is_new = above.n_terms() == below.n_terms() + 1;
    // Beyond the order the spectrum asked for, only while the fit still gets visibly better.
    if (is_new && (n + 1 < known || above.rss < below.rss * (1.0 - 1e-3))) keep_better(path, above);
  }
  // An order that no search could bring below a smaller one has nothing to say.
  double lowest = std::numeric_limits<double>::infinity();
  std::erase_if(path, [&](const SpectralState& state) {
    if (!is_filled(state) || !(state.rss < lowest)) return true;
    lowest = state.rss;
    return false;
  });
  return path;
}

}  // namespace viscard
