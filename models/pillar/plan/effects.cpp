#include "models/pillar/plan/effects.h"

#include <algorithm>

namespace viscard {

const std::vector<Effect>& effects() {
  static const std::vector<Effect> kEffects = {
      {"relaxation", "moduli fall with time", "a vector per term, and time steps",
       relaxation_estimate, leave_out_relaxation, nullptr},
      {"inertia", "mass resists", "a mass matrix", inertia_estimate, nullptr, nullptr},
      {"incompressibility", "pressures of their own near nu = 0.5", "a projection in every element",
       incompressibility_estimate, leave_out_incompressibility, insist_on_incompressibility},
      {"film_compliance", "the base yields", "the film's elements", film_compliance_estimate,
       leave_out_film, nullptr},
      {"piezo_coupling", "the film's field acts back on its strain",
       "potentials among the displacements", piezo_coupling_estimate, leave_out_piezo_coupling,
       nullptr},
      {"leakage", "charge leaves the electrode", "a time constant", leakage_estimate, nullptr,
       nullptr},
      {"crosstalk", "neighbours load the film", "the neighbours", crosstalk_estimate, nullptr,
       nullptr},
      {"three_dimensional", "a cylinder instead of a strip", "nothing: both are plane sections",
       three_dimensional_estimate, nullptr, nullptr},
      {"geometric_stiffness", "a load softens the pillar sideways",
       "the loaded state and its stress matrix", geometric_stiffness_estimate,
       leave_out_geometric_stiffness, nullptr},
      {"adhesion", "neighbours or base stick to the pillar", "a formula", adhesion_estimate,
       nullptr, nullptr},
      {"finite_strain", "stiffness changes with large strain", "a nonlinear solution",
       finite_strain_estimate, nullptr, nullptr},
      {"contact", "a shape presses on the top", "unilateral constraints", contact_estimate, nullptr,
       nullptr},
  };
  return kEffects;
}

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const Effect& effect : effects()) names.emplace_back(effect.name);
  return names;
}

bool asks_for(const Scene& scene, const std::string& result) {
  // A name stands for what is read off its curve: "reading" for "reading_end", and the other way.
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(), [&](const std::string& wanted) {
           return wanted == result || wanted.starts_with(result + "_") ||
                  result.starts_with(wanted + "_");
         });
}

}  // namespace viscard
