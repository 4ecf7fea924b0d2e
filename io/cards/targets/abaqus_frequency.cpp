// Abaqus, direct steady-state dynamics. Sources: Keywords Reference, *VISCOELASTIC (FREQUENCY=PRONY:
// rows g_i, k_i, tau_i; FREQUENCY=TABULAR: rows Re(wg*), Im(wg*), Re(wk*), Im(wk*), f in cycles per
// time; both take the long-term elasticity); Materials Guide, frequency domain viscoelasticity:
// G_s = G_inf (1 - Im(wg*)), G_l = G_inf Re(wg*), and the same for K.
#include "io/cards/card_values.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/liquid.h"

#include <fmt/format.h>

#include <complex>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

std::string elastic_block(const CardBody& body) {
  return keyword_head(body.name, body.numbers.density) +
         fmt::format("*ELASTIC, MODULI=LONG TERM\n{}, {}\n", number_of_20(body.numbers.young),
                     number_of_20(body.numbers.poisson));
}

std::string write_frequency_prony(const CardBody& body) {
  return elastic_block(body) + prony_block("FREQUENCY", body.numbers.branches);
}

// What both kinds of card share; returns the rows below *VISCOELASTIC.
std::vector<CardLine> read_frequency_blocks(const std::string& text, const char* kind,
                                            ReadCard& card) {
  bool has_elastic = false;
  std::vector<CardLine> rows;
  const std::vector<KeywordBlock> blocks = keyword_blocks(card_lines(text, "**"), '*');
  check_single_material(blocks, card);
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "*MATERIAL") card.name = block.name();
    if (block.keyword == "*DENSITY") card.numbers.density = density_in(block);
    if (block.keyword == "*ELASTIC") {
      has_elastic = true;
      read_elastic(block, card, card.numbers);
      if (block.has("MODULI=INSTANTANEOUS")) {
        card.add("instantaneous-in-frequency-domain",
                 "*VISCOELASTIC, FREQUENCY= takes the long-term elasticity; MODULI=INSTANTANEOUS "
                 "is for TIME=");
      }
    }
    if (block.keyword != "*VISCOELASTIC") continue;
    if (!block.has(std::string("FREQUENCY=") + kind)) {
      throw std::runtime_error(at_line(
          block.line, std::string("only *VISCOELASTIC, FREQUENCY=") + kind + " can be read"));
    }
    rows.insert(rows.end(), block.data.begin(), block.data.end());
  }
  require_in_card(has_elastic, "*ELASTIC");
  return rows;
}

void read_frequency_prony(const std::string& text, ReadCard& card) {
  read_prony_rows(read_frequency_blocks(text, "PRONY", card), card);
}

// M*/M_inf - 1 at omega, without the cancellation of that difference:
// sum m_i i w tau/(1 + i w tau) over 1 - sum m_i.
std::complex<double> rise_over_long_term(const std::vector<MaterialTerm>& terms,
                                         double MaterialTerm::*share, double omega_rad_s) {
  std::complex<double> rise;
  double rest = 1.0;
  for (const MaterialTerm& term : terms) {
    const double x = omega_rad_s * term.tau_s;
    rise += term.*share * std::complex<double>(1.0 / (1.0 + 1.0 / (x * x)), 1.0 / (x + 1.0 / x));
    rest -= term.*share;
  }
  return rise / rest;
}

constexpr const char* kTableColumns[] = {"Re(wg*)", "Im(wg*)", "Re(wk*)", "Im(wk*)"};

std::vector<CardValue> abaqus_table_values(const CardBody& body) {
  refuse_liquid(body.material, "the material");  // the rows are relative to G_inf
  std::vector<CardValue> out{{"E", body.numbers.young}, {"nu", body.numbers.poisson}};
  if (body.numbers.density > 0.0) out.push_back({"density", body.numbers.density});
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row) {
    const double omega = 2.0 * std::numbers::pi * body.frequencies_Hz[row];
    const auto& terms = body.material.terms;
    const auto shear = rise_over_long_term(terms, &MaterialTerm::g, omega);
    const auto bulk = body.material.nu == 0.5 ? std::complex<double>()  // Abaqus ignores it
                                              : rise_over_long_term(terms, &MaterialTerm::k, omega);
    const double numbers[] = {shear.imag(), -shear.real(), bulk.imag(), -bulk.real()};
    for (std::size_t i = 0; i < 4; ++i) {
      // Without -0, which no reader would distinguish.
      out.push_back({row_name(row, kTableColumns[i]), numbers[i] == 0.0 ? 0.0 : numbers[i]});
    }
  }
  return out;
}

std::string write_abaqus_table(const CardBody& body) {
  const auto number = number_of_20;
  std::string out = elastic_block(body) + "*VISCOELASTIC, FREQUENCY=TABULAR\n";
  const std::vector<CardValue> values = abaqus_table_values(body);
  std::size_t next = values.size() - 4 * body.frequencies_Hz.size();
  for (const double frequency_Hz : body.frequencies_Hz) {
    for (std::size_t i = 0; i < 4; ++i) out += number(values[next++].value) + ", ";
    out += number(to_card(frequency_Hz, -body.units.time_exponent)) + "\n";
  }
  return out;
}

void read_abaqus_table(const std::string& text, ReadCard& card) {
  const std::vector<CardLine> rows = read_frequency_blocks(text, "TABULAR", card);
  card.values = {{"E", card.numbers.young}, {"nu", card.numbers.poisson}};
  if (card.numbers.density > 0.0) card.values.push_back({"density", card.numbers.density});
  require_in_card(!rows.empty(), "rows below *VISCOELASTIC, FREQUENCY=TABULAR");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto cell = cells(rows[row].text, ',');
    check_width(rows[row], 5, card);
    for (std::size_t i = 0; i < 4; ++i) {
      card.values.push_back(
          {row_name(row, kTableColumns[i]), cell_number(cell, i, rows[row], kTableColumns[i])});
    }
    add_frequency(cell_number(cell, 4, rows[row], "frequency"), rows[row], card);
  }
}

// What both cards of the frequency domain share.
CardTarget frequency_target(const std::string& name, const std::string& how,
                            std::string (&write)(const CardBody& body),
                            void (&read)(const std::string& text, ReadCard& card)) {
  return {.name = name,
          .code = "Abaqus, steady-state dynamics with a " + how,
          .extension = ".inp",
          .comment = "**",
          .write = write,
          .read = read,
          .at = ModulusAt::kLongTerm,
          .is_case_sensitive = false,
          .reads_fortran_numbers = true,
          .takes_incompressible = true,
          .evidence = Evidence::kDocumentation,
          .evidence_note = "public keyword manual; not run"};
}

}  // namespace

CardTarget abaqus_frequency_target() {
  CardTarget target = frequency_target("abaqus-frequency", "Prony series", write_frequency_prony,
                                       read_frequency_prony);
  target.advice =
      "Use *STEADY STATE DYNAMICS, DIRECT (or SUBSPACE PROJECTION); mode-based steps ignore the "
      "damping of the "
      "material.";
  target.harmonic = "exact: *STEADY STATE DYNAMICS, DIRECT";
  target.cannot_represent =
      "tests in time (*VISCO, *DYNAMIC): card abaqus has the same material for them";
  return target;
}

CardTarget abaqus_table_target() {
  CardTarget target = frequency_target("abaqus-table", "table over frequency", write_abaqus_table,
                                       read_abaqus_table);
  target.advice =
      "Use *STEADY STATE DYNAMICS, DIRECT (or SUBSPACE PROJECTION). The first two columns of a row "
      "are G''/G_inf and 1 - G'/G_inf, the next two those of K.";
  target.cannot_represent = "tests in time, and frequencies outside the table";
  target.conventions =
      "long-term E, nu; rows Re(wg*) = G''/G_inf, Im(wg*) = 1 - G'/G_inf, the same of K, frequency "
      "in cycles per time";
  target.values = abaqus_table_values;
  target.rows_per_decade = 20;
  target.band_note = table_note;
  return target;
}

}  // namespace viscard
