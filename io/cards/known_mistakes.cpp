#include "io/cards/known_mistakes.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Plant = std::function<void(CardNumbers&)>;

Plant moduli_times(double factor, const CardTarget& target) {
  const bool are_branches_moduli = target.branch != BranchNumber::kRelative;
  return [factor, are_branches_moduli](CardNumbers& n) {
    n.young *= factor;
    n.bulk *= factor;
    n.shear *= factor;
    if (!are_branches_moduli) return;
    n.equilibrium *= factor;
    for (CardBranch& branch : n.branches) branch.shear *= factor;
  };
}

Plant in_branches(const std::function<void(CardBranch&)>& change) {
  return [change](CardNumbers& n) {
    for (CardBranch& branch : n.branches) change(branch);
  };
}

Plant times_times(double factor) {
  return in_branches([factor](CardBranch& b) { b.time *= factor; });
}

Plant branches_of(const CardNumbers& other, double CardBranch::*member) {
  return [other, member](CardNumbers& n) {
    for (std::size_t i = 0; i < n.branches.size(); ++i) {
      n.branches[i].*member = other.branches[i].*member;
    }
  };
}

// The elastic numbers at the other end of the relaxation.
void add_modulus_mistake(const CardContext& context, const CardNumbers& other,
                         std::vector<CardMistake>& list) {
  const ElasticForm elastic = context.target.elastic;
  if (elastic != ElasticForm::kYoungPoisson && elastic != ElasticForm::kBulkShear) return;
  const bool is_long_term = context.target.at == ModulusAt::kLongTerm;
  list.push_back(
      {is_long_term ? "instantaneous-modulus-as-long-term" : "long-term-modulus-as-instantaneous",
       is_long_term
           ? "the elastic modulus is the instantaneous one; this field wants the long-term one"
           : "the elastic modulus is the long-term one; this field wants the instantaneous one",
       [other](CardNumbers& n) {
         n.young = other.young;
         n.poisson = other.poisson;
         n.bulk = other.bulk;
         n.shear = other.shear;
       }});
  // The same with the Poisson ratio of the right end: only the modulus was mistaken.
  CardMistake young_alone = list.back();
  young_alone.plant = [other](CardNumbers& n) { n.young = other.young; };
  if (elastic == ElasticForm::kYoungPoisson) list.push_back(young_alone);
}

void add_equilibrium_mistake(const CardContext& context, const CardNumbers& expected,
                             std::vector<CardMistake>& list) {
  if (context.target.branch == BranchNumber::kRelative) {
    list.push_back({"g0-left-at-1",
                    "g0 is 1 beside the instantaneous modulus: everything is too stiff by (1 + sum "
                    "g); write g0 = 1 - sum g",
                    [](CardNumbers& n) { n.equilibrium = 1.0; }});
    return;
  }
  double sum = 0.0;
  for (const CardBranch& branch : expected.branches) sum += branch.shear;
  list.push_back({"instantaneous-as-equilibrium",
                  "the equilibrium branch carries the instantaneous modulus; the other branches "
                  "come on top of it",
                  [sum](CardNumbers& n) { n.equilibrium += sum; }});
}

void add_elastic_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  const CardTarget& target = context.target;
  CardTarget flipped = target;
  flipped.at = target.at == ModulusAt::kLongTerm ? ModulusAt::kInstantaneous : ModulusAt::kLongTerm;
  const CardNumbers expected = context.as(target), other = context.as(flipped);
  add_modulus_mistake(context, other, list);
  const double nu = context.material.nu;
  list.push_back({"plane-strain-modulus",
                  "the modulus is E/(1 - nu^2), the plane-strain modulus an indenter sees, not E",
                  moduli_times(1.0 / (1.0 - nu * nu), target)});
  list.push_back({"G-for-E", "the shear modulus stands where Young's modulus belongs",
                  [](CardNumbers& n) { n.young = n.shear; }});
  list.push_back({"E-for-G", "Young's modulus stands where the shear modulus belongs",
                  [](CardNumbers& n) { n.shear = n.young; }});
  for (const double young : {expected.young, other.young}) {
    list.push_back({"E-for-K", "Young's modulus stands where the bulk modulus belongs",
                    [young](CardNumbers& n) { n.bulk = young; }});
  }
  if (target.states_equilibrium) add_equilibrium_mistake(context, expected, list);
}

// The letter of a branch number in the names of mistakes.
const char* letter_of(BranchNumber branch) {
  return branch == BranchNumber::kRelative        ? "g"
         : branch == BranchNumber::kAbsoluteShear ? "G"
                                                  : "E_i";
}

void add_branch_number_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  const BranchNumber own = context.target.branch;
  for (const BranchNumber branch :
       {BranchNumber::kRelative, BranchNumber::kAbsoluteShear, BranchNumber::kAbsoluteYoung}) {
    if (branch == own) continue;
    CardTarget changed = context.target;
    changed.branch = branch;
    const CardNumbers numbers = context.as(changed);
    const std::string letter = letter_of(branch), wanted = letter_of(own);
    const std::string name = letter + "-for-" + wanted;
    const std::string text = "the branches carry " + letter + " where this field wants " + wanted +
                             " (" + to_word(own) + ")";
    const Plant shares = branches_of(numbers, &CardBranch::shear);
    list.push_back({name, text, shares});
    if (!context.target.states_equilibrium) continue;
    list.push_back({name, text + ", the equilibrium one too", [numbers, shares](CardNumbers& n) {
                      shares(n);
                      n.equilibrium = numbers.equilibrium;
                    }});
  }
}

void add_branch_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  add_branch_number_mistakes(context, list);
  double rest = 1.0;
  for (const MaterialTerm& term : context.material.terms) rest -= term.g;
  if (context.target.branch == BranchNumber::kRelative) {
    list.push_back({"g-relative-to-long-term",
                    "the g_i are relative to the long-term modulus; this field wants them relative "
                    "to the instantaneous one",
                    in_branches([rest](CardBranch& b) {
                      b.shear /= rest;
                      b.bulk /= rest;
                    })});
  }
  if (context.target.bulk != BulkRule::kOwnNumbers) return;
  list.push_back({"bulk-left-out",
                  "k_i is 0: the bulk modulus stays constant, unlike the material's",
                  in_branches([](CardBranch& b) { b.bulk = 0.0; })});
  list.push_back({"bulk-as-shear",
                  "k_i equals g_i: the bulk modulus relaxes, unlike the material's",
                  in_branches([](CardBranch& b) { b.bulk = b.shear; })});
}

void add_norton_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  const double shear_per_young = 0.5 / (1.0 + context.material.nu);
  list.push_back(
      {"A-without-3", "A is 1/(G tau); the von Mises stress wants 1/(3 G tau)", times_times(3.0)});
  list.push_back({"A-from-E", "A is 1/(3 E tau); it wants the shear modulus, 1/(3 G tau)",
                  times_times(shear_per_young)});
  list.push_back(
      {"A-from-E", "A is 1/(E tau); it wants 1/(3 G tau)", times_times(3.0 * shear_per_young)});
}

void add_time_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  const TimeNumber own = context.target.time;
  const std::string wanted = own == TimeNumber::kTau    ? "tau"
                             : own == TimeNumber::kBeta ? "beta"
                                                        : "A";
  for (const TimeNumber time : {TimeNumber::kTau, TimeNumber::kBeta}) {
    if (time == own) continue;
    const std::string letter = time == TimeNumber::kTau ? "tau" : "beta";
    CardTarget changed = context.target;
    changed.time = time;
    list.push_back({letter + "-for-" + wanted,
                    "the times are " + letter + " where this field wants " + to_word(own),
                    branches_of(context.as(changed), &CardBranch::time)});
  }
  // tau in ms is 1000 times that in s; 1/tau and A are smaller.
  const double in_ms = own == TimeNumber::kTau ? 1e3 : 1e-3;
  if (context.units.time_exponent == 3) {
    list.push_back(
        {"time-in-s", "the times are in s; the unit system wants ms", times_times(1.0 / in_ms)});
  } else {
    list.push_back(
        {"time-in-ms", "the times are in ms; the unit system wants s", times_times(in_ms)});
  }
  for (const double factor : {1e-3, 1e3}) {
    const bool is_short = (factor < 1.0) == (own == TimeNumber::kTau);
    list.push_back(
        {"time-unit",
         fmt::format("the times are too {} by a factor of 1000", is_short ? "short" : "long"),
         times_times(factor)});
  }
  if (own == TimeNumber::kNortonA) add_norton_mistakes(context, list);
}

void add_order_mistakes(std::vector<CardMistake>& list) {
  const char* name = "columns-swapped";
  list.push_back({name, "share and time have changed places in the rows",
                  in_branches([](CardBranch& b) { std::swap(b.shear, b.time); })});
  list.push_back({name, "the rows are g, tau, k; they must be g, k, tau",
                  in_branches([](CardBranch& b) { std::swap(b.bulk, b.time); })});
  list.push_back(
      {name, "the rows are tau, g, k; they must be g, k, tau", in_branches([](CardBranch& b) {
         b = {b.time, b.shear, b.bulk};
       })});
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
    list.push_back({"stress-unit", "the moduli are off by 10^" + std::to_string(power),
                    moduli_times(std::pow(10.0, power), context.target)});
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
  if (context.target.add_mistakes != nullptr) context.target.add_mistakes(context, list);
  add_branch_mistakes(context, list);
  add_time_mistakes(context, list);
  add_order_mistakes(list);
  return list;
}

}  // namespace viscard
