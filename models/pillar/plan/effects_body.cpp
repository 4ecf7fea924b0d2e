#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/plan/effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

double shear_modulus_Pa(const Material& pillar) {
  return pillar.E0_Pa / (2.0 * (1.0 + pillar.nu));
}

}  // namespace

double engesser_pressure_Pa(const Scene& scene) {
  const double radius_of_gyration_m =
      scene.plane ? scene.geometry.diameter_m / std::sqrt(12.0) : 0.25 * scene.geometry.diameter_m;
  // Half waves of four lengths with a free top, of two with one that a plate keeps upright.
  const bool is_upright = moves_top(scene) || scene.plate_on_top;
  const double half_wave_m = (is_upright ? 1.0 : 2.0) * scene.geometry.length_m;
  const double slenderness = half_wave_m / radius_of_gyration_m;
  const double euler_Pa =
      std::numbers::pi * std::numbers::pi * scene.pillar.E0_Pa / (slenderness * slenderness);
  const double nu = scene.pillar.nu;
  const double kappa = scene.plane ? 5.0 / 6.0 : 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
  return euler_Pa / (1.0 + euler_Pa / (kappa * shear_modulus_Pa(scene.pillar)));
}

double largest_pressure_Pa(const Scene& scene) {
  double largest = std::abs(scene.pressure_Pa);
  if (moves_top(scene) && !is_sideways(scene)) {
    largest = std::abs(*scene.displacement_m) / scene.geometry.length_m * scene.pillar.E0_Pa;
  }
  const bool is_in_time =
      scene.kind == AnalysisKind::kCreep ||
      (scene.kind == AnalysisKind::kTransient && scene.load_place == LoadPlace::kTop);
  if (is_in_time) {
    for (const HistoryPoint& p : scene.history) largest = std::max(largest, std::abs(p.value));
  }
  return largest;
}

EffectEstimate incompressibility_estimate(const Scene& scene) {
  const double nu = scene.pillar.nu;
  const double ratio = nu < 0.5 ? 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)) : HUGE_VAL;  // K/G
  const bool is_plane_stress = scene.plane == PlaneState::kStress;
  if (is_plane_stress) return {.reason = "plane stress does not lock"};
  if (nu == 0.5) {
    return {EffectRole::kNeeded, 1.0, "Poisson ratio", nu,
            "no displacement alone keeps its volume"};
  }
  // Pressures of displacement elements carry K/G times the error of the strains (eq. E4); below the
  // threshold the mesh error that is watched contains that.
  EffectEstimate estimate{EffectRole::kOptional, 0.0, "K/G", ratio,
                          "the mesh error that is watched contains it"};
  if (nu >= kNearlyIncompressible) {
    estimate.error = std::max(scene.tolerance, std::min(1.0, scene.tolerance * ratio));
    estimate.reason = "stresses would lock without pressures of their own";
  }
  return estimate;
}

void leave_out_incompressibility(Scene& scene) {
  scene.condense_pressures_from = 0.5;
}
void insist_on_incompressibility(Scene& scene) {
  scene.condense_pressures_from = -1.0;
}

EffectEstimate three_dimensional_estimate(const Scene& scene) {
  // Radius of gyration d/4 of a disc against d/sqrt(12) of a strip: lateral frequencies and
  // buckling of slender pillars differ by that; axial answers by the clamped foot (eq. E5).
  const double foot = scene.pillar.nu * scene.pillar.nu *
                      std::min(1.0, 0.5 * scene.geometry.diameter_m / scene.geometry.length_m);
  const bool bends = scene.kind == AnalysisKind::kModal || scene.kind == AnalysisKind::kBuckling;
  EffectEstimate estimate{EffectRole::kNeeded, bends ? std::sqrt(4.0 / 3.0) - 1.0 : foot,
                          bends ? "gyration of strip over disc" : "nu^2 R/L",
                          bends ? std::sqrt(4.0 / 3.0) : foot,
                          "a strip instead of a cylinder would save nothing"};
  if (scene.electrodes) estimate.error = 1.0;
  if (!scene.plane) return estimate;
  estimate.role = EffectRole::kOutside;
  estimate.reason = "the scene asks for a strip; of a cylinder it would be wrong by this";
  return estimate;
}

EffectEstimate geometric_stiffness_estimate(const Scene& scene) {
  if (scene.kind == AnalysisKind::kBuckling) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "buckling is nothing else"};
  }
  const double pressure_Pa = largest_pressure_Pa(scene);
  if (pressure_Pa == 0.0) return {.reason = "no pressure on the top"};
  const double share = pressure_Pa / engesser_pressure_Pa(scene);
  if (scene.direction == LoadDirection::kLateral) return {.reason = "no pressure along the pillar"};
  if (scene.kind == AnalysisKind::kTransient && share > 1.0) {
    return {EffectRole::kOutside, 1.0, "p/p_cr", share,
            "the straight pillar gives way sideways if the load stays longer than a swing"};
  }
  if (scene.kind != AnalysisKind::kModal) {
    return {EffectRole::kAbsent, 0.0, "p/p_cr", share, "a straight pillar shortens without it"};
  }
  if (scene.plane) {
    return {EffectRole::kOutside, std::min(1.0, 0.5 * share), "p/p_cr", share,
            "modes of a strip are computed without load"};
  }
  // f(p) = f(0) sqrt(1 - p/p_cr) holds for the first lateral mode, exactly for equal shapes, and
  // bounds the others (eq. E6).
  const double error = scene.pressure_Pa < 0.0 ? std::sqrt(1.0 + share) - 1.0
                       : share < 0.9           ? 1.0 - std::sqrt(1.0 - share / 0.95)
                                               : 1.0;
  return {EffectRole::kOptional, error, "p/p_cr", share, "the load softens lateral modes"};
}

void leave_out_geometric_stiffness(Scene& scene) {
  scene.pressure_Pa = 0.0;
}

EffectEstimate adhesion_estimate(const Scene&) {
  return {.reason = "one pillar with nothing to stick to"};
}

EffectEstimate finite_strain_estimate(const Scene& scene) {
  double strain = largest_pressure_Pa(scene) / scene.pillar.E0_Pa;
  if (is_sideways(scene) && moves_top(scene)) {  // 3 u R/L^2 at the foot of a beam
    const double L_m = scene.geometry.length_m;
    strain = 1.5 * std::abs(*scene.displacement_m) * scene.geometry.diameter_m / (L_m * L_m);
  } else if (scene.direction ==
             LoadDirection::kLateral) {  // bending at the foot: 4 tau L/R, of a strip 3 tau L/R
    strain *= (scene.plane ? 6.0 : 8.0) * scene.geometry.length_m / scene.geometry.diameter_m;
  }
  if (scene.kind == AnalysisKind::kBuckling) {
    strain = engesser_pressure_Pa(scene) / scene.pillar.E0_Pa;
  }
  if (scene.kind == AnalysisKind::kRelaxation) {
    for (const HistoryPoint& point : scene.history) {
      strain = std::max(strain, std::abs(point.value) / scene.geometry.length_m);
    }
  }
  if (strain == 0.0) return {.reason = "small vibrations about the unloaded shape"};
  return {EffectRole::kOutside, 2.3 * strain, "strain", strain,
          "small strains are assumed; not in the error"};
}

EffectEstimate contact_estimate(const Scene&) {
  return {.reason = "no shape presses on the pillar"};
}

}  // namespace viscard
