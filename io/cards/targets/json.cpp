// Neutral JSON, schema viscard-card/1: units stand beside the numbers.
#include "io/basics/json_string.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

nlohmann::ordered_json in_units(const std::vector<double>& values_SI, int exponent) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const double value : values_SI) out.push_back(to_card(value, exponent));
  return out;
}

std::string write_json(const CardBody& body) {
  const DerivedModuli moduli = derived_moduli(body.material);
  const UnitSystem& units = body.units;
  const auto stress = [&](double value_Pa) { return to_card(value_Pa, units.stress_exponent); };
  nlohmann::ordered_json json;
  json["schema"] = "viscard-card/1";
  json["name"] = body.material.name;
  json["units"] = {{"system", units.name},
                   {"stress", units.stress},
                   {"time", units.time},
                   {"density", units.density}};
  json["E0"] = body.numbers.young;
  json["nu"] = body.numbers.poisson;
  if (body.numbers.density > 0.0) json["rho"] = body.numbers.density;
  for (const char* key : {"g", "k", "tau"}) json[key] = nlohmann::ordered_json::array();
  for (const CardBranch& branch : body.numbers.branches) {
    json["g"].push_back(branch.shear);
    json["k"].push_back(branch.bulk);
    json["tau"].push_back(branch.time);
  }
  if (const auto& shift = body.numbers.shift; shift && shift->law == ShiftLaw::kWlf) {
    json["shift"] = {
        {"law", "wlf"}, {"T_ref_C", shift->T_ref_C}, {"C1", shift->C1}, {"C2_K", shift->C2_K}};
  } else if (shift) {
    json["shift"] = {{"law", "arrhenius"},
                     {"T_ref_C", shift->T_ref_C},
                     {"activation_J_mol", shift->activation_J_mol}};
  }
  auto& derived = json["derived"];
  derived["E_inf"] = stress(moduli.E_inf_Pa);
  derived["G0"] = stress(moduli.G0_Pa);
  derived["G_inf"] = stress(moduli.G_inf_Pa);
  if (std::isfinite(moduli.K0_Pa)) derived["K0"] = stress(moduli.K0_Pa);
  if (std::isfinite(moduli.K0_Pa)) derived["K_inf"] = stress(moduli.K_inf_Pa);
  derived["G"] = in_units(moduli.G_Pa, units.stress_exponent);
  derived["K"] = in_units(moduli.K_Pa, units.stress_exponent);
  derived["beta"] = in_units(moduli.beta_1_s, -units.time_exponent);
  json["header"] = body.header;
  return text_from_json(json, 2) + "\n";
}

void read_json(const std::string& text, ReadCard& card) {
  try {
    const nlohmann::json json = json_from_text(text);
    if (json.value("schema", "") != "viscard-card/1") {
      throw std::runtime_error("the card is not of schema viscard-card/1");
    }
    card.units = unit_system(json.at("units").at("system").get<std::string>());
    card.units_were_stated = true;
    card.name = json.value("name", "");
    card.numbers.young = json.at("E0").get<double>();
    card.numbers.poisson = json.at("nu").get<double>();
    card.numbers.density = json.value("rho", 0.0);
    const auto g = json.at("g").get<std::vector<double>>(),
               k = json.at("k").get<std::vector<double>>();
    const auto tau = json.at("tau").get<std::vector<double>>();
    if (g.size() != tau.size() || k.size() != tau.size()) {
      throw std::runtime_error("g, k and tau are of different lengths");
    }
    for (std::size_t i = 0; i < g.size(); ++i)
      card.numbers.branches.push_back({g[i], k[i], tau[i]});
    if (json.contains("shift")) {
      const nlohmann::json& shift = json["shift"];
      const std::string law = shift.value("law", "wlf");
      if (law != "wlf" && law != "arrhenius") {
        throw std::runtime_error("the law of the shift is '" + law +
                                 "'; wlf or arrhenius is expected");
      }
      card.numbers.shift = TemperatureShift{.T_ref_C = shift.at("T_ref_C").get<double>()};
      if (law == "wlf") {
        card.numbers.shift->C1 = shift.at("C1").get<double>();
        card.numbers.shift->C2_K = shift.at("C2_K").get<double>();
      } else {
        card.numbers.shift->law = ShiftLaw::kArrhenius;
        card.numbers.shift->activation_J_mol = shift.at("activation_J_mol").get<double>();
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("not a JSON card: ") + error.what());
  }
}

}  // namespace

CardTarget json_target() {
  return {.name = "json",
          .code = "neutral JSON",
          .extension = ".json",
          .write = write_json,
          .read = read_json,
          .takes_incompressible = true,
          .takes_wlf = true,
          .takes_arrhenius = true,
          .evidence_note = "read back by viscard; units stand beside the numbers",
          .harmonic = "exact: the series itself"};
}

}  // namespace viscard
