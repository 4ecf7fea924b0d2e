#include "io/cards/read_card.h"

#include "io/cards/card_lines.h"

#include <stdexcept>

namespace viscard {
namespace {

// The MFront writer pads its arrays with empty branches.
void drop_empty_branches(CardNumbers& numbers) {
  std::erase_if(numbers.branches,
                [](const CardBranch& b) { return b.shear == 0.0 && b.bulk == 0.0; });
}

bool has_negative_branch(ReadCard& card) {
  for (std::size_t i = 0; i < card.numbers.branches.size(); ++i) {
    const CardBranch& branch = card.numbers.branches[i];
    if (branch.shear >= 0.0 && branch.bulk >= 0.0) continue;
    card.add("negative-branch", "branch " + std::to_string(i + 1) +
                                    " is negative: it would gain energy, and solvers refuse it");
    return true;
  }
  return false;
}

}  // namespace

void ReadCard::add_second_material(const CardLine& line) {
  add("several-materials",
      at_line(line, "a second material begins; check a file with one of them"));
}

std::string stated_unit_system(const std::string& text) {
  const std::size_t at = text.find("units: ");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + 7;
  const std::size_t end = text.find_first_of(" \n\"", begin);
  const std::string name = text.substr(begin, end - begin);
  return find_unit_system(name) != nullptr ? name : "";
}

ReadCard read_card(const std::string& text, const CardTarget& target, const std::string& units) {
  const std::string stated = stated_unit_system(text);
  ReadCard card{.understood = target,
                .units = unit_system(!units.empty()    ? units
                                     : !stated.empty() ? stated
                                                       : "SI"),
                .units_were_stated = !stated.empty()};
  target.read(text, card);
  if (target.values != nullptr) return card;
  drop_empty_branches(card.numbers);
  if (!has_negative_branch(card)) {
    try {
      card.material = material_from_numbers(card.numbers, card.understood, card.units);
    } catch (const std::invalid_argument& error) {
      card.add("no-solid", error.what());
    }
  }
  card.material.name = card.name;
  return card;
}

}  // namespace viscard
