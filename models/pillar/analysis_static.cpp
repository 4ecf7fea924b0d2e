#include "models/pillar/analysis.h"
#include "models/pillar/piezo_one_way.h"

#include <optional>
#include <stdexcept>

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

void run_elastic(const Scene& scene, SceneAnswer& answer) {
  const PillarModel axial = model_of(scene, axial_motion(scene), answer);
  count_unknowns(axial, answer);
  const Eigen::VectorXd traction = axial.top_traction();
  const PillarState state = axial.solve(-scene.pressure_Pa * traction);
  answer.results.push_back(
      {"top_displacement", traction.dot(state.unknowns) / traction.sum(), "m"});
  add_stresses(axial, state, answer);
}

// The film's mesh with the electrode's edge.
PillarGeometry with_electrode_edge(const Scene& scene) {
  PillarGeometry geometry = scene.geometry;
  geometry.film->electrode_radius_m = scene.electrodes->electrode_radius_m;
  return geometry;
}

void run_piezoelectric(const Scene& scene, SceneAnswer& answer) {
  ModelOptions options = options_of(scene, axial_motion(scene));
  options.electrodes = scene.electrodes;
  const PillarModel coupled(scene.geometry, answer.discretisation, media_of(scene), options);
  std::optional<PillarModel> elastic;
  if (scene.one_way_potential) {
    elastic.emplace(with_electrode_edge(scene), answer.discretisation, media_of(scene),
                    options_of(scene, axial_motion(scene)));
  }
  count_unknowns(elastic ? *elastic : coupled, answer);
  if (coupled.electrode_dof() < 0) {  // charge-free face, read at its centre
    const PillarState state = elastic ? piezo_one_way_sampled(*elastic, coupled, scene.pressure_Pa)
                                      : piezo_sampled(coupled, scene.pressure_Pa);
    const bool top = scene.electrodes->grounded == FilmFace::kBottom;
    const double z_m = top ? 0.0 : -scene.geometry.film->thickness_m;
    answer.results.push_back(
        {"potential_at_centre", potential_at_V(coupled, state, 0.0, z_m), "V"});
    return;
  }
  const PiezoAnswer piezo = elastic ? piezo_one_way(*elastic, coupled, scene.pressure_Pa)
                                    : piezo_static(coupled, scene.pressure_Pa);
  answer.results = {{"electrode_voltage", piezo.voltage_V, "V"},
                    {"electrode_charge", piezo.charge_C, "C"},
                    {"electrode_capacitance", piezo.capacitance_F, "F"},
                    {"top_displacement", piezo.top_displacement_m, "m"}};
  if (!elastic) {
    answer.results.push_back({"displacement_per_volt", piezo.displacement_per_V_m, "m/V"});
  }
}

}  // namespace

void check_static(const Scene& scene) {
  if (scene.pressure_Pa == 0.0) {
    throw std::invalid_argument("a static analysis needs a pressure on the top");
  }
}

void run_static(const Scene& scene, SceneAnswer& answer) {
  scene.electrodes ? run_piezoelectric(scene, answer) : run_elastic(scene, answer);
}

}  // namespace viscard
