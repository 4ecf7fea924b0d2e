#include "models/material/prony_series.h"

#include "models/maths/require.h"

#include <cmath>
#include <string>

namespace viscard {

void validate(const PronySeries& series, bool allow_negative) {
  require_not_negative("equilibrium modulus", series.equilibrium_modulus_Pa, "Pa");
  for (std::size_t i = 0; i < series.terms.size(); ++i) {
    const MaxwellTerm& term = series.terms[i];
    const std::string of_term = " of term " + std::to_string(i + 1);
    require_positive("relaxation time" + of_term, term.relaxation_time_s, "s");
    require_value(allow_negative || term.modulus_Pa >= 0.0, "modulus" + of_term, term.modulus_Pa,
                  "Pa", "finite and not negative");
  }
  require(instantaneous_modulus_Pa(series) > 0.0, "the instantaneous modulus is zero or negative");
}

double instantaneous_modulus_Pa(const PronySeries& series) {
  double sum_Pa = series.equilibrium_modulus_Pa;
  for (const MaxwellTerm& term : series.terms) sum_Pa += term.modulus_Pa;
  return sum_Pa;
}

double relaxation_modulus_Pa(const PronySeries& series, double time_s) {
  double modulus_Pa = series.equilibrium_modulus_Pa;
  for (const MaxwellTerm& term : series.terms) {
    modulus_Pa += term.modulus_Pa * std::exp(-time_s / term.relaxation_time_s);
  }
  return modulus_Pa;
}

ComplexModulus complex_modulus_Pa(const PronySeries& series, double angular_frequency_rad_s) {
  ComplexModulus result{series.equilibrium_modulus_Pa, 0.0};
  for (const MaxwellTerm& term : series.terms) {
    const double x = angular_frequency_rad_s * term.relaxation_time_s;
    // x^2/(1+x^2) and x/(1+x^2), divided through so that neither overflows.
    if (x > 1.0) {
      const double inverse = 1.0 / x;
      result.storage_Pa += term.modulus_Pa / (1.0 + inverse * inverse);
      result.loss_Pa += term.modulus_Pa * inverse / (1.0 + inverse * inverse);
    } else {
      result.storage_Pa += term.modulus_Pa * x * x / (1.0 + x * x);
      result.loss_Pa += term.modulus_Pa * x / (1.0 + x * x);
    }
  }
  return result;
}

}  // namespace viscard
