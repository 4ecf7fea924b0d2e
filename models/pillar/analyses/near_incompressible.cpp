#include "models/pillar/analyses/near_incompressible.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// What a finite bulk modulus changes, relative: a body between plates is softened by its apparent modulus
// over K, E (1 + 2 S^2)/K with S = d/(4 L) (Gent & Lindley, Proc. Inst. Mech. Eng. 173 (1959) 111), and other
// answers by up to four times as much (tests/models/pillar/analyses).
double change_by_volume(const PillarScene& scene) {
  constexpr double kSafety = 4.0;
  const double shape = scene.geometry.diameter_m / (4.0 * scene.geometry.length_m);
  return kSafety * 3.0 * (1.0 - 2.0 * scene.pillar.nu) * (1.0 + 2.0 * shape * shape);
}

// A change of all moduli moves a curve along its axis too: by |x dy/dx|.
void leave_out(double change, SceneCurve& curve) {
  const std::vector<double>& x = curve.x;
  const std::vector<double>& y = curve.value;
  const double peak = largest_size(y);
  curve.left_out.resize(y.size(), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, y.size() - 1);
    const double along =
        x[after] > x[before] ? x[i] * (y[after] - y[before]) / (x[after] - x[before]) : 0.0;
    curve.left_out[i] +=
        change * ((curve.allowed.empty() ? peak : curve.allowed[i]) + std::abs(along));
  }
}

}  // namespace

bool is_near_incompressible(const PillarScene& scene) {
  constexpr double kOfTolerance = 0.03;
  constexpr double kMost = 1e-4;
  if (scene.plane == PlaneState::kStress) return false;    // where the thickness gives way
  if (scene.surroundings.strains_by_heat()) return false;  // which takes the bulk modulus
  return scene.pillar.nu < 0.5 &&
         change_by_volume(scene) <= std::min(kOfTolerance * scene.tolerance, kMost);
}

SceneAnswer near_incompressible_answer(
    const PillarScene& scene, const std::function<SceneAnswer(const PillarScene&)>& answer_on) {
  PillarScene half = scene;
  half.pillar.nu = 0.5;
  SceneAnswer answer = answer_on(half);
  const double change = change_by_volume(scene);
  for (SceneResult& result : answer.results) {
    result.left_out += change * std::max(std::abs(result.value), result.scale);
  }
  for (SceneMode& mode : answer.modes) {
    mode.unresolved += change;
    if (mode.damping_ratio) mode.damping_error += change * *mode.damping_ratio;
  }
  for (SceneCurve& curve : answer.curves) leave_out(change, curve);
  return answer;
}

}  // namespace viscard
