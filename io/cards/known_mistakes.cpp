#include "io/cards/known_mistakes.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace viscard {
namespace {

void scale_moduli(CardNumbers& numbers, const CardTarget& target, double factor) {
  numbers.young *= factor;
  numbers.bulk *= factor;
  numbers.shear *= factor;
  if (target.branch == BranchNumber::kRelative) return;
  numbers.equilibrium *= factor;
  for (CardBranch& branch : numbers.branches) branch.shear *= factor;
}

void scale_times(CardNumbers& numbers, double factor) {
  for (CardBranch& branch : numbers.branches) branch.time *= factor;
}

void copy_shear(CardNumbers& numbers, const CardNumbers& from) {
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    numbers.branches[i].shear = from.branches[i].shear;
  }
}

void copy_times(CardNumbers& numbers, const CardNumbers& from) {
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    numbers.branches[i].time = from.branches[i].time;
  }
}

void add_elastic_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  const CardTarget& target = context.target;
  CardTarget flipped = target;
  const bool is_long_term = target.at == ModulusAt::kLongTerm;
  flipped.at = is_long_term ? ModulusAt::kInstantaneous : ModulusAt::kLongTerm;
  const CardNumbers other = context.as(flipped);
  const bool is_abaqus = target.name == "abaqus";
  if (target.elastic == ElasticForm::kYoungPoisson || target.elastic == ElasticForm::kBulkShear) {
    list.push_back(
        {is_abaqus && is_long_term ? "E0-without-instantaneous"
         : is_long_term            ? "instantaneous-modulus-as-long-term"
                                   : "long-term-modulus-as-instantaneous",
         is_abaqus && is_long_term
             ? "E is the instantaneous modulus but *ELASTIC lacks MODULI=INSTANTANEOUS; "
               "Abaqus takes it for the long-term one"
         : is_long_term
             ? "the elastic modulus is the instantaneous one; this field wants the long-term "
               "one"
             : "the elastic modulus is the long-term one; this field wants the instantaneous "
               "one",
         [other](CardNumbers& n) {
           n.young = other.young;
           n.poisson = other.poisson;
           n.bulk = other.bulk;
           n.shear = other.shear;
         }});
  }
  const double nu = context.material.nu;
  list.push_back(
      {"plane-strain-modulus",
       "the modulus is E/(1 - nu^2), the plane-strain modulus an indenter sees, not E",
       [nu, target](CardNumbers& n) { scale_moduli(n, target, 1.0 / (1.0 - nu * nu)); }});
  if (target.name == "febio-uncoupled") {
    list.push_back({"G-for-c1",
                    "c1 is the shear modulus; c1 of a Mooney-Rivlin child is half of it",
                    [](CardNumbers& n) { n.shear *= 2.0; }});
  }
  list.push_back({"G-for-E", "the shear modulus stands where Young's modulus belongs",
                  [](CardNumbers& n) { n.young = n.shear; }});
  list.push_back({"E-for-G", "Young's modulus stands where the shear modulus belongs",
                  [](CardNumbers& n) { n.shear = n.young; }});
  for (const double young : {context.as(target).young, other.young}) {
    list.push_back({"E-for-K", "Young's modulus stands where the bulk modulus belongs",
                    [young](CardNumbers& n) { n.bulk = young; }});
  }
  if (!target.states_equilibrium) return;
  if (target.branch == BranchNumber::kRelative) {
    list.push_back(
        {"g0-left-at-1",
         "g0 is 1 beside the instantaneous modulus: everything is too stiff by (1 + sum g); "
         "write g0 = 1 - sum g",
         [](CardNumbers& n) { n.equilibrium = 1.0; }});
    return;
  }
  double sum = 0.0;
  const CardNumbers expected = context.as(target);
  for (const CardBranch& branch : expected.branches) sum += branch.shear;
  list.push_back(
      {"instantaneous-as-equilibrium",
       "the equilibrium branch carries the instantaneous modulus; the other branches come "
       "on top of it",
       [sum](CardNumbers& n) { n.equilibrium += sum; }});
  if (target.name == "lsdyna006") {
    list.push_back(
        {"branch-modulus-as-GI",
         "GI is the long-term shear modulus in 006; the branch modulus G0 - G_inf stands "
         "there (as in 076)",
         [](CardNumbers& n) {
           if (!n.branches.empty()) std::swap(n.equilibrium, n.branches[0].shear);
         }});
  }
}

void add_branch_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  struct Other {
    BranchNumber branch;
    const char* letter;
  };
  for (const Other& other :
       {Other{BranchNumber::kRelative, "g"}, Other{BranchNumber::kAbsoluteShear, "G"},
        Other{BranchNumber::kAbsoluteYoung, "E_i"}}) {
    const BranchNumber own = context.target.branch;
    if (other.branch == own) continue;
    const std::string wanted = own == BranchNumber::kRelative        ? "g"
                               : own == BranchNumber::kAbsoluteShear ? "G"
                                                                     : "E_i";
    CardTarget changed = context.target;
    changed.branch = other.branch;
    const CardNumbers numbers = context.as(changed);
    const std::string text = std::string("the branches carry ") + other.letter +
                             " where this field wants " + wanted + " (" + to_word(own) + ")";
    list.push_back({std::string(other.letter) + "-for-" + wanted, text,
                    [numbers](CardNumbers& n) { copy_shear(n, numbers); }});
    // COMSOL's expressions carry units: 0.008[MPa] where g was meant.
    for (const double unit : {1e3, 1e6, 1e9}) {
      if (context.target.name != "comsol" || other.branch != BranchNumber::kRelative) continue;
      list.push_back(
          {std::string(other.letter) + "-for-" + wanted, text, [numbers, unit](CardNumbers& n) {
             copy_shear(n, numbers);
             for (CardBranch& b : n.branches) b.shear *= unit;
           }});
    }
    if (context.target.states_equilibrium) {
      list.push_back({std::string(other.letter) + "-for-" + wanted,
                      text + ", the equilibrium one too", [numbers](CardNumbers& n) {
                        copy_shear(n, numbers);
                        n.equilibrium = numbers.equilibrium;
                      }});
    }
  }
  double rest = 1.0;
  for (const MaterialTerm& term : context.material.terms) rest -= term.g;
  if (context.target.branch == BranchNumber::kRelative) {
    list.push_back(
        {"g-relative-to-long-term",
         "the g_i are relative to the long-term modulus; this field wants them relative to "
         "the instantaneous one",
         [rest](CardNumbers& n) {
           for (CardBranch& b : n.branches) {
             b.shear /= rest;
             b.bulk /= rest;
           }
         }});
  }
  if (context.target.bulk != BulkRule::kOwnNumbers) return;
  list.push_back({"bulk-left-out",
                  "k_i is 0: the bulk modulus stays constant, unlike the material's",
                  [](CardNumbers& n) {
                    for (CardBranch& b : n.branches) b.bulk = 0.0;
                  }});
  list.push_back({"bulk-as-shear",
                  "k_i equals g_i: the bulk modulus relaxes, unlike the material's",
                  [](CardNumbers& n) {
                    for (CardBranch& b : n.branches) b.bulk = b.shear;
                  }});
}

void add_time_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  struct Other {
    TimeNumber time;
    const char* letter;
  };
  const TimeNumber own = context.target.time;
  const std::string wanted = own == TimeNumber::kTau    ? "tau"
                             : own == TimeNumber::kBeta ? "beta"
                                                        : "A";
  for (const Other& other : {Other{TimeNumber::kTau, "tau"}, Other{TimeNumber::kBeta, "beta"}}) {
    if (other.time == own) continue;
    CardTarget changed = context.target;
    changed.time = other.time;
    const CardNumbers numbers = context.as(changed);
    list.push_back(
        {std::string(other.letter) + "-for-" + wanted,
         std::string("the times are ") + other.letter + " where this field wants " + to_word(own),
         [numbers](CardNumbers& n) { copy_times(n, numbers); }});
  }
  // tau grows by 1000 when written in ms, 1/tau and A shrink.
  const double in_ms = own == TimeNumber::kTau ? 1e3 : 1e-3;
  const bool card_is_in_ms = context.units.time_exponent == 3;
  const std::string text = card_is_in_ms ? "the times are in s; the unit system wants ms"
                                         : "the times are in ms; the unit system wants s";
  list.push_back(
      {card_is_in_ms ? "time-in-s" : "time-in-ms", text, [in_ms, card_is_in_ms](CardNumbers& n) {
         scale_times(n, card_is_in_ms ? 1.0 / in_ms : in_ms);
       }});
  for (const double factor : {1e-3, 1e3}) {
    list.push_back(
        {"time-unit",
         fmt::format("the times are {} by a factor of 1000",
                     (factor < 1.0) == (own == TimeNumber::kTau) ? "too short" : "too long"),
         [factor](CardNumbers& n) { scale_times(n, factor); }});
  }
  if (own == TimeNumber::kNortonA) {
    list.push_back({"A-without-3", "A is 1/(G tau); the von Mises stress wants 1/(3 G tau)",
                    [](CardNumbers& n) { scale_times(n, 3.0); }});
    const double shear_per_young = 0.5 / (1.0 + context.material.nu);
    list.push_back({"A-from-E", "A is 1/(3 E tau); it wants the shear modulus, 1/(3 G tau)",
                    [shear_per_young](CardNumbers& n) { scale_times(n, shear_per_young); }});
    list.push_back({"A-from-E", "A is 1/(E tau); it wants 1/(3 G tau)",
                    [shear_per_young](CardNumbers& n) { scale_times(n, 3.0 * shear_per_young); }});
  }
}

void add_order_mistakes(std::vector<CardMistake>& list) {
  list.push_back(
      {"columns-swapped", "share and time have changed places in the rows", [](CardNumbers& n) {
         for (CardBranch& b : n.branches) std::swap(b.shear, b.time);
       }});
  list.push_back(
      {"columns-swapped", "the rows are g, tau, k; they must be g, k, tau", [](CardNumbers& n) {
         for (CardBranch& b : n.branches) std::swap(b.bulk, b.time);
       }});
  list.push_back(
      {"columns-swapped", "the rows are tau, g, k; they must be g, k, tau", [](CardNumbers& n) {
         for (CardBranch& b : n.branches) b = {b.time, b.shear, b.bulk};
       }});
}

void add_unit_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  for (const UnitSystem& system : unit_systems()) {
    if (std::string(system.name) == context.units.name) continue;
    const CardNumbers numbers = numbers_from_material(context.material, context.target, system);
    list.push_back(
        {"other-unit-system",
         std::string("all numbers are in ") + system.name + ", not in " + context.units.name,
         [numbers](CardNumbers& n) { n = numbers; }});
  }
  for (const int power : {-9, -6, -3, -1, 1, 3, 6, 9}) {
    const CardTarget target = context.target;
    list.push_back(
        {"stress-unit", "the moduli are off by 10^" + std::to_string(power),
         [power, target](CardNumbers& n) { scale_moduli(n, target, std::pow(10.0, power)); }});
  }
  for (int power = -18; power <= 18; power += 3) {
    if (power == 0) continue;
    list.push_back({"density-unit", "the density is off by 10^" + std::to_string(power),
                    [power](CardNumbers& n) { n.density *= std::pow(10.0, power); }});
  }
}

}  // namespace

std::vector<CardMistake> known_mistakes(const CardContext& context) {
  std::vector<CardMistake> list;
  add_unit_mistakes(context, list);
  add_elastic_mistakes(context, list);
  add_branch_mistakes(context, list);
  add_time_mistakes(context, list);
  add_order_mistakes(list);
  return list;
}

}  // namespace viscard
