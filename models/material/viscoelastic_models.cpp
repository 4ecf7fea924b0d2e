#include "models/material/viscoelastic_models.h"

#include "models/maths/mittag_leffler.h"
#include "models/maths/require.h"

#include <cmath>

namespace viscard {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

PronySeries maxwell_series(double equilibrium_Pa, double branch_Pa, double viscosity_Pa_s) {
  return {equilibrium_Pa, {{branch_Pa, viscosity_Pa_s / branch_Pa}}};
}

// (i w tau)^alpha.
std::complex<double> fractional_power(double x, double alpha) {
  constexpr double kHalfPi = 1.5707963267948966;
  return std::polar(std::pow(x, alpha), kHalfPi * alpha);
}

double fractional_creep_1_Pa(const FractionalZenerModel& m, double time_s) {
  const double E0_Pa = m.equilibrium_Pa + m.branch_Pa;
  if (m.equilibrium_Pa == 0.0) {  // fractional Maxwell: a spring and a power law in series
    return 1.0 / m.branch_Pa *
           (1.0 + std::pow(time_s / m.tau_s, m.alpha) / std::tgamma(1.0 + m.alpha));
  }
  const double stretch = E0_Pa / m.equilibrium_Pa;  // (lambda/tau)^alpha
  const double decay = mittag_leffler_decay(m.alpha, std::pow(time_s / m.tau_s, m.alpha) / stretch);
  return 1.0 / m.equilibrium_Pa - m.branch_Pa / (E0_Pa * m.equilibrium_Pa) * decay;
}

}  // namespace

void validate(const ViscoelasticModel& model) {
  std::visit(Overloaded{[](const ElasticModel& m) { require_positive("modulus", m.modulus_Pa); },
                        [](const MaxwellModel& m) {
                          require_positive("modulus", m.modulus_Pa);
                          require_positive("viscosity", m.viscosity_Pa_s);
                        },
                        [](const KelvinVoigtModel& m) {
                          require_positive("modulus", m.modulus_Pa);
                          require_positive("viscosity", m.viscosity_Pa_s);
                        },
                        [](const StandardLinearSolid& m) {
                          require_positive("equilibrium modulus", m.equilibrium_Pa);
                          require_positive("branch modulus", m.branch_Pa);
                          require_positive("viscosity", m.viscosity_Pa_s);
                        },
                        [](const GeneralizedMaxwellModel& m) { validate(m.series); },
                        [](const FractionalZenerModel& m) {
                          require_not_negative("equilibrium modulus", m.equilibrium_Pa);
                          require_positive("branch modulus", m.branch_Pa);
                          require_positive("time", m.tau_s);
                          require_value(m.alpha > 0.0 && m.alpha <= 1.0, "alpha", m.alpha, "",
                                        "in (0, 1]");
                        }},
             model);
}

std::optional<PronySeries> prony_series_of(const ViscoelasticModel& model) {
  using Series = std::optional<PronySeries>;
  return std::visit(
      Overloaded{[](const ElasticModel& m) {
                   return Series({m.modulus_Pa, {}});
                 },
                 [](const MaxwellModel& m) {
                   return Series(maxwell_series(0.0, m.modulus_Pa, m.viscosity_Pa_s));
                 },
                 [](const KelvinVoigtModel&) { return Series(); },
                 [](const StandardLinearSolid& m) {
                   return Series(maxwell_series(m.equilibrium_Pa, m.branch_Pa, m.viscosity_Pa_s));
                 },
                 [](const GeneralizedMaxwellModel& m) { return Series(m.series); },
                 [](const FractionalZenerModel&) { return Series(); }},
      model);
}

double relaxation_modulus_Pa(const ViscoelasticModel& model, double time_s) {
  if (const auto series = prony_series_of(model)) return relaxation_modulus_Pa(*series, time_s);
  if (const auto* solid = std::get_if<KelvinVoigtModel>(&model)) return solid->modulus_Pa;
  const auto& m = std::get<FractionalZenerModel>(model);
  return m.equilibrium_Pa +
         m.branch_Pa * mittag_leffler_decay(m.alpha, std::pow(time_s / m.tau_s, m.alpha));
}

double creep_compliance_1_Pa(const ViscoelasticModel& model, double time_s) {
  if (const auto series = prony_series_of(model)) {
    return creep_compliance_1_Pa(retardation_from_relaxation(*series), time_s);
  }
  if (const auto* m = std::get_if<KelvinVoigtModel>(&model)) {
    return -std::expm1(-time_s * m->modulus_Pa / m->viscosity_Pa_s) / m->modulus_Pa;
  }
  return fractional_creep_1_Pa(std::get<FractionalZenerModel>(model), time_s);
}

std::complex<double> complex_modulus_Pa(const ViscoelasticModel& model, double angular_1_s) {
  if (const auto series = prony_series_of(model)) {
    const ComplexModulus modulus = complex_modulus_Pa(*series, angular_1_s);
    return {modulus.storage_Pa, modulus.loss_Pa};
  }
  if (const auto* m = std::get_if<KelvinVoigtModel>(&model)) {
    return {m->modulus_Pa, m->viscosity_Pa_s * angular_1_s};
  }
  const auto& m = std::get<FractionalZenerModel>(model);
  const std::complex<double> inverse = 1.0 / fractional_power(angular_1_s * m.tau_s, m.alpha);
  return m.equilibrium_Pa + m.branch_Pa / (1.0 + inverse);
}

}  // namespace viscard
