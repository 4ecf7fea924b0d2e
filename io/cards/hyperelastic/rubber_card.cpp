#include "io/cards/hyperelastic/rubber_card.h"

#include "io/cards/card_numbers.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

// Names of the targets whose column has a property.
template <typename Has>
std::vector<std::string> targets_that(Has has) {
  std::vector<std::string> out;
  for (const CardTarget* target : law_targets()) {
    if (has(*target->laws)) out.push_back(target->name);
  }
  return out;
}

std::string between_commas(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

// Throws std::invalid_argument if the target cannot take the terms of the law: no memory beside a law,
// too many terms, shares that sum to 1, or a rule that holds at small strain only (unless it may
// approximate).
void require_terms_taken(const CardNumbers& law, const CardTarget& target, bool may_approximate) {
  if (law.branches.empty()) return;
  const std::string way_out =
      "; --elastic-only long-term or --elastic-only instantaneous writes the law without them";
  const LawColumn& laws = *target.laws;
  require(laws.takes_terms,
          target.name + " cannot take the terms of relaxation: " + laws.terms + way_out);
  require(laws.most_terms == 0 || law.branches.size() <= laws.most_terms,
          fmt::format("{} takes {} terms of relaxation and the law has {}{}", target.name,
                      laws.most_terms, law.branches.size(), way_out));
  require(law.long_term_share() > 0.0,
          "the shares g of the terms sum to 1: nothing is left after all relaxation, and solvers "
          "need less; fit again with fewer --terms");
  require(!laws.is_for_small_strain || may_approximate,
          target.name +
              " adds its terms of relaxation as a solid that is linear in the strain, not by the "
              "law's own stress: right at small strain only; --approximate writes them" +
              way_out);
}

// Throws std::invalid_argument, with the way on, if the target cannot take the damage of the law.
void require_damage_taken(HyperelasticForm form, const CardTarget& target) {
  const LawDamage& damage = target.laws->damage;
  if (damage.takes(form)) return;
  const auto takers = targets_that([&](const LawColumn& laws) { return laws.damage.takes(form); });
  std::vector<std::string> others;
  for (const HyperelasticForm other : damage.forms)
    others.push_back(name_of(other) + "+" + kMullinsName);
  throw std::invalid_argument(
      target.name + " cannot take the damage " + kMullinsName + " beside " + name_of(form) + ": " +
      damage.refusal + (takers.empty() ? "" : ". Write the card for " + between_commas(takers)) +
      (others.empty() ? "" : ", fit " + between_commas(others)) +
      (takers.empty() ? ". Fit" : ", or fit") +
      " the loading of one cycle without damage: viscard fit --model " + name_of(form) +
      " --cycle N");
}

// The numbers of a law or foam, its density checked, as the target writes them.
std::string written(CardNumbers& numbers, const CardTarget& target, const UnitSystem& units,
                    const RubberCardOptions& options, const char* some_density) {
  if (options.density_kg_m3) {
    require_positive("the density", *options.density_kg_m3, "kg/m3");
    numbers.density = to_card(*options.density_kg_m3, units.density_exponent);
  }
  require(!target.needs_density || numbers.density > 0.0,
          target.name + " needs a density: --density \"" + some_density + "\"");
  return target.laws->write({options.material_name, numbers, target, units, {}});
}

}  // namespace

const std::vector<std::string>& rubber_card_targets() {
  static const auto kNames = targets_that([](const LawColumn&) { return true; });
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
  const CardTarget& target = law_target(options.target);
  require(!target.laws->keywords.foam.empty(),
          "viscard writes no card of a foam (" + foam_name(law.mu_Pa.size()) + ") for " +
              target.name +
              ": no public text states that it has this law with these constants. "
              "Write the card for " +
              between_commas(
                  targets_that([](const LawColumn& laws) { return !laws.keywords.foam.empty(); })));
  require(!options.bulk_Pa, "the bulk modulus of a foam follows from its constants; omit it");
  const UnitSystem& units = unit_system(options.units);
  CardNumbers numbers;
  for (Eigen::Index i = 0; i < law.mu_Pa.size(); ++i)
    numbers.foam.push_back({to_card(law.mu_Pa[i], units.stress_exponent), law.alpha[i], law.nu[i]});
  numbers.shear = to_card(shear_modulus_Pa(law), units.stress_exponent);
  numbers.bulk = to_card(bulk_modulus_Pa(law), units.stress_exponent);
  return written(numbers, target, units, options, "30 kg/m3");
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
  const CardTarget& target = law_target(options.target);
  const UnitSystem& units = unit_system(options.units);
  const auto in_card = [&](double stress_Pa) { return to_card(stress_Pa, units.stress_exponent); };
  CardNumbers numbers;
  numbers.form = law.form;
  numbers.shapes.assign(law.shapes.begin(), law.shapes.end());
  for (const double modulus_Pa : law.moduli_Pa) numbers.moduli.push_back(in_card(modulus_Pa));
  numbers.shear = in_card(youngs_modulus_Pa(law) / 3.0);
  if (options.bulk_Pa) {
    require_positive("the bulk modulus", *options.bulk_Pa, "Pa");
    numbers.bulk = in_card(*options.bulk_Pa);
  } else if (!target.laws->may_be_incompressible) {
    numbers.bulk = kUsualBulkRatio * numbers.shear;
  }
  for (const RubberTerm& term : terms)
    numbers.branches.push_back({term.g, 0.0, to_card(term.tau_s, units.time_exponent)});
  if (target.laws->keywords.of(law.form).empty()) {
    std::vector<std::string> others;
    for (const HyperelasticForm form : hyperelastic_forms()) {
      if (!target.laws->keywords.of(form).empty()) others.push_back(name_of(form));
    }
    throw std::invalid_argument(
        target.name + " has no " + name_of(law.form) +
        " law; fit one that it has with viscard fit --model: " + between_commas(others));
  }
  require_terms_taken(numbers, target, options.may_approximate);
  if (damage) {
    require_damage_taken(law.form, target);
    numbers.damage = {damage->r, in_card(damage->m_Pa), damage->beta};
  }
  return written(numbers, target, units, options, "1.1 g/cm3");
}

}  // namespace viscard
