#include "models/scene/effects.h"

#include "models/scene/pillar_effects.h"
#include "models/scene/row_effects.h"

namespace viscard {
namespace {

using Pillar = EffectOn<PillarScene>;
using Row = EffectOn<ArrayScene>;

}  // namespace

const std::vector<Effect>& effects() {
  static const std::vector<Effect> kEffects = {
      {"relaxation",
       "moduli fall with time",
       "a vector per term, and time steps",
       {Pillar{relaxation_estimate, leave_out_relaxation}, Row{relaxation_estimate}}},
      {"inertia",
       "mass resists",
       "a mass matrix",
       {Pillar{inertia_estimate}, Row{inertia_estimate}}},
      {"incompressibility",
       "pressures of their own near nu = 0.5",
       "a projection in every element",
       {Pillar{incompressibility_estimate, leave_out_incompressibility,
               insist_on_incompressibility},
        Row{incompressibility_estimate}},
       true},
      {"film_compliance",
       "the base yields",
       "the film's elements",
       {Pillar{film_compliance_estimate, leave_out_film},
        Row{film_compliance_estimate, leave_out_film}}},
      {"piezo_coupling",
       "the film's field acts back on its strain",
       "potentials among the displacements",
       {Pillar{piezo_coupling_estimate, leave_out_piezo_coupling},
        Row{piezo_coupling_estimate, leave_out_piezo_coupling}}},
      {"leakage",
       "charge leaves the electrode",
       "a time constant",
       {Pillar{leakage_estimate}, Row{leakage_estimate}}},
      {"crosstalk",
       "neighbours load the film",
       "the neighbours",
       {Pillar{crosstalk_estimate}, Row{crosstalk_estimate, leave_out_crosstalk}}},
      {"three_dimensional",
       "a cylinder instead of a strip",
       "nothing: both are plane sections",
       {Pillar{three_dimensional_estimate}, Row{three_dimensional_estimate}}},
      {"geometric_stiffness",
       "a load softens the pillar sideways",
       "the loaded state and its stress matrix",
       {Pillar{geometric_stiffness_estimate, leave_out_geometric_stiffness},
        Row{geometric_stiffness_estimate}}},
      {"adhesion",
       "neighbours or base stick to the pillar",
       "a formula",
       {Pillar{adhesion_estimate}, Row{adhesion_estimate}}},
      {"finite_strain",
       "stiffness changes with large strain",
       "a nonlinear solution",
       {Pillar{finite_strain_estimate}, Row{finite_strain_estimate}}},
      {"contact",
       "a shape presses on the top",
       "unilateral constraints",
       {Pillar{contact_estimate}, Row{contact_estimate}}},
  };
  return kEffects;
}

}  // namespace viscard
