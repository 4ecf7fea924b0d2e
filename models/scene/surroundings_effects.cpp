// Effects of what a scene stands in: its temperature, weight and the air.
#include "models/answer/drive_parts.h"
#include "models/material/material.h"
#include "models/material/prony_series.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/air_damping.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/top_load.h"
#include "models/scene/scene_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// The largest change of the relative modulus if all relaxation times are multiplied by a factor.
double change_by_shift(const std::vector<MaterialTerm>& terms, double factor) {
  constexpr int kPerDecade = 20;
  const RelaxationTimes times = relaxation_times(terms);
  const double decades = std::log10(times.slowest_s / times.fastest_s) + 6.0;
  double largest = 0.0;
  for (int i = 0; i <= static_cast<int>(decades * kPerDecade); ++i) {
    const double t_s = 1e-3 * times.fastest_s * std::pow(10.0, i / double{kPerDecade});
    double before = 1.0, after = 1.0;
    for (const MaterialTerm& term : terms) {
      const double share = std::max(term.g, term.k);
      before += share * std::expm1(-t_s / term.tau_s);
      after += share * std::expm1(-t_s * factor / term.tau_s);
    }
    largest = std::max(largest, std::abs(after - before) / std::max(before, 1e-3));
  }
  return largest;
}

}  // namespace

EffectEstimate temperature_estimate(const SceneCommon& scene, const EffectEstimate& relaxation,
                                    const EffectEstimate& inertia) {
  const Surroundings& around = scene.surroundings;
  if (std::isnan(around.temperature_C)) {
    return {.reason = "the scene has the temperature at which its material was measured"};
  }
  if (relaxation.role == EffectRole::kAbsent) {
    return {.reason = "nothing relaxes here, and moduli without relaxation are taken as they are"};
  }
  if (around.shift_factor != 1.0) {
    const double factor = around.shift_factor;
    const double change = change_by_shift(scene.pillar.terms, factor);
    // A loss modulus changes at most as its frequency does.
    const bool vibrates = inertia.role == EffectRole::kNeeded;
    const double of_loss = vibrates ? std::max(factor, 1.0 / factor) - 1.0 : 0.0;
    return {EffectRole::kOptional, std::max(change, of_loss), "a_T", factor,
            "the relaxation times are those of the scene's temperature"};
  }
  const std::optional<double>& measured_C = scene.pillar.T_ref_C;
  if (measured_C && std::abs(*measured_C - around.temperature_C) < 0.5) {
    return {.reason = "the material was measured at it"};
  }
  double lost = 0.0;
  for (const MaterialTerm& term : scene.pillar.terms) lost += std::max(term.g, term.k);
  return {EffectRole::kOutside, lost, "relaxed share", lost,
          "the material states no shift of its times with temperature"};
}

void leave_out_temperature(SceneCommon& scene) {
  for (MaterialTerm& term : scene.pillar.terms) term.tau_s /= scene.surroundings.shift_factor;
  scene.surroundings.shift_factor = 1.0;
}

namespace {

constexpr const char* kNotOfRubber = "large strains of a law of rubber are answered without it";

// The weight of the film over its electrode, per area of the pillar: an electrode adds up what presses on it. A pressure
// without end reads up to 4 times that under a pillar (67.8 against 18.8 mV per 10 kPa at 40 um on 25 um), and half of the
// film's weight lies above its middle.
double film_weight_Pa(const PillarScene& scene) {
  if (!scene.film) return 0.0;
  constexpr double kWideOverNarrow = 4.0, kAboveMiddle = 0.5;
  const double own_Pa = kWideOverNarrow * kAboveMiddle * scene.film->rho_kg_m3 *
                        std::abs(scene.surroundings.gravity_m_s2) *
                        scene.geometry.film->thickness_m;
  const double read_m = scene.electrodes ? scene.electrodes->electrode_radius_m : 0.0;
  return own_Pa * std::max(1.0, std::pow(2.0 * read_m / scene.geometry.diameter_m, 2));
}

// A flat pillar is held by its foot: it expands more along its axis, and yields less to a load, up to the modulus of a
// body without sideways strain. Source: Gent & Lindley, Proc. Inst. Mech. Eng. 173 (1959) 111.
double apparent_modulus_Pa(const PillarScene& scene) {
  const double nu = scene.pillar.nu, E_Pa = scene.pillar.E0_Pa;
  const double shape = scene.geometry.diameter_m / (4.0 * scene.geometry.length_m);
  const double held = (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return E_Pa * std::min(1.0 + 2.0 * shape * shape, held > 0.0 ? held : HUGE_VAL);
}

constexpr const char* kChangeOnly = "it has acted for long: the answer is the change by the load";

bool is_axial_static(const PillarScene& scene) {
  return std::holds_alternative<StaticDrive>(scene.drive) && !is_lateral(scene);
}

}  // namespace

EffectEstimate weight_estimate(const PillarScene& scene) {
  const double gravity_m_s2 = std::abs(scene.surroundings.gravity_m_s2);
  if (gravity_m_s2 == 0.0) return {.reason = "surroundings.gravity is not given"};
  const double weight_Pa = scene.pillar.rho_kg_m3 * gravity_m_s2 * scene.geometry.length_m;
  if (scene.rubber) {
    const double load_Pa = largest_pressure_Pa(scene);
    const double share = load_Pa > 0.0 ? weight_Pa / load_Pa : 1.0;
    return {EffectRole::kOutside, share, "rho g L/p", share, kNotOfRubber};
  }
  if (is_axial_static(scene)) {
    const double load_Pa = largest_pressure_Pa(scene);
    const bool is_all = !(load_Pa > 0.0) || drive_V(scene) != 0.0;
    const double all_Pa = weight_Pa + film_weight_Pa(scene);
    return {EffectRole::kOptional, is_all ? 1.0 : all_Pa / load_Pa, "rho g L/p",
            is_all ? 0.0 : all_Pa / load_Pa, "the weight of pillar and film over the load"};
  }
  if (!analysis_of(scene).bends && !is_lateral(scene)) return {.reason = kChangeOnly};
  const double share = std::abs(weight_on_top_Pa(scene)) / engesser_pressure_Pa(scene);
  return {EffectRole::kOutside, std::min(1.0, share), "0.315 rho g L/p_cr", share,
          scene.surroundings.gravity_m_s2 > 0.0 ? "the weight softens the pillar sideways"
                                                : "the weight stiffens the pillar sideways"};
}

EffectEstimate thermal_strain_estimate(const PillarScene& scene) {
  const Surroundings& around = scene.surroundings;
  if (!around.strains_by_heat()) {
    return {.reason = "no temperatures and expansions under surroundings"};
  }
  if (!is_axial_static(scene)) return {.reason = kChangeOnly};
  const double load_Pa = largest_pressure_Pa(scene);
  const double strain =
      std::max(std::abs(around.pillar_expansion_1_K), std::abs(around.film_expansion_1_K)) *
      std::abs(around.heated_K());
  const double held = (1.0 + scene.pillar.nu) / (1.0 - scene.pillar.nu);
  const double by_strain =
      load_Pa > 0.0 ? strain * held * apparent_modulus_Pa(scene) / load_Pa : 1.0;
  if (scene.rubber)
    return {EffectRole::kOutside, by_strain, "alpha dT E/p", by_strain, kNotOfRubber};
  EffectEstimate estimate{EffectRole::kOptional, by_strain, "alpha dT E/p", by_strain,
                          "expansion over the load's strain"};
  if (!scene.electrodes) return estimate;
  // Charge of the film per area over that of the load, which is d33 p under the pillar.
  const double of_load_C_m2 = std::abs(scene.film_charge_C_N(2, 2)) * load_Pa;
  const double by_charge =
      of_load_C_m2 > 0.0 ? std::abs(around.pyroelectric_C_m2K * around.heated_K()) / of_load_C_m2
                         : 1.0;
  // The film, which the base holds, is stressed by its own modulus.
  const double by_film = load_Pa > 0.0 && scene.film
                             ? std::abs(around.film_expansion_1_K * around.heated_K()) *
                                   elasticity_of(*scene.film).young_Pa /
                                   (load_Pa * (1.0 - elasticity_of(*scene.film).nu))
                             : 0.0;
  estimate.error = std::max({by_strain, by_charge, by_film});
  if (estimate.error > by_strain) {
    estimate.number = by_charge > by_film ? "p dT/(d33 p)" : "alpha_f dT E_f/p";
    estimate.value = estimate.error;
    estimate.reason = "what the film itself gives by heat over the load's";
  }
  return estimate;
}

void leave_out_thermal_strain(PillarScene& scene) {
  scene.surroundings.made_at_C = scene.surroundings.temperature_C;
}

namespace {

// Damping ratio of the material at the pillar's first frequency along its axis.
double material_damping_ratio(const PillarScene& scene) {
  if (scene.pillar.terms.empty()) return 0.0;
  const ComplexModulus E = complex_modulus_Pa(
      largest_relaxation(scene.pillar), 2.0 * std::numbers::pi * first_rod_frequency_Hz(scene));
  return 0.5 * E.loss_Pa / E.storage_Pa;
}

}  // namespace

EffectEstimate air_damping_estimate(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  if (!analysis.has_inertia) return {.reason = "nothing vibrates"};
  if (!(scene.pillar.rho_kg_m3 > 0.0)) return {.reason = "the pillar has no mass"};
  const AirLoad air = air_load_of_slowest_mode(scene);
  if (!scene.surroundings.air) {
    return {.reason = "surroundings.air is not given; it would add a damping ratio of about " +
                      text_of(air.damping_ratio, 2)};
  }
  const double error = std::max(air.frequency_share, air.damping_ratio);
  if (std::holds_alternative<ModalDrive>(scene.drive)) {
    return {EffectRole::kOptional, error, "damping ratio by air", air.damping_ratio,
            "air that a mode moves takes its energy"};
  }
  // At a resonance the answer goes as one over the damping.
  return {EffectRole::kOutside,
          air.damping_ratio / (air.damping_ratio + material_damping_ratio(scene)),
          "damping ratio by air", air.damping_ratio,
          "air lowers resonances; only free vibration is computed with it"};
}

}  // namespace viscard
