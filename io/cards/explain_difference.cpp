#include "io/cards/check_card.h"
#include "io/cards/known_mistakes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

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

// Largest relative difference among the numbers that the target states.
double mismatch(const CardNumbers& one, const CardNumbers& other, const CardTarget& target) {
  double worst = branch_mismatch(one, other, target);
  const auto compare = [&](double CardNumbers::*member) {
    worst = std::max(worst, mismatch(one.*member, other.*member));
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
  std::vector<const CardMistake*> mistakes;
};

Best best_explanation(const std::vector<CardMistake>& list, const CardNumbers& found,
                      const CardNumbers& expected, const CardTarget& target) {
  Best best;
  const auto consider = [&](const CardNumbers& numbers, std::vector<const CardMistake*> mistakes) {
    const double off = mismatch(found, numbers, target);
    // Two mistakes must explain much better than one.
    const double penalty =
        mistakes.size() > best.mistakes.size() && !best.mistakes.empty() ? 10.0 : 1.0;
    if (off * penalty < best.mismatch) best = {off, std::move(mistakes)};
  };
  for (const CardMistake& one : list) {
    CardNumbers numbers = expected;
    one.plant(numbers);
    consider(numbers, {&one});
  }
  if (best.mismatch <= kHandTyped) return best;
  for (const CardMistake& one : list) {
    for (const CardMistake& two : list) {
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
  const CardContext context{with_bulk_rule(reference, read.understood.bulk), read.understood,
                            read.units};
  const CardNumbers expected = context.as(context.target);
  if (are_terms_swapped(read.numbers, expected, context.target)) {
    return {{"terms-swapped",
             "the shares and the times are right, but paired with the wrong partner", true}};
  }
  const std::vector<CardMistake> list = known_mistakes(context);
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
  for (const CardMistake* mistake : best.mistakes) {
    findings.push_back({mistake->name, mistake->text, true});
  }
  return findings;
}

}  // namespace viscard
