// MFront behaviour, neutral JSON and CSV table: texts that programs compile or parse.
#include "io/cards/card_body.h"
#include "io/cards/number_text.h"
#include "models/material/retardation_spectrum.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

std::string array_of(const std::vector<CardBranch>& branches, double CardBranch::*member) {
  std::string out;
  for (const CardBranch& branch : branches) {
    out += (out.empty() ? "" : ", ") + shortest_number(branch.*member);
  }
  return "{" + out + "}";
}

// Stress at the end of a step in which strain is linear in time: each branch decays by exp(-dt/tau)
// and gains its modulus times phi_1(dt/tau) = (1 - exp(-x))/x of the strain increment, exactly
// (Taylor, Pister & Goudreau, IJNME 2 (1970) 45). dt = 0 is a jump: phi_1 = 1.
constexpr const char* kMfrontIntegrator = R"(@StateVariable StressStensor q[Nt];
q.setEntryName("BranchStress");

@ProvidesSymmetricTangentOperator;
@Integrator {
  const real K0 = E0 / (3 * (1 - 2 * nu0));
  const real G0 = E0 / (2 * (1 + nu0));
  real Kt = K0;
  real Gt = G0;
  for (unsigned short i = 0; i != Nt; ++i) {
    Kt -= k[i] * K0;
    Gt -= g[i] * G0;
  }
  const StrainStensor e1 = eto + deto;
  sig = (Kt - 2 * Gt / 3) * trace(e1) * StrainStensor::Id() + 2 * Gt * e1;
  for (unsigned short i = 0; i != Nt; ++i) {
    const real x = dt / tau[i];
    const real phi = x > 1.e-300 ? -std::expm1(-x) / x : real(1);
    const real Kb = k[i] * K0 * phi;
    const real Gb = g[i] * G0 * phi;
    q[i] = std::exp(-x) * q[i] + (Kb - 2 * Gb / 3) * trace(deto) * StrainStensor::Id() +
           2 * Gb * deto;
    sig += q[i];
    Kt += Kb;
    Gt += Gb;
  }
  if (computeTangentOperator_) {
    Dt = (Kt - 2 * Gt / 3) * Stensor4::IxI() + 2 * Gt * Stensor4::Id();
  }
}
)";

nlohmann::ordered_json in_units(const std::vector<double>& values_SI, int exponent) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const double value : values_SI) out.push_back(to_card(value, exponent));
  return out;
}

// 1/s in the frequency unit that belongs to a time unit.
const char* frequency_unit(const UnitSystem& units) {
  return units.time_exponent == 3 ? "kHz" : "Hz";
}

}  // namespace

std::string mfront_body(const CardBody& body) {
  CardNumbers numbers = body.numbers;
  // MFront makes a scalar of an array of one; a branch of no stiffness keeps it an array.
  while (numbers.branches.size() < 2) {
    const double time = numbers.branches.empty() ? 1.0 : numbers.branches.back().time;
    numbers.branches.push_back({0.0, 0.0, time});
  }
  std::string out = "@DSL Default;\n@Behaviour " + body.name + ";\n\n";
  if (numbers.density > 0.0) {
    out += "// mass density " + shortest_number(numbers.density) + " " + body.units.density + "\n";
  }
  out += fmt::format("@IntegerConstant Nt = {};\n", numbers.branches.size());
  out += "@Parameter real E0 = " + shortest_number(numbers.young) + ";\n";
  out += "@Parameter real nu0 = " + shortest_number(numbers.poisson) + ";\n";
  out += "@Parameter real g[Nt] = " + array_of(numbers.branches, &CardBranch::shear) + ";\n";
  out += "@Parameter real k[Nt] = " + array_of(numbers.branches, &CardBranch::bulk) + ";\n";
  out += "@Parameter real tau[Nt] = " + array_of(numbers.branches, &CardBranch::time) + ";\n\n";
  return out + kMfrontIntegrator;
}

// Property names of the TFEL gallery's GeneralizedMaxwell.mfront, as MTest takes them.
std::string mfront_properties(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const auto property = [](const std::string& name, double value) {
    return "@MaterialProperty<constant> '" + name + "' " + shortest_number(value) + ";\n";
  };
  std::string out = fmt::format(
      "// for the gallery's GeneralizedMaxwell compiled with @IntegerConstant Nv = {};\n",
      numbers.branches.size());
  out += property("BulkModulus", numbers.bulk) + property("ShearModulus", numbers.shear);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    out += property("ViscoelasticBulkModulus" + index, numbers.branches[i].bulk);
    out += property("ViscoelasticShearModulus" + index, numbers.branches[i].shear);
    out += property("TimeScale" + index, numbers.branches[i].time);
  }
  return out;
}

std::string json_body(const CardBody& body) {
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
  if (body.numbers.shift) {
    json["shift"] = {{"law", "wlf"},
                     {"T_ref_C", body.numbers.shift->T_ref_C},
                     {"C1", body.numbers.shift->C1},
                     {"C2_K", body.numbers.shift->C2_K}};
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
  return json.dump(2) + "\n";
}

std::string csv_body(const CardBody& body) {
  const UnitSystem& units = body.units;
  const PronySeries relaxation = young_series(body.material);
  const RetardationSpectrum creep = retardation_from_relaxation(relaxation);
  std::string out = fmt::format(
      "time_{1},modulus_{0},compliance_1_{0},frequency_{2},storage_modulus_{0},loss_modulus_{0}\n",
      units.stress, units.time, frequency_unit(units));
  const auto cell = [](double value_SI, int exponent) {
    return shortest_number(to_card(value_SI, exponent));
  };
  for (const double time_s : comparison_times_s(body.material, 241)) {
    const double frequency_Hz = 1.0 / (2.0 * std::numbers::pi * time_s);
    const ComplexModulus complex = complex_modulus_Pa(relaxation, 1.0 / time_s);
    const int stress = units.stress_exponent;
    out += cell(time_s, units.time_exponent) + "," +
           cell(relaxation_modulus_Pa(relaxation, time_s), stress) + "," +
           cell(creep_compliance_1_Pa(creep, time_s), -stress) + "," +
           cell(frequency_Hz, -units.time_exponent) + "," + cell(complex.storage_Pa, stress) + "," +
           cell(complex.loss_Pa, stress) + "\n";
  }
  return out;
}

std::string card_body(const CardBody& body) {
  const std::string& name = body.target.name;
  if (name == "abaqus") return abaqus_body(body);
  if (name == "ansys") return ansys_body(body);
  if (name == "lsdyna") return lsdyna_body(body);
  if (name == "lsdyna006") return lsdyna006_body(body);
  if (name == "febio" || name == "febio-uncoupled") return febio_body(body);
  if (name == "mfront") return mfront_body(body);
  if (name == "calculix") return calculix_body(body);
  if (name == "openradioss") return openradioss_body(body);
  if (name == "comsol") return comsol_body(body);
  if (name == "moose") return moose_body(body);
  if (name == "frontistr") return frontistr_body(body);
  if (name == "csv") return csv_body(body);
  return json_body(body);
}

std::vector<CompanionFile> card_companions(const CardBody& body) {
  if (body.target.name == "comsol") {
    return {{"_relaxation.txt", comsol_relaxation_table(body)}};
  }
  if (body.target.name == "mfront" && body.material.nu < 0.5) {
    const CardTarget gallery = mfront_gallery_target();
    CardBody copy{body.name,     numbers_from_material(body.material, gallery, body.units),
                  gallery,       body.units,
                  body.material, body.header};
    return {{"_gallery.mtest", mfront_properties(copy)}};
  }
  return {};
}

}  // namespace viscard
