#include "io/cards/check_card.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/list_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

double branch_mismatch(const CardNumbers& one, const CardNumbers& other, const CardTarget& target) {
  if (one.branches.size() != other.branches.size()) return 1.0;
  double worst = 0.0;
  const std::vector<CardBranch> a = by_time(one.branches), b = by_time(other.branches);
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max({worst, relative_mismatch(a[i].shear, b[i].shear),
                      relative_mismatch(a[i].time, b[i].time)});
    if (target.bulk == BulkRule::kOwnNumbers)
      worst = std::max(worst, relative_mismatch(a[i].bulk, b[i].bulk));
  }
  return worst;
}

// Largest relative difference among the numbers that the target states.
double mismatch(const CardNumbers& one, const CardNumbers& other, const CardTarget& target) {
  double worst = branch_mismatch(one, other, target);
  const auto compare = [&](double CardNumbers::*member) {
    worst = std::max(worst, relative_mismatch(one.*member, other.*member));
  };
  using enum ElasticForm;
  const ElasticForm elastic = target.elastic;
  if (elastic == kYoungPoisson) compare(&CardNumbers::young);
  if (elastic == kYoungPoisson || elastic == kPoissonOnly) compare(&CardNumbers::poisson);
  if (elastic == kBulkShear || elastic == kBulkOnly) compare(&CardNumbers::bulk);
  if (elastic == kBulkShear) compare(&CardNumbers::shear);
  if (target.states_equilibrium) compare(&CardNumbers::equilibrium);
  if (one.density > 0.0 && other.density > 0.0) compare(&CardNumbers::density);
  return worst;
}

// The shares and the times are right, but not their pairs.
bool are_terms_swapped(const CardNumbers& found, const CardNumbers& expected,
                       const CardTarget& target) {
  if (found.branches.size() != expected.branches.size()) return false;
  // With their own partners the numbers are right to three digits: nothing has changed places.
  if (branch_mismatch(found, expected, target) <= kHandTyped) return false;
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
    if (relative_mismatch(times[i], wanted[i]) > kHandTyped) return false;
  }
  CardNumbers regrouped = found;
  regrouped.branches = by_share;
  const double off = mismatch(regrouped, expected, target);
  return off <= kHandTyped && off <= 0.2 * mismatch(found, expected, target);
}

struct Best {
  double mismatch = std::numeric_limits<double>::infinity();
  std::vector<const CardMistake*> mistakes;
};

// The planted mistakes, one or two, whose numbers are nearest to those of the card.
Best best_explanation(const std::vector<CardMistake>& list, bool are_two, const CardNumbers& found,
                      const CardNumbers& expected, const CardTarget& target) {
  Best best;
  const auto consider = [&](const CardNumbers& numbers, std::vector<const CardMistake*> mistakes) {
    const double off = mismatch(found, numbers, target);
    if (off < best.mismatch) best = {off, std::move(mistakes)};
  };
  for (const CardMistake& one : list) {
    CardNumbers numbers = expected;
    one.plant(numbers);
    if (!are_two) {
      consider(numbers, {&one});
      continue;
    }
    for (const CardMistake& two : list) {
      if (one.name == two.name) continue;
      CardNumbers both = numbers;
      two.plant(both);
      consider(both, {&one, &two});
    }
  }
  return best;
}

std::vector<CardFinding> findings_of(const Best& best) {
  std::vector<CardFinding> findings;
  for (const CardMistake* mistake : best.mistakes) {
    findings.push_back({mistake->name, mistake->text, true});
  }
  return findings;
}

}  // namespace

std::vector<CardFinding> explain_difference(const ReadCard& read, const Material& reference) {
  const CardContext context{with_bulk_rule(reference, read.understood.bulk), read.understood,
                            read.units};
  const CardNumbers expected = context.as(context.target);
  if (are_terms_swapped(read.numbers, expected, context.target)) {
    return {{"terms-swapped",
             "the shares and the times are right, but paired with the wrong partner", true}};
  }
  const std::vector<CardMistake> list = known_mistakes(context);
  const double plain = mismatch(read.numbers, expected, context.target);
  const auto explains = [&](const Best& best) {
    return best.mismatch <= kHandTyped && best.mismatch <= 0.2 * plain;
  };
  const Best one = best_explanation(list, false, read.numbers, expected, context.target);
  if (explains(one)) return findings_of(one);
  if (plain <= kHandTyped) {
    auto edited = edited_digits(read.numbers, expected, context.target);
    if (!edited.empty()) return edited;
    return {
        {"rounded",
         "the numbers are the material's, with fewer digits; --tolerance accepts the difference",
         false}};
  }
  // A mistake that the reader found explains the numbers that follow from it.
  const bool has_cause = std::any_of(
      read.findings.begin(), read.findings.end(),
      [](const CardFinding& finding) { return finding.is_mistake && finding.name != "no-solid"; });
  if (has_cause) return {};
  std::vector<CardFinding> single = single_difference(read.numbers, expected, context.target);
  if (!single.empty()) return single;
  const Best two = best_explanation(list, true, read.numbers, expected, context.target);
  return explains(two) ? findings_of(two) : std::vector<CardFinding>{};
}

}  // namespace viscard
