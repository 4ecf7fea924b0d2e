#include "models/maths/dense.h"
#include "models/pillar/analyses/analysis.h"
#include "models/scene/scene_effects.h"

#include <Eigen/Core>

#include <cmath>

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

}  // namespace viscard
