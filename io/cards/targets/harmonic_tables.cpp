// Tables over frequency for ANSYS and COMSOL. Sources: ANSYS command reference, TBFIELD (type FREQ,
// for TB,ELASTIC and TB,SDAMP in full harmonic analyses); theory reference, section 14.3: TB,SDAMP
// adds an imaginary stiffness. That the coefficient of TBOPT=STRU multiplies the stiffness itself,
// and so is E''/E', was found in no public text; the command reference of release 18.2 (DMPSTR) says
// that DMPSTR adds g K and MP,DMPR 2 g K. The card says so. COMSOL 5.5 and 6.2, Structural Mechanics
// Module User's Guide, viscoelastic damping, Viscoelasticity (User defined): G* = G' + i G''. Neither
// solver has run these cards here.
#include "io/cards/card_values.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

std::string card_frequency(const CardBody& body, std::size_t row) {
  return number_of_20(to_card(body.frequencies_Hz[row], -body.units.time_exponent));
}

std::vector<CardValue> ansys_table_values(const CardBody& body) {
  std::vector<CardValue> out;
  if (body.numbers.density > 0.0) out.push_back({"density", body.numbers.density});
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row) {
    const DynamicModuli moduli = dynamic_moduli(body.material, body.frequencies_Hz[row]);
    out.push_back(
        {row_name(row, "E'"), to_card(moduli.young_Pa.real(), body.units.stress_exponent)});
    out.push_back({row_name(row, "nu"), body.material.nu});
  }
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row) {
    out.push_back({row_name(row, "loss factor"),
                   dynamic_moduli(body.material, body.frequencies_Hz[row]).loss_factor()});
  }
  return out;
}

std::string write_ansys_table(const CardBody& body) {
  const std::vector<CardValue> values = ansys_table_values(body);
  std::string out;
  std::size_t next = 0;
  if (body.numbers.density > 0.0) {
    out += "MP,DENS,1," + number_of_20(values[next++].value) + "\n";
  }
  out += "TB,ELASTIC,1,,2,ISOT\n";
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row, next += 2) {
    out += "TBFIELD,FREQ," + card_frequency(body, row) + "\nTBDATA,1," +
           number_of_20(values[next].value) + "," + number_of_20(values[next + 1].value) + "\n";
  }
  out += "TB,SDAMP,1,,1,STRU\n";
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row) {
    out += "TBFIELD,FREQ," + card_frequency(body, row) + "\nTBDATA,1," +
           number_of_20(values[next++].value) + "\n";
  }
  return out;
}

// The commands of an ANSYS table, one after the other.
class AnsysTableReader {
 public:
  explicit AnsysTableReader(ReadCard& card) : card_(card) {}

  void read(const CardLine& line) {
    const auto row = cells(line.text, ',');
    const std::string command = upper(row[0]);
    if (command == "TB") return open(row, line);
    if (command == "TBFIELD") return read_field(row, line);
    if (command == "TBDATA") return read_data(row, line);
    if (command == "MP" && row.size() > 1 && upper(row[1]) == "DENS") {
      check_material(row, 2, line);
      card_.numbers.density = cell_number(row, 3, line, "density");
      card_.values.push_back({"density", card_.numbers.density});
      return;
    }
    card_.add("line-not-read", at_line(line, "is no command of these cards"), false);
  }

  void finish() {
    if (elastic_rows_ == 0) throw std::runtime_error("the card has no TB,ELASTIC with TBFIELD");
    if (damping_rows_ == 0) {
      card_.add("missing-damping", "the card has no TB,SDAMP: nothing is damped");
    }
  }

 private:
  void check_material(const std::vector<std::string>& row, std::size_t at, const CardLine& line) {
    const int number = cell_integer(row, at, line, "material number");
    if (material_ == 0) material_ = number;
    if (number != material_) {
      card_.add("material-number-differs",
                at_line(line, "is of another material than the lines above"));
    }
  }

  void open(const std::vector<std::string>& row, const CardLine& line) {
    const std::string table = row.size() > 1 ? upper(row[1]) : "";
    const std::string option = row.size() > 5 ? upper(row[5]) : "";
    check_material(row, 2, line);
    is_elastic_ = table == "ELASTIC";
    if (!is_elastic_ && table != "SDAMP") {
      throw std::runtime_error(at_line(line, "TB,ELASTIC or TB,SDAMP expected"));
    }
    if (option != (is_elastic_ ? "ISOT" : "STRU")) {
      card_.add("table-option",
                at_line(line, is_elastic_ ? "the option is not ISOT" : "the option is not STRU"));
    }
    has_table_ = true;
    has_field_ = false;
  }

  void read_field(const std::vector<std::string>& row, const CardLine& line) {
    if (!has_table_) throw std::runtime_error(at_line(line, "TBFIELD before TB"));
    if (row.size() < 3 || upper(row[1]) != "FREQ") {
      throw std::runtime_error(at_line(line, "TBFIELD,FREQ,frequency expected"));
    }
    const double number = cell_number(row, 2, line, "frequency");
    has_field_ = true;
    if (is_elastic_) return add_frequency(number, line, card_);
    const bool is_known = damping_rows_ < card_.frequencies_Hz.size();
    const double frequency_Hz = from_card(number, -card_.units.time_exponent);
    if (!is_known || frequency_Hz != card_.frequencies_Hz[damping_rows_]) {
      card_.add("frequencies-differ",
                at_line(line, "TB,SDAMP has another frequency than TB,ELASTIC in this row"));
    }
  }

  void read_data(const std::vector<std::string>& row, const CardLine& line) {
    if (!has_field_) throw std::runtime_error(at_line(line, "TBDATA before TBFIELD"));
    has_field_ = false;
    if (cell_integer(row, 1, line, "place in the table") != 1) {
      card_.add("table-place", at_line(line, "the first number of a row has the place 1"));
    }
    if (row.size() > (is_elastic_ ? 4U : 3U)) {
      card_.add("decimal-comma", at_line(line, "has more numbers than the table takes"));
    }
    if (is_elastic_) {
      card_.values.push_back({row_name(elastic_rows_, "E'"), cell_number(row, 2, line, "E'")});
      card_.values.push_back({row_name(elastic_rows_++, "nu"), cell_number(row, 3, line, "nu")});
    } else {
      card_.values.push_back(
          {row_name(damping_rows_++, "loss factor"), cell_number(row, 2, line, "loss factor")});
    }
  }

  ReadCard& card_;
  int material_ = 0;
  bool has_table_ = false, has_field_ = false, is_elastic_ = false;
  std::size_t elastic_rows_ = 0, damping_rows_ = 0;
};

void read_ansys_table(const std::string& text, ReadCard& card) {
  AnsysTableReader reader(card);
  for (const CardLine& line : card_lines(text, "!")) {
    if (!trimmed(line.text).empty()) reader.read(line);
  }
  reader.finish();
}

std::vector<CardValue> comsol_table_values(const CardBody& body) {
  std::vector<CardValue> out;
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row) {
    const auto shear_Pa = dynamic_moduli(body.material, body.frequencies_Hz[row]).shear_Pa;
    out.push_back({row_name(row, "G'"), to_card(shear_Pa.real(), body.units.stress_exponent)});
    out.push_back({row_name(row, "G''"), to_card(shear_Pa.imag(), body.units.stress_exponent)});
  }
  return out;
}

// Spreadsheet format of interpolation functions: "%" opens a comment, columns are blank-separated.
std::string write_comsol_table(const CardBody& body) {
  const std::vector<CardValue> values = comsol_table_values(body);
  std::string out = fmt::format("% f [1/{}]  G' [{}]  G'' [{}]\n", body.units.time,
                                body.units.stress, body.units.stress);
  for (std::size_t row = 0; row < body.frequencies_Hz.size(); ++row) {
    out += fmt::format("{} {} {}\n", to_card(body.frequencies_Hz[row], -body.units.time_exponent),
                       values[2 * row].value, values[2 * row + 1].value);
  }
  return out;
}

void read_comsol_table(const std::string& text, ReadCard& card) {
  std::size_t row = 0;
  for (const CardLine& line : card_lines(text, "%")) {
    const std::string_view plain = trimmed(line.text);
    if (plain.empty()) continue;
    std::vector<std::string> cell;
    for (const std::string& part : cells(plain, ' ')) {
      if (!part.empty()) cell.push_back(part);
    }
    if (cell.size() != 3) throw std::runtime_error(at_line(line, "f, G' and G'' expected"));
    add_frequency(cell_number(cell, 0, line, "frequency"), line, card);
    card.values.push_back({row_name(row, "G'"), cell_number(cell, 1, line, "G'")});
    card.values.push_back({row_name(row++, "G''"), cell_number(cell, 2, line, "G''")});
  }
  if (row == 0) throw std::runtime_error("the table has no rows f, G', G''");
}

}  // namespace

CardTarget ansys_table_target() {
  return {
      .name = "ansys-table",
      .code = "ANSYS MAPDL, full harmonic analysis with tables over frequency",
      .extension = ".mac",
      .comment = "!",
      .write = write_ansys_table,
      .read = read_ansys_table,
      .bulk = BulkRule::kConstantPoisson,
      .is_case_sensitive = false,
      .reads_fortran_numbers = true,
      .takes_incompressible = true,
      .evidence = Evidence::kDocumentation,
      .evidence_note = "public command reference; the factor of TB,SDAMP not checked; not run",
      .advice =
          "ANTYPE,HARMIC with HROPT,FULL. Without prestress TB,PRONY of card ansys does "
          "the same exactly; a prestressed harmonic analysis drops it, and then needs "
          "this card. Near nu = .5 set KEYOPT(6)=1 of SOLID185 to 187. NOT CHECKED: no public "
          "text states that the coefficient of TB,SDAMP with STRU multiplies the stiffness once, "
          "as here, and not twice, as that of MP,DMPR does; the stress of one element must lead "
          "its strain by atan(loss factor).",
      .cannot_represent =
          "time-domain tests, frequencies outside the table, and a loss factor "
          "of K other than that of G",
      .conventions =
          "E' and nu by TB,ELASTIC, loss factor E''/E' by TB,SDAMP with STRU, both "
          "over the frequency in cycles per time",
      .values = ansys_table_values,
      .rows_per_decade = 20,
      .band_note = table_note};
}

CardTarget comsol_table_target() {
  return {.name = "comsol-table",
          .code = "COMSOL, frequency domain, table of G' and G''",
          .extension = ".txt",
          .comment = "%",
          .write = write_comsol_table,
          .read = read_comsol_table,
          .bulk = BulkRule::kConstantBulk,
          .states_density = false,
          .evidence = Evidence::kDocumentation,
          .evidence_note = "public documentation; not run",
          .advice =
              "Interpolation functions of f (Load from File) for storage and loss modulus of "
              "a user-defined Viscoelasticity; K and density as in card comsol, whose "
              "branches do the same exactly.",
          .cannot_represent =
              "time-domain tests, frequencies outside the table, K and density "
              "(set them in the model)",
          .conventions = "rows f in cycles per time, G', G''; bulk does not relax (constant K)",
          .values = comsol_table_values,
          .rows_per_decade = 20,
          .band_note = table_note};
}

}  // namespace viscard
