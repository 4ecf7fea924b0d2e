#include "io/cards/list_differences.h"

#include "models/maths/leading_number.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

struct Difference {
  std::string what;  // "E", "tau of the term 0.1945"
  double found = 0.0, expected = 0.0;
};

const char* share_word(const CardTarget& target) {
  return target.branch == BranchNumber::kRelative        ? "g"
         : target.branch == BranchNumber::kAbsoluteShear ? "G"
                                                         : "E_i";
}

const char* time_word(const CardTarget& target) {
  return target.time == TimeNumber::kTau ? "tau" : target.time == TimeNumber::kBeta ? "beta" : "A";
}

bool is_same_branch(const CardBranch& a, const CardBranch& b, const CardTarget& target) {
  const bool has_bulk = target.bulk == BulkRule::kOwnNumbers;
  return relative_mismatch(a.shear, b.shear) <= kHandTyped &&
         relative_mismatch(a.time, b.time) <= kHandTyped &&
         (!has_bulk || relative_mismatch(a.bulk, b.bulk) <= kHandTyped);
}

// Branches of one side without a partner on the other.
struct Unpaired {
  std::vector<CardBranch> found, expected;
};

Unpaired unpaired(const CardNumbers& found, const CardNumbers& expected, const CardTarget& target) {
  Unpaired rest{found.branches, {}};
  for (const CardBranch& branch : expected.branches) {
    const auto same = std::find_if(rest.found.begin(), rest.found.end(), [&](const CardBranch& b) {
      return is_same_branch(b, branch, target);
    });
    if (same == rest.found.end()) {
      rest.expected.push_back(branch);
    } else {
      rest.found.erase(same);
    }
  }
  return rest;
}

// The numbers outside the branches.
std::vector<Difference> elastic_differences(const CardNumbers& found, const CardNumbers& expected,
                                            const CardTarget& target,
                                            double tolerance = kHandTyped) {
  std::vector<Difference> out;
  const auto note_if_off = [&](const char* what, double a, double b) {
    if (relative_mismatch(a, b) > tolerance) out.push_back({what, a, b});
  };
  using enum ElasticForm;
  const ElasticForm form = target.elastic;
  if (form == kYoungPoisson) note_if_off("E", found.young, expected.young);
  if (form == kYoungPoisson || form == kPoissonOnly) {
    note_if_off("nu", found.poisson, expected.poisson);
  }
  if (form == kBulkShear || form == kBulkOnly) note_if_off("K", found.bulk, expected.bulk);
  if (form == kBulkShear) note_if_off("G", found.shear, expected.shear);
  if (target.states_equilibrium) {
    note_if_off("the share that never relaxes", found.equilibrium, expected.equilibrium);
  }
  if (found.density > 0.0 && expected.density > 0.0) {
    note_if_off("the density", found.density, expected.density);
  }
  return out;
}

void compare_branch(const CardBranch& found, const CardBranch& expected, const CardTarget& target,
                    std::vector<Difference>& out, double tolerance = kHandTyped) {
  const auto add = [&](const char* word, double a, double b) {
    if (relative_mismatch(a, b) <= tolerance) return;
    out.push_back({fmt::format("{} of the term {} = {:g}, {} = {:g}", word, share_word(target),
                               expected.shear, time_word(target), expected.time),
                   a, b});
  };
  add(share_word(target), found.shear, expected.shear);
  if (target.bulk == BulkRule::kOwnNumbers) add("k", found.bulk, expected.bulk);
  add(time_word(target), found.time, expected.time);
}

}  // namespace

std::string factor_of(double found, double expected) {
  const double factor = found / expected;
  if (!std::isfinite(factor)) return "";
  return fmt::format(", {:.{}g} times it", factor, std::abs(factor - 1.0) < 1e-4 ? 10 : 6);
}

namespace {

std::string difference_in_words(const Difference& difference) {
  // Six digits, or as many as show the difference.
  const bool is_small = relative_mismatch(difference.found, difference.expected) < 1e-4;
  return fmt::format("{} is {:.{}g} where {:.{}g} is expected{}", difference.what, difference.found,
                     is_small ? 12 : 6, difference.expected, is_small ? 12 : 6,
                     factor_of(difference.found, difference.expected));
}

// How many digits of a number are not trailing zeros, of fourteen; and the place of the last one.
struct WrittenDigits {
  int count = 0;
  double last_place = 0.0;
};

WrittenDigits written_digits(double value) {
  const std::string text = fmt::format("{:.13e}", std::abs(value));
  const std::size_t exponent = text.find('e'), last = text.find_last_not_of('0', exponent - 1);
  const int count = last <= 1 ? 1 : static_cast<int>(last);  // one is the decimal point
  const double power = leading_number(text.substr(exponent + 1));
  return {count, std::pow(10.0, power - count + 1)};
}

// True if a number is the other one with fewer digits, rounded or cut off.
bool is_rounding_of(double found, double expected) {
  if (relative_mismatch(found, expected) <= 1e-12) return true;
  const WrittenDigits digits = written_digits(found);
  return digits.count < written_digits(expected).count &&
         std::abs(found - expected) <= 1.001 * digits.last_place;
}

std::string differences_in_words(const std::vector<Difference>& all, std::string text = "") {
  constexpr std::size_t kInWords = 4;
  for (std::size_t i = 0; i < std::min(kInWords, all.size()); ++i) {
    text += (text.empty() ? "" : "; ") + difference_in_words(all[i]);
  }
  if (all.size() > kInWords) text += fmt::format("; and {} more", all.size() - kInWords);
  return text;
}

// A whole power of ten of at least ten, or its inverse.
bool is_power_of_ten(double ratio) {
  if (!(ratio > 0.0)) return false;
  const double exponent = std::log10(ratio), nearest = std::round(exponent);
  return nearest != 0.0 && std::abs(exponent - nearest) <= 1e-3;
}

std::vector<CardFinding> one_row_too_few(const CardNumbers& found, const CardNumbers& expected,
                                         const CardBranch& row, const CardTarget& target) {
  const std::string term = fmt::format("{} = {:g}, {} = {:g}", share_word(target), row.shear,
                                       time_word(target), row.time);
  const bool is_in_equilibrium =
      target.time == TimeNumber::kNortonA &&
      relative_mismatch(found.equilibrium, expected.equilibrium + row.shear) <= kHandTyped;
  if (is_in_equilibrium) {
    return {{"missing-creep",
             "the material of the share " + term + " has no *CREEP: it never relaxes", true}};
  }
  return {{"missing-row", "the term " + term + " is missing", true}};
}

// All numbers that are no rounding of the expected ones to fewer digits.
std::vector<Difference> unrounded(const CardNumbers& found, const CardNumbers& expected,
                                  const CardTarget& target) {
  constexpr double kSame = 1e-12;
  std::vector<Difference> all = elastic_differences(found, expected, target, kSame);
  const std::vector<CardBranch> ours = by_time(found.branches), wanted = by_time(expected.branches);
  for (std::size_t i = 0; i < std::min(ours.size(), wanted.size()); ++i) {
    compare_branch(ours[i], wanted[i], target, all, kSame);
  }
  std::erase_if(all, [](const Difference& one) { return is_rounding_of(one.found, one.expected); });
  return all;
}

}  // namespace

std::vector<CardBranch> by_time(std::vector<CardBranch> branches) {
  std::sort(branches.begin(), branches.end(), [](const CardBranch& a, const CardBranch& b) {
    return a.time != b.time ? a.time < b.time : a.shear < b.shear;
  });
  return branches;
}

double relative_mismatch(double a, double b) {
  if (a == b) return 0.0;
  const double size = std::max(std::abs(a), std::abs(b));
  return std::isfinite(size) ? std::abs(a - b) / size : 1.0;
}

std::vector<CardFinding> single_difference(const CardNumbers& found, const CardNumbers& expected,
                                           const CardTarget& target) {
  if (found.branches.empty() && !expected.branches.empty()) {
    return {{"missing-viscoelastic",
             "the card has no relaxing term, so the solver stays elastic; the material has " +
                 std::to_string(expected.branches.size()),
             true}};
  }
  const Unpaired rest = unpaired(found, expected, target);
  if (rest.found.empty() && rest.expected.size() == 1) {
    return one_row_too_few(found, expected, rest.expected[0], target);
  }
  std::vector<Difference> all = elastic_differences(found, expected, target);
  if (rest.expected.empty() && rest.found.size() == 1 && all.empty()) {
    const CardBranch& extra = rest.found[0];
    const bool is_doubled =
        std::any_of(expected.branches.begin(), expected.branches.end(),
                    [&](const CardBranch& b) { return is_same_branch(b, extra, target); });
    return {{is_doubled ? "doubled-row" : "extra-row",
             fmt::format("the term {} = {:g}, {} = {:g} {}", share_word(target), extra.shear,
                         time_word(target), extra.time,
                         is_doubled ? "is in the card twice" : "is not of the material"),
             true}};
  }
  if (rest.found.size() != rest.expected.size() || rest.found.size() > 1) return {};
  if (rest.found.size() == 1) compare_branch(rest.found[0], rest.expected[0], target, all);
  const bool has_own_finding =
      std::all_of(all.begin(), all.end(), [](const Difference& difference) {
        return difference.what == "nu" || difference.what == "the density";
      });
  if (all.size() != 1 || has_own_finding) return {};
  const Difference& one = all.front();
  if (is_power_of_ten(one.found / one.expected)) {
    return {{"one-number-unit", difference_in_words(one) + ": one number in another unit", true}};
  }
  return {{"one-number", difference_in_words(one) + "; all others are right", true}};
}

std::vector<CardFinding> edited_digits(const CardNumbers& found, const CardNumbers& expected,
                                       const CardTarget& target) {
  std::vector<Difference> all = unrounded(found, expected, target);
  std::erase_if(all, [](const Difference& one) {
    return one.what == "nu" || one.what == "the density";  // they have their own findings
  });
  if (all.empty()) return {};
  return {{all.size() == 1 ? "one-number" : "numbers-differ", differences_in_words(all), true}};
}

std::vector<CardFinding> near_numbers(const CardNumbers& found, const CardNumbers& expected,
                                      const CardTarget& target) {
  const std::vector<Difference> all = unrounded(found, expected, target);
  if (all.empty()) return {};
  return {{"digits-differ", differences_in_words(all) + "; within the tolerance", false}};
}

std::vector<CardFinding> listed_differences(const CardNumbers& found, const CardNumbers& expected,
                                            const CardTarget& target) {
  std::vector<Difference> all = elastic_differences(found, expected, target);
  const Unpaired rest = unpaired(found, expected, target);
  std::string text;
  if (found.branches.size() != expected.branches.size()) {
    text = fmt::format("the card has {} and the material {}",
                       counted(found.branches.size(), "term"), expected.branches.size());
  }
  for (std::size_t i = 0; i < std::min(rest.found.size(), rest.expected.size()); ++i) {
    compare_branch(rest.found[i], rest.expected[i], target, all);
  }
  text = differences_in_words(all, text);
  if (text.empty()) return {};
  return {{"numbers-differ", text, true}};
}

}  // namespace viscard
