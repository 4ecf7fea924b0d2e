#pragma once

#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"

#include <complex>
#include <optional>
#include <variant>

namespace viscard {

// The classical models in one dimension, moduli in Pa, viscosities in Pa s. Sources: Tschoegl, The
// Phenomenological Theory of Linear Viscoelastic Behavior (1989), ch. 3; fractional Zener:
// Mainardi, Fractional Calculus and Waves in Linear Viscoelasticity (2010), ch. 3.
struct ElasticModel {
  double modulus_Pa = 0.0;
};
struct MaxwellModel {  // spring and dashpot in series
  double modulus_Pa = 0.0, viscosity_Pa_s = 0.0;
};
// Side by side; the relaxation modulus also contains viscosity times delta(t).
struct KelvinVoigtModel {
  double modulus_Pa = 0.0, viscosity_Pa_s = 0.0;
};
struct StandardLinearSolid {  // a spring beside a Maxwell element
  double equilibrium_Pa = 0.0, branch_Pa = 0.0, viscosity_Pa_s = 0.0;
};
struct GeneralizedMaxwellModel {  // a liquid when its equilibrium modulus is 0
  PronySeries series;
};
// E(t) = E_inf + E_1 E_alpha(-(t/tau)^alpha): a power law between two plateaus. alpha = 1 is the
// standard linear solid.
struct FractionalZenerModel {
  double equilibrium_Pa = 0.0, branch_Pa = 0.0, tau_s = 0.0, alpha = 1.0;  // alpha: a pure number
};

// Any of these models.
using ViscoelasticModel =
    std::variant<ElasticModel, MaxwellModel, KelvinVoigtModel, StandardLinearSolid,
                 GeneralizedMaxwellModel, FractionalZenerModel>;

// Throws std::invalid_argument naming the parameter: negative or not finite, no modulus at all,
// alpha outside (0, 1].
void validate(const ViscoelasticModel& model);

// Stress over strain at t > 0 after a step of strain at 0 (t = 0: just after it). Kelvin-Voigt:
// without the delta function.
double relaxation_modulus_Pa(const ViscoelasticModel& model, double time_s);
// Strain over stress at t >= 0 after a step of stress.
double creep_compliance_1_Pa(const ViscoelasticModel& model, double time_s);
// E' + i E'' at angular frequency in rad/s.
std::complex<double> complex_modulus_Pa(const ViscoelasticModel& model, double angular_1_s);

// The same solid as a Prony series, exactly; none for Kelvin-Voigt (infinite at t = 0) and the
// fractional model (a continuous spectrum). Retardation: retardation_from_relaxation().
std::optional<PronySeries> prony_series_of(const ViscoelasticModel& model);

}  // namespace viscard
