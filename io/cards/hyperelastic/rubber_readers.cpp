// What the solvers take from a card of rubber; conventions and sources as in rubber_keywords.cpp and rubber_terms.cpp.
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

// Eight cells to a line, as Abaqus and CalculiX read them: blank ones are 0, those at the end are left out.
std::vector<double> all_numbers(const KeywordBlock& block) {
  constexpr std::size_t kEight = 8;
  std::vector<double> out;
  for (const CardLine& line : block.data) {
    if (const std::size_t rest = out.size() % kEight; rest != 0)
      out.resize(out.size() + kEight - rest);
    auto row = cells(line.text, ',');
    while (!row.empty() && row.back().empty()) row.pop_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      out.push_back(cell_number_or_zero(row, i, line, "constant"));
  }
  return out;
}

// N= of a law of several orders.
std::size_t order_of(const KeywordBlock& block) {
  for (const std::string& parameter : block.parameters) {
    if (parameter.rfind("N=", 0) == 0)
      return static_cast<std::size_t>(
          cell_integer({parameter.substr(2)}, 0, block.line, "N of " + block.keyword));
  }
  return 1;
}

// The first n numbers, as constants of the polynomial C_ij (I1 - 3)^i (I2 - 3)^j; those of REDUCED POLYNOMIAL are C_i0.
void take_polynomial(const KeywordBlock& block, const std::vector<double>& numbers, std::size_t n,
                     RubberNumbers& law) {
  std::vector<double> constants(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  if (block.has("REDUCEDPOLYNOMIAL")) {
    constants.resize(std::max<std::size_t>(n, 3), 0.0);
    if (std::any_of(constants.begin() + 3, constants.end(), [](double c) { return c != 0.0; }))
      throw std::runtime_error(
          at_line(block.line, "a constant C_i0 above C30 is not 0, and viscard has no such law"));
    constants = {constants[0], 0.0, constants[1], 0.0, 0.0, constants[2]};
  }
  take_invariant_law(constants, law);
}

// Abaqus and CalculiX: the constants, then D.
void take_keyword_law(const KeywordBlock& block, RubberText& out) {
  const std::vector<double> numbers = all_numbers(block);
  RubberNumbers& law = out.numbers;
  const bool is_ogden_law = block.has("OGDEN"), is_reduced = block.has("REDUCEDPOLYNOMIAL"),
             is_polynomial = block.has("POLYNOMIAL"), is_yeoh = block.has("YEOH");
  const bool has_order = is_ogden_law || is_reduced || is_polynomial;
  const std::size_t order = has_order ? order_of(block) : is_yeoh ? 3 : 1;
  const std::size_t n = is_ogden_law                                     ? 2 * order
                        : is_polynomial                                  ? order * (order + 3) / 2
                        : is_reduced || is_yeoh || block.has("NEOHOOKE") ? order
                        : block.has("MOONEY-RIVLIN") || block.has("ARRUDA-BOYCE") ? 2
                                                                                  : 0;
  if (n == 0) {
    throw std::runtime_error(
        at_line(block.line,
                "only OGDEN, NEO HOOKE, MOONEY-RIVLIN, YEOH, ARRUDA-BOYCE, POLYNOMIAL and REDUCED "
                "POLYNOMIAL are read"));
  }
  require_count(numbers, n, block.keyword.c_str());
  if (is_ogden_law) {
    std::vector<double> moduli, shapes;
    for (std::size_t i = 0; i < order; ++i) {
      moduli.push_back(numbers[2 * i]);
      shapes.push_back(numbers[2 * i + 1]);
    }
    take_ogden(moduli, shapes, law);
  } else if (is_reduced || is_polynomial) {
    take_polynomial(block, numbers, n, law);
  } else if (block.has("ARRUDA-BOYCE")) {
    law.form = ReadForm::kArrudaBoyce;
    law.moduli = {numbers[0]};
    law.shapes = {numbers[1]};
  } else {
    law.form = is_yeoh ? ReadForm::kYeoh : n == 2 ? ReadForm::kMooneyRivlin : ReadForm::kNeoHooke;
    law.moduli.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  }
  law.bulk = numbers.size() > n ? bulk_of(numbers[n]) : 0.0;
  // D_2 ... are beyond the laws; with D_1^i they count for nothing, or are 0.
  if (numbers.size() > n + order) {
    out.findings.push_back(
        {"other-count",
         at_line(block.line,
                 fmt::format("{} numbers stand below {}, which takes {} constants and {} D",
                             numbers.size(), block.keyword, n, order)),
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

// *HYPERFOAM of Abaqus and CalculiX: mu and alpha of each term, then the nu of each.
void take_keyword_foam(const KeywordBlock& block, bool is_calculix, RubberText& out) {
  const std::vector<double> numbers = all_numbers(block);
  const std::size_t n = order_of(block);
  require_count(numbers, 2 * n, block.keyword.c_str());
  std::vector<double> mu, alpha, nu;
  for (std::size_t i = 0; i < n; ++i) {
    mu.push_back(numbers[2 * i]);
    alpha.push_back(numbers[2 * i + 1]);
    nu.push_back(2 * n + i < numbers.size() ? numbers[2 * n + i] : 0.0);
  }
  take_foam_terms(mu, alpha, nu, out.numbers);
  if (is_calculix && n == 1) {
    out.findings.push_back({"calculix-one-term",
                            at_line(block.line,
                                    "ccx gives *HYPERFOAM with N = 1 no stiffness; write N=2 with "
                                    "half of mu twice"),
                            true});
  }
  if (numbers.size() <= 3 * n) return;
  out.findings.push_back(
      {"other-count",
       at_line(block.line, fmt::format("{} numbers stand below {}, which takes {}", numbers.size(),
                                       block.keyword, 3 * n)),
       true});
  for (std::size_t i = 3 * n; i < numbers.size(); ++i)
    out.also_read += fmt::format(" {}", numbers[i]);
}

// *MULLINS EFFECT of Abaqus: r, m, beta.
void take_mullins(const KeywordBlock& block, RubberText& out) {
  const bool is_direct = std::none_of(
      block.parameters.begin(), block.parameters.end(), [](const std::string& parameter) {
        return parameter == "USER" || parameter == "TESTDATAINPUT" ||
               parameter.rfind("DEPENDENCIES", 0) == 0;
      });
  if (!is_direct) {
    out.findings.push_back(
        {"other-law",
         at_line(block.line, block.keyword + " is given by test data, fields or a subroutine "
                                             "and is not read; only r, m, beta are"),
         true});
    return;
  }
  const std::vector<double> numbers = all_numbers(block);
  constexpr std::size_t kConstants = 3;
  require_count(numbers, 2, block.keyword.c_str());
  out.numbers.damage = {numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 0.0};
  if (numbers.size() <= kConstants) return;
  out.findings.push_back(
      {"other-count",
       at_line(block.line, fmt::format("{} numbers stand below {}, and {} are read: r, m, beta",
                                       numbers.size(), block.keyword, kConstants)),
       true});
  for (std::size_t i = kConstants; i < numbers.size(); ++i)
    out.also_read += fmt::format(" {}", numbers[i]);
}

// Constants of MAPDL's tables by their locations.
struct TableOfMapdl {
  std::string option;
  int n_points = 0;
  std::vector<double> constants;
  CardLine line;
};

std::map<std::string, TableOfMapdl> mapdl_tables(const std::string& text) {
  std::map<std::string, TableOfMapdl> tables;
  TableOfMapdl* table = nullptr;
  for (const CardLine& line : mapdl_commands(text)) {
    const auto row = cells(line.text, ',');
    const std::string command = upper(row[0]);
    if (command == "TB" && row.size() > 1) {
      table = &tables[upper(row[1]).substr(0, 4)];
      table->option = row.size() > 5 ? upper(row[5]) : "";
      // MAPDL reads four letters.
      for (const char* known : {"OGDEN", "MOONEY", "BOYCE"}) {
        if (table->option.substr(0, 4) == std::string(known).substr(0, 4)) table->option = known;
      }
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

void take_foam_terms(const std::vector<double>& mu, const std::vector<double>& alpha,
                     const std::vector<double>& nu, RubberNumbers& out) {
  constexpr std::size_t kMost = 6;
  if (mu.empty() || mu.size() > kMost)
    throw std::runtime_error("a foam has 1 to 6 terms, this has " + std::to_string(mu.size()));
  for (std::size_t i = 0; i < mu.size(); ++i) out.foam.push_back({mu[i], alpha[i], nu[i]});
}

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

void take_invariant_law(const std::vector<double>& constants, RubberNumbers& law) {
  static const std::vector<const char*> kNames{"C10", "C01", "C20", "C11", "C02",
                                               "C30", "C21", "C12", "C03"};
  std::vector<double> C = constants;
  C.resize(std::max(C.size(), kNames.size()), 0.0);
  const bool is_yeoh_law = C[2] != 0.0 || C[5] != 0.0;
  for (std::size_t i = 1; i < C.size(); ++i) {
    const bool is_of_law = i == 2 || i == 5 || (i == 1 && !is_yeoh_law);
    if (C[i] == 0.0 || is_of_law) continue;
    throw std::runtime_error(
        (i < kNames.size() ? kNames[i] : std::string("a constant of a higher order")) + " = " +
        fmt::format("{:g}", C[i]) + " is not of Neo-Hooke, Mooney-Rivlin or Yeoh" +
        (i == 1 ? " beside C20 and C30" : "") + ", the laws of the invariants that are read");
  }
  law.form = is_yeoh_law   ? ReadForm::kYeoh
             : C[1] != 0.0 ? ReadForm::kMooneyRivlin
                           : ReadForm::kNeoHooke;
  law.moduli = is_yeoh_law ? std::vector{C[0], C[2], C[5]} : std::vector{C[0]};
  if (law.form == ReadForm::kMooneyRivlin) law.moduli.push_back(C[1]);
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
    } else if (block.keyword == "*HYPERFOAM") {
      take_keyword_foam(block, is_calculix, out);
      has_law = true;
    } else if (block.keyword == "*DENSITY") {
      out.numbers.density = density_in(block);
    } else if (block.keyword == "*MULLINS EFFECT" && is_calculix) {
      out.findings.push_back({"ignored-damage",
                              at_line(block.line,
                                      "ccx skips *MULLINS EFFECT with a warning: the "
                                      "law has no damage"),
                              true});
    } else if (block.keyword == "*MULLINS EFFECT") {
      take_mullins(block, out);
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
  if (!out.numbers.foam.empty() && !out.numbers.terms.empty()) {
    out.findings.push_back(
        {"foam-with-terms",
         "terms of relaxation stand beside *HYPERFOAM, and viscard's foams have none", true});
  }
  for (const CardFinding& finding : material_findings(blocks, false))
    out.findings.push_back(finding);
  for (const KeywordBlock& block : blocks) {
    for (const char* other :
         {"*ELASTIC", "*PLASTIC", "*CREEP", "*HYSTERESIS", "*DAMPING", "*USER MATERIAL", "*VISCOUS",
          "*DAMAGE INITIATION", "*CONCRETE", "*RATE DEPENDENT"}) {
      if (block.keyword != other) continue;
      out.findings.push_back(
          {"other-law", at_line(block.line, block.keyword + " changes the stress and is not read"),
           true});
    }
  }
  out.is_long_term = !is_at_once && !out.numbers.terms.empty();
  if (is_calculix && out.numbers.bulk == 0.0 && out.numbers.foam.empty()) {
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
  std::size_t n = 2, n_volume = 1;
  if (table.option == "OGDEN") {
    const auto terms = n_volume = static_cast<std::size_t>(std::max(table.n_points, 1));
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
  } else if (table.option == "MOONEY" || table.option == "POLY") {
    // Two, three, five or nine constants of Mooney and Rivlin; POLY has all of its order.
    const bool is_poly = table.option == "POLY";
    n_volume = is_poly ? static_cast<std::size_t>(std::max(table.n_points, 1)) : 1;
    n = is_poly ? n_volume * (n_volume + 3) / 2
                : static_cast<std::size_t>(std::max(table.n_points, 2));
    require_count(numbers, n, "TB,HYPER");
    std::vector<double> constants(numbers.begin(),
                                  numbers.begin() + static_cast<std::ptrdiff_t>(n));
    if (!is_poly && n == 3) constants = {numbers[0], numbers[1], 0.0, numbers[2]};  // C11
    take_invariant_law(constants, law);
  } else if (table.option == "YEOH") {
    n = n_volume = static_cast<std::size_t>(table.n_points > 0 ? table.n_points : 3);
    require_count(numbers, n, "TB,HYPER");
    std::vector<double> moduli(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
    moduli.resize(std::max<std::size_t>(n, 3), 0.0);
    if (n > 3)
      throw std::runtime_error(at_line(table.line, "only the first three orders of YEOH are read"));
    law.form = ReadForm::kYeoh;
    law.moduli = moduli;
  } else if (table.option == "BOYCE" || table.option == "GENT") {
    require_count(numbers, 2, "TB,HYPER");
    law.form = table.option == "BOYCE" ? ReadForm::kArrudaBoyce : ReadForm::kGent;
    law.moduli = {numbers[0]};
    law.shapes = {numbers[1]};
  } else {
    throw std::runtime_error("TB,HYPER has '" + table.option +
                             "'; OGDEN, NEO, MOONEY, POLY, YEOH, BOYCE and GENT are read");
  }
  law.bulk = numbers.size() > n ? bulk_of(numbers[n]) : 0.0;
  for (const CardLine& line : mapdl_commands(text)) {
    const auto row = cells(line.text, ',');
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
  if (numbers.size() > n + n_volume) {
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
