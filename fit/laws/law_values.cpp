#include "fit/laws/law_values.h"

#include "models/material/retardation_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

namespace viscard {
namespace {

using Index = Eigen::Index;

std::vector<double> log_times(double t_min_s, double t_max_s) {
  constexpr double kPerDecade = 40.0;
  const int count = 2 + static_cast<int>(kPerDecade * std::log10(t_max_s / t_min_s));
  std::vector<double> time_s;
  for (int i = 0; i < count; ++i) {
    time_s.push_back(t_min_s * std::pow(t_max_s / t_min_s, i / (count - 1.0)));
  }
  return time_s;
}

constexpr double kDecadesBelow = 1.5, kDecadesAbove = 2.5;  // of the window

LogGrid coarse_grid(double t_min_s, double t_max_s, double step) {
  const double decades = std::log10(t_max_s / t_min_s) + kDecadesBelow + kDecadesAbove;
  LogGrid grid{std::log(t_min_s) - kDecadesBelow * std::log(10.0), step};
  grid.count = 1 + static_cast<Index>(std::ceil(decades * std::log(10.0) / step - 1e-9));
  return grid;
}

CoarseSpectrum coarse_of(const LawNumbers& law, const LogGrid& grid) {
  const LawForm form = law_form(law.kind, law.is_creep);
  return coarse_spectrum(DecaySpectrum(form.shape, law.exponent, law.is_creep), law.ln_tau, grid);
}

// Everything faster than the grid becomes one term with the same sums of w T and w T^2, so the
// response to an oscillation within the window is the same. Its weight is at most the sum of w
// (Cauchy & Schwarz).
struct FastTerm {
  double weight = 0.0, time_s = 0.0;
};
std::optional<FastTerm> fast_term(const CoarseSpectrum& found) {
  if (!(found.faster_T2 > 0.0)) return std::nullopt;
  return FastTerm{found.faster_T * found.faster_T / found.faster_T2,
                  found.faster_T2 / found.faster_T};
}

RetardationSpectrum law_retardation(const LawNumbers& law, const LogGrid& grid) {
  const CoarseSpectrum found = coarse_of(law, grid);
  RetardationSpectrum spectrum{law.constant + law.amplitude * found.faster, {}, 0.0};
  if (const auto fast = fast_term(found)) {
    spectrum.instantaneous_compliance_1_Pa -= law.amplitude * fast->weight;
    spectrum.terms.push_back({law.amplitude * fast->weight, fast->time_s});
  }
  // Every point stays a term, so that neighbouring laws have the same terms.
  const double least = 1e-12 * law.amplitude * found.weights.maxCoeff();
  for (Index j = 0; j < grid.count; ++j) {
    const double compliance = law.amplitude * found.weights[j];
    spectrum.terms.push_back({std::max(compliance, least), std::exp(grid.at(j))});
  }
  // The flow within the window becomes a last term, because a material file always keeps some
  // modulus at infinite time.
  const double last_s = 10.0 * std::exp(grid.at(grid.count - 1));
  const double flow = law.amplitude * found.slower_per_T * last_s;
  spectrum.terms.push_back({std::max(flow, least), last_s});
  return spectrum;
}

PronySeries law_relaxation(const LawNumbers& law, const LogGrid& grid) {
  const CoarseSpectrum found = coarse_of(law, grid);
  PronySeries series{law.constant + law.amplitude * found.slower, {}};
  if (const auto fast = fast_term(found)) {
    series.terms.push_back({law.amplitude * fast->weight, fast->time_s});
  }
  for (Index j = 0; j < grid.count; ++j) {
    series.terms.push_back({law.amplitude * found.weights[j], std::exp(grid.at(j))});
  }
  return series;
}

// A constant and weights of times: of exp(-t/T) in relaxation, of 1 - exp(-t/T) in creep.
struct Mixture {
  double constant = 0.0;
  std::vector<double> weight, time_s;
  bool is_creep = false;

  double at(double t_s) const {
    double sum = constant;
    for (std::size_t j = 0; j < weight.size(); ++j) {
      const double x = t_s / time_s[j];
      sum += weight[j] * (is_creep ? -std::expm1(-x) : std::exp(-x));
    }
    return sum;
  }
  // Complex modulus or compliance.
  std::complex<double> at_frequency(double w) const {
    std::complex<double> sum = constant;
    for (std::size_t j = 0; j < weight.size(); ++j) {
      const std::complex<double> x(0.0, w * time_s[j]);
      sum += weight[j] / (is_creep ? 1.0 + x : 1.0 + 1.0 / x);
    }
    return sum;
  }
};

Mixture fine_mixture(const LawNumbers& law, double t_min_s, double t_max_s) {
  const LawForm form = law_form(law.kind, law.is_creep);
  const LogGrid grid = grid_for_times(std::log(t_min_s), std::log(t_max_s));
  const Eigen::VectorXd weights =
      weights_on_grid(DecaySpectrum(form.shape, law.exponent, law.is_creep), law.ln_tau, grid);
  Mixture out{law.constant, {}, {}, law.is_creep};
  for (Index j = 0; j < grid.count; ++j) {
    out.weight.push_back(law.amplitude * weights[j]);
    out.time_s.push_back(std::exp(grid.at(j)));
  }
  return out;
}

Mixture coarse_mixture(const LawNumbers& law, const LogGrid& grid) {
  Mixture out{0.0, {}, {}, law.is_creep};
  const auto add = [&](double weight, double time_s) {
    out.weight.push_back(weight);
    out.time_s.push_back(time_s);
  };
  if (law.is_creep) {
    const RetardationSpectrum creep = law_retardation(law, grid);
    out.constant = creep.instantaneous_compliance_1_Pa;
    for (const RetardationTerm& one : creep.terms) add(one.compliance_1_Pa, one.retardation_time_s);
  } else {
    const PronySeries series = law_relaxation(law, grid);
    out.constant = series.equilibrium_modulus_Pa;
    for (const MaxwellTerm& one : series.terms) add(one.modulus_Pa, one.relaxation_time_s);
  }
  return out;
}

}  // namespace

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> kNames{"kww", "springpot", "fractional-maxwell",
                                               "fractional-kelvin-voigt", "fractional-zener"};
  return kNames;
}

LawForm law_form(LawKind kind, bool is_creep) {
  switch (kind) {
    case LawKind::kKww:
      return {DecayShape::kStretched, true, true};
    case LawKind::kSpringpot:
      return {DecayShape::kPowerLaw, false, false};
    case LawKind::kFractionalMaxwell:  // J = J_g + power law
      return is_creep ? LawForm{DecayShape::kPowerLaw, true, false}
                      : LawForm{DecayShape::kMittagLeffler, false, true};
    case LawKind::kFractionalKelvinVoigt:  // J = (1 - E_alpha)/E_inf
      return is_creep ? LawForm{DecayShape::kMittagLeffler, false, true}
                      : LawForm{DecayShape::kPowerLaw, true, false};
    case LawKind::kFractionalZener:
      break;
  }
  return {DecayShape::kMittagLeffler, true, true};
}

NamedLawValues named_values(const LawNumbers& law, bool is_stiffness) {
  const std::string unit = is_stiffness ? "N_m" : "Pa";
  const double tau_s = std::exp(law.ln_tau), alpha = law.exponent;
  NamedLawValues out;
  const auto add = [&](const std::string& name, double value, bool is_logarithmic) {
    out.names.push_back(name);
    out.values.push_back(value);
    out.is_logarithmic.push_back(is_logarithmic);
  };
  const auto add_quasi = [&](double c) {
    add("c_" + unit + "_s_alpha", c, true);
    add("alpha", alpha, false);
  };
  // Amplitudes of power laws belong to the unit time tau.
  const double power = std::pow(tau_s, alpha);
  switch (law.kind) {
    case LawKind::kKww:
      add(law.is_creep ? "J_g_1_Pa" : "E_inf_" + unit, law.constant, false);
      add(law.is_creep ? "J_1_1_Pa" : "E_1_" + unit, law.amplitude, false);
      add(law.is_creep ? "lambda_s" : "tau_s", tau_s, true);
      add("beta", alpha, false);
      break;
    case LawKind::kSpringpot:
      add_quasi(law.is_creep ? power / law.amplitude : law.amplitude * power);
      break;
    case LawKind::kFractionalMaxwell: {
      const double E_1 = law.is_creep ? 1.0 / law.constant : law.amplitude;
      add("E_1_" + unit, E_1, false);
      add("tau_s", law.is_creep ? std::pow(power / law.amplitude / E_1, 1.0 / alpha) : tau_s, true);
      add("alpha", alpha, false);
      break;
    }
    case LawKind::kFractionalKelvinVoigt:
      add("E_inf_" + unit, law.is_creep ? 1.0 / law.amplitude : law.constant, false);
      add_quasi(law.is_creep ? power / law.amplitude : law.amplitude * power);
      break;
    case LawKind::kFractionalZener: {
      const double E_0 = law.is_creep ? 1.0 / law.constant : law.constant + law.amplitude;
      const double E_inf = law.is_creep ? 1.0 / (law.constant + law.amplitude) : law.constant;
      add("E_inf_" + unit, E_inf, false);
      add("E_1_" + unit, E_0 - E_inf, false);
      add("tau_s", law.is_creep ? tau_s * std::pow(E_inf / E_0, 1.0 / alpha) : tau_s, true);
      add("alpha", alpha, false);
      break;
    }
  }
  return out;
}

PronySeries law_series(const LawNumbers& law, double t_min_s, double t_max_s, double step) {
  const LogGrid grid = coarse_grid(t_min_s, t_max_s, step);
  return law.is_creep ? relaxation_from_retardation(law_retardation(law, grid))
                      : law_relaxation(law, grid);
}

LawSeriesStep series_step(const LawNumbers& law, double t_min_s, double t_max_s) {
  constexpr double kEnough = 1e-3, kNarrower = 0.85;
  constexpr Index kMostTerms = 60;
  const std::vector<double> time_s = log_times(t_min_s, t_max_s);
  const Mixture fine = fine_mixture(law, t_min_s, t_max_s);
  std::vector<double> exact;
  std::vector<std::complex<double>> exact_at_frequency;
  for (const double t_s : time_s) {
    exact.push_back(fine.at(t_s));
    exact_at_frequency.push_back(fine.at_frequency(1.0 / t_s));
  }
  LawSeriesStep found{0.5 * std::log(10.0), 0.0};
  while (true) {
    const Mixture coarse = coarse_mixture(law, coarse_grid(t_min_s, t_max_s, found.step));
    found.error = 0.0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      const std::complex<double> dynamic = coarse.at_frequency(1.0 / time_s[i]);
      found.error = std::max({found.error, std::abs(coarse.at(time_s[i]) / exact[i] - 1.0),
                              std::abs(dynamic / exact_at_frequency[i] - 1.0)});
    }
    const double next = kNarrower * found.step;
    if (found.error <= kEnough || coarse_grid(t_min_s, t_max_s, next).count > kMostTerms) {
      return found;
    }
    found.step = next;
  }
}

}  // namespace viscard
