// COMSOL, linear elastic material with Viscoelasticity. Source: public documentation.
// Laws of rubber: the Lame parameter mu = 2 C10, or C10 and C01, with the bulk modulus kappa of "nearly
// incompressible". Source: Structural Mechanics Module User's Guide 5.5 and 6.0, Hyperelastic Material; not run. The
// page names the numbers of the other laws without their energies, so they are refused.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/law_numbers.h"
#include "io/cards/material_difference.h"
#include "io/cards/named_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/comsol_deck.h"
#include "models/material/prony_series.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

// Rows of parameters, all with the name of the material.
struct ComsolRows {
  const std::string& name;

  std::string operator()(const std::string& suffix, double value, const std::string& unit,
                         const std::string& text) const {
    return fmt::format("{}_{} {}{} \"{}\"\n", name, suffix, value,
                       unit.empty() ? "" : "[" + unit + "]", text);
  }
};

std::string write_comsol(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const std::string stress = comsol_unit(body.units.stress), time = comsol_unit(body.units.time);
  const ComsolRows row{body.name};
  std::string out = row("Einf", numbers.young, stress, "long-term Young modulus");
  out += row("nuinf", numbers.poisson, "", "long-term Poisson ratio");
  if (numbers.density > 0.0) {
    out += row("rho", numbers.density, comsol_unit(body.units.density), "density");
  }
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    const std::string index = std::to_string(i + 1);
    out +=
        row("G" + index, numbers.branches[i].shear, stress, "branch " + index + " shear modulus");
    out +=
        row("tau" + index, numbers.branches[i].time, time, "branch " + index + " relaxation time");
  }
  if (numbers.shift) {
    const bool is_wlf = numbers.shift->law == ShiftLaw::kWlf;
    out += row("Tref", numbers.shift->T_ref_C, "degC",
               is_wlf ? "WLF reference temperature" : "Arrhenius reference temperature");
    if (is_wlf) {
      out += row("C1", numbers.shift->C1, "", "WLF constant C1");
      out += row("C2", numbers.shift->C2_K, "K", "WLF constant C2");
    } else {
      out += row("Q", numbers.shift->activation_J_mol, "J/mol", "Arrhenius activation energy");
    }
  }
  return out;
}

// Spreadsheet data format: "%" opens a comment, columns are blank-separated.
std::vector<CompanionFile> comsol_companions(const CardBody& body) {
  std::string out = fmt::format("% t [{}]  E(t) [{}]\n", body.units.time, body.units.stress);
  const PronySeries series = young_series(body.material);
  for (const double time_s : comparison_times_s(body.material, 101)) {
    out += fmt::format("{} {}\n", to_card(time_s, body.units.time_exponent),
                       to_card(relaxation_modulus_Pa(series, time_s), body.units.stress_exponent));
  }
  return {{"_relaxation.txt", out}};
}

// Units that COMSOL users write in these expressions, as a factor to SI.
double unit_factor(const std::string& unit, const CardLine& line) {
  static const std::map<std::string, double> kFactors{
      {"", 1.0},       {"Pa", 1.0},      {"kPa", 1e3},      {"MPa", 1e6},      {"GPa", 1e9},
      {"N/m^2", 1.0},  {"N/mm^2", 1e6},  {"dyn/cm^2", 0.1}, {"s", 1.0},        {"ms", 1e-3},
      {"us", 1e-6},    {"min", 60.0},    {"h", 3600.0},     {"kg/m^3", 1.0},   {"g/cm^3", 1e3},
      {"g/mm^3", 1e6}, {"kg/mm^3", 1e9}, {"t/mm^3", 1e12},  {"kg/um^3", 1e18}, {"1", 1.0}};
  const auto found = kFactors.find(unit);
  if (found == kFactors.end()) {
    throw std::runtime_error(at_line(line, "unit [" + unit + "] is not known"));
  }
  return found->second;
}

// A constant of the WLF or the Arrhenius law.
void read_shift(const std::string& kind, double value, const std::string& unit, ReadCard& card) {
  if (!card.numbers.shift) card.numbers.shift.emplace();
  if (kind == "C1") card.numbers.shift->C1 = value;
  if (kind == "C2") card.numbers.shift->C2_K = value;
  if (kind == "Q") {
    card.numbers.shift->law = ShiftLaw::kArrhenius;
    card.numbers.shift->activation_J_mol = unit == "kJ/mol" ? 1e3 * value : value;
  }
  if (kind != "Tref") return;
  card.numbers.shift->T_ref_C = unit == "K" ? value + kAbsoluteZero_C : value;
}

void read_elastic_number(const std::string& kind, double value, ReadCard& card) {
  if (kind == "Einf" || kind == "E_inf") card.numbers.young = value;
  if (kind == "nuinf" || kind == "nu") card.numbers.poisson = value;
  if (kind == "rho") card.numbers.density = value;
}

// A row: name, number[unit], text; its role is what the name ends in.
struct ComsolRow {
  std::string name, prefix, kind, number, unit;
  CardLine line;

  double in_SI() const {
    const double factor = unit_factor(unit, line), value = card_number(number, line, name);
    return factor < 1.0 ? value / std::round(1.0 / factor) : value * factor;
  }
};

// The rows whose names end in one of the kinds, a regular expression; others are notes, repeated ones mistakes.
std::vector<ComsolRow> comsol_rows(const std::string& text, const std::string& kinds,
                                   ReadCard& card) {
  card.units = unit_system("SI");  // each expression carries its own
  card.units_were_stated = true;
  std::vector<ComsolRow> out;
  std::set<std::string> prefixes, names;
  const char* row = "^\\s*(\\w+)\\s+([-+.\\deE]+)(?:\\[([^\\]]*)\\])?(?:\\s.*)?$";
  for (const CardLine& line : card_lines(text, "%")) {
    if (trimmed(line.text).empty()) continue;
    const auto match = first_match(line.text, row);
    if (!match) {
      card.add("line-not-read", at_line(line, "is not a name, a number[unit] and a text"), false);
      continue;
    }
    const std::string& name = match->group[1];
    const auto role = first_match(name, "^(.*_)?(" + kinds + ")$");
    if (!role) {
      card.add("parameter-not-known", at_line(line, name + " is no parameter of these cards"),
               false);
      continue;
    }
    if (!names.insert(name).second) {
      card.add("second-element", at_line(line, name + " stands in the card twice; keep one"));
    }
    if (prefixes.insert(role->group[1]).second && prefixes.size() > 1) {
      card.add("prefix-differs",
               at_line(line, name + " is of another material than the lines above"));
    }
    out.push_back({name, role->group[1], role->group[2], match->group[2], match->group[3], line});
  }
  return out;
}

void read_comsol(const std::string& text, ReadCard& card) {
  std::map<int, CardBranch> branches;
  bool has_young = false;
  for (const ComsolRow& row :
       comsol_rows(text, "Einf|E_inf|nuinf|nu|rho|Tref|C1|C2|Q|G\\d+|tau\\d+", card)) {
    const std::string& kind = row.kind;
    if (kind == "Tref" || kind == "C1" || kind == "C2" || kind == "Q") {
      read_shift(kind, card_number(row.number, row.line, row.name), row.unit, card);
      continue;
    }
    const double value = row.in_SI();
    if (kind[0] == 'G' || kind[0] == 't') {
      const bool is_modulus = kind[0] == 'G';
      CardBranch& branch =
          branches[cell_integer({kind.substr(is_modulus ? 1 : 3)}, 0, row.line, row.name)];
      (is_modulus ? branch.shear : branch.time) = value;
      continue;
    }
    read_elastic_number(kind, value, card);
    if (kind[0] != 'E') continue;
    has_young = true;
    if (!row.prefix.empty()) card.name = row.prefix.substr(0, row.prefix.size() - 1);
  }
  if (!has_young) throw std::runtime_error("the card has no parameter ending in Einf or E_inf");
  for (const auto& [index, branch] : branches) card.numbers.branches.push_back(branch);
}

std::string write_comsol_law(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  const std::string stress = comsol_unit(body.units.stress);
  const ComsolRows row{body.name};
  const std::string text =
      law.form == HyperelasticForm::kNeoHooke
          ? row("mu", 2.0 * law.moduli[0], stress, "Neo-Hookean, Lame parameter mu")
          : row("C10", law.moduli[0], stress, "Mooney-Rivlin, two parameters, C10") +
                row("C01", law.moduli[1], stress, "Mooney-Rivlin, two parameters, C01");
  return text + row("kappa", law.bulk, stress, "bulk modulus, nearly incompressible material") +
         (law.density > 0.0 ? row("rho", law.density, comsol_unit(body.units.density), "density")
                            : "");
}

void read_comsol_law(const std::string& text, ReadCard& card) {
  std::map<std::string, double> found;
  for (const ComsolRow& row : comsol_rows(text, "mu|C10|C01|kappa|rho", card)) {
    if (!found.emplace(row.kind, row.in_SI()).second)
      throw std::runtime_error(at_line(row.line, row.kind + " stands in the card twice; keep one"));
  }
  const bool has_mu = found.contains("mu");
  require_in_card(has_mu != found.contains("C10"), "parameter ending in mu or in C10, or has both");
  take_invariant_law({has_mu ? found["mu"] / 2.0 : found["C10"], has_mu ? 0.0 : found["C01"]},
                     card.numbers);
  card.numbers.bulk = found["kappa"];
  card.numbers.density = found["rho"];
}

// Expressions carry units: 0.008[MPa] where g was meant.
void add_comsol_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  CardTarget relative = context.target;
  relative.branch = BranchNumber::kRelative;
  const std::vector<CardBranch> branches = context.as(relative).branches;
  for (const double unit : {1e3, 1e6, 1e9}) {
    list.push_back(
        {"g-for-G",
         "the branches carry g where this field wants G (" + to_word(context.target.branch) + ")",
         [branches, unit](CardNumbers& n) {
           for (std::size_t i = 0; i < n.branches.size(); ++i) {
             n.branches[i].shear = branches[i].shear * unit;
           }
         }});
  }
}

}  // namespace

CardTarget comsol_target() {
  return {
      .name = "comsol",
      .code = "COMSOL linear elastic with Viscoelasticity",
      .extension = ".txt",
      .comment = "%",
      .write = write_comsol,
      .read = read_comsol,
      .companions = comsol_companions,
      .deck =
          DeckWriter{comsol_deck, "comsol compile {0}.java && comsol batch -inputfile {0}.class"},
      .laws = LawColumn{.write = write_comsol_law,
                        .read = read_comsol_law,
                        .keywords = {"Lame parameter mu = 2 C10", "C10, C01", "", "", "", ""},
                        .volume = "by kappa = K of a nearly incompressible material",
                        .terms = "the parameters are those of the law alone",
                        .damage = {"",
                                   "its node Mullins Effect has no beta, and its page states no "
                                   "formula"}},
      .add_mistakes = add_comsol_mistakes,
      .at = ModulusAt::kLongTerm,
      .branch = BranchNumber::kAbsoluteShear,
      .bulk = BulkRule::kConstantBulk,
      .numbers_carry_units = true,
      .takes_wlf = true,
      .takes_arrhenius = true,
      .set_temperature = "Model Input > Temperature, and the shift function of Viscoelasticity",
      .evidence = Evidence::kDocumentation,
      .evidence_note = "public documentation and published model files; not run",
      .advice =
          "Parameters > Load from File; E and nu are long-term, Gvm = G_i, tauvm = tau_i. "
          "Near nu = .5 use the pressure formulation.",
      .harmonic = "exact: Frequency Domain studies take the branches"};
}

}  // namespace viscard
