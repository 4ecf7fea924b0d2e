#include "io/flow/optimise/solved_values.h"

#include "io/basics/parallel.h"
#include "io/flow/design/judge_scene.h"
#include "io/flow/optimise/nearby_answers.h"
#include "io/flow/scenes/uncertain_scene.h"
#include "models/maths/failure_text.h"
#include "models/uncertainty/linear_propagation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace viscard {

SolvedValues::SolvedValues(const DesignSpec& spec, const DesignSpace& space)
    : spec_(spec), space_(space) {
  for (const RequirementKind& kind : requirement_kinds()) {
    if (!std::isnan(spec.requirements.*kind.limit)) kinds_.push_back(&kind);
  }
  for (const RequirementKind& kind : requirement_kinds()) {
    const bool is_objective =
        std::any_of(spec.objectives.begin(), spec.objectives.end(),
                    [&](const DesignObjective& one) { return one.quantity == kind.key; });
    if (is_objective && std::isnan(spec.requirements.*kind.limit)) kinds_.push_back(&kind);
  }
}

SolvedPoint SolvedValues::solve(const Scene& scene, const SceneSolver& solver,
                                bool is_nearby) const {
  SolvedPoint point;
  for (const RequirementKind* kind : kinds_) {
    const RequiredValue found = computed(*kind, scene, spec_.requirements, solver);
    if (!is_nearby) ++n_solved_;
    if (!found.is_answered) {
      point.why_not = std::string(kind->key) + " is not answered: " + found.how;
      return point;
    }
    // The logarithm of a quantity that crosses zero is limited by its error.
    const double size = std::max({std::abs(found.value), found.error_estimate, 1e-300});
    point.log_value.push_back(std::log(size));
    point.relative_error.push_back(found.error_estimate / size);
  }
  point.exists = true;
  return point;
}

std::vector<SolvedPoint> SolvedValues::at(const std::vector<DesignPoint>& points) {
  std::vector<DesignPoint> fresh;
  for (const DesignPoint& one : points) {
    if (known_.count(one) == 0 && std::find(fresh.begin(), fresh.end(), one) == fresh.end()) {
      fresh.push_back(one);
    }
  }
  std::vector<SolvedPoint> found(fresh.size());
  for_each_in_parallel(fresh.size(), [&](std::size_t i) {
    try {
      found[i] = solve(space_.scene_at(fresh[i]));
    } catch (const std::exception& error) {
      if (!is_refusal(error)) throw;
      found[i].why_not = error.what();
    }
  });
  for (std::size_t i = 0; i < fresh.size(); ++i) known_[fresh[i]] = found[i];
  std::vector<SolvedPoint> out;
  for (const DesignPoint& one : points) out.push_back(known_.at(one));
  return out;
}

std::vector<double> SolvedValues::spread_at(const DesignPoint& point) const {
  constexpr int kSpreadDigits = 9;
  constexpr double kSlopes = 0.05;  // of the standard uncertainty
  const std::string text = space_.text_at(point, kSpreadDigits);
  const UncertainScene scene(scene_from_toml(text, spec_.scene_path), text, spec_.scene_path);
  const auto n = static_cast<Eigen::Index>(kinds_.size());
  const auto logs_by = [&](const std::function<SceneSolver()>& solver,
                           bool is_nearby) -> BatchFunction {
    return [&, solver, is_nearby](const Eigen::MatrixXd& deviates) {
      Eigen::MatrixXd out =
          Eigen::MatrixXd::Constant(deviates.rows(), n, std::numeric_limits<double>::quiet_NaN());
      for_each_in_parallel(static_cast<std::size_t>(deviates.rows()), [&](std::size_t i) {
        const auto row = static_cast<Eigen::Index>(i);
        try {
          const SolvedPoint found =
              solve(scene.scene_at(deviates.row(row).transpose()), solver(), is_nearby);
          for (Eigen::Index k = 0; found.exists && k < n; ++k) {
            out(row, k) = found.log_value[static_cast<std::size_t>(k)];
          }
        } catch (const std::exception& error) {
          if (!is_refusal(error)) throw;  // otherwise a point without an answer
        }
      });
      return out;
    };
  };
  NearbyAnswers near;
  Eigen::VectorXd value_errors;
  const Eigen::VectorXd at_values = Eigen::VectorXd::Zero(count_deviates(scene.inputs()));
  const SolvedPoint nominal = solve(scene.scene_at(at_values), near.keep());
  if (nominal.exists) {
    constexpr double kOfBasis = 0.01;  // of the error of a value, as in scene_uncertainty()
    value_errors = kOfBasis * Eigen::Map<const Eigen::VectorXd>(nominal.relative_error.data(), n);
  }
  BatchFunction first_order;
  if (nominal.exists && near.has_any()) first_order = logs_by([&] { return near.nearby(); }, true);
  const LinearAnswer linear = linear_slopes(logs_by([] { return SceneSolver(simulate); }, false),
                                            scene.inputs(), kSlopes, first_order, value_errors);
  const Eigen::VectorXd deviation = standard_uncertainty(linear);
  std::vector<double> spread;
  for (Eigen::Index k = 0; k < n; ++k) {
    spread.push_back(std::hypot(deviation[k], linear.slope_error.row(k).norm()));
  }
  return spread;
}

}  // namespace viscard
