// Which mistake turns the material that was meant into the card that was found? Each known mistake
// is planted into the expected numbers; the one that reproduces the card is named.
#include "io/cards/check_card.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace viscard {
namespace {

// Digits a hand may leave out: numbers this close are the same number.
constexpr double kHandTyped = 2e-3;

struct Context {
  Material material;  // the reference under the target's bulk rule
  CardTarget target;
  UnitSystem units;

  CardNumbers as(const CardTarget& other) const {
    return numbers_from_material(material, other, units);
  }
};

struct Mistake {
  std::string name;
  std::string text;
  std::function<void(CardNumbers&)> plant;
};

double mismatch(double a, double b) {
  if (a == b) return 0.0;
  const double size = std::max(std::abs(a), std::abs(b));
  return std::isfinite(size) ? std::abs(a - b) / size : 1.0;
}

std::vector<CardBranch> by_time(std::vector<CardBranch> branches) {
  std::sort(branches.begin(), branches.end(), [](const CardBranch& a, const CardBranch& b) {
    return a.time != b.time ? a.time < b.time : a.shear < b.shear;
  });
  return branches;
}

double branch_mismatch(const CardNumbers& one, const CardNumbers& other, const CardTarget& target) {
  if (one.branches.size() != other.branches.size()) return 1.0;
  double worst = 0.0;
  const std::vector<CardBranch> a = by_time(one.branches), b = by_time(other.branches);
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max({worst, mismatch(a[i].shear, b[i].shear), mismatch(a[i].time, b[i].time)});
    if (target.bulk == BulkRule::kOwnNumbers)
      worst = std::max(worst, mismatch(a[i].bulk, b[i].bulk));
  }
  return worst;
}

// Largest relative difference of the numbers this target states.
double mismatch(const CardNumbers& one, const CardNumbers& other, const CardTarget& target) {
  double worst = branch_mismatch(one, other, target);
  const auto compare = [&](double CardNumbers::*member) {
    worst = std::max(worst, mismatch(one.*member, other.*member));
  };
  switch (target.elastic) {
    case ElasticForm::kYoungPoisson:
      compare(&CardNumbers::young);
      compare(&CardNumbers::poisson);
      break;
    case ElasticForm::kBulkShear:
      compare(&CardNumbers::bulk);
      compare(&CardNumbers::shear);
      break;
    case ElasticForm::kBulkOnly:
      compare(&CardNumbers::bulk);
      break;
    case ElasticForm::kPoissonOnly:
      compare(&CardNumbers::poisson);
      break;
  }
  if (target.states_equilibrium) compare(&CardNumbers::equilibrium);
  if (one.density > 0.0 && other.density > 0.0) compare(&CardNumbers::density);
  return worst;
}

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

void add_elastic_mistakes(const Context& context, std::vector<Mistake>& list) {
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

void add_branch_mistakes(const Context& context, std::vector<Mistake>& list) {
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

void add_time_mistakes(const Context& context, std::vector<Mistake>& list) {
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

void add_order_mistakes(std::vector<Mistake>& list) {
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

void add_unit_mistakes(const Context& context, std::vector<Mistake>& list) {
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

// The right shares and the right times, but not with each other.
bool are_terms_swapped(const CardNumbers& found, const CardNumbers& expected,
                       const CardTarget& target) {
  if (found.branches.size() != expected.branches.size()) return false;
  CardNumbers paired = expected;
  std::vector<CardBranch> by_share = found.branches;
  const auto less = [](const CardBranch& a, const CardBranch& b) { return a.shear < b.shear; };
  std::sort(by_share.begin(), by_share.end(), less);
  std::sort(paired.branches.begin(), paired.branches.end(), less);
  std::vector<double> times, wanted;
  for (std::size_t i = 0; i < by_share.size(); ++i) {
    times.push_back(by_share[i].time);
    wanted.push_back(paired.branches[i].time);
    by_share[i].time = paired.branches[i].time;
  }
  std::sort(times.begin(), times.end());
  std::sort(wanted.begin(), wanted.end());
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (mismatch(times[i], wanted[i]) > kHandTyped) return false;
  }
  CardNumbers regrouped = found;
  regrouped.branches = by_share;
  const double off = mismatch(regrouped, expected, target);
  return off <= kHandTyped && off <= 0.2 * mismatch(found, expected, target);
}

struct Best {
  double mismatch = std::numeric_limits<double>::infinity();
  std::vector<const Mistake*> mistakes;
};

Best best_explanation(const std::vector<Mistake>& list, const CardNumbers& found,
                      const CardNumbers& expected, const CardTarget& target) {
  Best best;
  const auto consider = [&](const CardNumbers& numbers, std::vector<const Mistake*> mistakes) {
    const double off = mismatch(found, numbers, target);
    // Two mistakes must explain much better than one.
    const double penalty =
        mistakes.size() > best.mistakes.size() && !best.mistakes.empty() ? 10.0 : 1.0;
    if (off * penalty < best.mismatch) best = {off, std::move(mistakes)};
  };
  for (const Mistake& one : list) {
    CardNumbers numbers = expected;
    one.plant(numbers);
    consider(numbers, {&one});
  }
  if (best.mismatch <= kHandTyped) return best;
  for (const Mistake& one : list) {
    for (const Mistake& two : list) {
      if (one.name == two.name) continue;
      CardNumbers numbers = expected;
      one.plant(numbers);
      two.plant(numbers);
      consider(numbers, {&one, &two});
    }
  }
  return best;
}

}  // namespace

std::vector<CardFinding> explain_difference(const ReadCard& read, const Material& reference) {
  const Context context{with_bulk_rule(reference, read.understood.bulk), read.understood,
                        read.units};
  const CardNumbers expected = context.as(context.target);
  if (are_terms_swapped(read.numbers, expected, context.target)) {
    return {{"terms-swapped",
             "the shares and the times are right, but paired with the wrong partner", true}};
  }
  std::vector<Mistake> list;
  add_unit_mistakes(context, list);
  add_elastic_mistakes(context, list);
  add_branch_mistakes(context, list);
  add_time_mistakes(context, list);
  add_order_mistakes(list);
  const Best best = best_explanation(list, read.numbers, expected, context.target);
  const double plain = mismatch(read.numbers, expected, context.target);
  if (best.mismatch > kHandTyped || best.mismatch > 0.2 * plain) {
    if (plain > kHandTyped) return {};
    return {
        {"rounded",
         "the numbers are the material's, with fewer digits; --tolerance accepts the difference",
         false}};
  }
  std::vector<CardFinding> findings;
  for (const Mistake* mistake : best.mistakes) {
    findings.push_back({mistake->name, mistake->text, true});
  }
  return findings;
}

}  // namespace viscard
