#include "io/cards/card_numbers.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

double sum_of(const CardNumbers& numbers, double CardBranch::*member) {
  double sum = 0.0;
  for (const CardBranch& branch : numbers.branches) sum += branch.*member;
  return sum;
}

int time_exponent(TimeNumber time, const UnitSystem& units) {
  if (time == TimeNumber::kTau) return units.time_exponent;
  const int stress = time == TimeNumber::kNortonA ? units.stress_exponent : 0;
  return -stress - units.time_exponent;
}

// Instantaneous moduli in SI, also for a card that states long-term ones.
struct Instantaneous {
  double G0_Pa = 0.0;
  double K0_Pa = 0.0;  // infinity at nu = 0.5
};

Instantaneous shear_and_bulk_Pa(double young_Pa, double poisson) {
  const double bulk_Pa = poisson == 0.5 ? std::numeric_limits<double>::infinity()
                                        : young_Pa / (3.0 * (1.0 - 2.0 * poisson));
  return {young_Pa / (2.0 * (1.0 + poisson)), bulk_Pa};
}

// Moduli read from the card, raised to the instantaneous ones where the card states long-term ones.
Instantaneous instantaneous_moduli(const CardNumbers& numbers, const CardTarget& target,
                                   const UnitSystem& units, double sum_g, double sum_k) {
  const int stress = units.stress_exponent;
  Instantaneous moduli;
  switch (target.elastic) {
    case ElasticForm::kYoungPoisson:
      moduli = shear_and_bulk_Pa(from_card(numbers.young, stress), numbers.poisson);
      break;
    case ElasticForm::kBulkShear:
      moduli = {from_card(numbers.shear, stress), from_card(numbers.bulk, stress)};
      break;
    case ElasticForm::kBulkOnly:
      return {from_card(numbers.equilibrium + sum_of(numbers, &CardBranch::shear), stress),
              from_card(numbers.bulk, stress)};
    case ElasticForm::kPoissonOnly:
      return shear_and_bulk_Pa(
          from_card(numbers.equilibrium + sum_of(numbers, &CardBranch::shear), stress),
          numbers.poisson);
  }
  if (target.at == ModulusAt::kLongTerm) {
    if (target.branch == BranchNumber::kAbsoluteShear) {
      moduli.G0_Pa += from_card(sum_of(numbers, &CardBranch::shear), stress);
      moduli.K0_Pa += from_card(sum_of(numbers, &CardBranch::bulk), stress);
    } else {
      moduli.G0_Pa /= 1.0 - sum_g;
      moduli.K0_Pa /= 1.0 - sum_k;
    }
  } else if (target.states_equilibrium && target.branch == BranchNumber::kRelative) {
    // FEBio scales its elastic child by g0 + sum g_i at time zero.
    const double scale = numbers.equilibrium + sum_of(numbers, &CardBranch::shear);
    moduli.G0_Pa *= scale;
    if (target.bulk != BulkRule::kConstantBulk) moduli.K0_Pa *= scale;
  }
  return moduli;
}

// A branch number divided by this is g_i.
double relative_to(const CardNumbers& numbers, const CardTarget& target) {
  const double sum = sum_of(numbers, &CardBranch::shear);
  if (target.branch == BranchNumber::kRelative) {
    return target.states_equilibrium ? numbers.equilibrium + sum : 1.0;
  }
  if (target.states_equilibrium) return numbers.equilibrium + sum;
  if (target.elastic == ElasticForm::kBulkShear) return numbers.shear + sum;
  if (target.branch == BranchNumber::kAbsoluteYoung) return numbers.young;
  return numbers.young / (2.0 * (1.0 + numbers.poisson)) + sum;  // long-term shear modulus
}

double tau_s(const CardBranch& branch, const CardNumbers& numbers, const CardTarget& target,
             const UnitSystem& units) {
  const double time = from_card(branch.time, time_exponent(target.time, units));
  if (target.time == TimeNumber::kTau) return time;
  if (target.time == TimeNumber::kBeta) return 1.0 / time;
  const double branch_G_Pa =
      from_card(branch.shear, units.stress_exponent) / (2.0 * (1.0 + numbers.poisson));
  return 1.0 / (3.0 * branch_G_Pa * time);
}

}  // namespace

Material with_bulk_rule(Material material, BulkRule rule) {
  for (MaterialTerm& term : material.terms) {
    if (rule == BulkRule::kConstantBulk) term.k = 0.0;
    if (rule == BulkRule::kConstantPoisson) term.k = term.g;
  }
  return material;
}

CardNumbers numbers_from_material(const Material& given, const CardTarget& target,
                                  const UnitSystem& units) {
  const Material material = with_bulk_rule(given, target.bulk);
  const DerivedModuli moduli = derived_moduli(material);
  const bool is_instantaneous = target.at == ModulusAt::kInstantaneous;
  const int stress = units.stress_exponent;
  CardNumbers numbers;
  numbers.young = to_card(is_instantaneous ? moduli.E0_Pa : moduli.E_inf_Pa, stress);
  numbers.poisson = is_instantaneous ? material.nu : moduli.nu_inf;
  numbers.bulk = to_card(is_instantaneous ? moduli.K0_Pa : moduli.K_inf_Pa, stress);
  numbers.shear = to_card(is_instantaneous ? moduli.G0_Pa : moduli.G_inf_Pa, stress);
  numbers.density = to_card(material.rho_kg_m3, units.density_exponent);
  if (takes_shift(target, material)) numbers.shift = material.shift;
  numbers.equilibrium = target.branch == BranchNumber::kRelative ? 1.0 - moduli.sum_g
                        : target.branch == BranchNumber::kAbsoluteShear
                            ? to_card(moduli.G_inf_Pa, stress)
                            : to_card(moduli.E_rest_Pa, stress);
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    const MaterialTerm& term = material.terms[i];
    CardBranch branch{term.g, term.k, 0.0};
    if (target.branch == BranchNumber::kAbsoluteShear) {
      branch.shear = to_card(moduli.G_Pa[i], stress);
      if (!moduli.K_Pa.empty()) branch.bulk = to_card(moduli.K_Pa[i], stress);
    }
    if (target.branch == BranchNumber::kAbsoluteYoung)
      branch.shear = to_card(moduli.E_Pa[i], stress);
    const double time_SI = target.time == TimeNumber::kTau    ? term.tau_s
                           : target.time == TimeNumber::kBeta ? moduli.beta_1_s[i]
                                                              : moduli.norton_1_Pa_s[i];
    branch.time = to_card(time_SI, time_exponent(target.time, units));
    numbers.branches.push_back(branch);
  }
  return numbers;
}

Material material_from_numbers(const CardNumbers& numbers, const CardTarget& target,
                               const UnitSystem& units) {
  const double divisor = relative_to(numbers, target);
  const bool is_bulk_absolute = target.branch == BranchNumber::kAbsoluteShear;
  const double bulk_divisor =
      is_bulk_absolute ? numbers.bulk + sum_of(numbers, &CardBranch::bulk) : 1.0;
  Material material;
  double sum_g = 0.0, sum_k = 0.0;
  for (const CardBranch& branch : numbers.branches) {
    MaterialTerm term{branch.shear / divisor, 0.0, tau_s(branch, numbers, target, units)};
    if (target.bulk == BulkRule::kConstantPoisson) term.k = term.g;
    if (target.bulk == BulkRule::kOwnNumbers) term.k = branch.bulk / bulk_divisor;
    if (!(term.tau_s > 0.0) || !std::isfinite(term.tau_s)) {
      throw std::invalid_argument("term " + std::to_string(material.terms.size() + 1) +
                                  " of the card has a relaxation time that is not positive");
    }
    sum_g += term.g;
    sum_k += term.k;
    material.terms.push_back(term);
  }
  if (!(sum_g < 1.0) || !(sum_k < 1.0)) {
    throw std::invalid_argument(
        "the branches of the card add up to the whole modulus or more (sum g = " +
        std::to_string(sum_g) + "); no solid is left");
  }
  const Instantaneous moduli = instantaneous_moduli(numbers, target, units, sum_g, sum_k);
  const double ratio = moduli.G0_Pa / moduli.K0_Pa;  // 0 for an incompressible solid
  material.E0_Pa = 9.0 * moduli.G0_Pa / (3.0 + ratio);
  material.nu = (3.0 - 2.0 * ratio) / (2.0 * (3.0 + ratio));
  material.rho_kg_m3 = from_card(numbers.density, units.density_exponent);
  material.shift = numbers.shift;
  if (numbers.shift) material.T_ref_C = numbers.shift->T_ref_C;
  return material;
}

}  // namespace viscard
