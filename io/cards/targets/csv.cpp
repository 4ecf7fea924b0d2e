// A table of E(t), J(t), E'(f), E''(f): units stand in the column names.
#include "io/cards/card_lines.h"
#include "io/cards/card_numbers.h"
#include "io/cards/material_difference.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/retardation_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace viscard {
namespace {

// The unit of frequency in this unit system.
const char* frequency_unit(const UnitSystem& units) {
  return units.time_exponent == 3 ? "kHz" : "Hz";
}

std::string write_csv(const CardBody& body) {
  const UnitSystem& units = body.units;
  const PronySeries relaxation = young_series(body.material);
  const RetardationSpectrum creep = retardation_from_relaxation(relaxation);
  std::string out = fmt::format(
      "time_{1},modulus_{0},compliance_1_{0},frequency_{2},storage_modulus_{0},loss_modulus_{0}\n",
      units.stress, units.time, frequency_unit(units));
  const int stress = units.stress_exponent, time = units.time_exponent;
  for (const double time_s : comparison_times_s(body.material, 241)) {
    const ComplexModulus complex = complex_modulus_Pa(relaxation, 1.0 / time_s);
    out += fmt::format("{},{},{},{},{},{}\n", to_card(time_s, time),
                       to_card(relaxation_modulus_Pa(relaxation, time_s), stress),
                       to_card(creep_compliance_1_Pa(creep, time_s), -stress),
                       to_card(1.0 / (2.0 * std::numbers::pi * time_s), -time),
                       to_card(complex.storage_Pa, stress), to_card(complex.loss_Pa, stress));
  }
  return out;
}

void refuse_csv(const std::string&, ReadCard&) {
  throw std::invalid_argument("a csv card holds a table, not a material");
}

// The first unit system with these units of time and stress.
const UnitSystem& system_of(const std::string& time, const std::string& stress) {
  for (const UnitSystem& system : unit_systems()) {
    if (time == system.time && stress == system.stress) return system;
  }
  throw std::runtime_error("no unit system has times in " + time + " and stresses in " + stress);
}

// A column beside those of time and modulus.
struct CsvColumn {
  std::string kind;
  std::size_t at = 0;
  int exponent = 0;
};

// Throws for a column that is none of those that viscard writes, or in other units.
std::vector<CsvColumn> csv_columns(const std::vector<std::string>& names, const UnitSystem& units,
                                   const CardLine& line) {
  const int stress = units.stress_exponent;
  const std::vector<std::pair<CsvColumn, std::string>> known{
      {{"compliance_1_", 0, -stress}, units.stress},
      {{"frequency_", 0, -units.time_exponent}, frequency_unit(units)},
      {{"storage_modulus_", 0, stress}, units.stress},
      {{"loss_modulus_", 0, stress}, units.stress}};
  std::vector<CsvColumn> out;
  for (std::size_t at = 2; at < names.size(); ++at) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) {
      return names[at] == one.first.kind + one.second;
    });
    if (found == known.end())
      throw std::runtime_error(
          at_line(line, "the column '" + names[at] + "' is not known in these units"));
    out.push_back(found->first);
    out.back().at = at;
  }
  return out;
}

// The units stand in the column names.
double csv_difference(const std::string& text, const Material& reference) {
  const std::vector<CardLine> lines = card_lines(text, "#");
  if (lines.empty()) throw std::runtime_error("the table is empty");
  const std::vector<std::string> names = cells(lines[0].text, ',');
  if (names.size() < 2 || names[0].rfind("time_", 0) != 0 || names[1].rfind("modulus_", 0) != 0) {
    throw std::runtime_error(
        at_line(lines[0], "expected the columns time_UNIT, modulus_UNIT, ..."));
  }
  const UnitSystem& units = system_of(names[0].substr(5), names[1].substr(8));
  const std::vector<CsvColumn> columns = csv_columns(names, units, lines[0]);
  const RetardationSpectrum creep = retardation_from_relaxation(young_series(reference));
  const PronySeries series = young_series(reference);
  double largest = 0.0, time_before_s = -1.0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i].text).empty()) continue;
    const auto row = cells(lines[i].text, ',');
    const double time_s = from_card(cell_number(row, 0, lines[i], "time"), units.time_exponent);
    // A relaxed material has the same E(t) at many times, so the modulus alone says nothing of them.
    if (!(time_s > time_before_s)) {
      throw std::runtime_error(at_line(lines[i], "the times of the table do not increase"));
    }
    time_before_s = time_s;
    const double found_Pa =
        from_card(cell_number(row, 1, lines[i], "modulus"), units.stress_exponent);
    largest = std::max(largest, std::abs(found_Pa / relaxation_modulus_Pa(series, time_s) - 1.0));
    const ComplexModulus complex = complex_modulus_Pa(series, 1.0 / time_s);
    for (const CsvColumn& column : columns) {
      const double expected = column.kind == "compliance_1_" ? creep_compliance_1_Pa(creep, time_s)
                              : column.kind == "frequency_"
                                  ? 1.0 / (2.0 * std::numbers::pi * time_s)
                              : column.kind == "storage_modulus_" ? complex.storage_Pa
                                                                  : complex.loss_Pa;
      const double number =
          from_card(cell_number(row, column.at, lines[i], names[column.at]), column.exponent);
      // A loss modulus far from its peak is the difference of nearly equal numbers.
      const double scale = column.kind == "loss_modulus_" ? complex.storage_Pa : expected;
      largest = std::max(largest, std::abs(number - expected) / std::abs(scale));
    }
  }
  return largest;
}

}  // namespace

CardTarget csv_target() {
  return {.name = "csv",
          .code = "table of E(t), J(t), E'(f), E''(f)",
          .extension = ".csv",
          .comment = "#",
          .write = write_csv,
          .read = refuse_csv,
          .table_difference = csv_difference,
          .takes_incompressible = true,
          .evidence_note = "read back by viscard; units stand in the column names",
          .harmonic = "exact: E'(f), E''(f) in its rows"};
}

}  // namespace viscard
