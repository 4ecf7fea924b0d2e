#include "models/material/temperature_shift.h"

#include "models/maths/require.h"
#include "models/maths/text_of_number.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
void validate(const TemperatureShift& shift) {
  require(std::isfinite(shift.T_ref_C) && shift.T_ref_C > kAbsoluteZero_C,
          "the reference temperature of the shift is " + text_of(shift.T_ref_C) +
              " C; it must lie above absolute zero");
  if (shift.law == ShiftLaw::kArrhenius) {
    require(shift.activation_J_mol >= 0.0 && std::isfinite(shift.activation_J_mol),
            "the activation energy is " + text_of(shift.activation_J_mol) +
                " J/mol; it must be finite and not negative");
    return;
  }
  require(
      shift.C1 > 0.0 && std::isfinite(shift.C1) && shift.C2_K > 0.0 && std::isfinite(shift.C2_K),
      "the WLF constants are C1 = " + text_of(shift.C1) + ", C2 = " + text_of(shift.C2_K) +
          " K; both must be positive and finite");
}

double ln_shift_factor(const TemperatureShift& shift, double temperature_C) {
  validate(shift);
  require(temperature_C > kAbsoluteZero_C,
          text_of(temperature_C) + " C is not above absolute zero");
  const double warmer_K = temperature_C - shift.T_ref_C;
  if (shift.law == ShiftLaw::kArrhenius) {
    return shift.activation_J_mol / kGasConstant_J_mol_K *
           (1.0 / (temperature_C - kAbsoluteZero_C) - 1.0 / (shift.T_ref_C - kAbsoluteZero_C));
  }
  require(shift.C2_K + warmer_K > 0.0, text_of(temperature_C) +
                                           " C lies beyond the pole of the WLF law at " +
                                           text_of(shift.T_ref_C - shift.C2_K) + " C");
  return -std::numbers::ln10 * shift.C1 * warmer_K / (shift.C2_K + warmer_K);
}

}  // namespace viscard
