#include "models/answer/drive_parts.h"
#include "models/maths/dense.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/large_strain.h"
#include "models/scene/scene_effects.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

bool asks_for_electric(const PillarScene& scene) {
  if (!scene.electrodes) return false;
  return asks_for(scene, "electrode_voltage") || asks_for(scene, "electrode_charge") ||
         asks_for(scene, "electrode_capacitance") || asks_for(scene, "displacement_per_volt") ||
         asks_for(scene, "potential_at_centre") || asks_for(scene, "potential_mean") ||
         asks_for(scene, "quadrant_charge") || asks_for(scene, "quadrant_voltage") ||
         scene.readout || drive_V(scene) != 0.0;
}

// Largest share of electric in elastic energy that any strain can cause: the largest eigenvalue of
// eps^-1 e c^-1 e^t (eq. E2).
double coupling_of(const Medium& film) {
  const Matrix6d c = film.is_isotropic && std::isinf(film.bulk_Pa)
                         ? Matrix6d(film.stiffness_Pa + 1e3 * film.shear_Pa * volumetric_form())
                         : film.stiffness_Pa;
  const Eigen::MatrixXd strains =
      SymmetricFactor(c).solve(Eigen::MatrixXd(film.piezo_C_m2.transpose()));
  return generalized_eigen(film.piezo_C_m2 * strains, film.permittivity_F_m).values.maxCoeff();
}

}  // namespace

EffectEstimate film_compliance_estimate(const PillarScene& scene) {
  if (!scene.film) return {.reason = scene.fixed_bottom ? "the base is rigid" : "there is no film"};
  const double share = film_shares(scene).axial;
  const auto needed = [&](const char* reason) {
    return EffectEstimate{EffectRole::kNeeded, 1.0, "E A/(k L)", share, reason};
  };
  const auto forced = scene.effects.find("piezo_coupling");
  if (asks_for_electric(scene) ||
      (scene.electrodes && forced != scene.effects.end() && forced->second == EffectChoice::kOn)) {
    return needed("its potential is asked for");
  }
  if (!scene.fixed_bottom) return needed("it is free and moves itself");
  const Analysis& analysis = analysis_of(scene);
  const EffectEstimate usual =
      analysis.has_inertia
          ? needed("it moves every resonance")
          : EffectEstimate{EffectRole::kOptional, kUnevenTraction * share, "E A/(k L)", share,
                           "the film's deflection over the pillar's"};
  return analysis.film_compliance == nullptr ? usual : analysis.film_compliance(scene, usual);
}

void leave_out_film(PillarScene& scene) {
  scene.film.reset();
  scene.directional_film.reset();
  scene.geometry.film.reset();
  scene.electrodes.reset();
}

EffectEstimate piezo_coupling_estimate(const PillarScene& scene) {
  if (!scene.electrodes || !scene.film) return {.reason = "no electrode"};
  const double coupling = coupling_of(*scene.film);
  EffectEstimate estimate{EffectRole::kOptional, coupling, "k^2 of the film", coupling,
                          "electric back on elastic energy"};
  if (!asks_for_electric(scene)) {
    estimate.error *= kUnevenTraction * film_shares(scene).axial;
    estimate.reason = "only the film's share of the deflection feels it";
    return estimate;
  }
  const Analysis& analysis = analysis_of(scene);
  const char* const why = analysis.why_two_way == nullptr ? "voltages in time need both ways"
                                                          : analysis.why_two_way(scene);
  if (why == nullptr) return estimate;
  estimate.role = EffectRole::kNeeded;
  estimate.reason = why;
  return estimate;
}

void leave_out_piezo_coupling(PillarScene& scene) {
  if (asks_for_electric(scene)) {
    scene.one_way_potential = true;
  } else {
    scene.electrodes.reset();
  }
}

EffectEstimate incompressibility_estimate(const PillarScene& scene) {
  const double nu = scene.pillar.nu;
  const double ratio = nu < 0.5 ? 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)) : HUGE_VAL;  // K/G
  const bool is_plane_stress = scene.plane == PlaneState::kStress;
  if (is_plane_stress) return {.reason = "plane stress does not lock"};
  if (nu == 0.5) {
    return {EffectRole::kNeeded, 1.0, "Poisson ratio", nu,
            "no displacement alone keeps its volume"};
  }
  // Pressures of displacement elements have K/G times the error of the strains (eq. E4); below the
  // threshold the estimated mesh error contains it.
  EffectEstimate estimate{EffectRole::kOptional, 0.0, "K/G", ratio,
                          "the mesh error that is watched contains it"};
  if (nu >= kNearlyIncompressible) {
    estimate.error = std::max(scene.tolerance, std::min(1.0, scene.tolerance * ratio));
    estimate.reason = "stresses would lock without pressures of their own";
  }
  return estimate;
}

EffectEstimate three_dimensional_estimate(const PillarScene& scene) {
  // Radius of gyration d/4 of a disc against d/sqrt(12) of a strip: lateral frequencies and
  // buckling of slender pillars differ by that ratio; axial answers differ by the clamped foot (eq.
  // E5).
  const double foot = scene.pillar.nu * scene.pillar.nu *
                      std::min(1.0, 0.5 * scene.geometry.diameter_m / scene.geometry.length_m);
  const bool bends = analysis_of(scene).bends;
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

namespace {

// p/p_cr of the load. Without the effect, a straight pillar under a load along its axis still
// shortens.
EffectEstimate stiffness_of_straight_pillar(const PillarScene& scene) {
  const double pressure_Pa = largest_pressure_Pa(scene);
  if (pressure_Pa == 0.0) return {.reason = "no pressure on the top"};
  if (is_lateral(scene)) return {.reason = "no pressure along the pillar"};
  if (!scene.fixed_bottom) return {.reason = "nothing holds the foot against the load"};
  const double share = pressure_Pa / engesser_pressure_Pa(scene);
  return {EffectRole::kAbsent, 0.0, "p/p_cr", share, "a straight pillar shortens without it"};
}

}  // namespace

EffectEstimate geometric_stiffness_estimate(const PillarScene& scene) {
  const EffectEstimate usual = stiffness_of_straight_pillar(scene);
  const Analysis& analysis = analysis_of(scene);
  return analysis.geometric_stiffness == nullptr ? usual
                                                 : analysis.geometric_stiffness(scene, usual);
}

void leave_out_geometric_stiffness(PillarScene& scene) {
  set_part(
      scene.drive, [](auto& d) requires requires { d.pressure_Pa; } { d.pressure_Pa = 0.0; });
}

EffectEstimate finite_strain_estimate(const PillarScene& scene) {
  double strain = largest_pressure_Pa(scene) / scene.pillar.E0_Pa;
  if (is_lateral(scene) && moves_top(scene)) {  // 3 u R/L^2 at the foot of a beam
    const double L_m = scene.geometry.length_m;
    strain = 1.5 * std::abs(*displacement_m(scene)) * scene.geometry.diameter_m / (L_m * L_m);
  } else if (is_lateral(scene)) {  // bending at the foot: 4 tau L/R, of a strip 3 tau L/R
    strain *= (scene.plane ? 6.0 : 8.0) * scene.geometry.length_m / scene.geometry.diameter_m;
  }
  if (analysis_of(scene).history == HistoryOf::kShortening) {
    strain = std::max(strain, largest_size(history(scene)) / scene.geometry.length_m);
  }
  const Surroundings& around = scene.surroundings;
  if (!analysis_of(scene).has_inertia) {
    strain += std::abs(around.pillar_expansion_1_K * around.heated_K()) +
              scene.pillar.rho_kg_m3 * std::abs(around.gravity_m_s2) * scene.geometry.length_m /
                  scene.pillar.E0_Pa;
  }
  if (const auto* bowed = std::get_if<BucklingDrive>(&scene.drive); bowed && bowed->bow_m > 0.0)
    strain = std::max(strain, bowed->collapse_strain);
  if (strain == 0.0) {
    return {.reason = analysis_of(scene).has_inertia ? "small vibrations about the unloaded shape"
                                                     : "no load strains the pillar"};
  }
  if (!scene.rubber) {
    return {EffectRole::kOutside, 2.3 * strain, "strain", strain,
            "small strains are assumed; not in the error"};
  }
  const bool is_pulled = !is_lateral(scene) && (moves_top(scene) ? *displacement_m(scene) > 0.0
                                                                 : pressure_Pa(scene) < 0.0);
  const double error = large_strain_error(scene, is_pulled ? strain : -strain);
  const char* const why = why_small_strain(scene);
  if (why != nullptr) return {EffectRole::kOutside, error, "strain", strain, why};
  return {EffectRole::kOptional, error, "strain", strain,
          "the law's stress against E0 times the strain"};
}

void leave_out_finite_strain(PillarScene& scene) {
  scene.small_strain = true;
}

namespace {

double shortest_ramp_s(const Course& points) {
  double shortest = std::numeric_limits<double>::infinity();
  if (!points.empty() && points.front().value != 0.0) shortest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].value == points[i - 1].value) continue;
    shortest = std::min(shortest, points[i].time_s - points[i - 1].time_s);
  }
  return shortest;
}

}  // namespace

EffectEstimate relaxation_estimate(const PillarScene& scene) {
  if (scene.pillar.terms.empty()) return {.reason = "the material is elastic"};
  const Analysis& analysis = analysis_of(scene);
  EffectEstimate usual{.reason = "answers right after loading, with the instantaneous moduli"};
  if (analysis.relaxes) {
    usual = {EffectRole::kNeeded, 1.0, "", 0.0, "its damping decides the response near resonance"};
  }
  return analysis.relaxation == nullptr ? usual : analysis.relaxation(scene, usual);
}

EffectEstimate inertia_estimate(const PillarScene& scene) {
  if (analysis_of(scene).has_inertia) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "vibration is nothing else"};
  }
  if (!has_history(scene) || !(scene.pillar.rho_kg_m3 > 0.0)) {
    return {.reason = "the load is at rest"};
  }
  // A rod under a ramp of length t_R rings by sin(x)/x, x = pi f_1 t_R (eq. E7).
  const double x =
      std::numbers::pi * first_rod_frequency_Hz(scene) * shortest_ramp_s(history(scene));
  return {EffectRole::kOutside, x > 1.0 ? 1.0 / x : 1.0, "pi f_1 t_ramp", x,
          "rings out after each ramp; not in a quasi-static answer"};
}

EffectEstimate film_loss_estimate(const FilmLoss& loss, double slowest_rad_s, double in_time) {
  if (loss.is_lossless()) return {.reason = "no losses of the film are given"};
  if (!(slowest_rad_s > 0.0)) {
    return {.reason = "answers right after loading, before the film loses charge"};
  }
  const double share = lost_share(loss, slowest_rad_s);
  return {EffectRole::kOptional, in_time * share, "lost share of the voltage", share,
          "the film's polarisation follows late, and charge leaks through it"};
}

EffectEstimate dielectric_loss_estimate(const PillarScene& scene) {
  if (!scene.electrodes) return {.reason = "no electrode"};
  if (reads_quadrants(scene) && scene.electrodes->electrode_radius_m > 0.0) {
    return {.reason = "quadrants at 0 V, where the film loses nothing"};
  }
  if (is_lateral(scene) && !reads_quadrants(scene)) {
    return {.reason = "a round electrode reads nothing of a sideways load"};
  }
  return film_loss_estimate(
      scene.film_loss, slowest_rad_s(scene),
      loss_in_time(analysis_of(scene).swings_from_Hz != nullptr, scene.readout.has_value()));
}

EffectEstimate leakage_estimate(const PillarScene& scene) {
  if (!scene.electrodes) return {.reason = "no electrode"};
  if (scene.readout) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "the electrode is wired to a readout"};
  }
  return {.reason = "the voltage of an open electrode, before charge leaks"};
}

}  // namespace viscard
