// What the solvers take from a card of rubber; conventions and sources as in rubber_card.cpp and rubber_terms.cpp.
#include "io/cards/hyperelastic/rubber_readers.h"

#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/named_values.h"

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
      if (parameter.rfind("N=", 0) == 0) n = static_cast<std::size_t>(parameter[2] - '0');
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
    n = block.has("YEOH") ? 3 : block.has("MOONEY-RIVLIN") ? 2 : 1;
    if (n == 1 && !block.has("NEOHOOKE"))
      throw std::runtime_error(at_line(block.line,
                                       "only OGDEN, NEO HOOKE, MOONEY-RIVLIN, YEOH and "
                                       "ARRUDA-BOYCE are read"));
    require_count(numbers, n, "*HYPERELASTIC");
    law.form = n == 3 ? ReadForm::kYeoh : n == 2 ? ReadForm::kMooneyRivlin : ReadForm::kNeoHooke;
    law.moduli.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  }
  law.bulk = numbers.size() > n ? bulk_of(numbers[n]) : 0.0;
}

// Constants of MAPDL's tables by their locations.
struct TableOfMapdl {
  std::string option;
  int n_points = 0;
  std::vector<double> constants;
};

std::map<std::string, TableOfMapdl> mapdl_tables(const std::string& text) {
  std::map<std::string, TableOfMapdl> tables;
  TableOfMapdl* table = nullptr;
  for (const CardLine& line : card_lines(text, "!")) {
    const auto row = cells(line.text.substr(0, line.text.find('!')), ',');
    const std::string command = upper(row[0]);
    if (command == "TB" && row.size() > 1) {
      table = &tables[upper(row[1]).substr(0, 4)];
      table->option = row.size() > 5 ? upper(row[5]) : "";
      const bool has_count = row.size() > 4 && !row[4].empty();
      table->n_points = has_count ? cell_integer(row, 4, line, "NPTS") : 0;
    } else if (command == "TBDATA" && table != nullptr && row.size() > 2) {
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

std::optional<double> value_of_tag(const std::string& text, const std::string& tag) {
  const auto match = first_match(text, "<" + tag + "(\\s[^>]*)?>([^<]*)</" + tag + ">");
  if (!match) return std::nullopt;
  return card_number(std::string(trimmed(match->group[2])), line_of(text, match->at[2]), tag);
}

// Numbers of the tags c1, c2 ... or m1, m2 ...
std::vector<double> numbered_tags(const std::string& text, const std::string& name) {
  std::vector<double> out;
  for (int i = 1; i <= 6; ++i) {
    const auto value = value_of_tag(text, name + std::to_string(i));
    if (!value) break;
    out.push_back(*value);
  }
  return out;
}

void take_febio_law(const std::string& text, RubberNumbers& law) {
  const auto type =
      first_match(text, "type\\s*=\\s*[\"'](Ogden|Arruda-Boyce|Yeoh|Mooney-Rivlin)[\"']");
  if (!type) throw std::runtime_error("the card has no Ogden, Arruda-Boyce, Yeoh or Mooney-Rivlin");
  const std::string child = text.substr(type->at[0]);
  std::vector<double> c = numbered_tags(child, "c");
  if (type->group[1] == "Ogden") {
    const std::vector<double> m = numbered_tags(child, "m");
    require_count(m, c.size(), "Ogden");
    for (double& value : c) value /= 2.0;  // c/m^2 is 2 mu/alpha^2
    take_ogden(c, m, law);
  } else if (type->group[1] == "Arruda-Boyce") {
    law.form = ReadForm::kArrudaBoyce;
    law.moduli = {value_of_tag(child, "mu").value_or(0.0)};
    law.shapes = {std::sqrt(value_of_tag(child, "N").value_or(0.0))};
  } else if (type->group[1] == "Yeoh") {
    law.form = ReadForm::kYeoh;
    c.resize(3, 0.0);
    law.moduli = c;
  } else {
    require_count(c, 1, "Mooney-Rivlin");
    const bool has_second = c.size() > 1 && c[1] != 0.0;
    law.form = has_second ? ReadForm::kMooneyRivlin : ReadForm::kNeoHooke;
    law.moduli = {c[0]};
    if (has_second) law.moduli.push_back(c[1]);
  }
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
  for (const KeywordBlock& block : keyword_blocks(card_lines(text, "**"), '*')) {
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
  const auto& prony = tables["PRON"].constants;
  for (std::size_t i = 0; i + 1 < prony.size(); i += 2)
    law.terms.push_back({prony[i], prony[i + 1]});
  return out;
}

RubberText read_febio_rubber(const std::string& card) {
  const std::string text = without_matches(card, "<!--[^>]*-->");
  RubberText out;
  RubberNumbers& law = out.numbers;
  take_febio_law(text, law);
  law.bulk = value_of_tag(text, "k").value_or(0.0);
  law.density = value_of_tag(text, "density").value_or(0.0);
  const std::vector<double> g = numbered_tags(text, "g"), t = numbered_tags(text, "t");
  if (g.empty()) return out;
  require_count(t, g.size(), "t1, t2 ...");
  // At once the child counts g0 + sum g times; g0 is 1 if it is not given.
  double whole = value_of_tag(text, "g0").value_or(1.0);
  for (const double share : g) whole += share;
  for (double& modulus : law.moduli) modulus *= whole;
  for (std::size_t i = 0; i < g.size(); ++i) law.terms.push_back({g[i] / whole, t[i]});
  return out;
}

}  // namespace viscard
