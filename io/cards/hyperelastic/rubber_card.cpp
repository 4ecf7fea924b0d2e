#include "io/cards/hyperelastic/rubber_card.h"

#include "io/cards/hyperelastic/rubber_targets.h"
#include "io/cards/unit_system.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

// Throws std::invalid_argument if the target cannot take the terms of the law: no memory beside a law,
// too many terms, shares that sum to 1, or a rule that holds at small strain only (unless it may
// approximate).
void require_terms_taken(const RubberNumbers& law, const RubberTarget& target,
                         bool may_approximate) {
  if (law.terms.empty()) return;
  const std::string way_out =
      "; --elastic-only long-term or --elastic-only instantaneous writes the law without them";
  if (!target.takes_terms) {
    throw std::invalid_argument(target.name +
                                " cannot take the terms of relaxation: " + target.terms + way_out);
  }
  if (target.most_terms > 0 && law.terms.size() > target.most_terms) {
    throw std::invalid_argument(fmt::format("{} takes {} terms of relaxation and the law has {}{}",
                                            target.name, target.most_terms, law.terms.size(),
                                            way_out));
  }
  require(law.long_term_share() > 0.0,
          "the shares g of the terms sum to 1: nothing is left after all relaxation, and solvers "
          "need less; fit again with fewer --terms");
  if (!target.is_for_small_strain || may_approximate) return;
  throw std::invalid_argument(
      target.name +
      " adds its terms of relaxation as a solid that is linear in the strain, not by the law's "
      "own stress: right at small strain only; --approximate writes them" +
      way_out);
}

// Throws std::invalid_argument, with the way on, if the target cannot take the damage of the law.
void require_damage_taken(HyperelasticForm form, const RubberTarget& target) {
  if (target.damage.takes(form)) return;
  std::string takers;
  for (const RubberTarget& other : rubber_targets()) {
    if (other.damage.takes(form)) takers += (takers.empty() ? "" : ", ") + other.name;
  }
  std::string others;
  for (const HyperelasticForm other : target.damage.forms)
    others += (others.empty() ? "" : ", ") + name_of(other) + "+" + kMullinsName;
  throw std::invalid_argument(
      target.name + " cannot take the damage " + kMullinsName + " beside " + name_of(form) + ": " +
      target.damage.refusal + (takers.empty() ? "" : ". Write the card for " + takers) +
      (others.empty() ? "" : ", fit " + others) + (takers.empty() ? ". Fit" : ", or fit") +
      " the loading of one cycle without damage: viscard fit --model " + name_of(form) +
      " --cycle N");
}

RubberNumbers numbers_of(const HyperelasticLaw& law, const std::vector<RubberTerm>& terms,
                         const RubberTarget& target, const RubberCardOptions& options) {
  const UnitSystem& units = unit_system(options.units);
  RubberNumbers out;
  out.form = law.form;
  out.shapes.assign(law.shapes.begin(), law.shapes.end());
  out.units = &units;
  for (const double modulus_Pa : law.moduli_Pa)
    out.moduli.push_back(to_card(modulus_Pa, units.stress_exponent));
  out.shear = to_card(youngs_modulus_Pa(law) / 3.0, units.stress_exponent);
  if (options.bulk_Pa) {
    require_positive("the bulk modulus", *options.bulk_Pa, "Pa");
    out.bulk = to_card(*options.bulk_Pa, units.stress_exponent);
  } else if (!target.may_be_incompressible) {
    out.bulk = kUsualBulkRatio * out.shear;
  }
  if (options.density_kg_m3) {
    require_positive("the density", *options.density_kg_m3, "kg/m3");
    out.density = to_card(*options.density_kg_m3, units.density_exponent);
  }
  for (const RubberTerm& term : terms)
    out.terms.push_back({term.g, to_card(term.tau_s, units.time_exponent)});
  return out;
}

}  // namespace

const std::vector<std::string>& rubber_card_targets() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const RubberTarget& target : rubber_targets()) names.push_back(target.name);
    return names;
  }();
  return kNames;
}

HyperelasticLaw law_without_terms(const HyperelasticLaw& law, const std::vector<RubberTerm>& terms,
                                  const std::string& when) {
  HyperelasticLaw out = law;
  if (when != "long-term") return out;
  double share = 1.0;
  for (const RubberTerm& term : terms) share -= term.g;
  out.moduli_Pa *= share;
  return out;
}

std::string foam_card(const FoamLaw& law, const RubberCardOptions& options) {
  validate(law);
  const RubberTarget& target = rubber_target(options.target);
  if (target.laws.foam.empty()) {
    std::string takers;
    for (const RubberTarget& other : rubber_targets()) {
      if (!other.laws.foam.empty()) takers += (takers.empty() ? "" : ", ") + other.name;
    }
    throw std::invalid_argument(
        "viscard writes no card of a foam (" + foam_name(law.mu_Pa.size()) + ") for " +
        target.name +
        ": no public text states that it has this law with these constants. "
        "Write the card for " +
        takers);
  }
  require(!options.bulk_Pa, "the bulk modulus of a foam follows from its constants; omit it");
  const UnitSystem& units = unit_system(options.units);
  RubberNumbers numbers;
  numbers.units = &units;
  for (Eigen::Index i = 0; i < law.mu_Pa.size(); ++i)
    numbers.foam.push_back({to_card(law.mu_Pa[i], units.stress_exponent), law.alpha[i], law.nu[i]});
  numbers.shear = to_card(shear_modulus_Pa(law), units.stress_exponent);
  numbers.bulk = to_card(bulk_modulus_Pa(law), units.stress_exponent);
  if (options.density_kg_m3) {
    require_positive("the density", *options.density_kg_m3, "kg/m3");
    numbers.density = to_card(*options.density_kg_m3, units.density_exponent);
  }
  require(!target.needs_density || numbers.density > 0.0,
          target.name + " needs a density: --density \"30 kg/m3\"");
  return target.write(numbers, options.material_name);
}

std::string rubber_card(const HyperelasticLaw& law, const RubberCardOptions& options) {
  return rubber_card(law, {}, options);
}

std::string rubber_card(const HyperelasticLaw& law, const std::vector<RubberTerm>& terms,
                        const RubberCardOptions& options,
                        const std::optional<MullinsDamage>& damage) {
  validate(law);
  validate(terms);
  if (damage) validate(*damage);
  require(!damage || terms.empty(), "damage and terms of relaxation never stand beside one law");
  if (!options.elastic_only.empty() && !terms.empty()) {
    RubberCardOptions elastic = options;
    elastic.elastic_only.clear();
    return rubber_card(law_without_terms(law, terms, options.elastic_only), elastic);
  }
  const RubberTarget& target = rubber_target(options.target);
  RubberNumbers numbers = numbers_of(law, terms, target, options);
  if (target.laws.of(law.form).empty()) {
    std::string others;
    for (const HyperelasticForm form : hyperelastic_forms()) {
      if (!target.laws.of(form).empty()) others += (others.empty() ? "" : ", ") + name_of(form);
    }
    throw std::invalid_argument(target.name + " has no " + name_of(law.form) +
                                " law; fit one that it has with viscard fit --model: " + others);
  }
  require(!target.needs_density || numbers.density > 0.0,
          target.name + " needs a density: --density \"1.1 g/cm3\"");
  require_terms_taken(numbers, target, options.may_approximate);
  if (damage) {
    require_damage_taken(law.form, target);
    numbers.damage = {damage->r, to_card(damage->m_Pa, numbers.units->stress_exponent),
                      damage->beta};
  }
  return target.write(numbers, options.material_name);
}

}  // namespace viscard
