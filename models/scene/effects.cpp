#include "models/scene/effects.h"

#include "models/scene/scene_effects.h"

namespace viscard {
namespace {

using Pillar = EffectOn<PillarScene>;
using Row = EffectOn<ArrayScene>;
using Space = EffectOn<SpaceScene>;  // an array in the plane

// An effect that only single pillars have.
const Row kOfPillars = {absent<"computed of single pillars">};
const Space kOfPillarsInSpace = {absent<"computed of single pillars">};

// How the material answers a load.
std::vector<Effect> material_effects() {
  return {
      {"relaxation",
       "moduli fall with time",
       "a vector per term, and time steps",
       {Pillar{relaxation_estimate, [](PillarScene& scene) { scene.pillar.terms.clear(); }},
        Row{relaxation_estimate}, Space{relaxation_estimate, leave_out_relaxation}}},
      {"inertia",
       "mass resists",
       "a mass matrix",
       {Pillar{inertia_estimate}, Row{inertia_estimate}, Space{absent<"the load is at rest">}}},
      {"incompressibility",
       "pressures of their own near nu = 0.5",
       "a projection in every element",
       {Pillar{incompressibility_estimate,
               [](PillarScene& scene) { scene.condense_pressures_from = 0.5; },
               [](PillarScene& scene) { scene.condense_pressures_from = -1.0; }},
        Row{incompressibility_estimate}, Space{incompressibility_estimate}},
       true},
  };
}

// What the base and its film add.
std::vector<Effect> base_effects() {
  return {
      {"film_compliance",
       "the base yields",
       "the film's elements",
       {Pillar{film_compliance_estimate, leave_out_film},
        Row{film_compliance_estimate, [](ArrayScene& scene) { scene.feels_film = false; }},
        Space{film_compliance_estimate}}},
      {"piezo_coupling",
       "the film's field acts back on its strain",
       "potentials among the displacements",
       {Pillar{piezo_coupling_estimate, leave_out_piezo_coupling},
        Row{piezo_coupling_estimate, leave_out_piezo_coupling}, Space{piezo_coupling_estimate}}},
      {"backing",
       "what lies under the film yields",
       "a table to all distances, sums by FFT",
       {Pillar{absent<"the base is rigid">}, Row{absent<"the base is rigid">},
        Space{backing_estimate, [](SpaceScene& scene) { scene.feels_backing = false; }}}},
      {"leakage",
       "charge leaves the electrode",
       "a time constant",
       {Pillar{leakage_estimate}, Row{absent<"open electrodes, before charge leaks">},
        Space{leakage_estimate}}},
  };
}

// What stands around a pillar, and the pillar's shape.
std::vector<Effect> neighbour_effects() {
  return {
      {"crosstalk",
       "neighbours load the film",
       "the neighbours",
       {Pillar{absent<"a single pillar">},
        Row{crosstalk_estimate, [](ArrayScene& scene) { scene.feels_neighbours = false; }},
        Space{crosstalk_estimate, [](SpaceScene& scene) { scene.feels_neighbours = false; }}}},
      {"three_dimensional",
       "a cylinder instead of a strip",
       "nothing: both are plane sections",
       {Pillar{three_dimensional_estimate},
        Row{absent<"rows are solved in the plane: strips, not cylinders">},
        Space{[](const SpaceScene&) -> EffectEstimate {
          return {EffectRole::kNeeded, 1.0, "", 0.0, "cylinders with neighbours on all sides"};
        }}}},
  };
}

// What a large load, or a shape that presses, adds.
std::vector<Effect> load_effects() {
  return {
      {"geometric_stiffness",
       "a load softens the pillar sideways",
       "the loaded state and its stress matrix",
       {Pillar{geometric_stiffness_estimate, leave_out_geometric_stiffness},
        Row{geometric_stiffness_estimate}, Space{geometric_stiffness_estimate}}},
      {"adhesion",
       "neighbours or base stick to the pillar",
       "a formula",
       {Pillar{absent<"one pillar with nothing to stick to">}, Row{adhesion_estimate},
        Space{adhesion_estimate}}},
      {"finite_strain",
       "stiffness changes with large strain",
       "a nonlinear solution",
       {Pillar{finite_strain_estimate, leave_out_finite_strain}, Row{finite_strain_estimate},
        Space{finite_strain_estimate}}},
      {"contact",
       "a shape presses on the top",
       "unilateral constraints",
       {Pillar{absent<"no shape presses on the pillar">},
        Row{contact_estimate, [](ArrayScene& scene) { scene.feels_contact = false; }},
        Space{contact_estimate, [](SpaceScene& scene) { scene.feels_contact = false; }}}},
      {"pull_off",
       "the shape holds tops until they let go",
       "the depths that it went through",
       {Pillar{absent<"no shape presses on the pillar">},
        Row{pull_off_estimate, leave_out_pull_off<ArrayScene>},
        Space{pull_off_estimate, leave_out_pull_off<SpaceScene>}}},
  };
}

template <typename Body>
EffectEstimate temperature_of(const Body& scene) {
  EffectEstimate inertia;
  if constexpr (!std::is_same_v<Body, SpaceScene>) inertia = inertia_estimate(scene);
  return temperature_estimate(scene, relaxation_estimate(scene), inertia);
}

template <typename Body>
void without_temperature(Body& scene) {
  leave_out_temperature(scene);
}

// What the scene stands in.
std::vector<Effect> surroundings_effects() {
  return {
      {"temperature",
       "relaxation times shift with it",
       "nothing",
       {Pillar{temperature_of<PillarScene>, without_temperature<PillarScene>},
        Row{temperature_of<ArrayScene>, without_temperature<ArrayScene>},
        Space{temperature_of<SpaceScene>, without_temperature<SpaceScene>}}},
      {"thermal_strain",
       "pillar and film expand, and the film gives charge",
       "a solution",
       {Pillar{thermal_strain_estimate, leave_out_thermal_strain}, kOfPillars, kOfPillarsInSpace}},
      {"weight",
       "the pillar presses on its foot",
       "a solution",
       {Pillar{weight_estimate, [](PillarScene& scene) { scene.surroundings.gravity_m_s2 = 0.0; }},
        kOfPillars, kOfPillarsInSpace}},
      {"air_damping",
       "air moves with the pillar",
       "a formula",
       {Pillar{air_damping_estimate, [](PillarScene& scene) { scene.surroundings.air = false; }},
        kOfPillars, kOfPillarsInSpace}},
  };
}

// What the film loses; behind all others, because lists of effects keep their order.
std::vector<Effect> film_effects() {
  return {
      {"dielectric_loss",
       "the film leaks, and its polarisation follows late",
       "a term of the reading for each of the film",
       {Pillar{dielectric_loss_estimate, [](PillarScene& scene) { scene.film_loss = {}; }},
        Row{dielectric_loss_estimate, [](ArrayScene& scene) { scene.film_loss = {}; }},
        Space{dielectric_loss_estimate, [](SpaceScene& scene) { scene.film_loss = {}; }}}},
  };
}

}  // namespace

const std::vector<Effect>& effects() {
  static const std::vector<Effect> kEffects = [] {
    std::vector<Effect> all;
    for (const auto& group : {material_effects(), base_effects(), neighbour_effects(),
                              load_effects(), surroundings_effects(), film_effects()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kEffects;
}

}  // namespace viscard
