#include "io/cards/column_fields.h"

#include "io/basics/number_text.h"
#include "io/cards/unit_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {

std::vector<std::string> columns(const std::string& line, std::size_t width) {
  if (line.find(',') != std::string::npos) return cells(line, ',');
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin < line.size(); begin += width) {
    out.emplace_back(trimmed(std::string_view(line).substr(begin, width)));
  }
  return out;
}

std::size_t dyna_width(const std::vector<CardLine>& lines, const CardLine& keyword) {
  constexpr std::size_t kUsual = 10, kLong = 20;
  const std::string_view word = trimmed(keyword.text);
  if (word.ends_with('+')) return kLong;
  const bool is_long_deck = std::any_of(lines.begin(), lines.end(), [](const CardLine& line) {
    const std::string deck = upper(trimmed(line.text));
    return deck.rfind("*KEYWORD", 0) == 0 && deck.find("LONG=Y") != std::string::npos;
  });
  return is_long_deck && !word.ends_with('-') ? kLong : kUsual;
}

std::string radioss_units(const std::vector<CardLine>& lines) {
  for (std::size_t i = 0; i + 2 < lines.size(); ++i) {
    if (upper(trimmed(lines[i].text)).rfind("/UNIT/", 0) != 0) continue;
    const CardLine& line = lines[i + 2];
    auto row = columns(line.text, 20);
    row.resize(std::max<std::size_t>(row.size(), 3));
    for (const UnitSystem& system : unit_systems()) {
      const bool is_tonne =
          row[0] == "t" && system.name[0] == 'm' && std::string(system.mass) == "Mg";
      if ((row[0] == system.mass || is_tonne) && row[1] == system.length && row[2] == system.time)
        return system.name;
    }
    throw std::runtime_error(at_line(line, "the units " + row[0] + ", " + row[1] + ", " + row[2] +
                                               " of /UNIT are of no known unit system"));
  }
  return "";
}

std::vector<CardFinding> material_number_findings(const std::string& field, const CardLine& line) {
  const auto number = number_from_text(field);
  if (!number && !field.empty()) return {};  // a label of LS-DYNA
  if (number && *number >= 1.0 && *number == std::floor(*number)) return {};
  return {{"material-number",
           at_line(line, "'" + field + "' is no number of a material: a whole one above 0"), true}};
}

std::vector<CardFinding> radioss_keyword_findings(const CardLine& law,
                                                  const std::vector<CardLine>& lines) {
  const std::vector<std::string> parts = cells(trimmed(law.text), '/');  // "", MAT, LAW40, 1, 2
  auto out = material_number_findings(parts.size() > 3 ? parts[3] : "", law);
  const std::string wanted = parts.size() > 4 ? parts[4] : "";
  bool has_block = false, has_any = false;
  for (const CardLine& line : lines) {
    const std::string word = upper(trimmed(line.text));
    if (word.rfind("/UNIT/", 0) != 0) continue;
    has_any = true;
    has_block = has_block || word == "/UNIT/" + wanted;
  }
  if (has_block || (!has_any && wanted.empty())) return out;
  out.push_back(
      {"unit-block",
       at_line(law, wanted.empty()
                        ? std::string("the law names no unit block, so those of /BEGIN hold "
                                      "and not /UNIT")
                        : "the law takes the unit block " + wanted + ", which the card has not"),
       has_any});
  return out;
}

std::string right(const std::string& text, int width) {
  return fmt::format("{:>{}}", text, width);
}

std::string real(double value, int width) {
  return right(nearest_number(value, width - 1), width);
}

std::string node_rows(int id_width, int width) {
  std::string out;
  for (int node = 1; node <= 8; ++node) {
    out += right(std::to_string(node), id_width);
    for (const int x : kCubeCorners[node - 1]) out += right(x == 0 ? "0.0" : "1.0", width);
    out += "\n";
  }
  return out;
}

std::string face_nodes(int face) {
  std::string out;
  for (const int node : kFaceNodes[face]) out += right(std::to_string(node), 10);
  return out + "\n";
}

std::string ramp_rows(const DeckInput& input) {
  const double top = input.pull();
  std::string out;
  for (const auto& [time, value] :
       {std::pair{0.0, 0.0}, std::pair{input.ramp(), top}, std::pair{2.0 * input.end(), top}}) {
    out += real(time, 20) + real(value, 20) + "\n";
  }
  return out;
}

}  // namespace viscard
