#include "models/material/material.h"

#include "models/material/lasting_share.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/require.h"
#include "models/maths/result_visitor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

double sum_of(const std::vector<MaterialTerm>& terms, double MaterialTerm::*member) {
  double sum = 0.0;
  for (const MaterialTerm& term : terms) sum += term.*member;
  return sum;
}

void validate_term(const MaterialTerm& term, std::size_t number) {
  const std::string where = "term " + std::to_string(number) + ": ";
  require_not_negative(where + "g", term.g);
  require_not_negative(where + "k", term.k);
  require_positive(where + "tau", term.tau_s, "s");
}

void validate_sum(const char* name, double sum, bool may_be_one) {
  require(
      sum < 1.0 || (may_be_one && lasting_share(sum) == 0.0),
      std::string("the ") + name + " of all terms add up to " + text_of(sum) +
          "; the sum must be below 1, or 1 for a liquid, in which no part of the modulus lasts");
}

PronySeries series_of(const Material& material, double equilibrium_Pa,
                      const std::vector<double>& branch_Pa) {
  PronySeries series{equilibrium_Pa, {}};
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    series.terms.push_back({branch_Pa[i], material.terms[i].tau_s});
  }
  return series;
}

}  // namespace

void validate(const Material& material) {
  require_positive("E0", material.E0_Pa, "Pa");
  require_value(material.nu > -1.0 && material.nu <= 0.5, "Poisson ratio", material.nu, "",
                "in (-1, 0.5]");
  require_not_negative("density", material.rho_kg_m3, "kg/m3");
  require_not_negative("mixing ratio", material.mixing_ratio);
  const ValidityWindow& valid = material.valid;
  require(valid.t_min_s >= 0.0 && valid.t_max_s >= 0.0 && std::isfinite(valid.t_max_s) &&
              !(valid.t_max_s > 0.0 && !(valid.t_min_s < valid.t_max_s)),
          "the validity window runs from " + text_of(valid.t_min_s) + " s to " +
              text_of(valid.t_max_s) + " s; it must begin at 0 or later and end after it begins");
  if (material.T_ref_C) {
    require_value(*material.T_ref_C > kAbsoluteZero_C, "the reference temperature",
                  *material.T_ref_C, "C", "above absolute zero");
  }
  if (material.shift) {
    validate(*material.shift);
    require(material.T_ref_C == material.shift->T_ref_C,
            "the reference temperature of the temperature shift is " +
                text_of(material.shift->T_ref_C) + " C; T_ref_C must be given and be the same");
  }
  if (material.terms.size() > kMostMaterialTerms) {
    throw std::invalid_argument("the material has " + std::to_string(material.terms.size()) +
                                " terms; at most " + std::to_string(kMostMaterialTerms) +
                                " are taken");
  }
  for (std::size_t i = 0; i < material.terms.size(); ++i) validate_term(material.terms[i], i + 1);
  const double sum_g = sum_of(material.terms, &MaterialTerm::g);
  validate_sum("g", sum_g, /*may_be_one=*/true);
  validate_sum("k", sum_of(material.terms, &MaterialTerm::k), lasting_share(sum_g) == 0.0);
}

bool is_defect(const std::string& flag_name) {
  constexpr std::array kDefects{"not-converged",
                                "saturated",
                                "gap-in-ramp",
                                "contact-lost",
                                "E0-unknown",
                                "contradicts-data",
                                "misfit",
                                "modulus-rises",
                                "rows-lost",
                                "law-not-a-series",
                                "tests-disagree",
                                "history-missing",
                                "time-zero-doubtful",
                                "unverified",
                                "shifts-not-determined"};
  return std::find(kDefects.begin(), kDefects.end(), flag_name) != kDefects.end();
}

bool is_about_record(const std::string& flag_name) {
  constexpr std::array kAboutOneFit{"tau-below-sampling",
                                    "tau-below-ramp",
                                    "tau-beyond-window",
                                    "fast-term-hidden",
                                    "slow-term-hidden",
                                    "modulus-may-be-zero",
                                    "terms-correlated",
                                    "confused-with-drift",
                                    "liquid",
                                    "solid-or-liquid",
                                    "on-bound",
                                    "faster-relaxation",
                                    "slower-relaxation",
                                    "order-uncertain",
                                    "fewer-terms",
                                    "few-rows",
                                    "law-as-series",
                                    "law-at-bound",
                                    "law-not-a-series",
                                    "constraints-strained",
                                    "contradicts-data",
                                    "E0-extrapolated",
                                    "E0-unknown",
                                    "time-zero-doubtful",
                                    "not-converged",
                                    "noise-grows",
                                    "noise-floor",
                                    "slow-noise",
                                    "lack-of-fit",
                                    "misfit",
                                    "storage-alone",
                                    "fast-dashpot",
                                    "slow-dashpot",
                                    "tests-disagree",
                                    "plausible-off"};  // is stated once
  // The conversion to Young's modulus is that of the whole fit.
  if (flag_name.starts_with("measured-as-")) return false;
  return std::find(kAboutOneFit.begin(), kAboutOneFit.end(), flag_name) == kAboutOneFit.end();
}

bool has_constant_poisson_ratio(const Material& material) {
  return std::all_of(material.terms.begin(), material.terms.end(),
                     [](const MaterialTerm& term) { return term.k == term.g; });
}

DerivedModuli derived_moduli(const Material& material) {
  DerivedModuli out;
  out.sum_g = sum_of(material.terms, &MaterialTerm::g);
  out.sum_k = sum_of(material.terms, &MaterialTerm::k);
  out.E0_Pa = material.E0_Pa;
  const double lasting = lasting_share(out.sum_g);
  out.E_rest_Pa = lasting * material.E0_Pa;
  out.G0_Pa = material.E0_Pa / (2.0 * (1.0 + material.nu));
  out.G_inf_Pa = out.G0_Pa * lasting;
  const bool incompressible = material.nu == 0.5;
  out.K0_Pa = incompressible ? std::numeric_limits<double>::infinity()
                             : material.E0_Pa / (3.0 * (1.0 - 2.0 * material.nu));
  out.K_inf_Pa = incompressible ? out.K0_Pa : out.K0_Pa * lasting_share(out.sum_k);
  if (incompressible) {
    out.E_inf_Pa = 3.0 * out.G_inf_Pa;
    out.nu_inf = 0.5;
  } else {
    out.E_inf_Pa = 9.0 * out.K_inf_Pa * out.G_inf_Pa / (3.0 * out.K_inf_Pa + out.G_inf_Pa);
    out.nu_inf =
        (3.0 * out.K_inf_Pa - 2.0 * out.G_inf_Pa) / (2.0 * (3.0 * out.K_inf_Pa + out.G_inf_Pa));
  }
  if (has_constant_poisson_ratio(material)) {  // directly, without the rounding of 9KG/(3K + G)
    out.E_inf_Pa = out.E_rest_Pa;
    out.nu_inf = material.nu;
  }
  for (const MaterialTerm& term : material.terms) {
    out.G_Pa.push_back(term.g * out.G0_Pa);
    if (!incompressible) out.K_Pa.push_back(term.k * out.K0_Pa);
    out.E_Pa.push_back(term.g * material.E0_Pa);
    out.beta_1_s.push_back(1.0 / term.tau_s);
    out.norton_1_Pa_s.push_back(1.0 / (3.0 * out.G_Pa.back() * term.tau_s));
  }
  return out;
}

PronySeries shear_series(const Material& material) {
  const DerivedModuli moduli = derived_moduli(material);
  return series_of(material, moduli.G_inf_Pa, moduli.G_Pa);
}

PronySeries young_series(const Material& material) {
  const DerivedModuli moduli = derived_moduli(material);
  if (material.nu == 0.5 || has_constant_poisson_ratio(material)) {
    return series_of(material, moduli.E_inf_Pa, moduli.E_Pa);
  }
  // 1/E = 1/(3G) + 1/(9K) in the Laplace domain: creep in tension is a third of the creep in shear
  // plus a ninth of that in volume, and the relaxation series follows from that compliance.
  const RetardationSpectrum shear = retardation_from_relaxation(shear_series(material));
  const RetardationSpectrum bulk =
      retardation_from_relaxation(series_of(material, moduli.K_inf_Pa, moduli.K_Pa));
  RetardationSpectrum uniaxial;
  uniaxial.fluidity_1_Pa_s = shear.fluidity_1_Pa_s / 3.0 + bulk.fluidity_1_Pa_s / 9.0;
  uniaxial.instantaneous_compliance_1_Pa =
      shear.instantaneous_compliance_1_Pa / 3.0 + bulk.instantaneous_compliance_1_Pa / 9.0;
  for (const RetardationTerm& term : shear.terms) {
    uniaxial.terms.push_back({term.compliance_1_Pa / 3.0, term.retardation_time_s});
  }
  for (const RetardationTerm& term : bulk.terms) {
    uniaxial.terms.push_back({term.compliance_1_Pa / 9.0, term.retardation_time_s});
  }
  return relaxation_from_retardation(uniaxial);
}

std::complex<double> relative_modulus(const std::vector<MaterialTerm>& terms,
                                      double MaterialTerm::*share, std::complex<double> s) {
  // Sum of the lasting and the relaxing parts: 1 - sum m/(1 + s tau) would cancel.
  double rest = 1.0;
  for (const MaterialTerm& term : terms) rest -= term.*share;
  std::complex<double> modulus = lasting_share(1.0 - rest) == 0.0 ? 0.0 : rest;
  for (const MaterialTerm& term : terms) {
    const std::complex<double> x = s * term.tau_s;
    modulus += term.*share * (std::abs(x) > 1.0 ? 1.0 / (1.0 + 1.0 / x) : x / (1.0 + x));
  }
  return modulus;
}

RelaxationTimes relaxation_times(const std::vector<MaterialTerm>& terms) {
  RelaxationTimes times{std::numeric_limits<double>::infinity(), 0.0};
  for (const MaterialTerm& term : terms) {
    if (term.g == 0.0 && term.k == 0.0) continue;
    times.fastest_s = std::min(times.fastest_s, term.tau_s);
    times.slowest_s = std::max(times.slowest_s, term.tau_s);
  }
  return times;
}

RelativeModuli relative_moduli(const std::vector<MaterialTerm>& terms, std::complex<double> s) {
  return {relative_modulus(terms, &MaterialTerm::g, s),
          relative_modulus(terms, &MaterialTerm::k, s)};
}

void show_keys(ResultVisitor& v, const MaterialFlag& flag) {
  v("name", flag.name, "name of the flag");
  v.when(flag.term > 0, [&] { v("term", flag.term, "number of the term, from 1"); });
  v("text", flag.text, "the flag in words");
}

}  // namespace viscard
