// What the solvers take from a card of rubber; conventions and sources as in rubber_card.cpp and rubber_terms.cpp.
#include "io/cards/hyperelastic/rubber_readers.h"

#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/named_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

using ReadForm = HyperelasticForm;

void require_count(const std::vector<double>& numbers, std::size_t least, const char* what) {
  if (numbers.size() >= least) return;
  throw std::runtime_error(std::string(what) + " has " + std::to_string(numbers.size()) +
                           " numbers, not the " + std::to_string(least) + " that its law takes");
}

// K of D = 2/K; 0: incompressible.
double bulk_of(double d) {
  return d > 0.0 ? 2.0 / d : 0.0;
}

std::vector<double> all_numbers(const KeywordBlock& block) {
  std::vector<double> out;
  for (const CardLine& line : block.data) {
    for (const std::string& cell : cells(line.text, ',')) {
      if (!cell.empty()) out.push_back(card_number(cell, line, "constant"));
    }
  }
  return out;
}

// Abaqus and CalculiX: the constants, then D.
void take_keyword_law(const KeywordBlock& block, RubberText& out) {
  const std::vector<double> numbers = all_numbers(block);
  RubberNumbers& law = out.numbers;
  std::size_t n = 1;
  if (block.has("OGDEN")) {
    for (const std::string& parameter : block.parameters) {
      if (parameter.rfind("N=", 0) == 0)
        n = static_cast<std::size_t>(
            cell_integer({parameter.substr(2)}, 0, block.line, "N of OGDEN"));
    }
    require_count(numbers, 2 * n, "*HYPERELASTIC, OGDEN");
    std::vector<double> moduli, shapes;
    for (std::size_t i = 0; i < n; ++i) {
      moduli.push_back(numbers[2 * i]);
      shapes.push_back(numbers[2 * i + 1]);
    }
    take_ogden(moduli, shapes, law);
    n *= 2;
  } else if (block.has("ARRUDA-BOYCE")) {
    require_count(numbers, n = 2, "*HYPERELASTIC, ARRUDA-BOYCE");
    law.form = ReadForm::kArrudaBoyce;
    law.moduli = {numbers[0]};
    law.shapes = {numbers[1]};
  } else {
    // REDUCED POLYNOMIAL, N=3 is Yeoh, N=1 Neo-Hooke; POLYNOMIAL, N=1 is Mooney-Rivlin.
    const bool is_reduced = block.has("REDUCEDPOLYNOMIAL"), is_polynomial = block.has("POLYNOMIAL");
    const bool has_three = block.has("N=3"), is_simple = !block.has("N=2") && !has_three;
    n = block.has("YEOH") || (is_reduced && has_three)               ? 3
        : block.has("MOONEY-RIVLIN") || (is_polynomial && is_simple) ? 2
                                                                     : 1;
    if (n == 1 && !block.has("NEOHOOKE") && !(is_reduced && is_simple))
      throw std::runtime_error(
          at_line(block.line,
                  "only OGDEN, NEO HOOKE, MOONEY-RIVLIN, YEOH, ARRUDA-BOYCE, "
                  "REDUCED POLYNOMIAL of N = 1 or 3 and POLYNOMIAL of N = 1 are read"));
    require_count(numbers, n, "*HYPERELASTIC");
    law.form = n == 3 ? ReadForm::kYeoh : n == 2 ? ReadForm::kMooneyRivlin : ReadForm::kNeoHooke;
    law.moduli.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  }
  law.bulk = numbers.size() > n ? bulk_of(numbers[n]) : 0.0;
  // D_2 ... of OGDEN and YEOH are beyond the law; with D_1^i they count for nothing, or are 0.
  const std::size_t n_D = block.has("OGDEN")                      ? n / 2
                          : block.has("YEOH") || block.has("N=3") ? 3
                                                                  : 1;
  if (numbers.size() > n + n_D) {
    out.findings.push_back(
        {"other-count",
         at_line(block.line,
                 fmt::format("{} numbers stand below {}, which takes {} constants and {} D",
                             numbers.size(), block.keyword, n, n_D)),
         true});
  }
  for (std::size_t i = n + 1; i < numbers.size(); ++i) {
    constexpr double kNothing = 1e9;
    out.also_read += fmt::format(" {}", numbers[i]);
    if (numbers[i] == 0.0 || numbers[i] >= kNothing) continue;
    out.findings.push_back(
        {"higher-volume-terms",
         at_line(block.line, fmt::format("D_{} = {:g} is not read: viscard's laws have D_1 alone",
                                         i - n + 1, numbers[i])),
         true});
  }
}

// Constants of MAPDL's tables by their locations.
struct TableOfMapdl {
  std::string option;
  int n_points = 0;
  std::vector<double> constants;
  CardLine line;
};

// Constants of the volume that a law may state.
std::size_t n_volume_of(const std::string& option) {
  return option == "YEOH" ? 3 : 1;
}

std::map<std::string, TableOfMapdl> mapdl_tables(const std::string& text) {
  std::map<std::string, TableOfMapdl> tables;
  TableOfMapdl* table = nullptr;
  for (const CardLine& line : card_lines(text, "!")) {
    const auto row = cells(line.text.substr(0, line.text.find('!')), ',');
    const std::string command = upper(row[0]);
    if (command == "TB" && row.size() > 1) {
      table = &tables[upper(row[1]).substr(0, 4)];
      table->option = row.size() > 5 ? upper(row[5]) : "";
      table->line = line;
      const bool has_count = row.size() > 4 && !row[4].empty();
      table->n_points = has_count ? cell_integer(row, 4, line, "NPTS") : 0;
    } else if (command.rfind("TBDAT", 0) == 0 && table != nullptr && row.size() > 2) {
      auto at = row[1].empty() ? table->constants.size() + 1
                               : static_cast<std::size_t>(cell_integer(row, 1, line, "location"));
      for (std::size_t i = 2; i < row.size(); ++i, ++at) {
        if (at == 0 || row[i].empty()) continue;
        if (table->constants.size() < at) table->constants.resize(at, 0.0);
        table->constants[at - 1] = card_number(row[i], line, "constant");
      }
    }
  }
  return tables;
}

}  // namespace

void take_ogden(const std::vector<double>& moduli, const std::vector<double>& shapes,
                RubberNumbers& out) {
  constexpr std::size_t kMost = 3;
  if (moduli.empty() || moduli.size() > kMost || shapes.size() != moduli.size())
    throw std::runtime_error("a law of Ogden has 1 to 3 terms, this has " +
                             std::to_string(moduli.size()));
  out.form = moduli.size() == 1   ? ReadForm::kOgden1
             : moduli.size() == 2 ? ReadForm::kOgden2
                                  : ReadForm::kOgden3;
  out.moduli = moduli;
  out.shapes = shapes;
}

RubberText read_keyword_rubber(const std::string& text, bool is_calculix) {
  RubberText out;
  bool has_law = false, is_at_once = false;
  const std::vector<KeywordBlock> blocks = keyword_blocks(card_lines(text, "**"), '*');
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "*HYPERELASTIC") {
      take_keyword_law(block, out);
      has_law = true;
      is_at_once = block.has("MODULI=INSTANTANEOUS");
    } else if (block.keyword == "*DENSITY") {
      out.numbers.density = density_in(block);
    } else if (block.keyword == "*VISCOELASTIC" && is_calculix) {
      out.findings.push_back({"ignored-viscoelastic",
                              at_line(block.line, "ccx ignores *VISCOELASTIC: the law is elastic"),
                              true});
    } else if (block.keyword == "*VISCOELASTIC") {
      if (!block.has("TIME=PRONY"))
        throw std::runtime_error(at_line(block.line, "only *VISCOELASTIC, TIME=PRONY can be read"));
      for (const CardLine& line : block.data) {
        const auto row = cells(line.text, ',');
        out.numbers.terms.push_back(
            {cell_number(row, 0, line, "g_i"), cell_number(row, 2, line, "tau_i")});
        if (cell_number_or_zero(row, 1, line, "k_i") != 0.0) {
          out.findings.push_back(
              {"bulk-relaxes", at_line(line, "k_i is not 0: the bulk modulus would relax"), true});
        }
      }
    }
  }
  require_in_card(has_law, "*HYPERELASTIC");
  for (const CardFinding& finding : material_findings(blocks, false))
    out.findings.push_back(finding);
  for (const KeywordBlock& block : blocks) {
    for (const char* other : {"*ELASTIC", "*PLASTIC", "*CREEP", "*HYPERFOAM", "*MULLINS EFFECT",
                              "*HYSTERESIS", "*DAMPING", "*USER MATERIAL", "*VISCOUS",
                              "*DAMAGE INITIATION", "*CONCRETE", "*RATE DEPENDENT"}) {
      if (block.keyword != other) continue;
      out.findings.push_back(
          {"other-law", at_line(block.line, block.keyword + " changes the stress and is not read"),
           true});
    }
  }
  out.is_long_term = !is_at_once && !out.numbers.terms.empty();
  if (is_calculix && out.numbers.bulk == 0.0) {
    out.findings.push_back(
        {"replaced-D", "ccx replaces D = 0 by 0.1/mu, a Poisson's ratio of 0.475", true});
  }
  return out;
}

RubberText read_ansys_rubber(const std::string& text) {
  auto tables = mapdl_tables(text);
  require_in_card(tables.contains("HYPE"), "TB,HYPER");
  const TableOfMapdl& table = tables["HYPE"];
  std::vector<double> numbers = table.constants;
  RubberText out;
  RubberNumbers& law = out.numbers;
  std::size_t n = 2;
  if (table.option == "OGDEN") {
    const auto terms = static_cast<std::size_t>(std::max(table.n_points, 1));
    require_count(numbers, 2 * terms, "TB,HYPER,,,,OGDEN");
    std::vector<double> moduli, shapes;
    for (std::size_t i = 0; i < terms; ++i) {
      moduli.push_back(numbers[2 * i] * numbers[2 * i + 1] / 2.0);  // Ogden's own constants
      shapes.push_back(numbers[2 * i + 1]);
    }
    take_ogden(moduli, shapes, law);
    n = 2 * moduli.size();
  } else if (table.option == "NEO") {
    require_count(numbers, n = 1, "TB,HYPER,,,,NEO");
    law.form = ReadForm::kNeoHooke;
    law.moduli = {numbers[0] / 2.0};
  } else if (table.option == "MOONEY" || table.option == "YEOH") {
    n = table.option == "YEOH" ? 3 : 2;
    require_count(numbers, n, "TB,HYPER");
    out.also_read += fmt::format(" {}", table.n_points);
    if (table.n_points != 0 && table.n_points != static_cast<int>(n)) {
      out.findings.push_back(
          {"other-count",
           at_line(table.line,
                   fmt::format("TB,HYPER announces {} constants of {}, of which {} are read",
                               table.n_points, table.option, n)),
           true});
    }
    law.form = n == 3 ? ReadForm::kYeoh : ReadForm::kMooneyRivlin;
    law.moduli.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  } else if (table.option == "BOYCE" || table.option == "GENT") {
    require_count(numbers, 2, "TB,HYPER");
    law.form = table.option == "BOYCE" ? ReadForm::kArrudaBoyce : ReadForm::kGent;
    law.moduli = {numbers[0]};
    law.shapes = {numbers[1]};
  } else {
    throw std::runtime_error("TB,HYPER has '" + table.option +
                             "'; OGDEN, NEO, MOONEY, YEOH, BOYCE and GENT are read");
  }
  law.bulk = numbers.size() > n ? bulk_of(numbers[n]) : 0.0;
  for (const CardLine& line : card_lines(text, "!")) {
    const auto row = cells(line.text.substr(0, line.text.find('!')), ',');
    const std::string command = upper(row[0]), property = row.size() > 1 ? upper(row[1]) : "";
    if (command == "MP" && property == "DENS") law.density = cell_number(row, 3, line, "DENS");
    if (command == "MPDATA" && row.size() > 6 && upper(row[3]) == "DENS")
      law.density = cell_number(row, 6, line, "DENS");
    const bool is_known = property.rfind("HYPE", 0) == 0 || property.rfind("PRON", 0) == 0;
    if (command == "TB" && !is_known) {
      out.findings.push_back(
          {"other-law", at_line(line, "TB," + property + " changes the stress and is not read"),
           true});
    }
    const std::string kind = row.size() > 5 ? upper(row[5]).substr(0, 4) : "";
    if (command == "TB" && property.rfind("PRON", 0) == 0 && !kind.empty() && kind != "BULK" &&
        kind != "SHEA")
      throw std::runtime_error(at_line(line, "'" + row[5] + "' is neither SHEAR nor BULK"));
    if (command == "TB" && property.rfind("PRON", 0) == 0 && kind == "BULK") {
      out.findings.push_back(
          {"bulk-relaxes", at_line(line, "a table of BULK: the bulk modulus would relax"), true});
    }
  }
  if (numbers.size() >
      n + std::max<std::size_t>(1, table.option == "OGDEN" ? n / 2 : n_volume_of(table.option))) {
    out.findings.push_back(
        {"other-count",
         at_line(table.line, fmt::format("{} constants are given and {} of {} are read",
                                         numbers.size(), n + 1, table.option)),
         true});
  }
  const TableOfMapdl& shares = tables["PRON"];
  const auto& prony = shares.constants;
  if (!prony.empty() && static_cast<int>((prony.size() + 1) / 2) != shares.n_points) {
    out.findings.push_back(
        {"npts-mismatch",
         at_line(shares.line, fmt::format("TB,PRONY announces {} pairs and {} are given",
                                          shares.n_points, (prony.size() + 1) / 2)),
         true});
  }
  for (std::size_t i = 0; i + 1 < prony.size(); i += 2)
    law.terms.push_back({prony[i], prony[i + 1]});
  return out;
}

}  // namespace viscard
