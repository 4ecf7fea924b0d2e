#pragma once

#include "models/material/material.h"

namespace viscard::test {

// E0 = 1.88 MPa, nu = 0.495, two terms: the material of all golden files.
Material reference_material();

// n terms over n/3 decades from 1 ms; their shares look like a measured spectrum and sum to 0.6.
Material material_of_terms(int n, double nu);

}  // namespace viscard::test
