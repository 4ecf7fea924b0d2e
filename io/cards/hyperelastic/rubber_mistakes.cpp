#include "io/cards/hyperelastic/rubber_mistakes.h"

#include "io/cards/law_numbers.h"
#include "io/cards/list_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace viscard {
namespace {

std::vector<RubberTerm> in_order(std::vector<RubberTerm> terms) {
  std::sort(terms.begin(), terms.end(),
            [](const RubberTerm& a, const RubberTerm& b) { return a.tau_s < b.tau_s; });
  return terms;
}

// A number of a law by name, with both values.
struct RubberPair {
  std::string name;
  double found = 0.0, expected = 0.0;
};

// Of two foams; empty if one is none, or their numbers of terms differ.
std::vector<RubberPair> foam_pairs(const RubberParts& found, const RubberParts& expected) {
  std::vector<RubberPair> out;
  if (!found.foam || !expected.foam || found.foam->mu_Pa.size() != expected.foam->mu_Pa.size())
    return out;
  for (Eigen::Index i = 0; i < found.foam->mu_Pa.size(); ++i) {
    out.push_back({fmt::format("mu_{}_Pa", i + 1), found.foam->mu_Pa[i], expected.foam->mu_Pa[i]});
    out.push_back({fmt::format("alpha_{}", i + 1), found.foam->alpha[i], expected.foam->alpha[i]});
    out.push_back({fmt::format("nu_{}", i + 1), found.foam->nu[i], expected.foam->nu[i]});
  }
  if (expected.density_kg_m3 > 0.0)
    out.push_back({"density", found.density_kg_m3, expected.density_kg_m3});
  return out;
}

// Empty if law or number of terms differ.
std::vector<RubberPair> pairs_between(const RubberParts& found, const RubberParts& expected) {
  std::vector<RubberPair> out;
  if (found.foam || expected.foam) return foam_pairs(found, expected);
  if (found.law.form != expected.law.form || found.terms.size() != expected.terms.size() ||
      found.damage.has_value() != expected.damage.has_value())
    return out;
  const auto moduli = modulus_names(found.law.form), shapes = shape_names(found.law.form);
  for (Eigen::Index i = 0; i < found.law.moduli_Pa.size(); ++i)
    out.push_back(
        {moduli[static_cast<std::size_t>(i)], found.law.moduli_Pa[i], expected.law.moduli_Pa[i]});
  for (Eigen::Index i = 0; i < found.law.shapes.size(); ++i)
    out.push_back(
        {shapes[static_cast<std::size_t>(i)], found.law.shapes[i], expected.law.shapes[i]});
  const auto a = in_order(found.terms), b = in_order(expected.terms);
  for (std::size_t i = 0; i < a.size(); ++i) {
    out.push_back({fmt::format("g_{}", i + 1), a[i].g, b[i].g});
    out.push_back({fmt::format("tau_{}_s", i + 1), a[i].tau_s, b[i].tau_s});
  }
  if (expected.damage) {
    out.push_back({"r", found.damage->r, expected.damage->r});
    out.push_back({"m_Pa", found.damage->m_Pa, expected.damage->m_Pa});
    out.push_back({"beta", found.damage->beta, expected.damage->beta});
  }
  if (expected.poisson != 0.0)
    out.push_back({"Poisson's ratio", found.poisson, expected.poisson});
  else if (expected.bulk_Pa)
    out.push_back({"bulk modulus", found.bulk_Pa.value_or(0.0), *expected.bulk_Pa});
  if (expected.density_kg_m3 > 0.0)
    out.push_back({"density", found.density_kg_m3, expected.density_kg_m3});
  return out;
}

// A common mistake, as a change of the right numbers.
struct RubberMistake {
  std::string name, text;
  std::function<void(RubberParts&)> plant;
};

void scale_law(RubberParts& parts, double factor) {
  if (parts.foam) parts.foam->mu_Pa *= factor;
  parts.law.moduli_Pa *= factor;
}

void add_basis_mistakes(std::vector<RubberMistake>& list) {
  list.push_back({"long-term-for-instantaneous",
                  "the law after all relaxation stands where the solver takes the law at once",
                  [](RubberParts& p) { scale_law(p, 1.0 - sum_of_shares(p.terms)); }});
  list.push_back({"instantaneous-for-long-term",
                  "the law at once stands where the solver takes the law after all relaxation (in "
                  "Abaqus without MODULI=INSTANTANEOUS)",
                  [](RubberParts& p) { scale_law(p, 1.0 / (1.0 - sum_of_shares(p.terms))); }});
  list.push_back({"branches-on-top",
                  "the branches stand beside the whole law at once instead of what is left of it "
                  "(g0 of FEBio at 1, or G_i beside the law at once in LS-DYNA)",
                  [](RubberParts& p) {
                    const double whole = 1.0 + sum_of_shares(p.terms);
                    scale_law(p, whole);
                    for (RubberTerm& term : p.terms) term.g /= whole;
                  }});
  list.push_back({"g-of-long-term", "the shares g are those of the law after all relaxation",
                  [](RubberParts& p) {
                    const double rest = 1.0 - sum_of_shares(p.terms);
                    for (RubberTerm& term : p.terms) term.g /= rest;
                  }});
}

void add_term_mistakes(const UnitSystem& units, std::vector<RubberMistake>& list) {
  list.push_back(
      {"tau-for-beta", "the times stand as 1/tau, or the reverse", [&units](RubberParts& p) {
         for (RubberTerm& term : p.terms) {
           const double in_card = to_card(term.tau_s, units.time_exponent);
           term.tau_s = from_card(1.0 / in_card, units.time_exponent);
         }
       }});
  list.push_back(
      {"terms-swapped", "the shares are paired with the wrong times", [](RubberParts& p) {
         p.terms = in_order(p.terms);
         std::vector<double> shares;
         for (const RubberTerm& term : p.terms) shares.push_back(term.g);
         std::reverse(shares.begin(), shares.end());
         for (std::size_t i = 0; i < shares.size(); ++i) p.terms[i].g = shares[i];
       }});
  list.push_back(
      {"g-and-tau-exchanged", "g and tau stand in the wrong order", [&units](RubberParts& p) {
         for (RubberTerm& term : p.terms) {
           const double g = term.g;
           term.g = to_card(term.tau_s, units.time_exponent);
           term.tau_s = from_card(g, units.time_exponent);
         }
       }});
}

void add_law_mistakes(HyperelasticForm form, const std::string& target,
                      std::vector<RubberMistake>& list) {
  if (form == HyperelasticForm::kYeoh && target == "febio") {
    list.push_back(
        {"yeoh-of-older-febio",
         "c_i of 'Yeoh' are C_i0, which FEBio took before 2023; since then (run in 4.11) it "
         "takes i C_i0, so that the law is too soft at large stretch (27 % at 2 for typical "
         "constants); write it as 'uncoupled hyperelastic' with W, which is right in both",
         [](RubberParts& p) {
           for (Eigen::Index i = 0; i < p.law.moduli_Pa.size(); ++i)
             p.law.moduli_Pa[i] /= static_cast<double>(i + 1);
         }});
  }
  if (is_ogden(form)) {
    const auto by_alpha = [](double power, double factor) {
      return [power, factor](RubberParts& p) {
        for (Eigen::Index i = 0; i < p.law.moduli_Pa.size(); ++i)
          p.law.moduli_Pa[i] *= factor * std::pow(p.law.shapes[i], power);
      };
    };
    list.push_back({"ogden-own-constants",
                    "the constants are Ogden's own, 2 mu/alpha, where the solver takes mu",
                    by_alpha(-1.0, 2.0)});
    list.push_back(
        {"ogden-shear-moduli",
         "the constants are shear moduli mu, where the solver takes Ogden's own, 2 mu/alpha",
         by_alpha(1.0, 0.5)});
  }
  list.push_back({"order-exchanged", "the constants stand in the reverse order",
                  [](RubberParts& p) { p.law.moduli_Pa.reverseInPlace(); }});
  list.push_back({"double-constants",
                  "the constants are twice the right ones: shear moduli for C10, or c for mu",
                  [](RubberParts& p) { scale_law(p, 2.0); }});
  list.push_back({"half-constants",
                  "the constants are half the right ones: C10 for a shear modulus, or mu for c",
                  [](RubberParts& p) { scale_law(p, 0.5); }});
  if (form == HyperelasticForm::kArrudaBoyce) {
    list.push_back({"N-for-s_m", "the limit is N = s_m^2, where the solver takes s_m",
                    [](RubberParts& p) { p.law.shapes[0] *= p.law.shapes[0]; }});
    list.push_back({"s_m-for-N", "the limit is s_m, where the solver takes N = s_m^2",
                    [](RubberParts& p) { p.law.shapes[0] = std::sqrt(p.law.shapes[0]); }});
  }
}

void add_damage_mistakes(const UnitSystem& units, std::vector<RubberMistake>& list) {
  list.push_back({"damage-order-exchanged",
                  "m and beta of the damage stand in the wrong order (Abaqus takes r, m, beta, "
                  "OpenRadioss R, beta, m)",
                  [&units](RubberParts& p) {
                    const double m = to_card(p.damage->m_Pa, units.stress_exponent);
                    p.damage->m_Pa = from_card(p.damage->beta, units.stress_exponent);
                    p.damage->beta = m;
                  }});
  list.push_back({"one-over-r", "1/r, the largest damage, stands where the solver takes r",
                  [](RubberParts& p) { p.damage->r = 1.0 / p.damage->r; }});
  for (const UnitSystem& other : unit_systems()) {
    const int shift = other.stress_exponent - units.stress_exponent;
    if (shift == 0) continue;
    list.push_back({"damage-unit", fmt::format("m of the damage is in the unit of {}", other.name),
                    [shift](RubberParts& p) { p.damage->m_Pa = to_card(p.damage->m_Pa, shift); }});
  }
}

void add_volume_and_unit_mistakes(const UnitSystem& units, std::vector<RubberMistake>& list) {
  list.push_back({"K-for-D", "the bulk modulus stands where the solver takes D = 2/K",
                  [&units](RubberParts& p) {
                    if (!p.bulk_Pa || *p.bulk_Pa == 0.0) return;
                    const double in_card = to_card(*p.bulk_Pa, units.stress_exponent);
                    p.bulk_Pa = from_card(2.0 / in_card, units.stress_exponent);
                  }});
  list.push_back({"D-without-2", "D is 1/K, where the solver takes 2/K", [](RubberParts& p) {
                    if (p.bulk_Pa) *p.bulk_Pa *= 2.0;
                  }});
  for (const UnitSystem& other : unit_systems()) {
    const int shift = other.stress_exponent - units.stress_exponent;
    if (shift == 0) continue;
    list.push_back({"stress-unit", fmt::format("the moduli are in the unit of {}", other.name),
                    [shift](RubberParts& p) {
                      scale_law(p, to_card(1.0, shift));
                      if (p.damage) p.damage->m_Pa = to_card(p.damage->m_Pa, shift);
                      if (p.bulk_Pa) p.bulk_Pa = to_card(*p.bulk_Pa, shift);
                    }});
  }
  for (const int shift : {3, -3}) {
    list.push_back({"time-unit", "the times are in another unit of time", [shift](RubberParts& p) {
                      for (RubberTerm& term : p.terms) term.tau_s = to_card(term.tau_s, shift);
                    }});
  }
}

void add_foam_mistakes(std::vector<RubberMistake>& list) {
  list.push_back(
      {"foam-own-constants",
       "the constants are 2 mu/alpha (as in ANSYS and LS-DYNA), where the solver takes mu",
       [](RubberParts& p) { p.foam->mu_Pa.array() *= 2.0 / p.foam->alpha.array(); }});
  list.push_back({"foam-shear-moduli",
                  "the constants are shear moduli mu, where the solver takes 2 mu/alpha",
                  [](RubberParts& p) { p.foam->mu_Pa.array() *= p.foam->alpha.array() / 2.0; }});
  list.push_back(
      {"beta-for-nu", "beta = nu/(1 - 2 nu) stands where the solver takes nu", [](RubberParts& p) {
         for (double& nu : p.foam->nu) nu = nu / (1.0 - 2.0 * nu);
       }});
  list.push_back(
      {"nu-for-beta", "nu stands where the solver takes beta = nu/(1 - 2 nu)", [](RubberParts& p) {
         for (double& nu : p.foam->nu) nu = nu / (1.0 + 2.0 * nu);
       }});
}

}  // namespace

RubberParts in_form(RubberParts parts, HyperelasticForm wanted) {
  HyperelasticLaw& law = parts.law;
  if (law.form == wanted || is_ogden(law.form) || !is_ogden(wanted) || !has_ogden_form(law.form))
    return parts;
  const bool has_second = law.form == HyperelasticForm::kMooneyRivlin;
  law.moduli_Pa *= 2.0;
  law.shapes.resize(law.moduli_Pa.size());
  law.shapes[0] = 2.0;
  if (has_second) law.shapes[1] = -2.0;
  law.form = has_second ? HyperelasticForm::kOgden2 : HyperelasticForm::kOgden1;
  return parts;
}

double largest_mismatch(const RubberParts& found, const RubberParts& expected) {
  const auto pairs = pairs_between(found, expected);
  double worst = pairs.empty() ? 1.0 : 0.0;
  for (const RubberPair& pair : pairs)
    worst = std::max(worst, relative_mismatch(pair.found, pair.expected));
  return worst;
}

double sum_of_shares(const std::vector<RubberTerm>& terms) {
  double sum = 0.0;
  for (const RubberTerm& term : terms) sum += term.g;
  return sum;
}

std::vector<CardFinding> explained(const RubberParts& found, const RubberParts& expected,
                                   const std::string& target, const UnitSystem& units) {
  const auto name_of_parts = [](const RubberParts& parts) {
    return parts.foam ? foam_name(parts.foam->mu_Pa.size()) : name_of(parts.law.form);
  };
  const std::string found_name = name_of_parts(found), expected_name = name_of_parts(expected);
  if (found_name != expected_name)
    return {{"other-law", "the card has the law " + found_name + ", not " + expected_name, true}};
  if (found.terms.size() != expected.terms.size())
    return {{"other-terms",
             fmt::format("the card has {} terms of relaxation, the law has {}", found.terms.size(),
                         expected.terms.size()),
             true}};
  if (found.damage.has_value() != expected.damage.has_value())
    return {{"other-damage",
             std::string(found.damage ? "the card has the damage by the first loading "
                                      : "the card lacks the damage by the first loading ") +
                 kMullinsName + (found.damage ? ", which the law has not" : " of the law"),
             true}};
  std::vector<RubberMistake> list;
  if (expected.damage) add_damage_mistakes(units, list);
  if (!expected.terms.empty()) {
    add_basis_mistakes(list);
    add_term_mistakes(units, list);
  }
  if (expected.foam) add_foam_mistakes(list);
  if (!expected.foam) add_law_mistakes(expected.law.form, target, list);
  add_volume_and_unit_mistakes(units, list);
  const RubberMistake* best = nullptr;
  double smallest = std::min(kHandTyped, 0.2 * largest_mismatch(found, expected));
  for (const RubberMistake& mistake : list) {
    RubberParts planted = expected;
    mistake.plant(planted);
    const double off = largest_mismatch(found, planted);
    if (off < smallest) {
      smallest = off;
      best = &mistake;
    }
  }
  if (best != nullptr) return {{best->name, best->text, true}};
  std::vector<RubberPair> pairs = pairs_between(found, expected);
  // Of a card with Poisson's ratio the bulk modulus shows what a small difference means.
  if (expected.poisson != 0.0 && expected.bulk_Pa && found.bulk_Pa)
    pairs.push_back({"so that the bulk modulus", *found.bulk_Pa, *expected.bulk_Pa});
  std::string text;
  for (const RubberPair& pair : pairs) {
    if (relative_mismatch(pair.found, pair.expected) <= 1e-6) continue;
    text += fmt::format(
        "{}{} is {:.9g}, {}", text.empty() ? "" : "; ", pair.name, pair.found,
        pair.expected == 0.0
            ? "not 0" + std::string(pair.name == "bulk modulus" ? " (incompressible)" : "")
            : fmt::format("{:.6g} times the expected {:.9g}", pair.found / pair.expected,
                          pair.expected));
  }
  return {{"numbers-differ", text, true}};
}

}  // namespace viscard
