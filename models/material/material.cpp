#include "models/material/material.h"

#include "models/material/retardation_spectrum.h"
#include "models/maths/text_of_number.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

void fail(const std::string& what) {
  throw std::invalid_argument(what);
}

double sum_of(const std::vector<MaterialTerm>& terms, double MaterialTerm::*member) {
  double sum = 0.0;
  for (const MaterialTerm& term : terms) sum += term.*member;
  return sum;
}

void validate_term(const MaterialTerm& term, std::size_t number) {
  const std::string where = "term " + std::to_string(number) + ": ";
  if (!(term.g >= 0.0) || !std::isfinite(term.g)) {
    fail(where + "g is " + text_of(term.g) + "; it must be finite and not negative");
  }
  if (!(term.k >= 0.0) || !std::isfinite(term.k)) {
    fail(where + "k is " + text_of(term.k) + "; it must be finite and not negative");
  }
  if (!(term.tau_s > 0.0) || !std::isfinite(term.tau_s)) {
    fail(where + "tau is " + text_of(term.tau_s) + " s; it must be positive and finite");
  }
}

PronySeries bulk_series(const Material& material, const DerivedModuli& moduli) {
  PronySeries series{moduli.K_inf_Pa, {}};
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    series.terms.push_back({moduli.K_Pa[i], material.terms[i].tau_s});
  }
  return series;
}

}  // namespace

void validate(const Material& material) {
  if (!(material.E0_Pa > 0.0) || !std::isfinite(material.E0_Pa)) {
    fail("E0 is " + text_of(material.E0_Pa) + " Pa; it must be positive and finite");
  }
  if (!(material.nu > -1.0 && material.nu <= 0.5)) {
    fail("Poisson ratio is " + text_of(material.nu) + "; it must lie in (-1, 0.5]");
  }
  if (!(material.rho_kg_m3 >= 0.0) || !std::isfinite(material.rho_kg_m3)) {
    fail("density is " + text_of(material.rho_kg_m3) + " kg/m3; it must not be negative");
  }
  if (!(material.mixing_ratio >= 0.0) || !std::isfinite(material.mixing_ratio)) {
    fail("mixing ratio is " + text_of(material.mixing_ratio) + "; it must be positive");
  }
  const ValidityWindow& valid = material.valid;
  if (!(valid.t_min_s >= 0.0) || !(valid.t_max_s >= 0.0) || !std::isfinite(valid.t_max_s) ||
      (valid.t_max_s > 0.0 && !(valid.t_min_s < valid.t_max_s))) {
    fail("the validity window runs from " + text_of(valid.t_min_s) + " s to " +
         text_of(valid.t_max_s) + " s; it must begin at 0 or later and end after it begins");
  }
  if (material.T_ref_C && !(*material.T_ref_C > -273.15 && std::isfinite(*material.T_ref_C))) {
    fail("the reference temperature is " + text_of(*material.T_ref_C) +
         " C; it must be above absolute zero");
  }
  if (material.shift) {
    validate(*material.shift);
    if (!material.T_ref_C || *material.T_ref_C != material.shift->T_ref_C) {
      fail("the temperature shift counts from " + text_of(material.shift->T_ref_C) +
           " C, so T_ref_C must be given and be the same");
    }
  }
  for (std::size_t i = 0; i < material.terms.size(); ++i) validate_term(material.terms[i], i + 1);
  const double sum_g = sum_of(material.terms, &MaterialTerm::g);
  const double sum_k = sum_of(material.terms, &MaterialTerm::k);
  // Rounding of a liquid's shares may add to 1 + 1e-16; a card for it is refused all the same.
  if (!(sum_g < 1.0)) {
    fail("the g of all terms add up to " + text_of(sum_g) +
         "; they must stay below 1, or nothing of the modulus is left in the end");
  }
  if (!(sum_k < 1.0)) {
    fail("the k of all terms add up to " + text_of(sum_k) + "; they must stay below 1");
  }
}

bool has_constant_poisson_ratio(const Material& material) {
  for (const MaterialTerm& term : material.terms) {
    if (term.k != term.g) return false;
  }
  return true;
}

DerivedModuli derived_moduli(const Material& material) {
  DerivedModuli out;
  out.sum_g = sum_of(material.terms, &MaterialTerm::g);
  out.sum_k = sum_of(material.terms, &MaterialTerm::k);
  out.E0_Pa = material.E0_Pa;
  out.E_rest_Pa = (1.0 - out.sum_g) * material.E0_Pa;
  out.G0_Pa = material.E0_Pa / (2.0 * (1.0 + material.nu));
  out.G_inf_Pa = out.G0_Pa * (1.0 - out.sum_g);
  const bool incompressible = material.nu == 0.5;
  out.K0_Pa = incompressible ? std::numeric_limits<double>::infinity()
                             : material.E0_Pa / (3.0 * (1.0 - 2.0 * material.nu));
  out.K_inf_Pa = out.K0_Pa * (1.0 - out.sum_k);
  if (incompressible) {
    out.E_inf_Pa = 3.0 * out.G_inf_Pa;
    out.nu_inf = 0.5;
  } else {
    out.E_inf_Pa = 9.0 * out.K_inf_Pa * out.G_inf_Pa / (3.0 * out.K_inf_Pa + out.G_inf_Pa);
    out.nu_inf =
        (3.0 * out.K_inf_Pa - 2.0 * out.G_inf_Pa) / (2.0 * (3.0 * out.K_inf_Pa + out.G_inf_Pa));
  }
  if (has_constant_poisson_ratio(material)) {  // without the rounding of the detour
    out.E_inf_Pa = material.E0_Pa * (1.0 - out.sum_g);
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
  PronySeries series{moduli.G_inf_Pa, {}};
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    series.terms.push_back({moduli.G_Pa[i], material.terms[i].tau_s});
  }
  return series;
}

PronySeries young_series(const Material& material) {
  const DerivedModuli moduli = derived_moduli(material);
  if (material.nu == 0.5 || has_constant_poisson_ratio(material)) {
    PronySeries series{moduli.E_inf_Pa, {}};
    for (const MaterialTerm& term : material.terms) {
      series.terms.push_back({term.g * material.E0_Pa, term.tau_s});
    }
    return series;
  }
  // 1/E = 1/(3G) + 1/(9K) in the Laplace domain: creep in tension is a third of the creep in shear
  // plus a ninth of that in volume, and the relaxation series follows from that compliance.
  const RetardationSpectrum shear = retardation_from_relaxation(shear_series(material));
  const RetardationSpectrum bulk = retardation_from_relaxation(bulk_series(material, moduli));
  RetardationSpectrum uniaxial;
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

}  // namespace viscard
