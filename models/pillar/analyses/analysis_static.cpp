#include "models/maths/gauss_legendre.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/piezo_one_way.h"
#include "models/pillar/body/pillar_loads.h"
#include "models/pillar/mesh/number_text.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <cmath>
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

bool names(const Scene& scene, const char* result) {
  return std::find(scene.wanted.begin(), scene.wanted.end(), result) != scene.wanted.end();
}

void run_elastic(const Scene& scene, SceneAnswer& answer) {
  const PillarModel axial = model_of(scene, axial_motion(scene), answer);
  count_unknowns(axial, answer);
  const Eigen::VectorXd traction = axial.top_traction();
  PillarState state = axial.solve(-traction);  // 1 Pa
  const double moved_m = traction.dot(state.unknowns) / traction.sum();
  const double pressure_Pa = top_pressure_Pa(scene, moved_m);
  state.unknowns *= pressure_Pa;
  state.pressure_source *= pressure_Pa;
  if (moves_top(scene)) {
    add_top_force(scene, -pressure_Pa * traction.sum(), -traction.sum() / moved_m, answer);
  } else {
    answer.results.push_back({"top_displacement", moved_m * pressure_Pa, "m"});
  }
  add_stresses(axial, state, answer);
  if (names(scene, "base_stress_rim_mean")) {  // converges slowly: only for who asks for it
    answer.results.push_back({"base_stress_rim_mean", rim_mean_Pa(axial, state), "Pa"});
  }
}

// The film's mesh with the electrode's edge.
PillarGeometry with_electrode_edge(const Scene& scene) {
  PillarGeometry geometry = scene.geometry;
  geometry.film->electrode_radius_m = scene.electrodes->electrode_radius_m;
  geometry.film->electrode_is_below = scene.electrodes->grounded == FilmFace::kTop;
  return geometry;
}

// A voltage on the electrode, and the pressure if there is one (actuator). The stiffness of the
// pillar on its film is told with the electrode shorted (or driven) and open, and how a drive
// changes it by changing length and cross-section of the film under it,
//   dk/k = (d31 + d32 - d33) V/t   (eq. 25, from k = E A/L).
void add_driven(const Scene& scene, const PillarModel& model, SceneAnswer& answer) {
  const PiezoAnswer unit = piezo_static(model, 1.0);  // 1 Pa; of a free body only the drive counts
  const double p_Pa = scene.pressure_Pa;
  const double V = scene.drive_V;
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
void add_sampled(const Scene& scene, const PillarModel& coupled, const PillarState& per_Pa,
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
    const PillarState state =
        elastic ? piezo_one_way_sampled(*elastic, coupled, 1.0) : piezo_sampled(coupled, 1.0);
    return add_sampled(scene, coupled, state, answer);
  }
  if (moves_top(scene)) {
    const PiezoAnswer unit =
        elastic ? piezo_one_way(*elastic, coupled, 1.0) : piezo_static(coupled, 1.0);
    return add_moved_piezoelectric(scene, coupled, unit, answer);
  }
  if (scene.drive_V != 0.0) return add_driven(scene, coupled, answer);
  const PiezoAnswer piezo = elastic ? piezo_one_way(*elastic, coupled, scene.pressure_Pa)
                                    : piezo_static(coupled, scene.pressure_Pa);
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

void check_displacement(const Scene& scene) {
  if (!scene.displacement_m) return;
  if (scene.pressure_Pa != 0.0) {
    throw SceneMistake("analysis.load", "give the top a pressure or a displacement, not both");
  }
  const double size_m = std::abs(*scene.displacement_m);
  if (!(size_m < scene.geometry.length_m)) {
    throw SceneMistake("analysis.load.displacement",
                       "a displacement of " + number_text(size_m * 1e6) +
                           " um is no smaller than the pillar's length of " +
                           number_text(scene.geometry.length_m * 1e6) + " um");
  }
}

}  // namespace

void check_static(const Scene& scene) {
  const bool is_held = scene.displacement_m == 0.0;
  if (scene.drive_V == 0.0 && scene.pressure_Pa == 0.0 && (!scene.displacement_m || is_held)) {
    throw SceneMistake("analysis.load",
                       "a static analysis needs a pressure on the top, a displacement of it or a "
                       "voltage");
  }
  check_displacement(scene);
  if (scene.drive_V != 0.0 &&
      (!scene.electrodes || !(scene.electrodes->electrode_radius_m > 0.0))) {
    throw SceneMistake("analysis.load.voltage", "needs an electrode with a radius to drive");
  }
  if (!std::isfinite(scene.drive_V)) {
    throw SceneMistake("analysis.load.voltage", "the voltage is not finite");
  }
  if (is_sideways(scene)) check_sideways(scene);
}

void run_static(const Scene& scene, SceneAnswer& answer) {
  if (is_sideways(scene)) return run_sideways(scene, answer);
  scene.electrodes ? run_piezoelectric(scene, answer) : run_elastic(scene, answer);
}

}  // namespace viscard
