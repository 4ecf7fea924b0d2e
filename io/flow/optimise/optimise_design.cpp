#include "io/flow/optimise/optimise_design.h"

#include "io/flow/optimise/cheap_values.h"
#include "io/flow/optimise/confirm_design.h"
#include "io/flow/optimise/solved_values.h"
#include "io/flow/optimise/step_on_model.h"
#include "models/maths/failure_text.h"
#include "models/uncertainty/sobol_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kSpare = 2e-3;      // of a margin, for the rounding of dimensions
constexpr double kSlopeStep = 0.02;  // share of a range
constexpr double kLeastGain = 3e-4;  // of the logarithm of the objective, or 3e-6 of a limit
constexpr int kMostSteps = 16, kMostStarts = 4;
constexpr double kNoScene = -10.0;  // margin where there is no scene

// The formulas of all quantities at a point, as logarithms; empty where there is no such scene.
std::vector<double> log_formulas(const SolvedValues& solved, const DesignSpace& space,
                                 const DesignSpec& spec, const DesignPoint& point) {
  std::vector<double> logs;
  try {
    const Scene scene = space.scene_at(point);
    for (const RequirementKind* kind : solved.kinds()) {
      const double value = cheap_value(*kind, scene, spec.requirements);
      if (!(value > 0.0) || !std::isfinite(value)) return {};
      logs.push_back(std::log(value));
    }
  } catch (const std::runtime_error& error) {
    if (!is_refusal(error)) throw;
    return {};
  }
  return logs;
}

// One search of a specification.
class DesignSearch {
 public:
  DesignSearch(const DesignSpec& spec, const OptimiseOptions& options)
      : spec_(spec), options_(options), space_(spec), solved_(spec, space_) {
    for (const RequirementKind* kind : solved_.kinds()) {
      n_limits_ += std::isnan(spec.requirements.*kind->limit) ? 0 : 1;
    }
    if (spec.probability > 0.0) z_ = deviate_of(spec.probability);
  }

  OptimisedDesign run();

 private:
  // A model of the solver about a point: formula times a factor whose logarithm is linear. Its values and
  // slopes there are the solver's (Alexandrov & Lewis, Optim. Eng. 2 (2001) 413).
  struct Model {
    DesignPoint centre;
    std::vector<double> offset, error, spread;
    std::vector<std::vector<double>> slope;
  };

  DesignScore score_of(const std::vector<double>& log_value, const std::vector<double>& error,
                       const std::vector<double>& spread, const DesignPoint& point) const;
  DesignScore score_of(const SolvedPoint& found, const DesignPoint& point) const;
  DesignScore score_on(const Model& model, const DesignPoint& point) const;
  double log_objective(std::size_t which, const std::vector<double>& log_value,
                       const DesignPoint& point) const;
  std::optional<Model> model_at(const DesignPoint& point);
  void learn(const DesignPoint& beside, const SolvedPoint& found, bool is_better,
             Model& model) const;
  std::optional<DesignPoint> follow(const DesignPoint& start, double share_done);
  std::vector<DesignPoint> starts();
  void report(double done, const std::string& what) const {
    if (options_.progress) options_.progress(done, what);
  }

  const DesignSpec& spec_;
  const OptimiseOptions& options_;
  DesignSpace space_;
  SolvedValues solved_;
  std::size_t n_limits_ = 0;
  double z_ = 0.0;
  std::vector<double> spread_;  // at the last point where it was found
  std::string why_not_;
};

double DesignSearch::log_objective(std::size_t which, const std::vector<double>& log_value,
                                   const DesignPoint& point) const {
  const DesignObjective& objective = spec_.objectives[which];
  const double sign = objective.is_largest() ? -1.0 : 1.0;
  for (std::size_t i = 0; i < spec_.ranges.size(); ++i) {
    if (spec_.ranges[i].key == objective.quantity) {
      return sign * std::log(std::max(space_.value_at(i, point[i]), 1e-300));
    }
  }
  for (std::size_t k = 0; k < log_value.size(); ++k) {
    if (objective.quantity == solved_.kinds()[k]->key) return sign * log_value[k];
  }
  return 0.0;
}

DesignScore DesignSearch::score_of(const std::vector<double>& log_value,
                                   const std::vector<double>& error,
                                   const std::vector<double>& spread,
                                   const DesignPoint& point) const {
  DesignScore score;
  const std::size_t n = n_limits_ + (options_.second ? 1 : 0);
  if (log_value.empty()) {
    score.margins.assign(n, kNoScene);
    return score;
  }
  score.objective = log_objective(options_.objective, log_value, point);
  for (std::size_t k = 0; k < n_limits_; ++k) {
    const RequirementKind& kind = *solved_.kinds()[k];
    const double to_limit = std::log(spec_.requirements.*kind.limit) - log_value[k];
    const double back = kSpare + 1.2 * error[k] + (spread.empty() ? 0.0 : z_ * spread[k]);
    score.margins.push_back((kind.is_upper ? to_limit : -to_limit) - back);
  }
  if (options_.second) {
    score.margins.push_back(options_.second->log_limit -
                            log_objective(1 - options_.objective, log_value, point));
  }
  return score;
}

DesignScore DesignSearch::score_of(const SolvedPoint& found, const DesignPoint& point) const {
  return score_of(found.log_value, found.relative_error, spread_, point);
}

DesignScore DesignSearch::score_on(const Model& model, const DesignPoint& point) const {
  std::vector<double> logs = log_formulas(solved_, space_, spec_, point);
  for (std::size_t k = 0; k < logs.size(); ++k) {
    logs[k] += model.offset[k];
    for (std::size_t i = 0; i < point.size(); ++i) {
      logs[k] += model.slope[k][i] * (point[i] - model.centre[i]);
    }
  }
  return score_of(logs, model.error, model.spread, point);
}

std::optional<DesignSearch::Model> DesignSearch::model_at(const DesignPoint& point) {
  std::vector<DesignPoint> points = {point};
  for (std::size_t i = 0; i < point.size(); ++i) {
    points.push_back(point);
    points.back()[i] += point[i] + kSlopeStep <= 1.0 ? kSlopeStep : -kSlopeStep;
  }
  const std::vector<SolvedPoint> found = solved_.at(points);
  const std::vector<double> formulas = log_formulas(solved_, space_, spec_, point);
  if (!found[0].exists || formulas.empty()) {
    if (why_not_.empty()) why_not_ = found[0].why_not;
    return std::nullopt;
  }
  Model model{point, {}, found[0].relative_error, {}, {}};
  const std::size_t n = formulas.size();
  for (std::size_t k = 0; k < n; ++k) model.offset.push_back(found[0].log_value[k] - formulas[k]);
  model.slope.assign(n, std::vector<double>(point.size(), 0.0));
  for (std::size_t i = 0; i < point.size(); ++i) {
    const std::vector<double> beside = log_formulas(solved_, space_, spec_, points[i + 1]);
    if (!found[i + 1].exists || beside.empty()) continue;
    const double step = points[i + 1][i] - point[i];
    for (std::size_t k = 0; k < n; ++k) {
      model.slope[k][i] = (found[i + 1].log_value[k] - beside[k] - model.offset[k]) / step;
    }
  }
  if (spec_.probability > 0.0) spread_ = solved_.spread_at(point);
  model.spread = spread_;
  return model;
}

// Adds the solver's values at a trial point to the model, by the smallest change of slopes that
// agrees with them (Broyden, Math. Comput. 19 (1965) 577). The centre moves to the trial point if
// that is better.
void DesignSearch::learn(const DesignPoint& beside, const SolvedPoint& found, bool is_better,
                         Model& model) const {
  const std::vector<double> formulas = log_formulas(solved_, space_, spec_, beside);
  if (!found.exists || formulas.empty()) return;
  double length_2 = 0.0;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    length_2 += (beside[i] - model.centre[i]) * (beside[i] - model.centre[i]);
  }
  for (std::size_t k = 0; k < formulas.size(); ++k) {
    const double offset = found.log_value[k] - formulas[k];
    double missing = offset - model.offset[k];
    for (std::size_t i = 0; i < beside.size(); ++i) {
      missing -= model.slope[k][i] * (beside[i] - model.centre[i]);
    }
    for (std::size_t i = 0; i < beside.size(); ++i) {
      model.slope[k][i] += missing * (beside[i] - model.centre[i]) / length_2;
    }
    if (is_better) model.offset[k] = offset;
  }
  if (!is_better) return;
  model.centre = beside;
  model.error = found.relative_error;
}

// Steps within a trust radius that grows if the model predicts the solver well, and shrinks if it
// does not (Conn, Gould & Toint, Trust-Region Methods (2000), ch. 6). They end when a model with
// the solver's slopes at the centre predicts no further improvement.
std::optional<DesignPoint> DesignSearch::follow(const DesignPoint& start, double share_done) {
  std::optional<Model> model = model_at(start);
  if (!model) return std::nullopt;
  bool is_fresh = true;
  double radius = 0.4;
  for (int step = 0; step < kMostSteps; ++step) {
    report(share_done + 0.2 * step / kMostSteps, "step " + std::to_string(step + 1));
    const DesignPoint point = model->centre;
    const ScoreAt on_model = [&](const DesignPoint& at) { return score_on(*model, at); };
    const DesignPoint next = step_on_model(on_model, point, radius);
    const double foretold = on_model(point).merit() - on_model(next).merit();
    if (!(foretold > kLeastGain) || radius < 1e-3) {
      if (is_fresh) break;
      model = model_at(point);
      if (!model) return point;
      is_fresh = true;
      radius = std::max(radius, 0.05);
      continue;
    }
    const SolvedPoint found = solved_.at({next})[0];
    const double gained = found.exists ? score_of(solved_.at({point})[0], point).merit() -
                                             score_of(found, next).merit()
                                       : -1.0;
    learn(next, found, gained > 0.05 * foretold, *model);
    is_fresh = false;
    if (gained < 0.3 * foretold) radius *= 0.35;
    if (gained > 0.75 * foretold) radius = std::min(1.0, 1.8 * radius);
  }
  return model->centre;
}

// The starts, in this order: the best point of the formulas after their correction in the middle of
// the ranges, the middle, and Sobol' points.
std::vector<DesignPoint> DesignSearch::starts() {
  const std::size_t n = space_.size();
  const DesignPoint middle(n, 0.5);
  std::vector<DesignPoint> points;
  const SolvedPoint found = solved_.at({middle})[0];
  const std::vector<double> formulas = log_formulas(solved_, space_, spec_, middle);
  if (found.exists && !formulas.empty()) {
    Model model{middle, {}, found.relative_error, {}, {}};
    for (std::size_t k = 0; k < formulas.size(); ++k) {
      model.offset.push_back(found.log_value[k] - formulas[k]);
    }
    model.slope.assign(formulas.size(), std::vector<double>(n, 0.0));
    const ScoreAt cheap = [&](const DesignPoint& at) { return score_on(model, at); };
    points.push_back(search_ranges(cheap, n, n_limits_ + (options_.second ? 1 : 0),
                                   static_cast<std::uint64_t>(spec_.seed)));
  }
  points.push_back(middle);
  const Eigen::MatrixXd sobol = sobol_points(kMostStarts, static_cast<Eigen::Index>(n));
  for (Eigen::Index i = 0; i < sobol.rows(); ++i) {
    points.emplace_back(sobol.row(i).begin(), sobol.row(i).end());
  }
  return points;
}

OptimisedDesign DesignSearch::run() {
  report(0.0, "formulas over the ranges");
  std::optional<OptimisedDesign> best;
  double least = std::numeric_limits<double>::infinity();
  int n_followed = 0;
  for (const DesignPoint& start : starts()) {
    if (n_followed == kMostStarts) break;
    const auto point = follow(start, 0.1 + 0.2 * n_followed);
    if (!point) continue;
    ++n_followed;
    const double merit = score_of(solved_.at({*point})[0], *point).merit();
    if (merit >= least) continue;
    least = merit;
    best = confirmed_design(spec_, space_, solved_, *point);
    if (best->is_feasible && n_followed >= 2)
      break;  // a second start guards against a local optimum
  }
  if (!best) {
    throw std::runtime_error(spec_.path.string() + ": " +
                             (why_not_.empty() ? "there is no scene within the ranges" : why_not_));
  }
  best->n_solved = solved_.n_solved();
  return *best;
}

}  // namespace

OptimisedDesign optimise_design(const DesignSpec& spec, const OptimiseOptions& options) {
  return DesignSearch(spec, options).run();
}

}  // namespace viscard
