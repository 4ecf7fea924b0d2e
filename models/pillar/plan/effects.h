#pragma once

#include "models/pillar/scene/scene.h"

#include <string>
#include <vector>

namespace viscard {

// What an effect is to a scene.
enum class EffectRole {
  kAbsent,    // nothing in the scene for it to act on: off, at no error
  kOptional,  // the estimate decides
  kNeeded,    // what is asked for does not exist without it
  kOutside    // no analysis here can have it: a bound of what it would change, as a warning
};

// A-priori estimate of leaving an effect out: from the scene's numbers alone, nothing is solved.
// models/README.md lists the formulas and their sources.
struct EffectEstimate {
  EffectRole role = EffectRole::kAbsent;
  double error = 0.0;  // largest relative error of what is asked for, if left out
  std::string number;  // the number that decides, as "E A/(k L)"
  double value = 0.0;  // of that number
  std::string reason;  // one clause
};

// One effect: what it changes, what it costs, and how a scene becomes one that never had it.
struct Effect {
  const char* name;  // key in a scene's [effects]
  const char* changes;
  const char* cost;
  EffectEstimate (*estimate)(const Scene& scene);
  void (*leave_out)(Scene& scene);  // for kOptional effects that are off
  void (*insist)(Scene& scene);     // for effects forced on; may be null
};

const std::vector<Effect>& effects();  // all, in the order they are printed
std::vector<std::string> effect_names();

// True when the scene asks for this result; a scene that names no results asks for all.
bool asks_for(const Scene& scene, const std::string& result);

// Effects that act in the film and its electrodes (effects_film.cpp).
EffectEstimate film_compliance_estimate(const Scene& scene);
void leave_out_film(Scene& scene);
EffectEstimate piezo_coupling_estimate(const Scene& scene);
void leave_out_piezo_coupling(Scene& scene);
EffectEstimate leakage_estimate(const Scene& scene);
EffectEstimate crosstalk_estimate(const Scene& scene);

// Effects in time (effects_time.cpp).
EffectEstimate relaxation_estimate(const Scene& scene);
void leave_out_relaxation(Scene& scene);
EffectEstimate inertia_estimate(const Scene& scene);

// Effects of the body's shape and large motion (effects_body.cpp).
EffectEstimate incompressibility_estimate(const Scene& scene);
void leave_out_incompressibility(Scene& scene);
void insist_on_incompressibility(Scene& scene);
EffectEstimate three_dimensional_estimate(const Scene& scene);
void leave_out_three_dimensional(Scene& scene);
EffectEstimate geometric_stiffness_estimate(const Scene& scene);
void leave_out_geometric_stiffness(Scene& scene);
EffectEstimate adhesion_estimate(const Scene& scene);
EffectEstimate finite_strain_estimate(const Scene& scene);
EffectEstimate contact_estimate(const Scene& scene);

// Pressure at which the pillar buckles, clamped at its foot, its top free (or, moved by a plate,
// kept upright but free to slide: four times as much), by Euler's formula with Engesser's
// correction for shear, P = P_e/(1 + P_e/(kappa G A)) (eq. E6). Pa.
double engesser_pressure_Pa(const Scene& scene);

// Largest pressure the scene puts on the top, Pa (0 for a history of shortening; a moved top counts
// E u/L).
double largest_pressure_Pa(const Scene& scene);

}  // namespace viscard
