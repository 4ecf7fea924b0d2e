#pragma once

#include "models/pillar/body/pillar_model.h"

namespace viscard {

// Static response of a pillar on a piezoelectric film, with elasticity and potential solved
// together (eq. 20). Charges are in C; for the strip of plane motions, per metre of thickness.
struct PiezoAnswer {
  double voltage_V = 0.0;             // electrode open (no charge flows)
  double charge_C = 0.0;              // electrode shorted to ground: charge that flows onto it
  double capacitance_F = 0.0;         // mechanically free: charge per volt without load
  double top_displacement_m = 0.0;    // mean, electrode open
  double displacement_per_V_m = 0.0;  // actuator: mean top displacement per volt on the electrode
  PillarState open;                   // solution with the electrode open
};

// The model must have electrodes with a radius. Throws std::invalid_argument otherwise.
PiezoAnswer piezo_static(const PillarModel& model, double pressure_Pa);

// Solution with a charge-free face instead of an electrode; potential_at() reads it.
PillarState piezo_sampled(const PillarModel& model, double pressure_Pa);
double potential_at_V(const PillarModel& model, const PillarState& state, double x, double z);
// Mean potential over the disc (half-width in the plane) x <= radius of the film at height z.
double mean_potential_V(const PillarModel& model, const PillarState& state, double z,
                        double radius_m);

}  // namespace viscard
