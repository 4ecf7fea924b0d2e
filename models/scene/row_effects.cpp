#include "models/array/plane/array_analysis.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/scene/scene_effects.h"
#include "models/sensor/sensor_design.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using std::numbers::pi;

// True for the stem itself and for "stem_4"; without a [want] everything is asked for.
bool asks_for(const ArrayScene& scene, const char* stem) {
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(),
                     [&](const std::string& name) { return name.starts_with(stem); });
}

bool asks_between_pillars(const ArrayScene& scene) {
  for (const char* stem : {"midway", "coupling", "crosstalk", "neighbours", "deviation"}) {
    if (asks_for(scene, stem)) return true;
  }
  return false;
}

// The film's share of a pillar's compliance, by the shares of one pillar's film (eq. E1).
double film_share(const ArrayScene& scene) {
  PillarScene one = single_pillar(scene);
  one.film = scene.film;
  const double edge_m = std::max(scene.geometry.film_edge_m, 0.5 * scene.geometry.spacing_m);
  one.geometry.film =
      FilmGeometry{scene.geometry.film_thickness_m, 0.5 * scene.geometry.diameter_m + edge_m};
  const FilmShares shares = film_shares(one);
  const double axial = kUnevenTraction * shares.axial;
  const bool bends =
      analysis_of(scene).has_inertia || scene.load == ArrayLoad::kShear || scene.press.has_value();
  return bends ? std::max(axial, kUnevenTraction * shares.lateral()) : axial;
}

// Distance over film thickness at which the nearest neighbour, or the film's mirrored end, is felt.
double nearest_over_thickness(const ArrayScene& scene) {
  const ArrayGeometry& g = scene.geometry;
  const bool has_gap = g.count > 1 || g.ends == FilmEnds::kMirror;
  double nearest_m = has_gap ? g.spacing_m : HUGE_VAL;
  if (g.ends == FilmEnds::kFree) nearest_m = std::min(nearest_m, 2.0 * g.film_edge_m);
  return nearest_m / g.film_thickness_m;
}

}  // namespace

// Field between plates decays as exp(-pi x/(2 t)) with one face free of charge, strain of a held
// layer as exp(-0.9215 x/t), the slowest root of (3 - 4 nu) cosh 2x + 2 x^2 + 5 - 12 nu + 8 nu^2 at
// nu = 0.29 (eq. A4). The amplitudes are 1.5 times the largest that rows of the thesis' film have.
EffectEstimate crosstalk_estimate(const ArrayScene& scene) {
  const double x = nearest_over_thickness(scene);
  if (std::isinf(x)) return {.reason = "no neighbour and no end of the film"};
  const double elastic = std::exp(-0.9215 * x);
  EffectEstimate estimate{EffectRole::kOptional, 0.0, "distance over film thickness", x,
                          "neighbours and film ends load the film"};
  if (asks_for_voltages(scene)) {
    const double t_d = scene.geometry.film_thickness_m / scene.geometry.diameter_m;
    const double field = 1.4 * t_d * std::exp(-0.5 * pi * x);
    const double strain = (scene.plane == PlaneState::kStress ? 0.12 : 0.45) * elastic;
    estimate.error = std::min(1.0, field + strain);
    if (asks_between_pillars(scene)) {
      estimate.role = EffectRole::kNeeded;
      estimate.reason = "the influence of the neighbours is asked for";
    }
  } else {
    estimate.error = film_share(scene) * elastic;
    estimate.reason = "neighbours move the film, and the film the pillar";
  }
  if (scene.load == ArrayLoad::kShear && asks_for_voltages(scene)) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "a pillar sheared alone gives no voltage in its middle or mean";
  }
  if (scene.press && asks_for_voltages(scene)) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "the tilt of a neighbour's top reads as pressure";
  }
  if (analysis_of(scene).relaxes) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "pillars of one frequency exchange their motion, however weakly tied";
  }
  return estimate;
}

EffectEstimate film_compliance_estimate(const ArrayScene& scene) {
  const double share = film_share(scene);
  EffectEstimate estimate{EffectRole::kOptional, share, "base compliance over pillar's", share,
                          "the film's deflection over the pillar's"};
  const bool is_push = scene.load == ArrayLoad::kPressure || !analysis_of(scene).is_loaded;
  if (asks_for_voltages(scene) || analysis_of(scene).relaxes || !is_push) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason =
        asks_for_voltages(scene) ? "its potential is asked for" : "it ties the pillars together";
  }
  return estimate;
}

EffectEstimate piezo_coupling_estimate(const ArrayScene& scene) {
  if (!is_electric(scene)) return {.reason = "the film has no permittivity"};
  PillarScene one = single_pillar(scene);
  one.film = scene.film;
  one.geometry.film = FilmGeometry{scene.geometry.film_thickness_m, scene.geometry.diameter_m};
  one.electrodes = ElectrodeOptions{FilmFace::kTop, 0.5 * scene.geometry.diameter_m};
  one.wanted = {"electrode_voltage"};
  EffectEstimate estimate = piezo_coupling_estimate(one);
  estimate.role = EffectRole::kNeeded;
  estimate.reason = "its potential is asked for";
  if (asks_for_voltages(scene)) return estimate;
  estimate.role = EffectRole::kOptional;
  estimate.error *= film_share(scene);
  estimate.reason = "only the film's share of the compliance feels it";
  return estimate;
}

EffectEstimate inertia_estimate(const ArrayScene& scene) {
  if (!analysis_of(scene).has_inertia) return {.reason = "the load is at rest"};
  return {EffectRole::kNeeded, 1.0, "", 0.0, "vibration is nothing else"};
}

EffectEstimate adhesion_at(double ratio) {
  if (ratio < 1.0) {
    return {EffectRole::kAbsent, 0.0, "length over matting length", ratio,
            "neighbours that touch part again"};
  }
  return {EffectRole::kOutside, 1.0, "length over matting length", ratio,
          "neighbours that once touch stay together (lateral collapse)"};
}

// Pillars longer than eq. D3 allows stay together once they touch; no analysis includes that.
EffectEstimate adhesion_estimate(const ArrayScene& scene) {
  const ArrayGeometry& g = scene.geometry;
  if (g.count == 1 && g.ends == FilmEnds::kFree) return {.reason = "nothing to stick to"};
  return adhesion_at(g.length_m /
                     longest_unmatted_m(g.diameter_m, g.spacing_m,
                                        {.young_modulus_Pa = scene.pillar.E0_Pa,
                                         .poisson_ratio = scene.pillar.nu,
                                         .surface_energy_J_m2 = scene.surface_energy_J_m2}));
}

EffectEstimate finite_strain_estimate(const ArrayScene& scene) {
  double peak_Pa = analysis_of(scene).is_loaded ? std::abs(scene.load_Pa) : 0.0;
  if (scene.press) {  // pulled tops stretch
    const FoundationPress pressed = row_foundation(scene);
    peak_Pa = std::max(pressed.largest_Pa, pressed.pull_Pa);
  }
  peak_Pa = std::max(peak_Pa, largest_size(history(scene)));
  if (peak_Pa == 0.0) {
    return {.reason = analysis_of(scene).has_inertia ? "small vibrations about the unloaded shape"
                                                     : "no load strains the pillars"};
  }
  double strain = peak_Pa / scene.pillar.E0_Pa;
  if (scene.load == ArrayLoad::kShear) {  // 6 l/d times the shear stress where a cantilever is held
    strain *= 6.0 * scene.geometry.length_m / scene.geometry.diameter_m;
  }
  return {EffectRole::kOutside, 2.3 * strain, "strain", strain,
          "small strains are assumed; not in the error"};
}

EffectEstimate dielectric_loss_estimate(const ArrayScene& scene) {
  if (!is_electric(scene)) return {.reason = "the film has no permittivity"};
  return film_loss_estimate(scene.film_loss, slowest_rad_s(scene),
                            loss_in_time(history(scene).empty(), false));
}

EffectEstimate relaxation_estimate(const ArrayScene& scene) {
  if (scene.pillar.terms.empty()) return {.reason = "the material is elastic"};
  if (analysis_of(scene).relaxes) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "its damping decides the response near resonance"};
  }
  return {.reason = "answers right after loading, with the instantaneous moduli"};
}

EffectEstimate incompressibility_estimate(const ArrayScene& scene) {
  if (scene.plane == PlaneState::kStress) return {.reason = "plane stress does not lock"};
  if (scene.pillar.nu < kNearlyIncompressible) {
    return {.reason = "the mesh error that is watched contains it"};
  }
  return {EffectRole::kNeeded, 1.0, "Poisson ratio", scene.pillar.nu,
          "stresses would lock without pressures of their own"};
}

// The moment at the foot of a cantilever grows by tan(u)/u, u = (pi/2) sqrt(p/p_cr), with an axial load (eq. E9):
// Timoshenko & Gere, Theory of Elastic Stability (1961), 1.3.
EffectEstimate stiffness_of_bent(double share, double bent, const char* reason) {
  if (share >= 1.0) {
    return {EffectRole::kOutside, 1.0, "p/p_cr", share,
            "pillars buckle; the answer is that of pillars that stay straight"};
  }
  const double u = 0.5 * pi * std::sqrt(std::min(share, 0.99));
  return {EffectRole::kOutside, bent * (std::tan(u) / u - 1.0), "p/p_cr", share, reason};
}

namespace {

EffectEstimate stiffness_under_shape(const ArrayScene& scene) {
  const double pressure_Pa = row_foundation(scene).largest_Pa;
  if (!(pressure_Pa > 0.0)) return {.reason = "the shape touches no pillar"};
  EffectEstimate estimate =
      stiffness_of_bent(pressure_Pa / engesser_pressure_Pa(single_pillar(scene)), 1.0, kTurned);
  // Forces and voltages of pillars that bend change less than their moments.
  estimate.error = std::min(estimate.error, 1.0);
  return estimate;
}

}  // namespace

EffectEstimate geometric_stiffness_estimate(const ArrayScene& scene) {
  if (!analysis_of(scene).is_loaded || scene.load != ArrayLoad::kPressure) {
    return {.reason = "no pressure on the top"};
  }
  if (scene.press) return stiffness_under_shape(scene);
  const double share = scene.load_Pa / engesser_pressure_Pa(single_pillar(scene));
  return {EffectRole::kAbsent, 0.0, "p/p_cr", share, "a straight pillar shortens without it"};
}

// A top lifts where the surface stays above it, about where a rotated top would (the stresses of bending and
// compression, Saint-Venant, are equal at the rim when the overlap vanishes there), and where a bent surface leaves it
// pulling.
EffectEstimate contact_of(const ShapePress& press, const FoundationPress& pressed) {
  EffectEstimate estimate{EffectRole::kOptional, pressed.lift, "largest gap or pull over overlap",
                          pressed.lift, "tops that the shape does not touch are not pulled"};
  estimate.declared_off = kPrescribed;
  const bool holds = press.work_of_adhesion_J_m2 > 0.0;
  if (!pressed.covers_all || holds) estimate.role = EffectRole::kNeeded;
  return estimate;
}

EffectEstimate contact_estimate(const ArrayScene& scene) {
  if (!scene.press) return {.reason = "no shape presses on the pillars"};
  return contact_of(*scene.press, row_foundation(scene));
}

// What a held top may be pulled by, over what the largest of the elastic foundation bears.
EffectEstimate pull_off_at(const ShapePress& press, double share) {
  EffectEstimate estimate{EffectRole::kOptional, std::min(share, 1.0),
                          "pull-off over largest force", share,
                          "tops that the shape has touched are pulled when it leaves"};
  if (press.before_m.empty()) return estimate;
  estimate.role = EffectRole::kNeeded;
  estimate.reason = "the depths that the shape went through are given";
  return estimate;
}

EffectEstimate pull_off_estimate(const ArrayScene& scene) {
  if (!scene.press) return {.reason = "no shape presses on the pillars"};
  if (scene.press->work_of_adhesion_J_m2 == 0.0) return {.reason = "no work of adhesion is given"};
  const double largest_N_m = row_foundation(scene).largest_Pa * scene.geometry.diameter_m;
  const double pull_N_m = row_pull_off_N_m(scene, scene.press->work_of_adhesion_J_m2);
  return pull_off_at(*scene.press, largest_N_m > 0.0 ? pull_N_m / largest_N_m : 1.0);
}

void leave_out_piezo_coupling(ArrayScene& scene) {
  scene.film.permittivity_F_m.setZero();
  scene.film.piezo_C_m2.setZero();
  scene.electrodes.is_equipotential = false;
}

}  // namespace viscard
