#include "io/tables/csv_header.h"

#include "io/basics/units.h"
#include "models/maths/text_of_number.h"

#include <utility>

namespace viscard {
namespace {

// E(t), G'(w): the argument of a function, not a unit.
bool is_argument(std::string_view header, std::size_t open, std::string_view inside) {
  const bool is_attached = open > 0 && header[open - 1] != ' ';
  return header[open] == '(' && is_attached &&
         (inside == "t" || inside == "w" || inside == "f" || inside == "ω" || inside == "omega");
}

}  // namespace

std::string lower_case(const std::string& text) {
  std::string out = text;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] >= 'A' && out[i] <= 'Z') out[i] = static_cast<char>(out[i] - 'A' + 'a');
    if (i + 1 == out.size()) break;
    const auto lead = static_cast<unsigned char>(out[i]);
    const auto next = static_cast<unsigned char>(out[i + 1]);
    const auto put = [&](int first, int second) {
      out[i] = static_cast<char>(first);
      out[i + 1] = static_cast<char>(second);
    };
    if (lead == 0xC3 && next >= 0x80 && next <= 0x9E && next != 0x97) put(lead, next + 0x20);
    // Latin Extended-A: a small letter follows its capital, which has an even code up to Ķ and from Ŋ to Ŷ, and else
    // an odd one.
    const bool is_even = next % 2 == 0;
    const bool after_even =
        (lead == 0xC4 && next <= 0xB7) || (lead == 0xC5 && next >= 0x8A && next <= 0xB7);
    const bool after_odd =
        (lead == 0xC4 && next >= 0xB9 && next < 0xBF) ||
        (lead == 0xC5 && ((next >= 0x81 && next <= 0x88) || (next >= 0xB9 && next <= 0xBD)));
    if ((after_even && is_even) || (after_odd && !is_even)) put(lead, next + 1);
    if (lead == 0xCE && next >= 0x91 && next <= 0x9F) put(lead, next + 0x20);
    if (lead == 0xCE && next >= 0xA0 && next <= 0xA9) put(0xCF, next - 0x20);
    if (lead == 0xD0 && next >= 0x90 && next <= 0x9F) put(lead, next + 0x20);
    if (lead == 0xD0 && next >= 0xA0 && next <= 0xAF) put(0xD1, next - 0x20);
  }
  return out;
}

std::string_view without_brackets(std::string_view cell) {
  const bool is_bracketed = cell.size() >= 2 && ((cell.front() == '(' && cell.back() == ')') ||
                                                 (cell.front() == '[' && cell.back() == ']'));
  return is_bracketed ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

HeaderParts split_header(std::string_view header) {
  constexpr std::string_view kWideOpen = "\uff08", kWideClose = "\uff09";  // of Chinese text
  if (header.find(kWideOpen) != std::string_view::npos) {
    std::string narrow(header);
    for (const auto& [wide, bracket] : {std::pair{kWideOpen, "("}, {kWideClose, ")"}}) {
      for (auto at = narrow.find(wide); at != std::string::npos; at = narrow.find(wide)) {
        narrow.replace(at, wide.size(), bracket);
      }
    }
    return split_header(narrow);
  }
  HeaderParts whole{std::string(header), ""};
  if (header.empty()) return whole;
  const std::size_t open = header.find_last_of("([");
  const char close = header.back();
  if (open != std::string_view::npos && open > 0 && (close == ')' || close == ']')) {
    const std::string_view inside = trimmed(header.substr(open + 1, header.size() - open - 2));
    if (is_argument(header, open, inside) || !is_unit(inside)) return whole;
    return {std::string(trimmed(header.substr(0, open))), std::string(inside)};
  }
  for (const char* mark :
       {" / ", ", ", " in ", "/"}) {  // "Force / N", "Force, N", "Kraft in N", "F/N"
    const std::size_t at = header.rfind(mark);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = trimmed(header.substr(at + std::string_view(mark).size()));
    if (unit.empty() || !is_unit(unit)) continue;
    return {std::string(trimmed(header.substr(0, at))), std::string(unit)};
  }
  return whole;
}

}  // namespace viscard
