#include "models/material/temperature_shift.h"

#include "models/maths/require.h"

#include <numbers>

namespace viscard {

void validate(const TemperatureShift& shift) {
  require_value(shift.T_ref_C > kAbsoluteZero_C, "the reference temperature of the shift",
                shift.T_ref_C, "C", "above absolute zero");
  if (shift.law == ShiftLaw::kArrhenius) {
    require_not_negative("the activation energy", shift.activation_J_mol, "J/mol");
    return;
  }
  require_positive("the WLF constant C1", shift.C1);
  require_positive("the WLF constant C2", shift.C2_K, "K");
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
