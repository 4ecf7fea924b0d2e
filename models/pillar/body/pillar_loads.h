#pragma once

#include "models/pillar/body/pillar_model.h"

namespace viscard {

// Loads along the direction in which a family of motion moves the pillar as a whole: along its axis
// for axial families, sideways (x) for lateral families. For a strip all forces are per metre of
// thickness.

// Area of the top, m^2; of a strip per metre, m.
double top_area_m2(const PillarModel& model);

// A pull of 1 N spread evenly over the top, so that load.u is the mean displacement of the top, m.
// Throws std::invalid_argument for torsion and harmonics above 1, which do not move the pillar as a
// whole.
Eigen::VectorXd unit_top_force(const PillarModel& model);

// Inertial force of an acceleration of 1 m/s^2 of the whole body, in N. If the bottom is shaken,
// the motion relative to the bottom is that of a body under minus this force times the
// acceleration. It also gives the participating mass: for a rigid motion of 1 m, load.u is the mass
// in kg.
Eigen::VectorXd unit_acceleration_force(const PillarModel& model);

}  // namespace viscard
