#pragma once

#include <vector>

namespace viscard {

// Generalised Maxwell solid, E(t) = E_inf + sum_i E_i exp(-t/tau_i)   (models/README.md, eq. 1)
// Moduli in Pa, times in s. The same form serves shear and bulk moduli.
// Source: Tschoegl, The Phenomenological Theory of Linear Viscoelastic Behavior (1989), ch. 3.
// Not a MaterialTerm: a modulus of one kind in Pa, not shares of two.
struct MaxwellTerm {
  double modulus_Pa = 0.0;
  double relaxation_time_s = 0.0;
};

// E(t) = E_inf + sum of modulus_Pa exp(-t/relaxation_time_s).
struct PronySeries {
  double equilibrium_modulus_Pa = 0.0;  // E_inf; 0 for a liquid
  std::vector<MaxwellTerm> terms;       // any order
};

// Throws std::invalid_argument naming the first term that is not finite, has a relaxation time
// that is not positive, or makes the instantaneous modulus non-positive. Negative moduli of single
// terms pass only with allow_negative.
void validate(const PronySeries& series, bool allow_negative = false);

// E_0 = E_inf + sum E_i, Pa.
double instantaneous_modulus_Pa(const PronySeries& series);

// E(t), Pa, for t >= 0 s.
double relaxation_modulus_Pa(const PronySeries& series, double time_s);

// E'(w) and E''(w), Pa (eq. 2), w in rad/s. Neither w tau = 1e12 nor 1e-12 loses digits.
struct ComplexModulus {
  double storage_Pa = 0.0;
  double loss_Pa = 0.0;
};
ComplexModulus complex_modulus_Pa(const PronySeries& series, double angular_frequency_rad_s);

}  // namespace viscard
