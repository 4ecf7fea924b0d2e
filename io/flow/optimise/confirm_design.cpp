#include "io/flow/optimise/confirm_design.h"

#include "io/scenes/scene_file.h"
#include "models/maths/leading_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr int kFileDigits = 4;

double probability_below(double deviate) {
  return 0.5 * std::erfc(-deviate / std::sqrt(2.0));
}

void add_probabilities(double probability, const std::vector<double>& spread,
                       OptimisedDesign& design) {
  for (std::size_t k = 0; k < design.judgement.lines.size(); ++k) {
    const JudgedLine& line = design.judgement.lines[k];
    const double sure = line.found.is_answered
                            ? probability_below(std::log(line.margin) / std::max(spread[k], 1e-12))
                            : 0.0;
    design.probabilities.push_back(sure);
    if (sure < probability) design.is_feasible = false;
  }
}

DesignedObjective objective_at(const DesignSpec& spec, const DesignSpace& space,
                               const SolvedValues& solved, const DesignPoint& point,
                               const Scene& scene, const std::string& quantity) {
  for (std::size_t i = 0; i < spec.ranges.size(); ++i) {
    if (spec.ranges[i].key == quantity) {
      // As it stands in the scene, rounded.
      return {quantity, space.unit_of(i),
              leading_number(space.values_at(point, kFileDigits)[i].second), 0.0};
    }
  }
  DesignedObjective objective{quantity, "", 0.0, 0.0};
  for (const RequirementKind* kind : solved.kinds()) {
    if (quantity != kind->key) continue;
    const RequiredValue found = computed(*kind, scene, spec.requirements);
    objective = {quantity, kind->unit, found.value, found.error_estimate};
  }
  return objective;
}

// Requirements that are at their limit within rounding, error and uncertainty.
void name_limits(const DesignSpec& spec, const DesignPoint& point,
                 const std::vector<double>& spread, OptimisedDesign& design) {
  constexpr double kNear = 0.02, kAtEnd = 5e-3;
  for (std::size_t k = 0; k < design.judgement.lines.size(); ++k) {
    const JudgedLine& line = design.judgement.lines[k];
    const double size = std::max(std::abs(line.found.value), 1e-300);
    const double back = 1.2 * line.found.error_estimate / size +
                        (spread.empty() ? 0.0 : deviate_of(spec.probability) * spread[k]);
    if (line.found.is_answered && std::log(line.margin) > kNear + back) continue;
    design.active.emplace_back(line.kind->key);
  }
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (point[i] > kAtEnd && point[i] < 1.0 - kAtEnd) continue;
    design.active.push_back(spec.ranges[i].key +
                            (point[i] < 0.5 ? " at its lower end" : " at its upper end"));
  }
}

}  // namespace

double deviate_of(double probability) {
  double low = -10.0, high = 10.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (probability_below(middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

OptimisedDesign confirmed_design(const DesignSpec& spec, const DesignSpace& space,
                                 const SolvedValues& solved, const DesignPoint& point) {
  OptimisedDesign design;
  design.values = spec.chosen;
  for (auto& value : space.values_at(point, kFileDigits)) design.values.push_back(std::move(value));
  design.scene_text = space.text_at(point, kFileDigits);
  JudgeOptions options;
  options.search_s = 0.0;
  design.judgement = judge_scene(design.scene_text, spec.scene_path, spec.requirements, options);
  design.is_feasible = design.judgement.passes();
  const std::vector<double> spread =
      spec.probability > 0.0 ? solved.spread_at(point) : std::vector<double>{};
  if (!spread.empty()) add_probabilities(spec.probability, spread, design);
  const Scene scene = scene_from_toml(design.scene_text, spec.scene_path).scene;
  for (const DesignObjective& one : spec.objectives) {
    design.objectives.push_back(objective_at(spec, space, solved, point, scene, one.quantity));
  }
  name_limits(spec, point, spread, design);
  return design;
}

}  // namespace viscard
