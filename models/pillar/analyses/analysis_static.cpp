#include "models/answer/scene_mistake.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/large_strain.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/body/solution_rest.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

void add_stresses(const PillarModel& model, const PillarState& state, SceneAnswer& answer) {
  const double R = model.radius_m();
  answer.results.push_back(
      {"base_stress_at_half_radius",
       model.stress_at(state, model.element_at(0.5 * R, 0.0, kPillarRegion), 0.5 * R, 0.0)[2],
       "Pa"});
  if (!model.geometry().film) return;
  const double bottom_m = -model.geometry().film->thickness_m;
  answer.results.push_back(
      {"film_bottom_stress_mean", model.mean_stress(state, 2, bottom_m, kFilmRegion, R), "Pa"});
}

// Mean axial stress at the pillar's base over the ring from 0.9 R to R. The stress itself grows
// without bound toward the rim (rho^(lambda - 1) at a clamped corner; Williams, J. Appl. Mech. 19
// (1952) 526), but its mean over any ring is finite.
double rim_mean_Pa(const PillarModel& model, const PillarState& state) {
  const double R_m = model.radius_m();
  const double inner_m = 0.9 * R_m;
  const bool is_round = model.system().kinematics().x_power == 1;
  const std::vector<double>& breaks = model.mesh().section.x().breaks();
  static const QuadratureRule rule = gauss_legendre(12);
  double sum = 0.0;
  double area = 0.0;
  for (int column = 0; column < model.mesh().pillar_columns; ++column) {
    const auto c = static_cast<std::size_t>(column);
    const double from_m = std::max(breaks[c], inner_m);
    const double length_m = breaks[c + 1] - from_m;
    if (!(length_m > 1e-9 * R_m)) continue;
    const SectionElement& element = model.element_at(from_m + 0.5 * length_m, 0.0, kPillarRegion);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const double x_m = from_m + length_m * rule.points[i];
      const double weight = rule.weights[i] * length_m * (is_round ? x_m : 1.0);
      sum += weight * model.stress_at(state, element, x_m, 0.0)[2];
      area += weight;
    }
  }
  return sum / area;
}

void run_elastic(const PillarScene& scene, SceneAnswer& answer) {
  const PillarModel axial = model_of(scene, axial_motion(scene), answer.discretisation);
  count_unknowns(axial, answer);
  const Eigen::VectorXd traction = axial.top_traction();
  // A body that nothing holds bears no load, and moves by heat alone.
  const PillarState per_Pa =
      scene.fixed_bottom ? axial.solve(-traction) : 0.0 * unloaded_state(scene, axial);
  const double moved_m = axial.mean_top_displacement_m(per_Pa);
  const bool has_more = moves_unloaded(scene);
  const PillarState unloaded = has_more ? unloaded_state(scene, axial) : 0.0 * per_Pa;
  const double moved_unloaded_m = axial.mean_top_displacement_m(unloaded);
  const double pressure_Pa = top_pressure_Pa(scene, moved_m, moved_unloaded_m);
  const PillarState state = pressure_Pa * per_Pa + unloaded;
  if (moves_top(scene)) {
    add_top_force(scene, -pressure_Pa * traction.sum(), -traction.sum() / moved_m, answer);
  } else {
    answer.results.push_back({"top_displacement", moved_m * pressure_Pa + moved_unloaded_m, "m"});
  }
  if (scene.nearby == nullptr && scene.fixed_bottom) {
    const SolutionRest rest(axial, per_Pa.unknowns);
    const double unresolved = missing_share(rest, rest, traction.dot(per_Pa.unknowns));
    for (SceneResult& result : answer.results) result.unresolved = unresolved;
  }
  add_stresses(axial, state, answer);
  if (scene.rubber) {  // by equilibrium
    const double bond_m = bond_radius_m(scene.geometry);
    answer.results.push_back({"base_stress_mean",
                              -pressure_Pa * traction.sum() / (std::numbers::pi * bond_m * bond_m),
                              "Pa"});
  }
  // Converges slowly: only if asked for by name.
  if (!scene.wanted.empty() && asks_for(scene, "base_stress_rim_mean")) {
    answer.results.push_back({"base_stress_rim_mean", rim_mean_Pa(axial, state), "Pa"});
  }
}

void check_displacement(const PillarScene& scene) {
  if (!displacement_m(scene)) return;
  if (pressure_Pa(scene) != 0.0) {
    throw SceneMistake("analysis.load", "give the top a pressure or a displacement, not both");
  }
  const double size_m = std::abs(*displacement_m(scene));
  if (!(size_m < scene.geometry.length_m)) {
    throw SceneMistake("analysis.load.displacement",
                       "a displacement of " + micrometres(size_m) +
                           " is no smaller than the pillar's length of " +
                           micrometres(scene.geometry.length_m));
  }
}

void check_heat(const PillarScene& scene) {
  if (!scene.surroundings.strains_by_heat()) return;
  if (scene.plane == PlaneState::kStress) {
    throw SceneMistake("surroundings.made_at",
                       "expansion by heat is answered for cylinders and in plane strain");
  }
  if (scene.pillar.nu == 0.5) {
    throw SceneMistake("surroundings.made_at",
                       "an incompressible pillar cannot expand by heat where it is held; the "
                       "pillar's nu must lie below 0.5, such as 0.4999");
  }
}

void check_static(const PillarScene& scene) {
  const bool is_held = displacement_m(scene) == 0.0;
  const bool is_loaded =
      drive_V(scene) != 0.0 || pressure_Pa(scene) != 0.0 || (displacement_m(scene) && !is_held);
  if (!is_loaded && (is_lateral(scene) || !moves_unloaded(scene))) {
    throw SceneMistake("analysis.load",
                       "a static analysis needs a pressure on the top, a displacement of it or a "
                       "voltage");
  }
  check_heat(scene);
  if (!scene.fixed_bottom && scene.surroundings.gravity_m_s2 != 0.0) {
    throw SceneMistake("surroundings.gravity", "nothing holds the free bottom against the weight");
  }
  check_displacement(scene);
  if (drive_V(scene) != 0.0 &&
      (!scene.electrodes || !(scene.electrodes->electrode_radius_m > 0.0))) {
    throw SceneMistake("analysis.load.voltage", "needs an electrode with a radius to drive");
  }
  if (!std::isfinite(drive_V(scene))) {
    throw SceneMistake("analysis.load.voltage", "the voltage is not finite");
  }
  if (is_lateral(scene)) check_sideways(scene);
}

void run_static(const PillarScene& scene, SceneAnswer& answer) {
  if (is_lateral(scene)) return run_sideways(scene, answer);
  if (is_large(scene)) return run_large(scene, answer);
  scene.electrodes ? run_static_piezo(scene, answer) : run_elastic(scene, answer);
}

using Names = std::vector<std::string>;

void append(Names& names, const Names& more) {
  names.insert(names.end(), more.begin(), more.end());
}

Names sideways_names(const PillarScene& scene, Names names) {
  if (!scene.electrodes) return names;
  if (scene.electrodes->electrode_radius_m == 0.0) {
    names.emplace_back("quadrant_voltage");
    return names;
  }
  names.emplace_back("displacement_per_volt");
  if (drive_V(scene) == 0.0) names.emplace_back("quadrant_charge");
  return names;
}

// The top's motion, or the force for a given motion.
Names static_names(const PillarScene& scene) {
  const bool is_moved = moves_top(scene);
  const Names top = is_moved ? Names{"top_force", "top_stiffness"} : Names{"top_displacement"};
  if (is_lateral(scene)) return sideways_names(scene, top);
  if (!scene.electrodes) {
    Names names = top;
    append(names, {"base_stress_at_half_radius", "base_stress_rim_mean"});
    if (scene.rubber) names.emplace_back("base_stress_mean");
    if (scene.film) names.emplace_back("film_bottom_stress_mean");
    return names;
  }
  if (scene.electrodes->electrode_radius_m == 0.0) {
    Names names = {"potential_at_centre", "potential_mean"};
    if (is_moved) append(names, top);
    return names;
  }
  Names names = {"electrode_voltage", "electrode_charge", "electrode_capacitance"};
  append(names, top);
  if (!is_moved) names.emplace_back("displacement_per_volt");
  if (drive_V(scene) == 0.0) {
    if (scene.readout) append(names, {"reading_at_once", "readout_time_constant"});
  } else if (!is_moved) {
    if (scene.fixed_bottom) append(names, {"stiffness_driven", "stiffness_open"});
    names.emplace_back("film_stiffness_change_by_drive");
  }
  return names;
}

PillarState static_state(const PillarScene& scene, const PillarModel& model) {
  const Eigen::VectorXd traction = model.top_traction();
  PiezoAnswer unit, unloaded;  // 1 Pa, and weight and heat without a load
  const bool has_more = moves_unloaded(scene);
  if (model.electrode_dof() < 0) {
    unit.open = model.solve(-traction);
    unit.top_displacement_m = model.mean_top_displacement_m(unit.open);
  } else {
    unit = piezo_static(model, 1.0);
  }
  if (has_more) unloaded = unloaded_answer(scene, model, unit);
  const double pressure_Pa = top_pressure_Pa(scene, unit, unloaded);
  if (drive_V(scene) == 0.0) {
    return has_more ? pressure_Pa * unit.open + unloaded.open : pressure_Pa * unit.open;
  }
  // The charge that brings the electrode to the voltage, in addition to that of the pressure.
  Eigen::VectorXd forces = -pressure_Pa * traction;
  if (has_more) forces += unloaded_force(scene, model);
  const double charge_C =
      unit.charge_C * pressure_Pa + unit.capacitance_F * drive_V(scene) + unloaded.charge_C;
  forces[model.electrode_dof()] -= charge_C * model.potential_scale_V();
  PillarState state = model.solve(forces);
  state.heat = has_more ? 1.0 : 0.0;
  return state;
}

std::vector<SectionGrid> static_fields(const PillarScene& scene, const Discretisation& mesh) {
  if (is_lateral(scene)) return sideways_fields(scene, mesh);
  if (is_large(scene)) return large_fields(scene, mesh);
  const PillarModel model = electric_model_of(scene, axial_motion(scene), mesh);
  const PillarState state = static_state(scene, model);
  Sampling at = sampling_of(model);
  at.grid.name = "static";
  at.grid.fields.push_back(displacement_field(model, at, "displacement_m", state.unknowns));
  at.grid.fields.push_back(stress_field(model, at, state));
  if (scene.electrodes) at.grid.fields.push_back(potential_field(model, at, state));
  return {at.grid};
}

NearbyPillars static_nearby(const PillarScene& scene, const Discretisation& mesh) {
  NearbyPillars nearby;
  if (is_large(scene) || moves_unloaded(scene)) return nearby;
  if (is_lateral(scene)) {
    nearby.push_back(nearby_electric_model_of(scene, lateral_motion(scene), mesh));
  } else if (!scene.electrodes) {
    nearby.push_back(nearby_model_of(scene, axial_motion(scene), mesh));
  } else if (!scene.one_way_potential) {
    nearby.push_back(nearby_electric_model_of(scene, axial_motion(scene), mesh));
  }
  for (const auto& one : nearby) one->solve();
  return nearby;
}

// Change of the stress at half the radius over E_pillar/E_film times min(1, t/R); the factor is the
// largest seen over random scenes.
constexpr double kStressShare = 2.0;

EffectEstimate static_film_compliance(const PillarScene& scene, const EffectEstimate&) {
  const FilmShares shares = film_shares(scene);
  // A force at the end turns the foot by F L c: 3 E I c/L of the beam's F L^3/(3 E I).
  if (is_lateral(scene)) {
    const double share = 3.0 * shares.bending + shares.shear;
    return {EffectRole::kOptional, kUnevenTraction * share, "3 E I/(k L)", 3.0 * shares.bending,
            "the base turns and slides under the bent pillar"};
  }
  if (!scene.electrodes && asks_for(scene, "film_bottom_stress_mean")) {
    return {EffectRole::kNeeded, 1.0, "E A/(k L)", shares.axial, "its own stress is asked for"};
  }
  double error = kUnevenTraction * shares.axial;
  if (asks_for(scene, "base_stress_at_half_radius")) {
    const double R = 0.5 * scene.geometry.diameter_m;
    const double thin = std::min(1.0, scene.geometry.film->thickness_m / R);
    const double stress_error =
        kStressShare * thin * scene.pillar.E0_Pa / elasticity_of(*scene.film).young_Pa;
    // If the top is moved, its force changes too.
    error = moves_top(scene) ? error + stress_error : std::max(error, stress_error);
  }
  return {EffectRole::kOptional, error, "E A/(k L)", shares.axial,
          "the film's deflection over the pillar's"};
}

const char* static_why_two_way(const PillarScene& scene) {
  if (is_lateral(scene)) return "quadrants are answered both ways";
  if (drive_V(scene) != 0.0) return "the film is driven by a voltage";
  if (moves_unloaded(scene)) return "weight and heat are answered both ways";
  if (!asks_for(scene, "displacement_per_volt")) return nullptr;
  return scene.wanted.empty() ? "without a [want] everything is asked for, the motion per volt too"
                              : "the motion per volt is asked for";
}

// What models/pillar/large does not compute.
const char* static_why_small_strain(const PillarScene& scene) {
  const auto wants = [&](const char* name) {
    return !scene.wanted.empty() && asks_for(scene, name);
  };
  if (is_lateral(scene)) return "only loads along the axis are answered at large strain";
  if (scene.plane) return "only round pillars are answered at large strain";
  if (!scene.fixed_bottom) return "a free bottom is answered at small strain";
  if (drive_V(scene) != 0.0) return "a driven film is answered at small strain";
  if (scene.directional_film) return "a film with a direction is answered at small strain";
  if (wants("displacement_per_volt")) return "the motion per volt is that of small strain";
  if (wants("base_stress_rim_mean")) return "the stress at the rim is that of small strain";
  return nullptr;
}

}  // namespace

Analysis static_analysis() {
  return {.name = "static",
          .drive = StaticDrive{},
          .load_stays = true,
          .free_bottom = FreeBottom::kPinned,
          .check = check_static,
          .result_names = static_names,
          .run = run_static,
          .push_Pa = pressure_Pa,
          .fields = static_fields,
          .solve_nearby = static_nearby,
          .why_two_way = static_why_two_way,
          .why_small_strain = static_why_small_strain,
          .film_compliance = static_film_compliance};
}

}  // namespace viscard
