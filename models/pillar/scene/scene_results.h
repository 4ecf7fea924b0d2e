#pragma once

#include "models/pillar/scene/scene.h"

#include <string>
#include <vector>

namespace viscard {

// Everything a scene may ask for under [want]: the names of its results, and of its curves, which
// stand for the results read off them. Nothing is solved. tests/scenes holds this list against what
// the analyses give.
std::vector<std::string> result_names(const Scene& scene);

// True for names under which people ask for the largest stress at the rim of the bond. There is
// none: it is infinite in an elastic body (Williams, J. Appl. Mech. 19 (1952) 526).
bool is_peak_stress(const std::string& name);

}  // namespace viscard
