#pragma once

#include "models/pillar/system/medium.h"

namespace viscard {

// The constants of a medium in axes that are turned about z by an angle (rad, from x to y).
Medium rotated_about_z(const Medium& medium, double angle);

// The mean of the medium over all directions about z, which is all that harmonic 0 alone can
// represent of an orthotropic film. Exact on the axis, to first order in the film's coupling, for
// loads without direction.
Medium averaged_about_z(const Medium& medium);

// True if turning the medium about z changes none of its constants by more than rounding.
bool is_isotropic_about_z(const Medium& medium);

}  // namespace viscard
