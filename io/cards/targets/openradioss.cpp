// OpenRadioss, /MAT/LAW40 (KELVINMAX): K, long-term shear modulus, five branches. The only target
// that declares its units. Source: Radioss Reference Guide (/MAT/LAW40, /PROP/TYPE14, /IMPDISP,
// /CLOAD, /TH); OpenRadioss has not run the one-element model here.
#include "io/cards/card_lines.h"
#include "io/cards/column_fields.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/radioss_model.h"
#include "io/cards/unit_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

std::string row20(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += real(value, 20);
  return out + "\n";
}

// MUNIT, LUNIT, TUNIT.
std::string unit_row(const UnitSystem& units) {
  return right(units.mass, 20) + right(units.length, 20) + right(units.time, 20) + "\n";
}

std::string write_openradioss(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::vector<double> shear(5, 0.0), decay(5, 0.0);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    shear[i] = numbers.branches[i].shear;
    decay[i] = numbers.branches[i].time;
  }
  return fmt::format("/UNIT/1\n{}\n", body.units.name) +
         "#              MUNIT               LUNIT               TUNIT\n" + unit_row(body.units) +
         "/MAT/LAW40/1/1\n" + body.name + "\n#              RHO_I\n" + row20({numbers.density}) +
         "#                  K               G_inf              Astass              Bstass"
         "                 Kvm\n" +
         row20({numbers.bulk, numbers.equilibrium, 0.0, 0.0, 0.0}) +
         "#                 G1                  G2                  G3                  G4"
         "                  G5\n" +
         row20(shear) +
         "#              BETA1               BETA2               BETA3               BETA4"
         "               BETA5\n" +
         row20(decay);
}

void read_openradioss(const std::string& text, ReadCard& card) {
  const std::vector<CardLine> lines = card_lines(text, "#");
  if (const std::string units = radioss_units(lines); !units.empty()) {
    card.units = unit_system(units);
    card.units_were_stated = true;
  }
  std::size_t at = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string word = upper(trimmed(lines[i].text));
    if (word.rfind("/MAT/LAW40", 0) != 0 && word.rfind("/MAT/KELVINMAX", 0) != 0) continue;
    if (at != lines.size()) card.add_second_material(lines[i]);
    at = std::min(at, i);
  }
  if (at + 5 >= lines.size()) {
    throw std::runtime_error(
        "the card has no complete /MAT/LAW40 (title and four lines of numbers)");
  }
  for (const CardFinding& finding : radioss_keyword_findings(lines[at], lines))
    card.findings.push_back(finding);
  card.name = trimmed(lines[at + 1].text);
  const auto row = [&](std::size_t offset) { return columns(lines[at + offset].text, 20); };
  card.numbers.density = cell_number_or_zero(row(2), 0, lines[at + 2], "RHO_I");
  card.numbers.bulk = cell_number(row(3), 0, lines[at + 3], "K");
  card.numbers.equilibrium = cell_number(row(3), 1, lines[at + 3], "G_inf");
  for (std::size_t i = 0; i < 5; ++i) {
    const double shear = cell_number_or_zero(row(4), i, lines[at + 4], "G");
    if (shear == 0.0) continue;
    card.numbers.branches.push_back(
        {shear, 0.0, cell_number_or_zero(row(5), i, lines[at + 5], "BETA")});
  }
}

// Explicit: about (end time) * (wave speed) / (edge) cycles, half a minute for a few seconds of
// PDMS on one element with an edge of 1 mm.
std::vector<DeckFile> openradioss_deck(const DeckInput& input, const std::string& name) {
  const double end = input.end();
  const RadiossModel model{.name = name,
                           .units = unit_row(input.units),
                           .card = input.card.text,
                           .curve = ramp_rows(input),
                           .is_creep = input.is_creep()};
  return {{name + "_0000.rad", radioss_starter(model)},
          {name + "_0001.rad", "#RADIOSS ENGINE\n/RUN/" + name + "/1\n" + real(end, 20) +
                                   "\n/VERS/2022\n/TFILE\n" + real(end / 1000.0, 20) +
                                   "\n/PRINT/-100000\n"}};
}

}  // namespace

CardTarget openradioss_target() {
  return {.name = "openradioss",
          .code = "OpenRadioss /MAT/LAW40",
          .extension = ".rad",
          .comment = "#",
          .write = write_openradioss,
          .read = read_openradioss,
          .deck = DeckWriter{openradioss_deck, "starter -i {0}_0000.rad && engine -i {0}_0001.rad"},
          .elastic = ElasticForm::kBulkOnly,
          .at = ModulusAt::kLongTerm,
          .branch = BranchNumber::kAbsoluteShear,
          .time = TimeNumber::kBeta,
          .bulk = BulkRule::kConstantBulk,
          .states_equilibrium = true,
          .is_case_sensitive = false,
          .reads_fortran_numbers = true,
          .max_terms = 5,
          .needs_density = true,
          .evidence = Evidence::kSource,
          .evidence_note = "format definition of the open source code; not run",
          .advice = "The card declares its units in /UNIT; solid elements only."};
}

}  // namespace viscard
