#include "models/pillar/analyses/bowed_pillar.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

constexpr double kQuarterWave = 0.5 * std::numbers::pi;
constexpr int kSteps = 100;  // of Runge-Kutta along the pillar: 1e-9 of the load

// theta_0'' of a bow a_0 (1 - cos(pi s/2)) at the steps and their middles.
std::vector<double> given_bend(double bow) {
  std::vector<double> bend;
  for (int i = 0; i <= 2 * kSteps; ++i) {
    bend.push_back(-std::pow(kQuarterWave, 3) * bow * std::sin(kQuarterWave * i / (2.0 * kSteps)));
  }
  return bend;
}

// Curvature of the top of an elastica with this curvature at its foot; 0 under the load that holds it.
double curvature_of_top(double foot, double load, const std::vector<double>& bend) {
  constexpr double kStep = 1.0 / kSteps;
  double angle = 0.0, curvature = foot;
  for (std::size_t i = 0; i + 2 < bend.size(); i += 2) {
    const auto slope = [&](std::size_t at, double theta) {
      return bend[at] - load * std::sin(theta);
    };
    const double a1 = curvature, c1 = slope(i, angle);
    const double a2 = curvature + 0.5 * kStep * c1, c2 = slope(i + 1, angle + 0.5 * kStep * a1);
    const double a3 = curvature + 0.5 * kStep * c2, c3 = slope(i + 1, angle + 0.5 * kStep * a2);
    const double a4 = curvature + kStep * c3, c4 = slope(i + 2, angle + kStep * a3);
    angle += kStep / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    curvature += kStep / 6.0 * (c1 + 2.0 * c2 + 2.0 * c3 + c4);
  }
  return curvature;
}

// Where a falling function of [low, high] vanishes; an end where it does not.
template <typename Falling>
double root_of(const Falling& falling, double low, double high) {
  for (int i = 0; i < 60 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

BentElastica bent_elastica(double curvature, double bow) {
  const std::vector<double> bend = given_bend(bow);
  const double straight = kQuarterWave * kQuarterWave;
  const double foot = straight * bow + curvature;
  // At most twice the buckling load: beyond it the top points downward.
  const double load =
      root_of([&](double one) { return curvature_of_top(foot, one, bend); }, 0.0, 2.0 * straight);
  return {load / straight, curvature / load};
}

void check_bow(const PillarScene& scene, double bow_m, double strain) {
  const double L_m = scene.geometry.length_m;
  require(bow_m > 0.0 && bow_m < 0.5 * L_m,
          "a bow of " + micrometres(bow_m) + " is not between 0 and half the pillar's length");
  require(strain > 0.0, "the strain at which a bowed pillar collapses must be positive");
}

Collapse collapse(const PillarScene& scene, double buckling_Pa, double bow_m, double strain) {
  check_bow(scene, bow_m, strain);
  const double L_m = scene.geometry.length_m;
  const double arm = top_end(scene) == TopEnd::kFree ? 1.0 : 0.5;
  const double arm_over_radius = 4.0 * arm * L_m / (0.5 * scene.geometry.diameter_m);
  const double critical = buckling_Pa / scene.pillar.E0_Pa;
  const auto strain_at = [&](double log_curvature) {
    const BentElastica bent = bent_elastica(std::exp(log_curvature), bow_m / L_m);
    return critical * bent.load_share * (1.0 + arm_over_radius * bent.offset);
  };
  // The curvature per bow is between that of a load far below buckling and that of a top that points downward.
  const double low = std::log(1e-12 * bow_m / L_m), high = std::log(kQuarterWave * kQuarterWave);
  if (strain_at(high) < strain) {
    throw SceneMistake("analysis.collapse_strain",
                       "the foot reaches a strain of " + text_of(strain_at(high), 3) +
                           " when the top points downward, and never " + text_of(strain, 3) +
                           ": such a slender pillar lies down first; write a smaller strain");
  }
  const double log_curvature =
      -root_of([&](double minus) { return strain_at(-minus) - strain; }, -high, -low);
  const BentElastica bent = bent_elastica(std::exp(log_curvature), bow_m / L_m);
  const double of_base = std::clamp(1.0 - buckling_Pa / engesser_pressure_Pa(scene), 0.0, 1.0);
  const double rise = kQuarterWave * kQuarterWave / 8.0 * bent.offset * bent.offset;
  return {buckling_Pa * bent.load_share, bent.offset * L_m, 0.5 * of_base * rise};
}

}  // namespace viscard
