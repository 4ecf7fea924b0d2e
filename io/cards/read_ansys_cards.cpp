// Reader of ANSYS MAPDL commands.
#include "io/cards/card_lines.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

// One TB,PRONY table while its TBDATA lines come in.
struct PronyTable {
  CardLine line;
  bool is_bulk = false;
  int pairs = 0;
  int next_location = 1;
  std::map<int, double> constants;
};

std::vector<CardBranch> pairs_of(const PronyTable& table) {
  std::vector<CardBranch> out;
  for (int pair = 0; pair < table.pairs; ++pair) {
    const auto alpha = table.constants.find(2 * pair + 1), tau = table.constants.find(2 * pair + 2);
    if (alpha == table.constants.end() || tau == table.constants.end()) break;
    out.push_back({alpha->second, 0.0, tau->second});
  }
  return out;
}

void add_constants(const std::vector<std::string>& row, const CardLine& line, PronyTable& table,
                   ReadCard& card) {
  int location = row.size() > 1 && !row[1].empty()
                     ? static_cast<int>(card_number(row[1], line, "location"))
                     : table.next_location;
  for (std::size_t i = 2; i < row.size(); ++i, ++location) {
    if (row[i].empty()) continue;
    if (!table.constants.emplace(location, card_number(row[i], line, "constant")).second) {
      card.findings.push_back({"tbdata-overwritten",
                               "line " + std::to_string(line.number) + ": constant " +
                                   std::to_string(location) +
                                   " was given before and is overwritten; count the location on "
                                   "(1, 3, 5 ...)",
                               true});
      table.constants[location] = card_number(row[i], line, "constant");
    }
  }
  table.next_location = location;
}

void check_pairs(const PronyTable& table, ReadCard& card) {
  const std::size_t given = (table.constants.size() + 1) / 2;
  if (static_cast<int>(given) == table.pairs) return;
  card.findings.push_back({"npts-mismatch",
                           "line " + std::to_string(table.line.number) + ": TB,PRONY announces " +
                               std::to_string(table.pairs) + " pairs and " + std::to_string(given) +
                               " are given",
                           true});
}

// The two tables of one material share their times, or they are terms of their own.
void add_tables(const std::vector<PronyTable>& tables, ReadCard& card) {
  for (const PronyTable& table : tables) {
    check_pairs(table, card);
    for (const CardBranch& pair : pairs_of(table)) {
      auto& branches = card.numbers.branches;
      auto same = std::find_if(branches.begin(), branches.end(), [&](const CardBranch& b) {
        return b.time == pair.time && (table.is_bulk ? b.bulk : b.shear) == 0.0;
      });
      if (same == branches.end()) same = branches.insert(same, {0.0, 0.0, pair.time});
      CardBranch& branch = *same;
      (table.is_bulk ? branch.bulk : branch.shear) = pair.shear;
    }
  }
}

// Without comments; "$" puts several commands on one line.
std::vector<CardLine> ansys_commands(const std::string& text) {
  std::vector<CardLine> commands;
  for (const CardLine& line : card_lines(text, "!")) {
    for (const std::string& command : cells(line.text.substr(0, line.text.find('!')), '$')) {
      commands.push_back({line.number, command});
    }
  }
  return commands;
}

void read_ansys_property(const std::vector<std::string>& row, const CardLine& line, ReadCard& card,
                         bool& has_young) {
  const std::string property = upper(row.size() > 1 ? row[1] : "");
  const double value = cell_number(row, 3, line, property);
  if (property == "EX") {
    card.numbers.young = value;
    has_young = true;
  } else if (property == "PRXY" || property == "NUXY") {
    card.numbers.poisson = value;
  } else if (property == "DENS") {
    card.numbers.density = value;
  }
}

}  // namespace

void read_ansys(const std::string& text, ReadCard& card) {
  std::vector<PronyTable> tables;
  bool in_elastic = false, in_shift = false, has_young = false;
  for (const CardLine& line : ansys_commands(text)) {
    const std::vector<std::string> row = cells(line.text, ',');
    const std::string command = upper(row[0]);
    if (command == "MP") {
      read_ansys_property(row, line, card, has_young);
    } else if (command == "TB") {
      const std::string kind = upper(row.size() > 1 ? row[1] : "").substr(0, 4);
      in_elastic = kind == "ELAS";
      in_shift = kind == "SHIF" && upper(row.size() > 5 ? row[5] : "") == "WLF";
      if (kind == "PRON") {
        const std::string part = upper(row.size() > 5 ? row[5] : "SHEAR").substr(0, 4);
        tables.push_back({line,
                          part == "BULK",
                          static_cast<int>(cell_number(row, 4, line, "number of pairs")),
                          1,
                          {}});
      }
    } else if (command == "TBDATA" && in_elastic) {
      card.numbers.young = cell_number(row, 2, line, "E");
      card.numbers.poisson = cell_number(row, 3, line, "nu");
      has_young = true;
    } else if (command == "TBDATA" && in_shift) {
      card.numbers.shift = TemperatureShift{.T_ref_C = cell_number(row, 2, line, "Tref"),
                                            .C1 = cell_number(row, 3, line, "C1"),
                                            .C2_K = cell_number(row, 4, line, "C2")};
    } else if (command == "TBDATA" && !tables.empty()) {
      add_constants(row, line, tables.back(), card);
    }
  }
  if (!has_young) throw std::runtime_error("the card has no MP,EX and no TB,ELASTIC");
  add_tables(tables, card);
}

}  // namespace viscard
