#include "models/pillar/analysis.h"
#include "models/pillar/piezo_quadrants.h"
#include "models/pillar/pillar_loads.h"
#include "models/pillar/scene_mistake.h"

namespace viscard {

bool is_sideways(const Scene& scene) {
  return scene.kind == AnalysisKind::kStatic && scene.direction == LoadDirection::kLateral;
}

// A shear on the top, along x, and a voltage on the quadrants' opposite halves.
PillarModel sideways_model(const Scene& scene, const SceneAnswer& on_mesh) {
  ModelOptions options =
      options_of(scene, scene.plane ? Motion::kPlaneAntisymmetric : Motion::kLateral);
  options.electrodes = scene.electrodes;
  return PillarModel(scene.geometry, on_mesh.discretisation, media_of(scene), options);
}

PillarState sideways_state(const Scene& scene, const PillarModel& model) {
  const double force_N = scene.pressure_Pa * top_area_m2(model);
  if (model.electrode_dof() >= 0) return piezo_quadrants(model, force_N).shorted;
  return model.solve(force_N * unit_top_force(model));
}

void check_sideways(const Scene& scene) {
  if (!scene.electrodes) return;
  if (!scene.electrodes->quadrants) {
    throw SceneMistake("geometry.electrode",
                       "a round electrode reads nothing of a sideways load; add quadrants = true");
  }
  if (scene.plane && scene.electrodes->electrode_radius_m > 0.0) {
    throw SceneMistake("geometry.electrode.kind",
                       "halves of a strip touch where their voltages jump; say \"sampled\"");
  }
  if (scene.readout) {
    throw SceneMistake("readout", "reads round electrodes under axial loads only");
  }
}

void run_sideways(const Scene& scene, SceneAnswer& answer) {
  const PillarModel model = sideways_model(scene, answer);
  count_unknowns(model, answer);
  const double force_N = scene.pressure_Pa * top_area_m2(model);
  if (model.electrode_dof() >= 0) {
    const QuadrantAnswer quadrants = piezo_quadrants(model, force_N);
    const double moved_m = quadrants.displacement_per_V_m * scene.drive_V;
    answer.results = {{"top_displacement", quadrants.top_displacement_m + moved_m, "m"},
                      {"displacement_per_volt", quadrants.displacement_per_V_m, "m/V"}};
    // Under a drive the charge of touching quadrants has no bound.
    if (scene.drive_V == 0.0) {
      answer.results.push_back({"quadrant_charge", quadrants.charge_C, "C"});
    }
    return;
  }
  const PillarState state = model.solve(force_N * unit_top_force(model));
  answer.results.push_back({"top_displacement", unit_top_force(model).dot(state.unknowns), "m"});
  if (!scene.electrodes) return;
  const bool top = scene.electrodes->grounded == FilmFace::kBottom;
  const double z_m = top ? 0.0 : -scene.geometry.film->thickness_m;
  answer.results.push_back(
      {"quadrant_voltage", quadrant_mean_V(model, state, z_m, model.radius_m()), "V"});
}

}  // namespace viscard
