#include "io/cards/card_sum.h"

#include "io/basics/sha256.h"
#include "io/cards/header_name.h"

#include <algorithm>

namespace viscard {
namespace {

constexpr const char* kMark = "card sha256 ";
constexpr const char* kEditedCard = "card-edited";
constexpr std::size_t kDigits = 64;

// Where the digits of the sum begin; npos if the card states none.
std::size_t digits_at(const std::string& card) {
  return behind_mark(card, kMark);
}

}  // namespace

std::string unsealed_sum_line() {
  return kMark + std::string(kDigits, '0');
}

std::string stated_card_sum(const std::string& card) {
  const std::size_t at = digits_at(card);
  return at == std::string::npos ? "" : card.substr(at, kDigits);
}

std::string card_sum(const std::string& card) {
  std::string rest = card;
  if (const std::size_t at = digits_at(card); at != std::string::npos) rest.erase(at, kDigits);
  std::erase(rest, '\r');
  return sha256_of_text(rest);
}

bool is_card_edited(const std::string& card) {
  const std::string stated = stated_card_sum(card);
  return !stated.empty() && stated != card_sum(card);
}

std::optional<CardFinding> sum_finding(const std::string& card, bool is_compared) {
  const bool is_by_viscard = behind_mark(card, "viscard ") != std::string::npos &&
                             behind_mark(card, "units: ") != std::string::npos;
  if (is_by_viscard && !is_compared && stated_card_sum(card).empty()) {
    return CardFinding{"card-unchecked",
                       "the header states no sum of the card, because it was written before "
                       "2026-12 or the sum was removed; whether it was edited cannot be seen",
                       false};
  }
  if (!is_card_edited(card)) return std::nullopt;
  const std::string text =
      "the card is not as viscard wrote it (the sum in its header differs)" +
      std::string(is_compared ? ", and no number of it differs from the material's"
                              : ": numbers or words of it were changed since");
  return CardFinding{kEditedCard, text, false};
}

bool has_edited_finding(const std::vector<CardFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const CardFinding& finding) { return finding.name == kEditedCard; });
}

std::string sealed(const std::string& card) {
  const std::size_t at = digits_at(card);
  if (at == std::string::npos) return card;
  return std::string(card).replace(at, kDigits, card_sum(card));
}

}  // namespace viscard
