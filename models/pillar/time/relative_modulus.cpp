#include "models/pillar/time/relative_modulus.h"

namespace viscard {

std::complex<double> relative_modulus(const std::vector<MaterialTerm>& terms,
                                      double MaterialTerm::*share, std::complex<double> s) {
  // Sum of the lasting part and the relaxing parts, without the cancellation of 1 - sum m/(1 + s
  // tau).
  double rest = 1.0;
  for (const MaterialTerm& term : terms) rest -= term.*share;
  std::complex<double> modulus = rest;
  for (const MaterialTerm& term : terms) {
    const std::complex<double> x = s * term.tau_s;
    modulus += term.*share * (std::abs(x) > 1.0 ? 1.0 / (1.0 + 1.0 / x) : x / (1.0 + x));
  }
  return modulus;
}

}  // namespace viscard
