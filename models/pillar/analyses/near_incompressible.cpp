#include "models/pillar/analyses/near_incompressible.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Rounding of an answer at the last Poisson ratio (bent pillars: tests/golden/pillar_stability.csv).
constexpr double kRounding = 1e-4;
// Part of a larger change that a straight line may be wrong by: of f = 1/(a + b x), which a bonded layer
// follows, it is a quarter of the change times the relative change.
constexpr double kOfCurve = 0.1;

PillarScene with_ratio(const PillarScene& scene, double nu) {
  PillarScene other = scene;
  other.pillar.nu = nu;
  return other;
}

// A straight line between two ends, `share` of the way from the first.
class Line {
 public:
  explicit Line(double share) : share_(share) {}

  double value(double at_half, double at_last) const {
    return at_half + share_ * (at_last - at_half);
  }
  double error(double at_half, double at_last) const {
    const double change = std::abs(at_last - at_half);
    const double of_rounding = kRounding * std::max(std::abs(at_half), std::abs(at_last));
    return share_ * std::min(change, kOfCurve * change + of_rounding);
  }

 private:
  double share_;
};

void require_alike(bool is_alike) {
  if (is_alike) return;
  throw std::runtime_error(
      "a Poisson ratio between 0.499999 and 0.5 is answered from those two, which have different "
      "results here; choose one of them");
}

void move(const Line& line, const SceneResult& last, SceneResult& result) {
  require_alike(last.name == result.name);
  result.left_out += line.error(result.value, last.value);
  result.value = line.value(result.value, last.value);
}

void move(const Line& line, const SceneMode& last, SceneMode& mode) {
  require_alike(last.family == mode.family &&
                last.damping_ratio.has_value() == mode.damping_ratio.has_value());
  mode.unresolved += line.error(mode.frequency_Hz, last.frequency_Hz) / mode.frequency_Hz;
  mode.frequency_Hz = line.value(mode.frequency_Hz, last.frequency_Hz);
  if (!mode.damping_ratio) return;
  mode.damping_error += line.error(*mode.damping_ratio, *last.damping_ratio);
  mode.damping_ratio = line.value(*mode.damping_ratio, *last.damping_ratio);
}

void move(const Line& line, const SceneCurve& last, SceneCurve& curve) {
  require_alike(last.name == curve.name && last.value.size() == curve.value.size());
  curve.left_out.resize(curve.value.size(), 0.0);
  for (std::size_t i = 0; i < curve.value.size(); ++i) {
    curve.left_out[i] += line.error(curve.value[i], last.value[i]);
    curve.value[i] = line.value(curve.value[i], last.value[i]);
  }
}

template <typename Part>
void move_all(const Line& line, const std::vector<Part>& last, std::vector<Part>& parts) {
  require_alike(last.size() == parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) move(line, last[i], parts[i]);
}

}  // namespace

bool is_near_incompressible(const PillarScene& scene) {
  return scene.pillar.nu > kLastPoissonRatio * (1.0 + 1e-9) && scene.pillar.nu < 0.5;
}

SceneAnswer near_incompressible_answer(
    const PillarScene& scene, const std::function<SceneAnswer(const PillarScene&)>& answer_on) {
  SceneAnswer answer = answer_on(with_ratio(scene, 0.5));
  const SceneAnswer last = answer_on(with_ratio(scene, kLastPoissonRatio));
  const Line line((0.5 - scene.pillar.nu) / (0.5 - kLastPoissonRatio));
  move_all(line, last.results, answer.results);
  move_all(line, last.modes, answer.modes);
  move_all(line, last.curves, answer.curves);
  answer.unknowns = std::max(answer.unknowns, last.unknowns);
  answer.step_error = std::max(answer.step_error, last.step_error);
  return answer;
}

}  // namespace viscard
