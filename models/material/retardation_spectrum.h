#pragma once

#include "models/material/prony_series.h"

#include <vector>

namespace viscard {

// Creep compliance of the same solid, J(t) = J_g + sum_j J_j (1 - exp(-t/lambda_j)) + t/eta (eq.
// 3). Compliances in 1/Pa, times in s. fluidity_1_Pa_s = 1/eta is zero except for a liquid. Not a MaxwellTerm: the strain
// of a term grows towards J_j, where the stress of one of relaxation falls to zero.
struct RetardationTerm {
  double compliance_1_Pa = 0.0;
  double retardation_time_s = 0.0;
};

// J(t) as above.
struct RetardationSpectrum {
  double instantaneous_compliance_1_Pa = 0.0;  // J_g = 1/E_0
  std::vector<RetardationTerm> terms;          // ascending retardation time
  double fluidity_1_Pa_s = 0.0;
};

// Exact interconversion (eq. 4): the zeros s = -1/lambda_j of s * (Laplace transform of E)
// interlace the poles -1/tau_i, one in each gap, and J_j follows from the residue there. Terms of
// equal time are merged and terms of zero modulus dropped first, since neither makes a pole.
// Source: Tschoegl (1989), ch. 4; Park & Schapery, Int. J. Solids Struct. 36 (1999) 1653.
// Throws std::invalid_argument if validate(series) does.
RetardationSpectrum retardation_from_relaxation(const PronySeries& series);

// The way back: relaxation times are the zeros of J_g + sum J_j/(1 + s lambda_j) + fluidity/s, and
// E_i = 1/(r f'(r)) at s = -r. Throws std::invalid_argument unless J_g > 0 and all else is
// non-negative with positive times.
PronySeries relaxation_from_retardation(const RetardationSpectrum& spectrum);

// J(t), 1/Pa, for t >= 0 s.
double creep_compliance_1_Pa(const RetardationSpectrum& spectrum, double time_s);

}  // namespace viscard
