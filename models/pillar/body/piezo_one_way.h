#pragma once

#include "models/pillar/body/piezo_static.h"

namespace viscard {

// The film's potential from the strain of an uncoupled body: two smaller systems instead of one,
//   c S(u) = T(load),  then  div(eps grad phi) = div(e S(u)),
// at a relative error of about the film's k^2 (eq. E2). `elastic` has no electrodes but a mesh with
// the electrode's break; `electric` has them on the same mesh and gives only its potentials.
// Capacitance and charge are those of a clamped film. displacement_per_V_m stays 0.
// The electric model must have an electrode with a radius; throws std::invalid_argument otherwise.
PiezoAnswer piezo_one_way(const PillarModel& elastic, const PillarModel& electric,
                          double pressure_Pa);

// With a charge-free face: unknowns of the electric model, for potential_at_V().
PillarState piezo_one_way_sampled(const PillarModel& elastic, const PillarModel& electric,
                                  double pressure_Pa);

}  // namespace viscard
