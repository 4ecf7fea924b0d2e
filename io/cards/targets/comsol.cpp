// COMSOL, linear elastic material with Viscoelasticity. Source: public documentation.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/known_mistakes.h"
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

std::string write_comsol(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const std::string stress = comsol_unit(body.units.stress), time = comsol_unit(body.units.time);
  const auto row = [&](const std::string& suffix, double value, const std::string& unit,
                       const std::string& text) {
    return fmt::format("{}_{} {}{} \"{}\"\n", body.name, suffix, value,
                       unit.empty() ? "" : "[" + unit + "]", text);
  };
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

void read_comsol(const std::string& text, ReadCard& card) {
  card.units = unit_system("SI");  // each expression carries its own
  card.units_were_stated = true;
  std::map<int, CardBranch> branches;
  std::set<std::string> prefixes, names;
  bool has_young = false;
  const char* row = "^\\s*(\\w+)\\s+([-+.\\deE]+)(?:\\[([^\\]]*)\\])?(?:\\s.*)?$";
  const char* suffix = "^(.*_)?(Einf|E_inf|nuinf|nu|rho|Tref|C1|C2|Q|G\\d+|tau\\d+)$";
  for (const CardLine& line : card_lines(text, "%")) {
    if (trimmed(line.text).empty()) continue;
    const auto match = first_match(line.text, row);
    if (!match) {
      card.add("line-not-read", at_line(line, "is not a name, a number[unit] and a text"), false);
      continue;
    }
    const std::string& name = match->group[1];
    const std::string& unit = match->group[3];
    const auto role = first_match(name, suffix);
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
    const std::string& kind = role->group[2];
    if (kind == "Tref" || kind == "C1" || kind == "C2" || kind == "Q") {
      read_shift(kind, card_number(match->group[2], line, name), unit, card);
      continue;
    }
    const double factor = unit_factor(unit, line);
    const double number = card_number(match->group[2], line, name);
    const double value = factor < 1.0 ? number / std::round(1.0 / factor) : number * factor;
    if (kind[0] == 'G' || kind[0] == 't') {
      const bool is_modulus = kind[0] == 'G';
      CardBranch& branch = branches[cell_integer({kind.substr(is_modulus ? 1 : 3)}, 0, line, name)];
      (is_modulus ? branch.shear : branch.time) = value;
      continue;
    }
    read_elastic_number(kind, value, card);
    if (kind[0] != 'E') continue;
    has_young = true;
    if (!role->group[1].empty()) card.name = role->group[1].substr(0, role->group[1].size() - 1);
  }
  if (!has_young) throw std::runtime_error("the card has no parameter ending in Einf or E_inf");
  for (const auto& [index, branch] : branches) card.numbers.branches.push_back(branch);
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
  return {.name = "comsol",
          .code = "COMSOL linear elastic with Viscoelasticity",
          .extension = ".txt",
          .comment = "%",
          .write = write_comsol,
          .read = read_comsol,
          .companions = comsol_companions,
          .deck = DeckWriter{comsol_deck,
                             "comsol compile {0}.java && comsol batch -inputfile {0}.class"},
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
