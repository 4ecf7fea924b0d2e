#pragma once

#include "models/material/material.h"

#include <complex>
#include <vector>

namespace viscard {

// Relative shear (share = &MaterialTerm::g) or bulk (k) modulus in the Laplace domain,
//   M~(s) = s M^(s)/M_0 = 1 - sum m_i + sum m_i s tau_i/(1 + s tau_i)   (eq. 2 at s = i omega),
// written so that neither s tau = 1e12 nor 1e-12 loses digits.
std::complex<double> relative_modulus(const std::vector<MaterialTerm>& terms,
                                      double MaterialTerm::*share, std::complex<double> s);

}  // namespace viscard
