#include "io/flow/json/fit_json_parts.h"

namespace viscard {
namespace {

Json json_of(const TemperatureShift& shift, double chi2, double bic) {
  Json json;
  if (shift.law == ShiftLaw::kWlf) {
    json = {{"C1", json_number(shift.C1)},
            {"C2_K", json_number(shift.C2_K)},
            {"interval_95", {{"C1", json_from(shift.C1_95)}, {"C2_K", json_from(shift.C2_K_95)}}}};
  } else {
    json = {{"activation_J_mol", json_number(shift.activation_J_mol)},
            {"interval_95", {{"activation_J_mol", json_from(shift.activation_J_mol_95)}}}};
  }
  json["chi2"] = json_number(chi2);
  json["bic"] = json_number(bic);
  return json;
}

Json json_of(const std::vector<ShiftFactor>& factors, bool has_vertical_shift) {
  Json rows = Json::array();
  for (const ShiftFactor& factor : factors) {
    Json& row = rows.emplace_back(Json{{"temperature_C", json_number(factor.temperature_C)},
                                       {"ln_a", json_number(factor.ln_a)},
                                       {"ln_a_se", json_number(factor.ln_a_se)}});
    if (has_vertical_shift) row["ln_b"] = json_number(factor.ln_b);
    if (has_vertical_shift) row["ln_b_se"] = json_number(factor.ln_b_se);
  }
  return rows;
}

}  // namespace

Json json_from(const MasterCurve& curve) {
  const ShiftLaws& laws = curve.laws;
  Json json{{"T_ref_C", json_number(curve.T_ref_C)}};
  json["factors"] = json_of(curve.factors, curve.has_vertical_shift);
  json["form"] = curve.form;
  json["residual_relative"] = json_number(curve.residual);
  json["free_factors"] = json_of(curve.free_factors, curve.has_vertical_shift);
  json["free_residual_relative"] = json_number(curve.free_residual);
  json["left_out"] = curve.left_out;
  if (laws.wlf) json["wlf"] = json_of(*laws.wlf, laws.wlf_chi2, laws.wlf_bic);
  if (laws.arrhenius) {
    json["arrhenius"] = json_of(*laws.arrhenius, laws.arrhenius_chi2, laws.arrhenius_bic);
  }
  if (laws.better() != nullptr) json["better"] = laws.wlf_is_better ? "wlf" : "arrhenius";
  return json;
}

}  // namespace viscard
