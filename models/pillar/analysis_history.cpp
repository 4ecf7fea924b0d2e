#include "models/pillar/analysis.h"
#include "models/pillar/viscoelastic_pillar.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {

void check_history(const Scene& scene) {
  if (scene.history.size() < 2) {
    throw std::invalid_argument("creep and relaxation need a history of at least two points");
  }
  if (scene.plane) {
    throw std::invalid_argument(
        "creep and relaxation are computed for a cylinder, not for a strip");
  }
}

void run_creep_or_relaxation(const Scene& scene, SceneAnswer& answer) {
  const bool is_creep = scene.kind == AnalysisKind::kCreep;
  const ViscoelasticPillar pillar(scene.geometry, answer.discretisation, scene.pillar,
                                  is_creep ? TopLoad::kPressure : TopLoad::kRigidPlate, scene.film);
  count_unknowns(pillar.model(), answer);
  std::vector<HistoryPoint> history = scene.history;
  for (HistoryPoint& point : history) point.value *= is_creep ? -pillar.top_area_m2() : -1.0;
  HistoryOptions options;
  options.tolerance = 0.1 * scene.tolerance;
  const HistoryResult run = run_history(
      pillar.system(), is_creep ? Control::kForce : Control::kDisplacement, history, options);
  if (!run.converged) {
    throw std::runtime_error("the time steps do not settle to a tenth of the tolerance of " +
                             std::to_string(scene.tolerance));
  }
  const double per_area = -1.0 / pillar.top_area_m2();
  SceneCurve curve{
      is_creep ? "top_displacement" : "top_pressure", is_creep ? "m" : "Pa", run.time_s, {}};
  for (std::size_t i = 0; i < run.time_s.size(); ++i) {
    curve.value.push_back(is_creep ? run.displacement[i] : run.force[i] * per_area);
  }
  const auto peak = *std::max_element(curve.value.begin(), curve.value.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  answer.results = {{curve.name + "_end", curve.value.back(), curve.unit, 0.0, std::abs(peak)},
                    {curve.name + "_peak", peak, curve.unit}};
  answer.step_error = run.error_estimate;
  answer.curves.push_back(std::move(curve));
}

}  // namespace viscard
