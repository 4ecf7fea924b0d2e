#pragma once

#include "models/array/space/space_scene.h"

#include <random>

namespace viscard::test {

// An array of one to five by one to five pillars on a square or hexagonal lattice or at random places,
// with dead ones and up to one class of others: moduli over a decade, films of PVDF or of any coupling
// up to 0.5 and at least 1000 times as stiff, sampled and quadrant electrodes, pressed,
// sheared or both, all or some of them; tolerances from 5e-4 to 3e-2.
SpaceScene random_array(std::mt19937_64& random);

// Such an array under a rigid plane, cylinder, sphere, paraboloid or wedge anywhere over it, inclined or
// not, to a depth of up to half of what buckles a pillar; tolerances from 2e-3 to 3e-2.
SpaceScene random_pressed_array(std::mt19937_64& random);

// Arrays as above with all that an array in the plane may have, within the limits that it states: electrodes of all kinds,
// some of them on the face under the pillars; films on a rigid base or on a backing at least twice as stiff; half of
// them under a shape; tolerances from 1e-4 to 1e-2, under a shape from 2e-3.
SpaceScene random_touch(std::mt19937_64& random);

}  // namespace viscard::test
