// Cards that state no whole material (card_values.h), compared number by number.
#include "io/cards/card_form.h"
#include "io/cards/card_header.h"
#include "io/cards/card_values.h"
#include "io/cards/check_card.h"
#include "io/cards/list_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace viscard {
namespace {

double largest_value_mismatch(const std::vector<ValuePair>& pairs) {
  double largest = 0.0;
  for (const ValuePair& pair : pairs) {
    const double off = value_mismatch(pair);
    if (!(off <= largest)) largest = off;
  }
  return largest;
}

// A known factor between a value and the expected one.
std::string factor_in_words(double ratio) {
  struct Known {
    double factor;
    const char* words;
  };
  constexpr double kTurn = 2.0 * std::numbers::pi;
  static const Known kKnown[] = {{2.0, "twice: a loss factor is twice the damping ratio"},
                                 {0.5, "half: a damping ratio is half the loss factor"},
                                 {kTurn, "2 pi times: rad/s for Hz"},
                                 {1.0 / kTurn, "1/(2 pi) times: Hz for rad/s"}};
  for (const Known& known : kKnown) {
    if (relative_mismatch(ratio, known.factor) <= kHandTyped) return known.words;
  }
  const double power = ratio > 0.0 ? std::log10(ratio) : 0.5, whole = std::round(power);
  return whole != 0.0 && std::abs(power - whole) <= 1e-3
             ? fmt::format("off by 10^{:g}: another unit", whole)
             : "";
}

CardFinding finding_of(const std::vector<ValuePair>& wrong, std::size_t n_values) {
  std::string text;
  constexpr std::size_t kInWords = 4;
  for (std::size_t i = 0; i < std::min(kInWords, wrong.size()); ++i) {
    text += (text.empty() ? "" : "; ") + pair_in_words(wrong[i]);
  }
  if (wrong.size() > kInWords) text += fmt::format("; and {} more", wrong.size() - kInWords);
  const ValuePair& first = wrong.front();
  const bool are_both = first.found != nullptr && first.expected != nullptr;
  const std::string factor =
      are_both ? factor_in_words(first.found->value / first.expected->value) : "";
  if (!factor.empty()) text += " (" + factor + ")";
  const bool is_one = wrong.size() == 1 && n_values > 1;
  return {is_one && are_both ? "one-number"
          : is_one           ? "missing-number"
                             : "numbers-differ",
          text, true};
}

// Rows that a table over frequency has lost: its steps are equal, and its ends are those of its band.
std::optional<CardFinding> missing_rows(const std::string& text, const ReadCard& read) {
  const std::vector<double>& at_Hz = read.frequencies_Hz;
  if (read.understood.rows_per_decade == 0 || at_Hz.empty()) return std::nullopt;
  double step = HUGE_VAL;
  for (std::size_t row = 1; row < at_Hz.size(); ++row) {
    step = std::min(step, at_Hz[row] / at_Hz[row - 1]);
  }
  const auto finding = [](const std::string& where) {
    return CardFinding{"missing-rows", "the table has no rows " + where, true};
  };
  for (std::size_t row = 1; row < at_Hz.size(); ++row) {
    if (at_Hz[row] <= std::pow(step, 1.5) * at_Hz[row - 1]) continue;
    return finding(fmt::format("between {:.4g} and {:.4g} Hz", at_Hz[row - 1], at_Hz[row]));
  }
  const auto band = stated_band(text);
  if (!band) return std::nullopt;
  if (at_Hz.front() > 1.02 * band->from_Hz) {
    return finding(fmt::format("from {:.4g} Hz, where its band begins", band->from_Hz));
  }
  if (at_Hz.back() < band->to_Hz / 1.02) {
    return finding(fmt::format("up to {:.4g} Hz, where its band ends", band->to_Hz));
  }
  return std::nullopt;
}

// The material as the target takes it.
CardBody expected_body(const ReadCard& read, const Material& material, const CardNumbers& numbers) {
  return {card_identifier(read.name.empty() ? material.name : read.name),
          numbers,
          read.understood,
          read.units,
          material,
          {},
          read.frequencies_Hz};
}

void require_band(const Material& reference, const CheckOptions& options, ReadCard& read) {
  const CardTarget& target = read.understood;
  if (target.band_note == nullptr || !read.frequencies_Hz.empty()) return;
  if (!options.band) {
    read.add("band-not-stated",
             "the card does not state its band; the one that the material's data support is taken "
             "(--band names another)",
             false);
  }
  read.frequencies_Hz = card_frequencies_Hz(reference, target, options.band);
}

void compare_values(const std::string& text, const Material& given, const CheckOptions& options,
                    CardCheck& check) {
  require_band(given, options, check.read);
  const Material reference = with_bulk_rule(given, check.read.understood.bulk);
  const CardNumbers numbers =
      numbers_from_material(reference, check.read.understood, check.read.units);
  const CardBody body = expected_body(check.read, reference, numbers);
  const std::vector<CardValue> expected = check.read.understood.values(body);
  const std::vector<ValuePair> pairs = paired_values(check.read.values, expected);
  check.E_difference = largest_value_mismatch(pairs);
  check.E_difference_with_bulk = check.E_difference;
  std::vector<ValuePair> wrong;
  for (const ValuePair& pair : pairs) {
    if (!(value_mismatch(pair) <= check.tolerance)) wrong.push_back(pair);
  }
  check.findings = check.read.findings;
  if (!wrong.empty()) check.findings.push_back(finding_of(wrong, expected.size()));
  const bool has_mistake = std::any_of(check.findings.begin(), check.findings.end(),
                                       [](const CardFinding& one) { return one.is_mistake; });
  if (has_mistake) return;
  // A text that is not as viscard writes these very numbers.
  if (*check.E_difference > kSameValue) return;
  if (const auto form = form_difference(text, body)) check.findings.push_back(*form);
  const std::vector<CardFinding> header =
      header_differences(text, check.read, check.read.understood, &given);
  check.findings.insert(check.findings.end(), header.begin(), header.end());
}

// A band that the user names beside the one that the card has.
void compare_band(const CheckOptions& options, ReadCard& read) {
  if (!options.band || read.frequencies_Hz.empty()) return;
  const double from_Hz = read.frequencies_Hz.front(), to_Hz = read.frequencies_Hz.back();
  constexpr double kSameBand = 1e-3;
  if (relative_mismatch(from_Hz, options.band->from_Hz) <= kSameBand &&
      relative_mismatch(to_Hz, options.band->to_Hz) <= kSameBand) {
    return;
  }
  read.add(
      "band-differs",
      fmt::format("the card is for {:g} to {:g} Hz, and --band names {:g} to {:g} Hz; the card "
                  "was compared over its own band",
                  from_Hz, to_Hz, options.band->from_Hz, options.band->to_Hz));
}

}  // namespace

CardCheck check_card_values(const std::string& text, const CardTarget& target,
                            const CheckOptions& options, const Material* reference) {
  CardCheck check{.read = read_card(text, target, options.units)};
  check.tolerance = options.tolerance.value_or(1e-6);
  check.units = check.read.units.name;
  if (const auto gap = missing_rows(text, check.read)) check.read.findings.push_back(*gap);
  if (check.read.frequencies_Hz.empty()) {
    if (const auto band = stated_band(text)) {
      check.read.frequencies_Hz = {band->from_Hz, band->to_Hz};
    }
  }
  compare_band(options, check.read);
  if (reference != nullptr) {
    compare_values(text, *reference, options, check);
  } else {
    check.findings = check.read.findings;
  }
  note_unread_tokens(text, target, options.units, check.findings);
  if (!check.read.units_were_stated && options.units.empty()) {
    check.findings.push_back(
        {"units-not-stated",
         "the card does not state its units; it is read as SI (--units names others)", false});
  }
  check.agrees = std::none_of(check.findings.begin(), check.findings.end(),
                              [](const CardFinding& finding) { return finding.is_mistake; });
  return check;
}

}  // namespace viscard
