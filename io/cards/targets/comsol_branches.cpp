// The branch table of COMSOL's Viscoelasticity (generalized Maxwell), a file for its Load from File:
// three columns, number, shear modulus in Pa and relaxation time in s. Source: COMSOL 5.3 Structural
// Mechanics Module User's Guide, Viscoelasticity. That its cells take expressions with a unit as
// those of Parameters do was found in no public text, and the card says so. COMSOL has not run it
// here.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/card_values.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

std::vector<CardValue> branch_values(const CardBody& body) {
  std::vector<CardValue> out;
  for (std::size_t i = 0; i < body.numbers.branches.size(); ++i) {
    out.push_back({row_name(i, "G"), body.numbers.branches[i].shear});
    out.push_back({row_name(i, "tau"), body.numbers.branches[i].time});
  }
  return out;
}

std::string stress_unit(const UnitSystem& units) {
  return std::string(units.stress) == "Ba" ? "dyn/cm^2" : units.stress;
}

// The table counts in Pa and s; other units stand beside the numbers.
std::string branch_cell(double value, const std::string& unit, const char* of_table) {
  return unit == of_table ? fmt::format("{}", value) : fmt::format("{}[{}]", value, unit);
}

std::string write_comsol_branches(const CardBody& body) {
  if (body.numbers.branches.empty()) {
    throw std::invalid_argument("a table of branches needs a material with terms; choose comsol");
  }
  const std::vector<CardValue> values = branch_values(body);
  const std::string stress = stress_unit(body.units);
  std::string out;
  for (std::size_t i = 0; i < body.numbers.branches.size(); ++i) {
    out += fmt::format("{} {} {}\n", i + 1, branch_cell(values[2 * i].value, stress, "Pa"),
                       branch_cell(values[2 * i + 1].value, body.units.time, "s"));
  }
  return out;
}

double number_before_unit(const std::string& text, const std::string& expected,
                          const std::string& of_table, const CardLine& line) {
  const auto match = first_match(text, "^([^\\[\\]]+)(?:\\[([^\\[\\]]*)\\])?$");
  if (!match) throw std::runtime_error(at_line(line, "number or number[unit] expected"));
  const std::string& unit = match->group[2];
  const double number = card_number(match->group[1], line, "branch");
  if (unit == expected || (unit.empty() && of_table == expected)) return number;
  throw std::runtime_error(at_line(
      line, unit.empty() ? "without a unit the table counts in " + of_table + ", not in " + expected
                         : "[" + unit + "] is not the unit of the card's system, " + expected));
}

void read_comsol_branches(const std::string& text, ReadCard& card) {
  const std::string stress = stress_unit(card.units);
  std::size_t row = 0;
  for (const CardLine& line : card_lines(text, "%")) {
    if (trimmed(line.text).empty()) continue;
    std::vector<std::string> row_cells;
    for (const std::string& part : cells(trimmed(line.text), ' ')) {
      if (!part.empty()) row_cells.push_back(part);
    }
    if (row_cells.size() != 3) {
      throw std::runtime_error(at_line(line, "number, shear modulus and time expected"));
    }
    if (cell_integer(row_cells, 0, line, "number of the branch") != static_cast<int>(row) + 1) {
      card.add("branch-number", at_line(line, "the branches are not numbered 1, 2, 3 ..."));
    }
    card.values.push_back(
        {row_name(row, "G"), number_before_unit(row_cells[1], stress, "Pa", line)});
    card.values.push_back(
        {row_name(row++, "tau"), number_before_unit(row_cells[2], card.units.time, "s", line)});
  }
  if (row == 0) throw std::runtime_error("the table has no branches");
}

}  // namespace

CardTarget comsol_branches_target() {
  return {.name = "comsol-branches",
          .code = "COMSOL, table of the branches of Viscoelasticity",
          .extension = ".txt",
          .comment = "%",
          .write = write_comsol_branches,
          .read = read_comsol_branches,
          .at = ModulusAt::kLongTerm,
          .branch = BranchNumber::kAbsoluteShear,
          .bulk = BulkRule::kConstantBulk,
          .states_density = false,
          .evidence = Evidence::kDocumentation,
          .evidence_note = "public documentation; not run",
          .advice =
              "Viscoelasticity > Generalized Maxwell > Load from File. E, nu (both long-term) "
              "and density as in card comsol. NOT CHECKED: that the file may have units beside its "
              "numbers; with --units SI it has none.",
          .harmonic = "exact: Frequency Domain studies take the branches",
          .cannot_represent =
              "E, nu and the density (set the long-term ones in the model), and "
              "relaxation of the bulk modulus",
          .conventions =
              "rows number, G_i, tau_i, in Pa and s where no unit stands beside them; "
              "bulk does not relax (constant K)",
          .values = branch_values};
}

}  // namespace viscard
