#pragma once

#include "models/pillar/body/piezo_static.h"

namespace viscard {

// The film's potential from the strain of an uncoupled body. It solves two smaller systems instead
// of one,
//  c S(u) = T(load),  then  div(eps grad phi) = div(e S(u)),
// with a relative error of about k^2 of the film (eq. E2). `elastic` has no electrodes, but its
// mesh contains the break at the electrode's edge; `electric` has the electrodes on the same mesh
// and provides only its potentials. Capacitance and charge are those of a clamped film.
// displacement_per_V_m stays 0. Throws std::invalid_argument unless the electric model has an
// electrode with a radius.
PiezoAnswer piezo_one_way(const PillarModel& elastic, const PillarModel& electric,
                          double pressure_Pa);

// The same with a charge-free face. Returns the unknowns of the electric model, for
// potential_at_V().
PillarState piezo_one_way_sampled(const PillarModel& elastic, const PillarModel& electric,
                                  double pressure_Pa);

}  // namespace viscard
