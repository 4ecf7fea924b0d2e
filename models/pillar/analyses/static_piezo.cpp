#include "models/pillar/analyses/static_piezo.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/piezo_one_way.h"
#include "models/pillar/body/pillar_loads.h"

#include <cmath>
#include <optional>
#include <string>

namespace viscard {
namespace {

// The film's mesh with the electrode's edge.
PillarGeometry with_electrode_edge(const PillarScene& scene) {
  PillarGeometry geometry = scene.geometry;
  geometry.film->electrode_radius_m = scene.electrodes->electrode_radius_m;
  geometry.film->electrode_is_below = scene.electrodes->grounded == FilmFace::kTop;
  return geometry;
}

// A voltage on the electrode, and the pressure if there is one (actuator). The stiffness of the
// pillar on its film is given with the electrode shorted (or driven) and open, and how a drive
// changes it by changing length and cross-section of the film under it,
//   dk/k = (d31 + d32 - d33) V/t   (eq. 25, from k = E A/L).
void add_driven(const PillarScene& scene, const PillarModel& model, SceneAnswer& answer) {
  const PiezoAnswer unit = piezo_static(model, 1.0);  // 1 Pa; of a free body only the drive counts
  const double p_Pa = pressure_Pa(scene);
  const double V = drive_V(scene);
  const double short_m_Pa = shorted_displacement_m(unit);
  const double force_N_Pa = top_area_m2(model);
  const PiezoMatrix& d = scene.film_charge_C_N;
  answer.results = {{"electrode_voltage", V, "V"},
                    {"electrode_charge", unit.charge_C * p_Pa + unit.capacitance_F * V, "C"},
                    {"electrode_capacitance", unit.capacitance_F, "F"},
                    {"top_displacement", short_m_Pa * p_Pa + unit.displacement_per_V_m * V, "m"},
                    {"displacement_per_volt", unit.displacement_per_V_m, "m/V"},
                    {"stiffness_driven", -force_N_Pa / short_m_Pa, "N/m"},
                    {"stiffness_open", -force_N_Pa / unit.top_displacement_m, "N/m"},
                    {"film_stiffness_change_by_drive",
                     (d(2, 0) + d(2, 1) - d(2, 2)) * V / scene.geometry.film->thickness_m, "1"}};
  // Nothing holds a free body against a force whose share of the deflection would be its stiffness.
  if (scene.fixed_bottom) return;
  std::erase_if(answer.results,
                [](const SceneResult& result) { return result.name.starts_with("stiffness"); });
}

// The potential of a charge-free face, from the state under 1 Pa.
void add_sampled(const PillarScene& scene, const PillarModel& coupled, const PillarState& per_Pa,
                 SceneAnswer& answer) {
  const Eigen::VectorXd traction = coupled.top_traction();
  const double moved_m = traction.dot(per_Pa.unknowns) / traction.sum();
  const double pressure_Pa = top_pressure_Pa(scene, moved_m);
  const bool top = scene.electrodes->grounded == FilmFace::kBottom;
  const double z_m = top ? 0.0 : -scene.geometry.film->thickness_m;
  const double R_m = coupled.radius_m();
  answer.results = {
      {"potential_at_centre", pressure_Pa * potential_at_V(coupled, per_Pa, 0.0, z_m), "V"},
      {"potential_mean", pressure_Pa * mean_potential_V(coupled, per_Pa, z_m, R_m), "V"}};
  if (!moves_top(scene)) return;
  add_top_force(scene, -pressure_Pa * traction.sum(), -traction.sum() / moved_m, answer);
}

}  // namespace

void run_static_piezo(const PillarScene& scene, SceneAnswer& answer) {
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
    const PillarState state =
        elastic ? piezo_one_way_sampled(*elastic, coupled, 1.0) : piezo_sampled(coupled, 1.0);
    return add_sampled(scene, coupled, state, answer);
  }
  if (moves_top(scene)) {
    const PiezoAnswer unit =
        elastic ? piezo_one_way(*elastic, coupled, 1.0) : piezo_static(coupled, 1.0);
    return add_moved_piezoelectric(scene, coupled, unit, answer);
  }
  if (drive_V(scene) != 0.0) return add_driven(scene, coupled, answer);
  const PiezoAnswer piezo = elastic ? piezo_one_way(*elastic, coupled, pressure_Pa(scene))
                                    : piezo_static(coupled, pressure_Pa(scene));
  answer.results = {{"electrode_voltage", piezo.voltage_V, "V"},
                    {"electrode_charge", piezo.charge_C, "C"},
                    {"electrode_capacitance", piezo.capacitance_F, "F"},
                    {"top_displacement", piezo.top_displacement_m, "m"}};
  if (!elastic) {
    answer.results.push_back({"displacement_per_volt", piezo.displacement_per_V_m, "m/V"});
  }
  if (!scene.readout) return;
  const ReadoutFilter filter = readout_filter(*scene.readout, piezo.capacitance_F);
  answer.results.push_back({"reading_at_once", filter.gain * piezo.voltage_V, "V"});
  if (std::isfinite(filter.time_constant_s)) {
    answer.results.push_back({"readout_time_constant", filter.time_constant_s, "s"});
  }
}

}  // namespace viscard
