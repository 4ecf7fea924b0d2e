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

TemperatureShift with_reference(const TemperatureShift& shift, double T_ref_C) {
  ln_shift_factor(shift, T_ref_C);  // throws where the law does not reach
  TemperatureShift moved = shift;
  moved.T_ref_C = T_ref_C;
  moved.C1_95 = moved.C2_K_95 = moved.activation_J_mol_95 = {};
  if (shift.law == ShiftLaw::kWlf) {
    // Ferry (1980), ch. 11, eq. 24: C1 C2 and T_ref - C2 do not depend on the reference.
    moved.C2_K = shift.C2_K + T_ref_C - shift.T_ref_C;
    moved.C1 = shift.C1 * shift.C2_K / moved.C2_K;
  }
  return moved;
}

}  // namespace viscard
