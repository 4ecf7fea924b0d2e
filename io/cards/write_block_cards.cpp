// FEBio, MOOSE, COMSOL: nested or named values.
#include "io/cards/card_body.h"
#include "io/cards/number_text.h"
#include "models/material/prony_series.h"

#include <fmt/format.h>

namespace viscard {
namespace {

std::string joined(const std::vector<CardBranch>& branches, double CardBranch::*member) {
  std::string out;
  for (const CardBranch& branch : branches) {
    if (!out.empty()) out += ' ';
    out += shortest_number(branch.*member);
  }
  return out;
}

std::string tag(const char* name, double value) {
  return fmt::format("<{0}>{1}</{0}>", name, shortest_number(value));
}

// COMSOL's unit syntax: "MPa", "t/mm^3".
std::string comsol_unit(std::string unit) {
  if (unit == "Ba") return "dyn/cm^2";
  if (unit.back() == '3') unit.insert(unit.size() - 1, "^");
  return unit;
}

}  // namespace

// FEBio: the stress is g0 times the elastic child's plus a branch for each g_i, so g0 = 1 - sum g
// beside an instantaneous child; g0 defaults to 1 (FEViscoElasticMaterial.cpp). The uncoupled form
// relaxes the deviatoric part alone; Mooney-Rivlin with c2 = 0 has G = 2 c1.
std::string febio_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const bool is_uncoupled = body.target.elastic == ElasticForm::kBulkShear;
  std::string out = fmt::format("<material id=\"1\" name=\"{}\" type=\"{}\">\n", body.name,
                                is_uncoupled ? "uncoupled viscoelastic" : "viscoelastic");
  out += "  " + tag("g0", numbers.equilibrium) + "\n";
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    out += fmt::format("  <g{0}>{1}</g{0}><t{0}>{2}</t{0}>\n", i + 1,
                       shortest_number(numbers.branches[i].shear),
                       shortest_number(numbers.branches[i].time));
  }
  out += is_uncoupled ? "  <elastic type=\"Mooney-Rivlin\">\n    "
                      : "  <elastic type=\"isotropic elastic\">\n    ";
  if (numbers.density > 0.0) out += tag("density", numbers.density);
  if (is_uncoupled) {
    out += tag("c1", 0.5 * numbers.shear) + "<c2>0</c2>" + tag("k", numbers.bulk);
  } else {
    out += tag("E", numbers.young) + tag("v", numbers.poisson);
  }
  return out + "\n  </elastic>\n</material>\n";
}

// MOOSE GeneralizedMaxwellModel: young_modulus is instantaneous and each branch is subtracted from
// it; creep_viscosity is the relaxation time; branches take poisson_ratio
// (GeneralizedMaxwellModel.C).
std::string moose_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  // The linear elastic class spells its parameters differently.
  const bool relaxes = !numbers.branches.empty();
  const std::string elastic =
      fmt::format("    {} = {}\n    {} = {}\n", relaxes ? "young_modulus" : "youngs_modulus",
                  shortest_number(numbers.young), relaxes ? "poisson_ratio" : "poissons_ratio",
                  shortest_number(numbers.poisson));
  std::string out = "[Materials]\n";
  if (!relaxes) {
    out += fmt::format("  [{}]\n    type = ComputeIsotropicElasticityTensor\n{}  []\n", body.name,
                       elastic);
    out +=
        "  [stress]\n    type = ComputeLinearElasticStress\n  []\n  [strain]\n"
        "    type = ComputeSmallStrain\n    displacements = 'disp_x disp_y disp_z'\n  []\n";
  } else {
    out += fmt::format("  [{}]\n    type = GeneralizedMaxwellModel\n{}", body.name, elastic);
    // The default, backward Euler, is first order; this rule takes stress linear in the step.
    out += "    integration_rule = zienkiewicz\n";
    out += "    creep_modulus = '" + joined(numbers.branches, &CardBranch::shear) + "'\n";
    out += "    creep_viscosity = '" + joined(numbers.branches, &CardBranch::time) + "'\n  []\n";
    out +=
        "  [creep]\n    type = LinearViscoelasticStressUpdate\n  []\n"
        "  [stress]\n    type = ComputeMultipleInelasticStress\n"
        "    inelastic_models = 'creep'\n  []\n"
        "  [strain]\n    type = ComputeIncrementalSmallStrain\n"
        "    displacements = 'disp_x disp_y disp_z'\n  []\n";
  }
  if (numbers.density > 0.0) {
    out +=
        "  [density]\n    type = GenericConstantMaterial\n    prop_names = 'density'\n"
        "    prop_values = '" +
        shortest_number(numbers.density) + "'\n  []\n";
  }
  out += "[]\n";
  if (relaxes) {
    out +=
        "[UserObjects]\n  [update]\n    type = LinearViscoelasticityManager\n"
        "    viscoelastic_model = " +
        body.name + "\n  []\n[]\n";
  }
  return out;
}

// COMSOL, Parameters > Load from File: name, expression, description. Units stand in the
// expression, so the file is right in every model. E and nu are long-term, the branches absolute
// shear moduli.
std::string comsol_body(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const std::string stress = comsol_unit(body.units.stress), time = comsol_unit(body.units.time);
  const auto row = [&](const std::string& suffix, double value, const std::string& unit,
                       const std::string& text) {
    return fmt::format("{}_{} {}{} \"{}\"\n", body.name, suffix, shortest_number(value),
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
    out += row("Tref", numbers.shift->T_ref_C, "degC", "WLF reference temperature");
    out += row("C1", numbers.shift->C1, "", "WLF constant C1");
    out += row("C2", numbers.shift->C2_K, "K", "WLF constant C2");
  }
  return out;
}

// Spreadsheet data format: "%" opens a comment, columns are blank-separated.
std::string comsol_relaxation_table(const CardBody& body) {
  std::string out = fmt::format("% t [{}]  E(t) [{}]\n", body.units.time, body.units.stress);
  const PronySeries series = young_series(body.material);
  for (const double time_s : comparison_times_s(body.material, 101)) {
    out += shortest_number(to_card(time_s, body.units.time_exponent)) + " " +
           shortest_number(
               to_card(relaxation_modulus_Pa(series, time_s), body.units.stress_exponent)) +
           "\n";
  }
  return out;
}

}  // namespace viscard
