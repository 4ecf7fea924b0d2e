#pragma once

#include "models/material/law_spectrum.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// The laws beside the Prony series. Relaxation modulus E(t), or compliance J(t) of a creep test:
//   kww                      E_inf + E_1 exp(-(t/tau)^beta); creep: J_g + J_1 (1 - exp(-(t/lambda)^beta))
//   springpot                c t^-alpha/Gamma(1 - alpha)
//   fractional-maxwell       spring E_1 and springpot in series: E_1 E_alpha(-(t/tau)^alpha)
//   fractional-kelvin-voigt  spring E_inf and springpot side by side
//   fractional-zener         spring E_inf beside a fractional Maxwell element
// The fractional laws are one law in relaxation, creep and oscillation; a stretched exponential of E
// is none of J. Sources: Kohlrausch (1854); Mainardi, Fractional Calculus and Waves in Linear
// Viscoelasticity (2010), ch. 3.
enum class LawKind {
  kKww,
  kSpringpot,
  kFractionalMaxwell,
  kFractionalKelvinVoigt,
  kFractionalZener
};

// In the order of LawKind, as on the command line.
const std::vector<std::string>& law_names();

// How a law appears in a record: constant + amplitude * decay (growth in creep).
struct LawForm {
  DecayShape shape = DecayShape::kMittagLeffler;
  bool has_constant = false;  // E_inf, or J_g in creep
  bool has_time = true;       // false: a power law, whose time is the unit time of its amplitude
};
LawForm law_form(LawKind kind, bool is_creep);

// What is fitted.
struct LawNumbers {
  LawKind kind = LawKind::kKww;
  bool is_creep = false;
  double constant = 0.0, amplitude = 0.0, ln_tau = 0.0, exponent = 0.5;
};

// The parameters in their usual form, with names. is_stiffness: moduli in N/m.
struct NamedLawValues {
  std::vector<std::string> names;
  std::vector<double> values;
  std::vector<bool> is_logarithmic;  // intervals symmetric in the logarithm
};
NamedLawValues named_values(const LawNumbers& law, bool is_stiffness);

// A Prony series of the law: terms evenly spaced in ln tau by `step`, from 1.5 decades below
// t_min_s to 2.5 decades above t_max_s. Relaxation faster than that becomes one more term, slower
// relaxation becomes part of E_inf. A creep law is written as a retardation spectrum and converted.
PronySeries law_series(const LawNumbers& law, double t_min_s, double t_max_s, double step);
// The widest step whose series is within 0.1 % (or with at most 60 terms), and its largest relative
// error: of E(t), or J(t) in creep, between t_min_s and t_max_s, and of the complex modulus (or
// compliance) at the angular frequencies 1/t_max_s to 1/t_min_s.
struct LawSeriesStep {
  double step = 0.0, error = 0.0;
};
LawSeriesStep series_step(const LawNumbers& law, double t_min_s, double t_max_s);

}  // namespace viscard
