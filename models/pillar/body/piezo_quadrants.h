#pragma once

#include "models/pillar/body/piezo_static.h"

namespace viscard {

// A round electrode divided into four quadrants along x and y, under loads along x. The motion of
// the pillar, the field and the charge on the film's face then vary as cos(theta). Opposite halves
// read opposite values, so one quadrant on the +x side is enough: its charge is int_0^(pi/2)
// cos(theta) = 1 times int D r dr, and its mean voltage is 2/pi of the amplitude.
struct QuadrantAnswer {
  double charge_C = 0.0;  // all shorted: flows onto each of the two quadrants toward +x
  double displacement_per_V_m =
      0.0;                          // top along +x, 1 V on the halves toward +x, -1 V on the others
  double top_displacement_m = 0.0;  // mean, all shorted
  PillarState shorted;
  PillarState driven_per_V;  // without force, 1 and -1 V on the halves
};

// Solution under a force along x on the top, for a lateral model whose electrode has a radius. A
// potential of +-1 V on the two halves has the first harmonic 4/pi cos(theta); no other harmonic
// moves the pillar as a whole. Under the force, with all quadrants shorted, there are no other
// harmonics, so the gaps can be ignored. Throws std::invalid_argument for another model.
QuadrantAnswer piezo_quadrants(const PillarModel& lateral, double force_N);

// The same charge as a functional of a motion with all quadrants shorted: charge_C = row.dot(u)
// without the entry of the electrode itself. `stiffness` is that of the model.
Eigen::VectorXd quadrant_charge_row(const PillarModel& lateral, const SymmetricSparse& stiffness);

// Mean over one quadrant (in the plane: the half toward +x) of the potential of a charge-free face.
double quadrant_mean_V(const PillarModel& lateral, const PillarState& state, double z,
                       double radius_m);

}  // namespace viscard
