#include "models/answer/scene_mistake.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/body/solution_rest.h"

namespace viscard {
namespace {

// Force along x: that of the given shear, or the one that produces the given displacement of the
// top.
double side_force_N(const PillarScene& scene, const PillarModel& model, double displacement_per_N_m,
                    double moved_by_voltage_m = 0.0) {
  const double area_m2 = top_area_m2(model);
  return area_m2 * top_pressure_Pa(scene, area_m2 * displacement_per_N_m, moved_by_voltage_m);
}

// Errors that the solution under the force itself shows.
void note_unresolved_sideways(double of_displacement, double of_charge, SceneAnswer& answer) {
  for (SceneResult& result : answer.results) {
    const bool is_of_charge =
        result.name == "displacement_per_volt" || result.name == "quadrant_charge";
    result.unresolved = is_of_charge ? of_charge : of_displacement;
  }
}

void add_quadrants(const PillarScene& scene, const PillarModel& model, SceneAnswer& answer) {
  // With a free bottom a force on the top has no static answer.
  const QuadrantAnswer unit = piezo_quadrants(model, scene.fixed_bottom ? 1.0 : 0.0);
  const double by_voltage_m = unit.displacement_per_V_m * drive_V(scene);
  const double force_N = side_force_N(scene, model, unit.top_displacement_m, by_voltage_m);
  if (moves_top(scene)) {
    add_top_force(scene, force_N, 1.0 / unit.top_displacement_m, answer);
  } else {
    const double moved_m = force_N * unit.top_displacement_m + by_voltage_m;
    answer.results.push_back({"top_displacement", moved_m, "m"});
  }
  answer.results.push_back({"displacement_per_volt", unit.displacement_per_V_m, "m/V"});
  // If the electrode is driven, the charge of touching quadrants is unbounded.
  if (drive_V(scene) == 0.0) {
    answer.results.push_back({"quadrant_charge", force_N * unit.charge_C, "C"});
  }
  note_unresolved_sideways(unit.rest.displacement, unit.rest.charge, answer);
}

PillarState sideways_state(const PillarScene& scene, const PillarModel& model) {
  if (model.electrode_dof() >= 0) {
    const QuadrantAnswer unit = piezo_quadrants(model, scene.fixed_bottom ? 1.0 : 0.0);
    const double by_voltage_m = unit.displacement_per_V_m * drive_V(scene);
    PillarState state =
        side_force_N(scene, model, unit.top_displacement_m, by_voltage_m) * unit.shorted;
    state.unknowns += drive_V(scene) * unit.driven_per_V.unknowns;
    state.pressure_source += drive_V(scene) * unit.driven_per_V.pressure_source;
    return state;
  }
  const Eigen::VectorXd push = unit_top_force(model);
  const PillarState unit = model.solve(push);
  return side_force_N(scene, model, push.dot(unit.unknowns)) * unit;
}

void refuse_round_electrode() {
  throw SceneMistake("geometry.electrode",
                     "a round electrode reads nothing of a sideways load; add quadrants = true");
}

void check_quadrants(const PillarScene& scene) {
  if (scene.plane && scene.electrodes->electrode_radius_m > 0.0) {
    throw SceneMistake("geometry.electrode.kind",
                       "the halves of a strip touch, and a voltage cannot jump there; use kind = "
                       "\"sampled\"");
  }
  if (!scene.readout || scene.readout->kind == ReadoutKind::kCharge) return;
  throw SceneMistake(
      "readout.kind",
      "a quadrant has no voltage of its own here: between touching quadrants of different voltage "
      "the field and the capacitance are unbounded. Use kind = \"charge\", an amplifier that holds "
      "every quadrant at ground, or a charge-free face (electrode kind = \"sampled\")");
}

}  // namespace

void check_sideways(const PillarScene& scene) {
  if (!scene.electrodes) return;
  if (!scene.electrodes->quadrants) refuse_round_electrode();
  check_quadrants(scene);
  if (scene.readout) {
    throw SceneMistake("readout",
                       "a readout of a sideways load needs a harmonic or transient analysis");
  }
}

void check_sideways_in_time(const PillarScene& scene) {
  if (!is_lateral(scene) || !scene.electrodes) return;
  if (scene.electrodes->quadrants) return check_quadrants(scene);
  if (scene.readout) refuse_round_electrode();
}

void run_sideways(const PillarScene& scene, SceneAnswer& answer) {
  const PillarModel model = electric_model_of(scene, lateral_motion(scene), answer.discretisation);
  count_unknowns(model, answer);
  if (model.electrode_dof() >= 0) return add_quadrants(scene, model, answer);
  const Eigen::VectorXd push = unit_top_force(model);
  const PillarState unit = model.solve(push);
  const double moved_m = push.dot(unit.unknowns);
  const double force_N = side_force_N(scene, model, moved_m);
  if (moves_top(scene)) {
    add_top_force(scene, force_N, 1.0 / moved_m, answer);
  } else {
    answer.results.push_back({"top_displacement", force_N * moved_m, "m"});
  }
  if (scene.nearby == nullptr) {
    const SolutionRest rest(model, unit.unknowns);
    note_unresolved_sideways(missing_share(rest, rest, moved_m), 0.0, answer);
  }
  if (!scene.electrodes) return;
  const double mean_V = quadrant_mean_V(model, unit, free_face_m(scene), model.radius_m());
  answer.results.push_back({"quadrant_voltage", force_N * mean_V, "V"});
}

std::vector<SectionGrid> sideways_fields(const PillarScene& scene, const Discretisation& mesh) {
  const PillarModel model = electric_model_of(scene, lateral_motion(scene), mesh);
  const PillarState state = sideways_state(scene, model);
  Sampling at = sampling_of(model);
  at.grid.name = "static";
  at.grid.harmonic = 1;
  at.grid.fields.push_back(displacement_field(model, at, "displacement_m", state.unknowns));
  if (scene.electrodes) at.grid.fields.push_back(potential_field(model, at, state));
  return {at.grid};
}

}  // namespace viscard
