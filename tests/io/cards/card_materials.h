#pragma once

#include "models/material/material.h"

namespace viscard::test {

// E0 = 1.88 MPa, nu = .495, two terms: the card all golden files are of.
Material reference_material();

// n terms over n/3 decades from 1 ms, shares that look like a measured spectrum and sum to .6;
// fixed.
Material material_of_terms(int n, double nu);

}  // namespace viscard::test
