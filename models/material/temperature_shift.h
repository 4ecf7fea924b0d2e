#pragma once

#include "models/maths/interval.h"

namespace viscard {

// How temperature accelerates relaxation: at T every relaxation time is a_T times its value at
// T_ref (a thermorheologically simple material). a_T < 1 when warmer.
//   WLF:       log10 a_T = -C1 (T - T_ref)/(C2 + T - T_ref)        (eq. 26)
//   Arrhenius: ln a_T = (E_a/R) (1/T - 1/T_ref), T in K            (eq. 27)
// Sources: Williams, Landel & Ferry, J. Am. Chem. Soc. 77 (1955) 3701; Ferry, Viscoelastic
// Properties of Polymers (1980), ch. 11.
enum class ShiftLaw { kWlf, kArrhenius };

// One of these laws with its reference.
struct TemperatureShift {
  ShiftLaw law = ShiftLaw::kWlf;
  double T_ref_C = 0.0;
  double C1 = 0.0;                               // WLF, dimensionless
  double C2_K = 0.0;                             // WLF
  double activation_J_mol = 0.0;                 // Arrhenius
  Interval C1_95, C2_K_95, activation_J_mol_95;  // 0, 0: not known
  double T_min_C = 0.0, T_max_C = 0.0;           // range of the data; both 0: unknown
};

// Throws std::invalid_argument: C1 or C2 not positive (WLF), negative activation energy, reference
// below absolute zero, or a number that is not finite.
void validate(const TemperatureShift& shift);

// ln a_T. Throws std::invalid_argument at or below absolute zero and, for WLF, at or below
// T_ref - C2, where the law has its pole.
double ln_shift_factor(const TemperatureShift& shift, double temperature_C);

constexpr double kAbsoluteZero_C = -273.15;
constexpr double kGasConstant_J_mol_K = 8.314462618;  // CODATA 2018, exact

}  // namespace viscard
