#pragma once

namespace viscard {

// E_alpha(-x) for x >= 0 and 0 < alpha <= 1: the decay of fractional relaxation, exp(-x) at
// alpha = 1, completely monotone below. From its spectral form
//   E_alpha(-x) =
//     sin(alpha pi)/(alpha pi) int exp(-x^(1/alpha) e^(v/alpha))/(2 cosh v + 2 cos(alpha pi)) dv
// by the trapezoidal rule, which converges exponentially (the integrand is analytic in a strip):
// relative error about 1e-13. Source: Gorenflo & Mainardi in Fractals and Fractional Calculus in
// Continuum Mechanics (1997), p. 223; Trefethen & Weideman, SIAM Review 56 (2014) 385.
// Throws std::invalid_argument unless x and alpha lie in these ranges.
double mittag_leffler_decay(double alpha, double x);

}  // namespace viscard
