#include "models/pillar/analyses/top_load.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/pillar_model.h"

#include <cmath>
#include <map>
#include <optional>
#include <string>

namespace viscard {

double top_pressure_Pa(const PillarScene& scene, double displacement_per_Pa_m,
                       double moved_unloaded_m) {
  if (!moves_top(scene)) return pressure_Pa(scene);
  return (*displacement_m(scene) - moved_unloaded_m) / displacement_per_Pa_m;
}

bool moves_unloaded(const PillarScene& scene) {
  if (scene.rubber) return false;  // its large strains are answered without them
  return scene.surroundings.gravity_m_s2 != 0.0 || scene.surroundings.strains_by_heat();
}

Eigen::VectorXd unloaded_force(const PillarScene& scene, const PillarModel& model) {
  Eigen::VectorXd force = heat_force(model);
  if (scene.surroundings.gravity_m_s2 != 0.0) {
    force -= scene.surroundings.gravity_m_s2 * unit_acceleration_force(model);
  }
  return force;
}

PillarState unloaded_state(const PillarScene& scene, const PillarModel& model) {
  PillarState state = model.solve(unloaded_force(scene, model));
  state.heat = 1.0;
  return state;
}

double shorted_displacement_m(const PiezoAnswer& answer) {
  return answer.top_displacement_m - answer.displacement_per_V_m * answer.voltage_V;
}

double top_pressure_Pa(const PillarScene& scene, const PiezoAnswer& per_Pa,
                       const PiezoAnswer& unloaded) {
  if (drive_V(scene) == 0.0) {
    return top_pressure_Pa(scene, per_Pa.top_displacement_m, unloaded.top_displacement_m);
  }
  return top_pressure_Pa(
      scene, shorted_displacement_m(per_Pa),
      per_Pa.displacement_per_V_m * drive_V(scene) + shorted_displacement_m(unloaded));
}

void add_top_force(const PillarScene& scene, double force_N, double stiffness_N_m,
                   SceneAnswer& answer) {
  // If a drive cancels most of the force, the error is still judged against the force that the
  // displacement alone takes.
  const double scale_N = std::abs(stiffness_N_m * *displacement_m(scene));
  answer.results.push_back({"top_force", force_N, scene.plane ? "N/m" : "N", 0.0, scale_N});
  answer.results.push_back({"top_stiffness", stiffness_N_m, scene.plane ? "N/m2" : "N/m"});
}

namespace {

// An electrode of that capacitance.
FilmPort port_of(const PillarScene& scene, double capacitance_F, const PiezoAnswer& per_Pa) {
  const double dielectric_F = per_Pa.dielectric_F > 0.0 ? per_Pa.dielectric_F : capacitance_F;
  return {capacitance_F, dielectric_F, scene.film_loss};
}

// The reading right after the load, and the readout's time constant.
void add_reading(const PillarScene& scene, double voltage_V, const FilmPort& film,
                 SceneAnswer& answer) {
  if (!scene.readout) return;
  const ReadoutFilter filter = readout_filter(*scene.readout, film);
  answer.results.push_back({"reading_at_once", filter.gain * voltage_V, "V"});
  add_time_constant(filter.time_constant_s, answer);
}

// Errors that the coupled solution itself shows. A result per displacement of the top also has the
// error of the displacement per force.
void note_unresolved(const PillarScene& scene, const PiezoRest& rest, SceneAnswer& answer) {
  const double of_top = moves_top(scene) ? rest.displacement : 0.0;
  const std::map<std::string, double> unresolved = {{"electrode_voltage", rest.voltage + of_top},
                                                    {"electrode_charge", rest.charge + of_top},
                                                    {"electrode_capacitance", rest.capacitance},
                                                    {"top_displacement", rest.displacement},
                                                    {"top_force", rest.displacement},
                                                    {"top_stiffness", rest.displacement},
                                                    {"stiffness_driven", rest.displacement},
                                                    {"stiffness_open", rest.displacement},
                                                    {"displacement_per_volt", rest.charge},
                                                    {"reading_at_once", rest.voltage + of_top}};
  for (SceneResult& result : answer.results) {
    const auto found = unresolved.find(result.name);
    if (found != unresolved.end()) result.unresolved = found->second;
  }
}

// A pillar on a film with an electrode, whose top is moved: voltage and force with the electrode
// open (or driven), the charge that flows onto a shorted electrode, and the capacitance with the
// top held.
void add_moved_piezoelectric(const PillarScene& scene, const PiezoAnswer& per_Pa,
                             const PiezoAnswer& unloaded, double area_m2, SceneAnswer& answer) {
  const double shorted_m = shorted_displacement_m(per_Pa);
  const double charge_C_per_m = per_Pa.charge_C / shorted_m;
  // With the top held, a voltage on the electrode moves no charge by moving the top.
  const double held_F = per_Pa.capacitance_F - charge_C_per_m * per_Pa.displacement_per_V_m;
  const double pressure_Pa = top_pressure_Pa(scene, per_Pa, unloaded);
  const bool is_driven = drive_V(scene) != 0.0;
  const double voltage_V =
      is_driven ? drive_V(scene) : per_Pa.voltage_V * pressure_Pa + unloaded.voltage_V;
  const double by_motion_C =
      charge_C_per_m * (*displacement_m(scene) - shorted_displacement_m(unloaded)) +
      unloaded.charge_C;
  const double charge_C = by_motion_C + held_F * drive_V(scene);
  answer.results = {{"electrode_voltage", voltage_V, "V"},
                    {"electrode_charge", charge_C, "C", 0.0, std::abs(by_motion_C)},
                    {"electrode_capacitance", held_F, "F"}};
  const double moved_m = is_driven ? shorted_m : per_Pa.top_displacement_m;
  add_top_force(scene, -area_m2 * pressure_Pa, -area_m2 / moved_m, answer);
  if (!is_driven) add_reading(scene, voltage_V, port_of(scene, held_F, per_Pa), answer);
}

// A voltage on the electrode, and the pressure if there is one (actuator). The stiffness of the
// pillar on its film is given with the electrode shorted (or driven) and open, and how a drive
// changes it by changing length and cross-section of the film under it,
//   dk/k = (d31 + d32 - d33) V/t   (eq. 25, from k = E A/L).
void add_driven(const PillarScene& scene, const PiezoAnswer& unit, const PiezoAnswer& unloaded,
                double force_N_Pa, SceneAnswer& answer) {
  const double p_Pa = pressure_Pa(scene);
  const double V = drive_V(scene);
  const double short_m_Pa = shorted_displacement_m(unit);
  const PiezoMatrix& d = scene.film_charge_C_N;
  answer.results = {
      {"electrode_voltage", V, "V"},
      {"electrode_charge", unit.charge_C * p_Pa + unit.capacitance_F * V + unloaded.charge_C, "C"},
      {"electrode_capacitance", unit.capacitance_F, "F"},
      {"top_displacement",
       short_m_Pa * p_Pa + unit.displacement_per_V_m * V + shorted_displacement_m(unloaded), "m"},
      {"displacement_per_volt", unit.displacement_per_V_m, "m/V"},
      {"stiffness_driven", -force_N_Pa / short_m_Pa, "N/m"},
      {"stiffness_open", -force_N_Pa / unit.top_displacement_m, "N/m"},
      {"film_stiffness_change_by_drive",
       (d(2, 0) + d(2, 1) - d(2, 2)) * V / scene.geometry.film->thickness_m, "1"}};
  // A free body has no stiffness against a force.
  if (scene.fixed_bottom) return;
  std::erase_if(answer.results,
                [](const SceneResult& result) { return result.name.starts_with("stiffness"); });
}

// The potential of a charge-free face.
void add_sampled(const PillarScene& scene, const FilmAnswer& per_Pa, SceneAnswer& answer) {
  const double moved_m = per_Pa.piezo.top_displacement_m;
  const double pressure_Pa = top_pressure_Pa(scene, moved_m, per_Pa.unloaded.top_displacement_m);
  answer.results = {
      {"potential_at_centre", pressure_Pa * per_Pa.centre_V + per_Pa.unloaded_centre_V, "V"},
      {"potential_mean", pressure_Pa * per_Pa.mean_V + per_Pa.unloaded_mean_V, "V"}};
  if (!moves_top(scene)) return;
  add_top_force(scene, -pressure_Pa * per_Pa.area_m2, -per_Pa.area_m2 / moved_m, answer);
}

void add_pressed(const PillarScene& scene, const PiezoAnswer& per_Pa, const PiezoAnswer& unloaded,
                 SceneAnswer& answer) {
  const double p_Pa = pressure_Pa(scene);
  const double voltage_V = p_Pa * per_Pa.voltage_V + unloaded.voltage_V;
  answer.results = {
      {"electrode_voltage", voltage_V, "V"},
      {"electrode_charge", p_Pa * per_Pa.charge_C + unloaded.charge_C, "C"},
      {"electrode_capacitance", per_Pa.capacitance_F, "F"},
      {"top_displacement", p_Pa * per_Pa.top_displacement_m + unloaded.top_displacement_m, "m"}};
  if (!scene.one_way_potential) {
    answer.results.push_back({"displacement_per_volt", per_Pa.displacement_per_V_m, "m/V"});
  }
  add_reading(scene, voltage_V, port_of(scene, per_Pa.capacitance_F, per_Pa), answer);
}

}  // namespace

PiezoAnswer unloaded_answer(const PillarScene& scene, const PillarModel& coupled,
                            const PiezoAnswer& per_Pa) {
  PiezoAnswer unloaded;
  unloaded.open = unloaded_state(scene, coupled);
  unloaded.top_displacement_m = coupled.mean_top_displacement_m(unloaded.open);
  if (coupled.electrode_dof() < 0) return unloaded;
  unloaded.voltage_V =
      unloaded.open.unknowns[coupled.electrode_dof()] * coupled.potential_scale_V();
  unloaded.charge_C = -unloaded.voltage_V * per_Pa.capacitance_F;
  unloaded.displacement_per_V_m = per_Pa.displacement_per_V_m;
  return unloaded;
}

FilmAnswer film_answer(const PillarScene& scene, SceneAnswer& answer) {
  const PillarModel coupled = electric_model_of(scene, axial_motion(scene), answer.discretisation);
  std::optional<PillarModel> elastic;
  if (scene.one_way_potential) {
    elastic.emplace(with_electrode_edge(scene.geometry, scene.electrodes), answer.discretisation,
                    media_of(scene), options_of(scene, axial_motion(scene)));
  }
  count_unknowns(elastic ? *elastic : coupled, answer);
  FilmAnswer per_Pa;
  per_Pa.area_m2 = coupled.top_traction().sum();
  if (coupled.electrode_dof() >= 0) {
    per_Pa.piezo = elastic ? piezo_one_way(*elastic, coupled, 1.0) : piezo_static(coupled, 1.0);
    if (!elastic && !scene.film_loss.is_lossless()) {
      per_Pa.piezo.dielectric_F = permittivity_change(coupled, per_Pa.piezo).dielectric_F;
    }
    if (moves_unloaded(scene)) per_Pa.unloaded = unloaded_answer(scene, coupled, per_Pa.piezo);
    return per_Pa;
  }
  const PillarState state =
      elastic ? piezo_one_way_sampled(*elastic, coupled, 1.0) : piezo_sampled(coupled, 1.0);
  const double z_m = free_face_m(scene);
  per_Pa.piezo.top_displacement_m = coupled.mean_top_displacement_m(state);
  per_Pa.centre_V = potential_at_V(coupled, state, 0.0, z_m);
  per_Pa.mean_V = mean_potential_V(coupled, state, z_m, coupled.radius_m());
  if (!moves_unloaded(scene)) return per_Pa;
  per_Pa.unloaded = unloaded_answer(scene, coupled, per_Pa.piezo);
  per_Pa.unloaded_centre_V = potential_at_V(coupled, per_Pa.unloaded.open, 0.0, z_m);
  per_Pa.unloaded_mean_V = mean_potential_V(coupled, per_Pa.unloaded.open, z_m, coupled.radius_m());
  return per_Pa;
}

void add_film_results(const PillarScene& scene, const FilmAnswer& per_Pa, SceneAnswer& answer) {
  if (scene.electrodes->electrode_radius_m == 0.0) return add_sampled(scene, per_Pa, answer);
  if (moves_top(scene)) {
    add_moved_piezoelectric(scene, per_Pa.piezo, per_Pa.unloaded, per_Pa.area_m2, answer);
  } else if (drive_V(scene) != 0.0) {  // for a free body only the drive has an effect
    add_driven(scene, per_Pa.piezo, per_Pa.unloaded, per_Pa.area_m2, answer);
  } else {
    add_pressed(scene, per_Pa.piezo, per_Pa.unloaded, answer);
  }
  note_unresolved(scene, per_Pa.piezo.rest, answer);
}

void run_static_piezo(const PillarScene& scene, SceneAnswer& answer) {
  add_film_results(scene, film_answer(scene, answer), answer);
}

}  // namespace viscard
