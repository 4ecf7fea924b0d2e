#include "fit/search/projection.h"
#include "fit/search/separable.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Indices of the parameters that can move: the gradient does not push them against a bound, and
// they influence the model.
std::vector<Index> movable(const Projection& at, const Eigen::VectorXd& p, const Box& box) {
  std::vector<Index> list;
  for (Index i = 0; i < p.size(); ++i) {
    const bool is_held = (p[i] <= box.low[i] && at.gradient[i] > 0.0) ||
                         (p[i] >= box.high[i] && at.gradient[i] < 0.0);
    if (!is_held && at.normal(i, i) > 0.0) list.push_back(i);
  }
  return list;
}

struct Step {
  Eigen::VectorXd change;
  double predicted = 0.0;  // decrease of the sum of squares
};

Step damped_step(const Projection& at, const std::vector<Index>& list, double damping) {
  Eigen::MatrixXd matrix = at.normal(list, list);
  matrix.diagonal() *= 1.0 + damping;
  const Eigen::VectorXd g = at.gradient(list);
  const Eigen::VectorXd part = -SymmetricFactor(matrix).solve(g);
  Step step;
  step.change = Eigen::VectorXd::Zero(at.gradient.size());
  step.change(list) = part;
  step.predicted = -g.dot(part) - 0.5 * part.dot(matrix * part);
  step.predicted *= 2.0;
  return step;
}

}  // namespace

SpectralState quick_search(const SpectralModel& model, const SpectralState& start,
                           const RefineOptions& options) {
  const Index n_terms = start.n_terms();
  Box box = search_box(model, n_terms);
  if (options.held >= 0) {
    box.low[options.held] = box.high[options.held] = start.ln_tau[options.held];
  }
  Eigen::VectorXd p =
      search_parameters(model, start.ln_tau, start.nuisance).cwiseMax(box.low).cwiseMin(box.high);
  Projection at = project(model, p);
  double damping = 1e-3;
  double growth = 2.0;
  bool is_converged = p.size() == 0;
  constexpr double kTooStiff = 1e12;
  const double unseen = options.unseen_variances * model.sample_variance();
  for (int i = 0; i < options.max_iterations && !is_converged && damping < kTooStiff; ++i) {
    const std::vector<Index> list = movable(at, p, box);
    is_converged = list.empty();
    if (is_converged) break;
    const Step step = damped_step(at, list, damping);
    const Eigen::VectorXd trial = (p + step.change).cwiseMax(box.low).cwiseMin(box.high);
    const Projection next = project(model, trial);
    const double gain = at.rss - next.rss;
    const double little = std::max(options.tolerance * at.rss, unseen);
    is_converged = std::max(std::abs(gain), step.predicted) <= little;
    if (gain > 0.0) {
      // Convergence is at least linear, so the next ten steps gain at most ten times this gain.
      constexpr double kStepsLeft = 10.0;
      if (i > 2 && next.rss - kStepsLeft * gain > options.target) i = options.max_iterations;
      const double ratio = gain / std::max(step.predicted, 1e-300);
      damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * std::min(ratio, 2.0) - 1.0, 3));
      damping = std::max(damping, 1e-12);
      growth = 2.0;
      p = trial;
      at = next;
    } else {
      damping *= growth;
      growth *= 2.0;
    }
  }
  SpectralState state{p.head(n_terms), nuisance_from(model, p), at.coefficients, at.rss,
                      is_converged};
  return sorted_by_time(std::move(state), model.n_common());
}

}  // namespace viscard
