// Reader of COMSOL's parameter text.
#include "io/cards/card_lines.h"

#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>

namespace viscard {
namespace {

// Units COMSOL users write in these expressions, as a factor to SI.
double comsol_factor(const std::string& unit, const CardLine& line) {
  static const std::map<std::string, double> kFactors{
      {"", 1.0},       {"Pa", 1.0},      {"kPa", 1e3},      {"MPa", 1e6},      {"GPa", 1e9},
      {"N/m^2", 1.0},  {"N/mm^2", 1e6},  {"dyn/cm^2", 0.1}, {"s", 1.0},        {"ms", 1e-3},
      {"us", 1e-6},    {"min", 60.0},    {"h", 3600.0},     {"kg/m^3", 1.0},   {"g/cm^3", 1e3},
      {"g/mm^3", 1e6}, {"kg/mm^3", 1e9}, {"t/mm^3", 1e12},  {"kg/um^3", 1e18}, {"1", 1.0}};
  const auto found = kFactors.find(unit);
  if (found == kFactors.end()) {
    throw std::runtime_error("line " + std::to_string(line.number) + ": unit [" + unit +
                             "] is not known");
  }
  return found->second;
}

}  // namespace

void read_comsol(const std::string& text, ReadCard& card) {
  card.units = unit_system("SI");  // each expression carries its own
  card.units_were_stated = true;
  std::map<int, CardBranch> branches;
  bool has_young = false;
  const std::regex row("^\\s*(\\w+)\\s+([-+.\\deE]+)(?:\\[([^\\]]*)\\])?(?:\\s.*)?$");
  const std::regex suffix("^(.*_)?(Einf|E_inf|nuinf|nu|rho|Tref|C1|C2|G\\d+|tau\\d+)$");
  for (const CardLine& line : card_lines(text, "%")) {
    std::smatch match, role;
    if (!std::regex_match(line.text, match, row)) continue;
    const std::string name = match[1].str();
    if (!std::regex_match(name, role, suffix)) continue;
    const std::string shift_role = role[2].str();
    if (shift_role == "Tref" || shift_role == "C1" || shift_role == "C2") {
      if (!card.numbers.shift) card.numbers.shift.emplace();
      double& constant = shift_role == "Tref" ? card.numbers.shift->T_ref_C
                         : shift_role == "C1" ? card.numbers.shift->C1
                                              : card.numbers.shift->C2_K;
      constant = card_number(match[2].str(), line, name);
      if (shift_role == "Tref" && match[3].str() == "K") constant += kAbsoluteZero_C;
      continue;
    }
    const double factor = comsol_factor(match[3].str(), line);
    const double number = card_number(match[2].str(), line, name);
    const double value = factor < 1.0 ? number / std::round(1.0 / factor) : number * factor;
    const std::string kind = role[2].str();
    if (kind == "Einf" || kind == "E_inf") {
      card.numbers.young = value;
      has_young = true;
      if (role[1].length() > 0) card.name = role[1].str().substr(0, role[1].str().size() - 1);
    } else if (kind == "nuinf" || kind == "nu") {
      card.numbers.poisson = value;
    } else if (kind == "rho") {
      card.numbers.density = value;
    } else if (kind[0] == 'G') {
      branches[std::stoi(kind.substr(1))].shear = value;
    } else {
      branches[std::stoi(kind.substr(3))].time = value;
    }
  }
  if (!has_young) throw std::runtime_error("the card has no parameter ending in Einf or E_inf");
  for (const auto& [index, branch] : branches) card.numbers.branches.push_back(branch);
}

}  // namespace viscard
