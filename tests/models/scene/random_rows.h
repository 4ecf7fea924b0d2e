#pragma once

#include "models/array/plane/array_scene.h"

#include <random>

namespace viscard::test {

// A row of two to five pillars: moduli over three decades, films of PVDF or of any coupling up to
// 0.5 and permittivity up to 2000, sampled and equipotential electrodes on either face, ends cut
// off or mirrored, pressed or sheared, all or one of them; tolerances from 1e-4 to 1e-1.
ArrayScene random_row(std::mt19937_64& random);

}  // namespace viscard::test
