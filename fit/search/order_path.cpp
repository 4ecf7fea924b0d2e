#include "fit/search/order_path.h"

#include "fit/search/nnls.h"
#include "fit/search/separable.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

Eigen::VectorXd grid_of_times(const SpectralModel& model, double per_decade) {
  const double decades = (model.ln_tau_max() - model.ln_tau_min()) / std::log(10.0);
  const Index count = std::max<Index>(4, static_cast<Index>(std::ceil(decades * per_decade)) + 1);
  return Eigen::VectorXd::LinSpaced(count, model.ln_tau_min(), model.ln_tau_max());
}

Eigen::VectorXd with(const Eigen::VectorXd& values, double added) {
  Eigen::VectorXd more(values.size() + 1);
  more.head(values.size()) = values;
  more[values.size()] = added;
  std::sort(more.begin(), more.end());
  return more;
}

// Terms with zero modulus carry no information; remove them.
SpectralState without_zero_terms(const SpectralModel& model, SpectralState state) {
  if (model.may_be_negative()) return state;
  for (Index i = state.n_terms(); i-- > 0;) {
    if (state.coefficients[model.n_common() + i] > 0.0) continue;
    state.ln_tau = without(state.ln_tau, i);
    state.coefficients = without(state.coefficients, model.n_common() + i);
  }
  return state;
}

// Non-negative spectrum on a grid. Adjacent non-zero grid points become one term at their mean
// time, weighted by their contribution to the data.
Eigen::VectorXd spectrum_peaks(const SpectralModel& model, const Eigen::VectorXd& nuisance,
                               double per_decade) {
  const Eigen::VectorXd grid = grid_of_times(model, per_decade);
  const ModelColumns columns = model.columns(grid, nuisance, /*with_slopes=*/false);
  const Eigen::VectorXd x = nonnegative_from_normal_equations(
      gram_of(columns.values), transposed_product(columns.values, model.data()),
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

// One term fewer: the cheapest candidate, refined. For few terms the search is cheap and the
// candidates lead to different local minima, so the best of several is taken.
SpectralState with_one_less_term(const SpectralModel& model, const SpectralState& state,
                                 RefineOptions options) {
  constexpr Index kFew = 12;
  constexpr std::size_t kWays = 5;
  constexpr double kHidden = 2.0;
  const std::vector<Eigen::VectorXd> ways = reductions(model, state);
  const std::size_t tried = state.n_terms() <= kFew ? std::min(kWays, ways.size()) : 1;
  SpectralState best;
  best.rss = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tried; ++i) {
    SpectralState less;
    less.ln_tau = ways[i];
    less.nuisance = state.nuisance;
    less = quick_search(model, less, options);
    if (!(less.rss < best.rss)) continue;
    options.target = std::min(options.target, less.rss);
    best = std::move(less);
    // The increase is below the noise level, so stop trying other removals.
    if (best.rss - state.rss < kHidden * model.sample_variance()) break;
  }
  return best;
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

RefineOptions better_than(RefineOptions options, const std::vector<SpectralState>& path,
                          std::size_t n_terms) {
  if (n_terms < path.size() && is_filled(path[n_terms])) options.target = path[n_terms].rss;
  return options;
}

// The order of the spectrum's peaks at these nuisances and all smaller ones.
void descend_from_peaks(const SpectralModel& model, const Eigen::VectorXd& nuisance,
                        const OrderPathOptions& options, std::vector<SpectralState>& path) {
  const bool has_elastic = model.n_common() > 0 && !model.common()[0].is_free;
  SpectralState start =
      solve_coefficients(model, spectrum_peaks(model, nuisance, options.grid_per_decade), nuisance);
  start = without_zero_terms(model, std::move(start));
  while (start.n_terms() > options.max_terms) {
    start = with_one_less_term(model, start, {.max_iterations = 0});
  }
  if (start.n_terms() == 0 && !has_elastic) return;
  descend(model, without_zero_terms(model, quick_search(model, start, options.refine)), options,
          path);
}

// Upward pass. Returns the previously known orders whose fit improved.
std::vector<std::size_t> ascend(const SpectralModel& model, const Eigen::VectorXd& nuisance,
                                const OrderPathOptions& options, std::vector<SpectralState>& path) {
  std::vector<std::size_t> improved;
  const std::size_t known = path.size();
  for (std::size_t n = 0; n < static_cast<std::size_t>(options.max_terms); ++n) {
    if (n >= path.size()) break;
    if (n > 0 && !is_filled(path[n])) continue;
    SpectralState below = path[n];
    if (n == 0 && !is_filled(below))
      below = solve_coefficients(model, Eigen::VectorXd(0), nuisance);
    OrderPathOptions targeted = options;
    targeted.refine = better_than(options.refine, path, n + 1);
    SpectralState above = without_zero_terms(model, with_one_more_term(model, below, targeted));
    const bool is_new = above.n_terms() == below.n_terms() + 1;
    // Beyond the largest order of the start spectrum, continue only while the fit improves visibly.
    if (!is_new || (n + 1 >= known && above.rss >= below.rss * (1.0 - 1e-3))) continue;
    constexpr double kVisible = 1e-6;
    if (above.rss < targeted.refine.target * (1.0 - kVisible)) improved.push_back(n + 1);
    keep_better(path, std::move(above));
  }
  return improved;
}

// Downward pass from an order that improved, as long as the smaller orders improve too.
void descend_again(const SpectralModel& model, std::size_t from, const OrderPathOptions& options,
                   std::vector<SpectralState>& path) {
  for (std::size_t n = from; n > 1 && is_filled(path[n]); --n) {
    const RefineOptions refine = better_than(options.refine, path, n - 1);
    SpectralState less = without_zero_terms(model, with_one_less_term(model, path[n], refine));
    if (less.n_terms() + 1 != static_cast<Index>(n) || !(less.rss < refine.target)) return;
    keep_better(path, std::move(less));
  }
}

}  // namespace

SpectralState with_one_more_term(const SpectralModel& model, const SpectralState& state,
                                 const OrderPathOptions& options) {
  const Eigen::VectorXd grid = grid_of_times(model, 0.5 * options.grid_per_decade);
  const ModelColumns present = model.columns(state.ln_tau, state.nuisance, /*with_slopes=*/false);
  const Eigen::MatrixXd offered =
      model.columns(grid, state.nuisance, /*with_slopes=*/false).values.rightCols(grid.size());
  const Offers offers =
      offers_of(model, present.values, offered, free_columns(model, state.n_terms()));
  Index best = -1;
  double best_gain = 0.0;
  for (Index i = 0; i < grid.size(); ++i) {
    constexpr double kNothingNew = 1e-14;  // the column is linearly dependent on those in use
    if (!(offers.length[i] > kNothingNew * offered.col(i).squaredNorm())) continue;
    if (offers.product[i] <= 0.0 && !model.may_be_negative()) continue;
    const double gain = offers.product[i] * offers.product[i] / offers.length[i];
    if (gain > best_gain) {
      best_gain = gain;
      best = i;
    }
  }
  constexpr double kChance = 1.0;  // in variances: no gain, or less than chance would give
  if (best < 0 || best_gain < kChance * model.sample_variance()) return state;
  const SpectralState start =
      solve_coefficients(model, with(state.ln_tau, grid[best]), state.nuisance);
  const SpectralState more = quick_search(model, start, options.refine);
  return more.rss < state.rss ? more : state;
}

std::vector<SpectralState> order_path(const SpectralModel& model, const OrderPathOptions& options) {
  std::vector<SpectralState> path;
  const bool has_elastic = model.n_common() > 0 && !model.common()[0].is_free;
  Eigen::VectorXd nuisance = model.nuisance_start();
  const bool has_peaks = !model.may_be_negative() && options.max_terms > 0;
  if (has_elastic) {
    const SpectralState elastic = quick_search(
        model, solve_coefficients(model, Eigen::VectorXd(0), nuisance), options.refine);
    keep_better(path, elastic);
    // An elastic fit to a specimen that relaxes much moves the nuisances far away, from where later
    // fits may not return.
    if (has_peaks && nuisance.size() > 0) descend_from_peaks(model, nuisance, options, path);
    nuisance = elastic.nuisance;
  }
  if (has_peaks) descend_from_peaks(model, nuisance, options, path);
  const std::vector<std::size_t> improved = ascend(model, nuisance, options, path);
  for (auto n = improved.rbegin(); n != improved.rend(); ++n)
    descend_again(model, *n, options, path);
  std::erase_if(path, [](const SpectralState& state) { return !is_filled(state); });
  drop_useless_orders(path);
  return path;
}

void drop_useless_orders(std::vector<SpectralState>& path) {
  double lowest = std::numeric_limits<double>::infinity();
  std::erase_if(path, [&](const SpectralState& state) {
    if (!(state.rss < lowest)) return true;
    lowest = state.rss;
    return false;
  });
}

}  // namespace viscard
