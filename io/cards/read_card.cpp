#include "io/cards/read_card.h"

#include "io/cards/card_lines.h"

#include <cctype>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

// "units: mm-t-s (...)" of the header, whatever the comment signs.
std::string stated_units(const std::string& text) {
  const std::size_t at = text.find("units: ");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + 7;
  const std::size_t end = text.find_first_of(" \n\"", begin);
  const std::string name = text.substr(begin, end - begin);
  return find_unit_system(name) != nullptr ? name : "";
}

// Where ours are read, an empty branch only pads an array.
void drop_empty_branches(CardNumbers& numbers) {
  std::erase_if(numbers.branches,
                [](const CardBranch& b) { return b.shear == 0.0 && b.bulk == 0.0; });
}

bool has_negative_branch(ReadCard& card) {
  for (std::size_t i = 0; i < card.numbers.branches.size(); ++i) {
    const CardBranch& branch = card.numbers.branches[i];
    if (branch.shear >= 0.0 && branch.bulk >= 0.0) continue;
    card.findings.push_back({"negative-branch",
                             "branch " + std::to_string(i + 1) +
                                 " is negative: it would gain energy, and solvers refuse it",
                             true});
    return true;
  }
  return false;
}

void read_dialect(const std::string& text, ReadCard& card) {
  const std::string& name = card.understood.name;
  if (name == "abaqus") return read_abaqus(text, card);
  if (name == "ansys") return read_ansys(text, card);
  if (name == "lsdyna") return read_lsdyna(text, card);
  if (name == "lsdyna006") return read_lsdyna006(text, card);
  if (name == "febio" || name == "febio-uncoupled") return read_febio(text, card);
  if (name == "mfront") return read_mfront(text, card);
  if (name == "calculix") return read_calculix(text, card);
  if (name == "openradioss") return read_openradioss(text, card);
  if (name == "comsol") return read_comsol(text, card);
  if (name == "moose") return read_moose(text, card);
  if (name == "frontistr") return read_frontistr(text, card);
  if (name == "json") return read_card_json(text, card);
  throw std::invalid_argument("a " + name + " card holds a table, not a material");
}

}  // namespace

ReadCard read_card(const std::string& text, const std::string& target, const std::string& units) {
  ReadCard card;
  card.understood = card_target(target);
  const std::string stated = stated_units(text);
  card.units_were_stated = !stated.empty();
  card.units = unit_system(!units.empty() ? units : !stated.empty() ? stated : "SI");
  read_dialect(text, card);
  drop_empty_branches(card.numbers);
  if (!has_negative_branch(card)) {
    try {
      card.material = material_from_numbers(card.numbers, card.understood, card.units);
    } catch (const std::invalid_argument& error) {
      card.findings.push_back({"no-solid", error.what(), true});
    }
  }
  card.material.name = card.name;
  return card;
}

std::vector<CardLine> card_lines(const std::string& text, const std::string& comment) {
  std::vector<CardLine> lines;
  std::istringstream stream(text);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (trimmed(line).rfind(comment, 0) == 0) continue;
    lines.push_back({number, line});
  }
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> cells(const std::string& line, char separator) {
  std::vector<std::string> out;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(separator, begin);
    out.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string::npos) return out;
    begin = end + 1;
  }
}

std::vector<std::string> columns(const std::string& line, std::size_t width) {
  if (line.find(',') != std::string::npos) return cells(line, ',');
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin < line.size(); begin += width) {
    out.push_back(trimmed(line.substr(begin, width)));
  }
  return out;
}

double card_number(const std::string& cell, const CardLine& line, const std::string& expected) {
  std::string text = cell;
  for (char& c : text) {
    if (c == 'D' || c == 'd') c = 'e';
  }
  // Fortran lets the exponent letter go: "1.2-5".
  const std::size_t sign = text.find_first_of("+-", 1);
  if (sign != std::string::npos && text.find_first_of("eE") == std::string::npos) {
    text.insert(sign, "e");
  }
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_decimal = text.find_first_of("xXnNiI") == std::string::npos;
  if (text.empty() || *end != '\0' || !is_decimal) {
    throw std::runtime_error("line " + std::to_string(line.number) + ": '" + cell +
                             "' is not a number (" + expected + " expected)");
  }
  return value;
}

double cell_number(const std::vector<std::string>& row, std::size_t index, const CardLine& line,
                   const std::string& expected) {
  if (index >= row.size()) {
    throw std::runtime_error("line " + std::to_string(line.number) + ": " + expected +
                             " is missing (field " + std::to_string(index + 1) + ")");
  }
  return card_number(row[index], line, expected);
}

double cell_number_or_zero(const std::vector<std::string>& row, std::size_t index,
                           const CardLine& line, const std::string& expected) {
  if (index >= row.size() || row[index].empty()) return 0.0;
  return card_number(row[index], line, expected);
}

}  // namespace viscard
