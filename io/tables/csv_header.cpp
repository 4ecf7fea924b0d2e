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
