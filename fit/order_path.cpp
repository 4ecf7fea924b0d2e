#include "fit/order_path.h"

#include "fit/nnls.h"
#include "fit/quick_search.h"

#include <Eigen/LU>
#include <Eigen/QR>

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

// The pair (i, i + 1) merged at its mean time by modulus.
double merged_ln_tau(const SpectralModel& model, const SpectralState& state, Index i) {
  const double a = std::abs(state.coefficients[model.n_common() + i]);
  const double b = std::abs(state.coefficients[model.n_common() + i + 1]);
  if (!(a + b > 0.0)) return state.ln_tau[i];
  return (a * state.ln_tau[i] + b * state.ln_tau[i + 1]) / (a + b);
}

// What the sum of squares grows by when terms go or are replaced, the others following freely: for
// A = (V^T V)^-1 and coefficients x, dropping the columns R costs x_R^T (A_RR)^-1 x_R; a new column
// m then takes back (m^T r)^2/|m outside the rest|^2.
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
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(values * scale.cwiseInverse().asDiagonal());
    const auto upper = qr.matrixQR().topRows(values.cols()).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd inverse =
        scale.cwiseInverse().asDiagonal() *
        Eigen::MatrixXd(upper.solve(Eigen::MatrixXd::Identity(values.cols(), values.cols())));
    inverse_gram_ = inverse * inverse.transpose();
    const Eigen::MatrixXd rotated = qr.householderQ().adjoint() * offered;
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
  Eigen::MatrixXd shares_;   // coefficients of each merged column in those present
  Eigen::VectorXd outside_;  // squared length of what is outside them
  Eigen::VectorXd left_;     // its product with the residual
};

// Times of all ways to have one term fewer, dropping one or merging two neighbours, cheapest first.
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
  for (auto& way : ways) {  // what rounding made of a nearly dependent pair comes last
    if (!std::isfinite(way.first)) way.first = std::numeric_limits<double>::max();
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> times;
  for (auto& way : ways) times.push_back(std::move(way.second));
  return times;
}

// One term fewer: the cheapest way, refined. With few terms, where each leads to another valley and
// the search costs little, the best of some ways.
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
    // Nothing was lost that the noise would not hide: other ways lead no lower.
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

// Upwards, as far as it helps. Returns the orders that were known and became better.
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
    // Beyond the order the spectrum asked for, only while the fit still gets visibly better.
    if (!is_new || (n + 1 >= known && above.rss >= below.rss * (1.0 - 1e-3))) continue;
    constexpr double kVisible = 1e-6;
    if (above.rss < targeted.refine.target * (1.0 - kVisible)) improved.push_back(n + 1);
    keep_better(path, std::move(above));
  }
  return improved;
}

// Down from an order that has become better, while that makes the next ones better too.
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
  constexpr double kChance = 1.0;  // variances: nothing, or less than chance, to be had
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
  if (has_elastic) {
    const SpectralState elastic = quick_search(
        model, solve_coefficients(model, Eigen::VectorXd(0), nuisance), options.refine);
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
      descend(model, without_zero_terms(model, quick_search(model, start, options.refine)), options,
              path);
    }
  }
  const std::vector<std::size_t> improved = ascend(model, nuisance, options, path);
  for (auto n = improved.rbegin(); n != improved.rend(); ++n)
    descend_again(model, *n, options, path);
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
