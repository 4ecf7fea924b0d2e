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

// Every way to have one term fewer: each term dropped, each pair of neighbours merged at their mean
// time by modulus.
std::vector<Eigen::VectorXd> reductions(const SpectralModel& model, const SpectralState& state) {
  std::vector<Eigen::VectorXd> ways;
  for (Index i = 0; i < state.n_terms(); ++i) {
    ways.push_back(without(state.ln_tau, i));
    if (i + 1 == state.n_terms()) break;
    const double a = std::abs(state.coefficients[model.n_common() + i]);
    const double b = std::abs(state.coefficients[model.n_common() + i + 1]);
    Eigen::VectorXd merged = without(state.ln_tau, i + 1);
    if (a + b > 0.0) merged[i] = (a * state.ln_tau[i] + b * state.ln_tau[i + 1]) / (a + b);
    ways.push_back(merged);
  }
  return ways;
}

// Sums of squares of all these ways from one set of normal equations: good enough to rank them when
// there are many, and far cheaper than a QR of each.
std::vector<double> ranked_roughly(const SpectralModel& model, const SpectralState& state,
                                   const std::vector<Eigen::VectorXd>& ways) {
  std::vector<double> times(state.ln_tau.begin(), state.ln_tau.end());
  for (const Eigen::VectorXd& way : ways) times.insert(times.end(), way.begin(), way.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const Eigen::Map<Eigen::VectorXd> all(times.data(), static_cast<Index>(times.size()));
  const Eigen::MatrixXd columns = model.columns(all, state.nuisance, false).values;
  const Eigen::MatrixXd gram = columns.transpose() * columns;
  const Eigen::VectorXd right = columns.transpose() * model.data();
  std::vector<double> sums;
  for (const Eigen::VectorXd& way : ways) {
    std::vector<Index> used;
    for (Index j = 0; j < model.n_common(); ++j) used.push_back(j);
    for (const double ln_tau : way) {
      used.push_back(model.n_common() +
                     (std::lower_bound(times.begin(), times.end(), ln_tau) - times.begin()));
    }
    const Eigen::VectorXd x = nonnegative_from_normal_equations(gram(used, used), right(used),
                                                                free_columns(model, way.size()));
    sums.push_back(x.dot(gram(used, used) * x) - 2.0 * x.dot(right(used)));
  }
  return sums;
}

// One term fewer: the cheapest of all ways, refined.
SpectralState with_one_less_term(const SpectralModel& model, const SpectralState& state,
                                 const RefineOptions& options) {
  const std::vector<Eigen::VectorXd> ways = reductions(model, state);
  constexpr Index kMany = 8;
  std::vector<double> sums;
  if (state.n_terms() > kMany) {
    sums = ranked_roughly(model, state, ways);
  } else {
    for (const Eigen::VectorXd& way : ways) {
      sums.push_back(solve_coefficients(model, way, state.nuisance).rss);
    }
  }
  const auto cheapest = std::min_element(sums.begin(), sums.end()) - sums.begin();
  return refine(model,
                solve_coefficients(model, ways[static_cast<std::size_t>(cheapest)], state.nuisance),
                options);
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
  const ModelColumns present = model.columns(state.ln_tau, state.nuisance, /*with_slopes=*/false);
  const ModelColumns offered = model.columns(grid, state.nuisance, /*with_slopes=*/false);
  const SignedLeastSquares fit(present.values, model.data(), free_columns(model, state.n_terms()));
  // What each new column would take off the sum of squares, the others following freely.
  const Eigen::MatrixXd columns = fit.outside(offered.values.rightCols(grid.size()));
  const Eigen::VectorXd residual = fit.outside(model.data() - present.values * fit.x());
  Index best = -1;
  double best_gain = 0.0;
  for (Index i = 0; i < grid.size(); ++i) {
    const double length = columns.col(i).squaredNorm();
    const double product = columns.col(i).dot(residual);
    const double full = offered.values.col(model.n_common() + i).squaredNorm();
    constexpr double kNothingNew = 1e-14;  // the column lies among those in use
    if (!(length > kNothingNew * full)) continue;
    if (product <= 0.0 && !model.may_be_negative()) continue;
    const double gain = product * product / length;
    if (gain > best_gain) {
      best_gain = gain;
      best = i;
    }
  }
  if (best < 0) return state;
  const SpectralState start =
      solve_coefficients(model, with(state.ln_tau, grid[best]), state.nuisance);
  const SpectralState more = refine(model, start, options.refine);
  return more.rss < state.rss ? more : state;
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
