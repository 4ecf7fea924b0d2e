#include "models/array/plane/array_plan.h"

#include "models/pillar/plan/effect_budget.h"
#include "models/sensor/sensor_design.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using std::numbers::pi;

bool is_electric(const ArrayScene& scene) {
  return scene.film.permittivity_F_m(2, 2) > 0.0;
}

bool is_in_time(const ArrayScene& scene) {
  return scene.analysis == ArrayAnalysis::kHarmonic || scene.analysis == ArrayAnalysis::kTransient;
}

// "centre_voltage" and "centre_voltage_4" begin alike; without a [want] everything is asked for.
bool asks_for(const ArrayScene& scene, const char* stem) {
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(),
                     [&](const std::string& name) { return name.starts_with(stem); });
}

bool asks_for_voltages(const ArrayScene& scene) {
  if (!is_electric(scene) || scene.analysis == ArrayAnalysis::kModal) return false;
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(),
                     [](const std::string& name) { return !name.starts_with("top_displacement"); });
}

bool asks_between_pillars(const ArrayScene& scene) {
  for (const char* stem : {"midway", "coupling", "crosstalk", "neighbours", "deviation"}) {
    if (asks_for(scene, stem)) return true;
  }
  return false;
}

// The film's share of a pillar's compliance, by the estimate of one pillar's film (eq. E1).
double film_share(const ArrayScene& scene) {
  Scene one = single_pillar(scene);
  one.pressure_Pa = 1.0;
  one.film = scene.film;
  const double edge_m = std::max(scene.geometry.film_edge_m, 0.5 * scene.geometry.spacing_m);
  one.geometry.film =
      FilmGeometry{scene.geometry.film_thickness_m, 0.5 * scene.geometry.diameter_m + edge_m};
  one.wanted = {"top_displacement"};
  const bool bends = scene.analysis != ArrayAnalysis::kStatic || scene.load == ArrayLoad::kShear;
  const double axial = film_compliance_estimate(one).error;
  if (!bends) return axial;
  one.kind = AnalysisKind::kBuckling;
  return std::max(axial, film_compliance_estimate(one).error);
}

// Distance over the film's thickness at which the nearest neighbour, or the film's end mirrored, is
// felt.
double nearest_over_thickness(const ArrayScene& scene) {
  const ArrayGeometry& g = scene.geometry;
  const bool has_gap = g.count > 1 || g.ends == FilmEnds::kMirror;
  double nearest_m = has_gap ? g.spacing_m : HUGE_VAL;
  if (g.ends == FilmEnds::kFree) nearest_m = std::min(nearest_m, 2.0 * g.film_edge_m);
  return nearest_m / g.film_thickness_m;
}

// Field between plates decays as exp(-pi x/(2 t)) with one face free of charge, strain of a held
// layer as exp(-.9215 x/t), the slowest root of (3 - 4 nu) cosh 2x + 2 x^2 + 5 - 12 nu + 8 nu^2 at
// nu = .29 (eq. A4). The amplitudes are 1.5 times the largest that rows of the thesis' film have.
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
      estimate.reason = "what passes between pillars is asked for";
    }
  } else {
    estimate.error = film_share(scene) * elastic;
    estimate.reason = "neighbours move the film, and the film the pillar";
  }
  if (scene.load == ArrayLoad::kShear && asks_for_voltages(scene)) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "a pillar sheared alone gives no voltage in its middle or mean";
  }
  if (is_in_time(scene)) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "pillars of one frequency exchange their motion, however weakly tied";
  }
  return estimate;
}

EffectEstimate film_estimate(const ArrayScene& scene) {
  const double share = film_share(scene);
  EffectEstimate estimate{EffectRole::kOptional, share, "base compliance over pillar's", share,
                          "the film's deflection over the pillar's"};
  const bool is_push =
      scene.load == ArrayLoad::kPressure || scene.analysis == ArrayAnalysis::kModal;
  if (asks_for_voltages(scene) || is_in_time(scene) || !is_push) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason =
        asks_for_voltages(scene) ? "its potential is asked for" : "it ties the pillars together";
  }
  return estimate;
}

EffectEstimate piezo_estimate(const ArrayScene& scene) {
  if (!is_electric(scene)) return {.reason = "the film has no permittivity"};
  Scene one = single_pillar(scene);
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

EffectEstimate time_estimate(const ArrayScene& scene, const char* at_rest) {
  if (scene.analysis == ArrayAnalysis::kStatic) return {.reason = at_rest};
  return {EffectRole::kNeeded, 1.0, "", 0.0, "vibration is nothing else"};
}

// Pillars longer than eq. D3 allows stay together once they touch; no analysis follows them there.
EffectEstimate adhesion_estimate(const ArrayScene& scene) {
  const ArrayGeometry& g = scene.geometry;
  if (g.count == 1 && g.ends == FilmEnds::kFree) return {.reason = "nothing to stick to"};
  SensorMaterial material;
  material.young_modulus_Pa = scene.pillar.E0_Pa;
  material.poisson_ratio = scene.pillar.nu;
  material.surface_energy_J_m2 = scene.surface_energy_J_m2;
  const double ratio = g.length_m / longest_unmatted_m(g.diameter_m, g.spacing_m, material);
  if (ratio < 1.0) {
    return {EffectRole::kAbsent, 0.0, "length over matting length", ratio,
            "neighbours that touch part again"};
  }
  return {EffectRole::kOutside, 1.0, "length over matting length", ratio,
          "neighbours that once touch stay together (lateral collapse)"};
}

EffectEstimate strain_estimate(const ArrayScene& scene) {
  double peak_Pa = scene.analysis == ArrayAnalysis::kModal ? 0.0 : std::abs(scene.load_Pa);
  for (const HistoryPoint& point : scene.history)
    peak_Pa = std::max(peak_Pa, std::abs(point.value));
  if (peak_Pa == 0.0) return {.reason = "small vibrations about the unloaded shape"};
  double strain = peak_Pa / scene.pillar.E0_Pa;
  if (scene.load == ArrayLoad::kShear) {  // 6 l/d times the shear stress where a cantilever is held
    strain *= 6.0 * scene.geometry.length_m / scene.geometry.diameter_m;
  }
  return {EffectRole::kOutside, 2.3 * strain, "strain", strain,
          "small strains are assumed; not in the error"};
}

EffectEstimate relaxation_estimate(const ArrayScene& scene) {
  if (scene.pillar.terms.empty()) return {.reason = "the material is elastic"};
  if (is_in_time(scene)) {
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

EffectEstimate stiffness_estimate(const ArrayScene& scene) {
  if (scene.analysis == ArrayAnalysis::kModal || scene.load != ArrayLoad::kPressure) {
    return {.reason = "no pressure on the top"};
  }
  const double share = scene.load_Pa / engesser_pressure_Pa(single_pillar(scene));
  return {EffectRole::kAbsent, 0.0, "p/p_cr", share, "a straight pillar shortens without it"};
}

std::vector<NamedEstimate> estimates_of(const ArrayScene& scene) {
  const EffectEstimate strip{.reason = "rows are solved in the plane: strips, not cylinders"};
  return {{"relaxation", relaxation_estimate(scene)},
          {"inertia", time_estimate(scene, "the load is at rest")},
          {"incompressibility", incompressibility_estimate(scene)},
          {"film_compliance", film_estimate(scene)},
          {"piezo_coupling", piezo_estimate(scene)},
          {"leakage", {.reason = "open electrodes, before charge leaks"}},
          {"crosstalk", crosstalk_estimate(scene)},
          {"three_dimensional", strip},
          {"geometric_stiffness", stiffness_estimate(scene)},
          {"adhesion", adhesion_estimate(scene)},
          {"finite_strain", strain_estimate(scene)},
          {"contact", {.reason = "no shape presses on the pillars"}}};
}

void leave_out(const std::string& name, ArrayScene& scene) {
  if (name == "crosstalk") scene.feels_neighbours = false;
  if (name == "film_compliance") scene.feels_film = false;
  if (name == "piezo_coupling") {
    scene.film.permittivity_F_m.setZero();
    scene.film.piezo_C_m2.setZero();
    scene.electrodes.is_equipotential = false;
  }
}

}  // namespace

ArrayPlan plan_effects(const ArrayScene& scene) {
  validate(scene);
  EffectDecisions decisions = decide_effects(estimates_of(scene), scene.effects, scene.tolerance);
  ArrayPlan plan{std::move(decisions.effects), scene, decisions.left_out};
  for (const SceneEffect& effect : plan.effects) {
    if (effect.is_counted) leave_out(effect.name, plan.reduced);
  }
  plan.reduced.tolerance =
      std::max({scene.tolerance - plan.left_out, 1e-7, kShareOfMesh * scene.tolerance});
  return plan;
}

ArrayScene with_all_effects_on(const ArrayScene& scene) {
  ArrayScene all = scene;
  for (const NamedEstimate& one : estimates_of(scene)) {
    if (one.estimate.role == EffectRole::kOptional) all.effects[one.name] = EffectChoice::kOn;
  }
  return all;
}

SceneAnswer simulate_array_planned(const ArrayScene& scene) {
  const ArrayPlan plan = plan_effects(scene);
  SceneAnswer answer = simulate_array(plan.reduced);
  tell_left_out({plan.effects, plan.left_out}, scene.tolerance, answer);
  return answer;
}

}  // namespace viscard
