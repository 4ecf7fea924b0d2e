#pragma once

#include "models/pillar/system/medium.h"

namespace viscard {

// The constants of a medium in axes that are turned about z by an angle (rad, from x to y).
Medium rotated_about_z(const Medium& medium, double angle);

// True if turning the medium about z changes none of its constants by more than rounding.
bool is_isotropic_about_z(const Medium& medium);

}  // namespace viscard
