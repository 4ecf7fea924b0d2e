#include "fit/search/full_system.h"
#include "fit/search/polish.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

double rss_of_rows(const SpectralModel& model, const SpectralState& state) {
  return (model.data() - model.fitted(state)).squaredNorm() +
         model.prior_residual(state.nuisance).squaredNorm();
}

// Lower and upper bounds of coefficients and ln tau.
struct Bounds {
  Eigen::VectorXd low, high;
};

Bounds bounds_of(const SpectralModel& model, const SpectralState& state) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Index linear = state.coefficients.size(), n = linear + state.n_terms();
  Bounds bounds{Eigen::VectorXd::Constant(n, -kInfinity), Eigen::VectorXd::Constant(n, kInfinity)};
  const std::vector<bool> is_free = free_columns(model, state.n_terms());
  for (Index j = 0; j < linear; ++j) {
    if (!is_free[static_cast<std::size_t>(j)]) bounds.low[j] = 0.0;
  }
  bounds.low.tail(state.n_terms()).setConstant(model.ln_tau_min());
  bounds.high.tail(state.n_terms()).setConstant(model.ln_tau_max());
  return bounds;
}

// Half the second derivatives of the sum of squares of the averages with respect to coefficients
// and ln tau, from differences of its gradient. Where that sum is almost flat, the term that
// Gauss-Newton neglects matters.
Eigen::MatrixXd curvature_of(const SpectralModel& model, const SpectralState& state,
                             const Eigen::VectorXd& unit) {
  constexpr double kShare = 1e-4;  // of the sum's own scale
  const double reach = kShare * model.data().norm();
  const Index n = unit.size();
  Eigen::MatrixXd curvature(n, n);
  const auto descent_at = [&](Index i, double by) {
    const FullSystem at =
        full_system(model, moved_by(state, by * unit[i] * Eigen::VectorXd::Unit(n, i)));
    return Eigen::VectorXd(transposed_product(at.jacobian, at.residual).cwiseProduct(unit));
  };
  for (Index i = 0; i < n; ++i) {
    curvature.col(i) = (descent_at(i, -reach) - descent_at(i, reach)) / (2.0 * reach);
  }
  return 0.5 * (curvature + curvature.transpose());
}

// Searches the optimum of all samples among the parameters that are not on a bound, by quasi-Newton
// steps that start with the curvature of the averages. A step ends at the first bound that it
// meets, and is halved until the sum of squares falls.
class SamplePolish {
 public:
  SamplePolish(const SpectralModel& model, const SpectralState& start,
               SpectralModel::SampleSums sums)
      : model_(model), state_(start), now_(std::move(sums)), bounds_(bounds_of(model, start)) {
    const Eigen::MatrixXd jacobian = full_system(model, start).jacobian;
    unit_ = unit_of(jacobian);
    gauss_newton_ = unit_.asDiagonal() * gram_of(jacobian) * unit_.asDiagonal();
  }

  PolishedState run() {
    constexpr int kMostSteps = 150;
    if (is_there()) return {state_, now_.rss};
    curvature_ = curvature_of(model_, state_, unit_);
    for (int step = 0; step < kMostSteps; ++step) {
      if (!advance()) break;
    }
    state_.rss = rss_of_rows(model_, state_);
    return {state_, now_.rss};
  }

 private:
  // A smaller gain of the sum of squares ends the search. A useful additional parameter would gain
  // about 1 over the number of samples.
  static constexpr double kGain = 1e-10;

  Eigen::VectorXd parameters() const {
    Eigen::VectorXd all(bounds_.low.size());
    all << state_.coefficients, state_.ln_tau;
    return all;
  }

  // True in the usual case, where the gain predicted by a Gauss-Newton step is negligible.
  bool is_there() const {
    const Cholesky factor(gauss_newton_);
    if (!factor.is_definite()) return false;
    const Eigen::VectorXd descent = now_.descent.cwiseProduct(unit_);
    return factor.solve_lower(descent).squaredNorm() < kGain * now_.rss;
  }

  bool leads_out(Index i, const Eigen::VectorXd& at, const Eigen::VectorXd& direction) const {
    return (at[i] <= bounds_.low[i] && direction[i] < 0.0) ||
           (at[i] >= bounds_.high[i] && direction[i] > 0.0);
  }

  // Removes the parameters whose bounds the direction would violate. Returns true if there were
  // any.
  bool hold_outward(std::vector<Index>& free, const Eigen::VectorXd& direction) const {
    const Eigen::VectorXd at = parameters();
    return std::erase_if(free, [&](Index i) { return leads_out(i, at, direction); }) > 0;
  }

  // Of the free parameters, in units of their columns' lengths.
  Eigen::VectorXd scaled(const Eigen::VectorXd& descent) const {
    return descent.cwiseProduct(unit_)(free_);
  }

  void use_free(std::vector<Index> free) {
    if (free == free_) return;
    free_ = std::move(free);
    const Eigen::MatrixXd curvature = curvature_(free_, free_);
    const Cholesky factor(curvature);
    inverse_ = factor.is_definite() ? factor.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(
                                          curvature.rows(), curvature.cols())))
                                    : pseudo_inverse(gauss_newton_(free_, free_));
  }

  Eigen::VectorXd full_step() {
    std::vector<Index> free(static_cast<std::size_t>(unit_.size()));
    std::iota(free.begin(), free.end(), Index{0});
    hold_outward(free, now_.descent);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(unit_.size());
    do {
      use_free(free);
      change.setZero();
      const Eigen::VectorXd step = inverse_ * scaled(now_.descent);
      change(free_) = step.cwiseProduct(Eigen::VectorXd(unit_(free_)));
    } while (change.allFinite() && hold_outward(free, change));
    return change;
  }

  // The largest share of a step that stays within the bounds, at most 1.
  double share_within(const Eigen::VectorXd& change) const {
    const Eigen::VectorXd at = parameters();
    double share = 1.0;
    for (Index i = 0; i < at.size(); ++i) {
      const double room = change[i] < 0.0 ? bounds_.low[i] - at[i] : bounds_.high[i] - at[i];
      if (change[i] != 0.0) share = std::min(share, room / change[i]);
    }
    return share;
  }

  // Broyden, Fletcher, Goldfarb & Shanno (Nocedal & Wright, Numerical Optimization (2006), eq. 6.17).
  void learn(const Eigen::VectorXd& step, const Eigen::VectorXd& fall_of_descent) {
    const double product = step.dot(fall_of_descent);
    if (!(product > 1e-12 * step.norm() * fall_of_descent.norm())) return;
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(step.size(), step.size()) -
                                 step * fall_of_descent.transpose() / product;
    inverse_ = left * inverse_ * left.transpose() + step * step.transpose() / product;
  }

  // False if no step reduces the sum of squares.
  bool advance() {
    constexpr int kMostHalvings = 12;
    const Eigen::VectorXd change = full_step();
    if (!change.allFinite()) return false;
    double share = share_within(change);
    for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
      const Eigen::VectorXd from = parameters();
      const Eigen::VectorXd to =
          (from + share * change).cwiseMax(bounds_.low).cwiseMin(bounds_.high);
      const Eigen::VectorXd moved = to - from;
      if (!(now_.descent.dot(moved) > kGain * now_.rss)) return false;
      SpectralState next = state_;
      next.coefficients = to.head(state_.coefficients.size());
      next.ln_tau = to.tail(state_.n_terms());
      std::optional<SpectralModel::SampleSums> then = model_.sample_sums(next);
      if (!(then->rss < now_.rss)) continue;
      learn(moved.cwiseQuotient(unit_)(free_), scaled(now_.descent - then->descent));
      state_ = std::move(next);
      now_ = std::move(*then);
      return true;
    }
    return false;
  }

  const SpectralModel& model_;
  SpectralState state_;
  SpectralModel::SampleSums now_;
  Bounds bounds_;
  Eigen::VectorXd unit_;                      // 1 over the lengths of the Jacobian's columns
  Eigen::MatrixXd gauss_newton_, curvature_;  // of the averages, at the start
  std::vector<Index> free_;
  Eigen::MatrixXd inverse_;  // of the curvature among the free parameters
};

}  // namespace

PolishedState polish_samples(const SpectralModel& model, const SpectralState& start) {
  std::optional<SpectralModel::SampleSums> sums = model.sample_sums(start);
  if (!sums) return {start, start.rss + model.hidden_rss(start)};
  return SamplePolish(model, start, std::move(*sums)).run();
}

}  // namespace viscard
