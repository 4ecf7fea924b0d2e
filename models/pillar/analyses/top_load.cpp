#include "models/pillar/analyses/top_load.h"

#include <cmath>

namespace viscard {

bool moves_top(const PillarScene& scene) {
  return displacement_m(scene).has_value();
}

double top_pressure_Pa(const PillarScene& scene, double displacement_per_Pa_m,
                       double moved_by_voltage_m) {
  if (!moves_top(scene)) return pressure_Pa(scene);
  return (*displacement_m(scene) - moved_by_voltage_m) / displacement_per_Pa_m;
}

double shorted_displacement_m(const PiezoAnswer& answer) {
  return answer.top_displacement_m - answer.displacement_per_V_m * answer.voltage_V;
}

double top_pressure_Pa(const PillarScene& scene, const PiezoAnswer& per_Pa) {
  if (drive_V(scene) == 0.0) return top_pressure_Pa(scene, per_Pa.top_displacement_m);
  return top_pressure_Pa(scene, shorted_displacement_m(per_Pa),
                         per_Pa.displacement_per_V_m * drive_V(scene));
}

void add_top_force(const PillarScene& scene, double force_N, double stiffness_N_m,
                   SceneAnswer& answer) {
  // If a drive cancels most of the force, the error is still judged against the force that the
  // displacement alone takes.
  const double scale_N = std::abs(stiffness_N_m * *displacement_m(scene));
  answer.results.push_back({"top_force", force_N, scene.plane ? "N/m" : "N", 0.0, scale_N});
  answer.results.push_back({"top_stiffness", stiffness_N_m, scene.plane ? "N/m2" : "N/m"});
}

void add_moved_piezoelectric(const PillarScene& scene, const PillarModel& model,
                             const PiezoAnswer& per_Pa, SceneAnswer& answer) {
  const double shorted_m = shorted_displacement_m(per_Pa);
  const double charge_C_per_m = per_Pa.charge_C / shorted_m;
  // A voltage on the electrode moves no charge by moving a top that is held.
  const double held_F = per_Pa.capacitance_F - charge_C_per_m * per_Pa.displacement_per_V_m;
  const double pressure_Pa = top_pressure_Pa(scene, per_Pa);
  const double area_m2 = model.top_traction().sum();
  const bool is_driven = drive_V(scene) != 0.0;
  const double voltage_V = is_driven ? drive_V(scene) : per_Pa.voltage_V * pressure_Pa;
  const double by_motion_C = charge_C_per_m * *displacement_m(scene);
  const double charge_C = by_motion_C + held_F * drive_V(scene);
  answer.results = {{"electrode_voltage", voltage_V, "V"},
                    {"electrode_charge", charge_C, "C", 0.0, std::abs(by_motion_C)},
                    {"electrode_capacitance", held_F, "F"}};
  const double moved_m = is_driven ? shorted_m : per_Pa.top_displacement_m;
  add_top_force(scene, -area_m2 * pressure_Pa, -area_m2 / moved_m, answer);
  if (is_driven || !scene.readout) return;
  const ReadoutFilter filter = readout_filter(*scene.readout, held_F);
  answer.results.push_back({"reading_at_once", filter.gain * voltage_V, "V"});
  if (std::isfinite(filter.time_constant_s)) {
    answer.results.push_back({"readout_time_constant", filter.time_constant_s, "s"});
  }
}

}  // namespace viscard
