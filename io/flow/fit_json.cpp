#include "fit/intervals/viscosity.h"
#include "io/flow/flow_json.h"
#include "io/materials/material_json.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace viscard {
namespace {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json terms_of(const FitResult& fit, const std::string& unit) {
  Json terms = Json::array();
  const std::string stem = unit == "_N" ? "force" : fit.is_stiffness ? "stiffness" : "modulus";
  for (const FittedTerm& term : fit.terms) {
    Json row;
    row[stem + unit] = number(term.modulus_Pa);
    row["g"] = number(term.g);
    row["tau_s"] = number(term.tau_s);
    row[stem + "_se" + unit] = number(term.modulus_se_Pa);
    row["ln_tau_se"] = number(term.ln_tau_se);
    row["interval_95"][stem + unit] = json_from(term.modulus_Pa_95);
    row["interval_95"]["g"] = json_from(term.g_95);
    row["interval_95"]["tau_s"] = json_from(term.tau_s_95);
    const TermIntervals combined = combined_intervals(fit, terms.size());
    row["combined_interval_95"] = {{stem + unit, json_from(combined.modulus_Pa)},
                                   {"g", json_from(combined.g)},
                                   {"tau_s", json_from(combined.tau_s)}};
    terms.push_back(row);
  }
  return terms;
}

Json orders_of(const FitResult& fit) {
  Json orders = Json::array();
  for (const OrderRow& row : fit.orders) {
    orders.push_back({{"n_terms", row.n_terms},
                      {"rss", number(row.rss)},
                      {"aicc", number(row.aicc)},
                      {"bic", number(row.bic)},
                      {"cv", number(row.cv)},
                      {"chosen", row.is_chosen}});
  }
  return orders;
}

Json flags_of(const FitResult& fit) {
  Json flags = Json::array();
  for (const MaterialFlag& flag : fit.flags) {
    Json& row = flags.emplace_back(Json{{"name", flag.name}});
    if (flag.term > 0) row["term"] = flag.term;
    row["text"] = flag.text;
  }
  return flags;
}

Json profiles_of(const FitResult& fit) {
  Json profiles = Json::array();
  for (const ProfileCurve& curve : fit.profiles) {
    profiles.push_back({{"parameter", curve.parameter},
                        {"value", curve.value},
                        {"rise", curve.rise},
                        {"interval_95", json_from(curve.interval_95)}});
  }
  return profiles;
}

Json json_of(const TemperatureShift& shift, double chi2, double bic) {
  Json json;
  if (shift.law == ShiftLaw::kWlf) {
    json = {{"C1", number(shift.C1)},
            {"C2_K", number(shift.C2_K)},
            {"interval_95", {{"C1", json_from(shift.C1_95)}, {"C2_K", json_from(shift.C2_K_95)}}}};
  } else {
    json = {{"activation_J_mol", number(shift.activation_J_mol)},
            {"interval_95", {{"activation_J_mol", json_from(shift.activation_J_mol_95)}}}};
  }
  json["chi2"] = number(chi2);
  json["bic"] = number(bic);
  return json;
}

Json json_of(const std::vector<ShiftFactor>& factors, bool has_vertical_shift) {
  Json rows = Json::array();
  for (const ShiftFactor& factor : factors) {
    Json& row = rows.emplace_back(Json{{"temperature_C", number(factor.temperature_C)},
                                       {"ln_a", number(factor.ln_a)},
                                       {"ln_a_se", number(factor.ln_a_se)}});
    if (has_vertical_shift) row["ln_b"] = number(factor.ln_b);
    if (has_vertical_shift) row["ln_b_se"] = number(factor.ln_b_se);
  }
  return rows;
}

Json json_of(const MasterCurve& curve) {
  const ShiftLaws& laws = curve.laws;
  Json json{{"T_ref_C", number(curve.T_ref_C)}};
  json["factors"] = json_of(curve.factors, curve.has_vertical_shift);
  json["form"] = curve.form;
  json["residual_relative"] = number(curve.residual);
  json["free_factors"] = json_of(curve.free_factors, curve.has_vertical_shift);
  json["free_residual_relative"] = number(curve.free_residual);
  json["left_out"] = curve.left_out;
  if (laws.wlf) json["wlf"] = json_of(*laws.wlf, laws.wlf_chi2, laws.wlf_bic);
  if (laws.arrhenius) {
    json["arrhenius"] = json_of(*laws.arrhenius, laws.arrhenius_chi2, laws.arrhenius_bic);
  }
  if (laws.better() != nullptr) json["better"] = laws.wlf_is_better ? "wlf" : "arrhenius";
  return json;
}

Json json_of(const FractionalDiagnosis& fractional) {
  return {{"E_inf_Pa", number(fractional.model.equilibrium_Pa)},
          {"E_1_Pa", number(fractional.model.branch_Pa)},
          {"tau_s", number(fractional.model.tau_s)},
          {"alpha", number(fractional.model.alpha)},
          {"chi_square", number(fractional.chi_square)},
          {"series_chi_square", number(fractional.series_chi_square)},
          {"bic_difference", number(fractional.bic_difference)}};
}

Json laws_of(const FitResult& fit) {
  Json laws = Json::array();
  for (const FittedLaw& law : fit.laws) {
    Json row{{"name", law.name},
             {"n_parameters", law.n_parameters},
             {"rss", number(law.rss)},
             {"bic", number(law.bic)},
             {"bic_difference", number(law.bic_difference)},
             {"at_bound", law.is_at_bound}};
    row["parameters"] = Json::object();
    for (const LawParameter& one : law.parameters) {
      row["parameters"][one.name] = {{"value", number(one.value)},
                                     {"se", number(one.se)},
                                     {"interval_95", json_from(one.interval_95)}};
    }
    row["series"] = {{"n_terms", law.series.terms.size()},
                     {"largest_error", number(law.series_error)},
                     {"t_min_s", number(law.t_min_s)},
                     {"t_max_s", number(law.t_max_s)}};
    laws.push_back(row);
  }
  return laws;
}

Json tests_of(const FittedFile& fitted) {
  Json tests = Json::array();
  for (std::size_t k = 0; k < fitted.result.tests.size(); ++k) {
    const FittedTest& test = fitted.result.tests[k];
    const FitCurves& curves = test.curves;
    const std::string unit = test.is_stiffness ? "_N_m" : "_Pa";
    const std::string letter = test.is_stiffness ? "K" : "E";
    Json row{{"name", test.name}, {"kind", name_of_kind(test.kind)}};
    if (k < fitted.tests.size()) row["file"] = fitted.tests[k].path;
    row["n_samples"] = test.n_samples;
    row["unit"] = test.kind == FitKind::kDma ? "relative" : test.fitted_unit;
    row["rss"] = number(test.rss);
    row["noise"] = {{"sigma", number(test.noise.sigma)},
                    {"inflation", number(test.noise.inflation)}};
    row["from_s"] = number(test.from_s);
    row["to_s"] = number(test.to_s);
    if (test.has_scale) {
      row["scale"] = number(test.scale);
      row["scale_interval_95"] = json_from(test.scale_95);
    }
    row["alone"] = {{"n_terms", test.own_terms},
                    {letter + "0" + unit, number(test.own_E0_Pa)},
                    {letter + "0_interval_95", json_from(test.own_E0_95)},
                    {letter + "_inf" + unit, number(test.own_E_inf_Pa)},
                    {letter + "_inf_interval_95", json_from(test.own_E_inf_95)},
                    {"rss", number(test.own_rss)}};
    row["difference"] = {
        {"relative", number(test.difference)}, {"interval_95", json_from(test.difference_95)},
        {"worst", number(test.worst)},         {"p_value", number(test.p_value)},
        {"degrees_of_freedom", test.freedom},  {"disagrees", test.disagrees}};
    row["residuals"][test.kind == FitKind::kDma ? "frequency_Hz" : "time_s"] = curves.time_s;
    row["residuals"]["measured"] = curves.measured;
    row["residuals"]["fitted"] = curves.fitted;
    row["residuals"]["sigma"] = curves.sigma;
    if (!curves.loss_measured.empty()) {
      row["residuals"]["loss_measured"] = curves.loss_measured;
      row["residuals"]["loss_fitted"] = curves.loss_fitted;
      row["residuals"]["loss_sigma"] = curves.loss_sigma;
    }
    tests.push_back(row);
  }
  return tests;
}

}  // namespace

const char* name_of_kind(FitKind kind) {
  constexpr const char* kNames[] = {"indentation", "relaxation", "creep", "dma", "several"};
  return kNames[static_cast<std::size_t>(kind)];
}

Json json_from_fit(const FittedFile& fitted) {
  const FitResult& fit = fitted.result;
  const std::string unit = fitted.has_no_depth ? "_N" : fit.is_stiffness ? "_N_m" : "_Pa";
  const std::string letter = fitted.has_no_depth ? "F" : fit.is_stiffness ? "K" : "E";
  Json json;
  json["file"] = fitted.path;
  if (!fitted.maker.empty()) json["maker"] = fitted.maker;
  json["kind"] = name_of_kind(fit.kind);
  json["trustworthy"] = fit.is_trustworthy;
  json[letter + "0" + unit] = number(fit.E0_Pa);
  json[letter + "_inf" + unit] = number(fit.E_inf_Pa);
  json[letter + "0_se" + unit] = number(fit.E0_se_Pa);
  json[letter + "_inf_se" + unit] = number(fit.E_inf_se_Pa);
  json[letter + "0_interval_95"] = json_from(fit.E0_interval_95);
  json[letter + "_inf_interval_95"] = json_from(fit.E_inf_interval_95);
  if (const auto viscosity = viscosity_of(fit)) {
    json["viscosity_Pa_s"] = number(viscosity->value_Pa_s);
    json["viscosity_interval_95"] = json_from(viscosity->interval_95);
  }
  json["sum_g"] = number(fit.sum_g);
  json["sum_g_interval_95"] = json_from(fit.sum_g_95);
  json["terms"] = terms_of(fit, unit);
  json["rss"] = number(fit.rss);
  json["n_samples"] = fit.n_samples;
  json["n_averages"] = fit.n_averages;
  json["n_terms"] = fit.terms.size();
  json["orders"] = orders_of(fit);
  if (fit.bic_liquid_minus_solid) {
    json["bic_liquid_minus_solid"] = number(*fit.bic_liquid_minus_solid);
  }
  json["flags"] = flags_of(fit);
  json["noise"] = {{"sigma", number(fit.noise.sigma)}, {"inflation", number(fit.noise.inflation)}};
  json["systematic_relative"] = number(fit.systematic_relative);
  Json& parts = json["systematic_parts"] = Json::array();
  for (const SystematicPart& p : fit.systematic_parts) {
    parts.push_back({{"cause", p.cause}, {"E0", p.E0}, {"g", p.g}, {"tau_s", p.tau}});
  }
  json["gain_drift_relative"] = number(fit.gain_drift_relative);
  const ModulusIntervals combined = combined_intervals(fit);
  json[letter + "0_combined_interval_95"] = json_from(combined.E0_Pa);
  json[letter + "_inf_combined_interval_95"] = json_from(combined.E_inf_Pa);
  if (fitted.temperature) {
    const RunTemperature& measured = *fitted.temperature;
    json["temperature"] = {{"mean_C", number(measured.mean_C)},
                           {"min_C", number(measured.min_C)},
                           {"max_C", number(measured.max_C)},
                           {"n_readings", measured.n_readings}};
  }
  if (fit.first) {
    json[letter + "_first_sample" + unit] = number(fit.first->modulus_Pa);
    json[letter + "_first_sample_interval_95"] = json_from(fit.first->interval_95);
    json["first_sample_s"] = number(fit.first->time_s);
  }
  if (fit.highest) {
    json[letter + "_storage_highest" + unit] = number(fit.highest->modulus_Pa);
    json[letter + "_storage_highest_interval_95"] = json_from(fit.highest->interval_95);
    json["highest_frequency_Hz"] = number(fit.highest->frequency_Hz);
  }
  if (fit.drift) {
    json["drift"] = {{"per_s", number(fit.drift->per_s)},
                     {"se_per_s", number(fit.drift->se_per_s)},
                     {"unit", fitted.fitted_unit + "/s"}};
  }
  if (fit.lack_of_fit) {
    json["lack_of_fit"] = {{"structure", number(fit.lack_of_fit->structure)},
                           {"noise", number(fit.lack_of_fit->noise)},
                           {"significant", fit.lack_of_fit->is_significant}};
  }
  json["fit_from_s"] = number(fit.fit_from_s);
  json["fit_to_s"] = number(fit.fit_to_s);
  if (fit.contact_position_m) json["contact_position_m"] = number(*fit.contact_position_m);
  if (fit.stage_speed) json["stage_speed"] = number(*fit.stage_speed);
  if (fit.stage_speed) json["stage_speed_se"] = number(fit.stage_speed_se);
  if (fit.dashpot_Pa_s) json["dashpot_Pa_s"] = number(*fit.dashpot_Pa_s);
  if (fit.dashpot_Pa_s) json["dashpot_se_Pa_s"] = number(fit.dashpot_se_Pa_s);
  if (const auto& two = fit.two_point) {
    json["two_point"] = {{"modulus_Pa", number(two->modulus_Pa)},
                         {"se_Pa", number(two->se_Pa)},
                         {"half_space_modulus_Pa", number(two->half_space_modulus_Pa)},
                         {"bias", two->bias}};
  }
  if (fit.n_bootstrap > 0) json["n_bootstrap"] = fit.n_bootstrap;
  if (!fit.profiles.empty()) json["profiles"] = profiles_of(fit);
  if (fitted.master) json["shift"] = json_of(*fitted.master);
  if (fitted.fractional) json["fractional_zener"] = json_of(*fitted.fractional);
  if (!fit.laws.empty()) json["laws"] = laws_of(fit);
  if (!fitted.model.empty()) json["model"] = fitted.model;
  if (!fit.tests.empty()) json["tests"] = tests_of(fitted);
  json["n_spikes"] = fit.n_spikes;
  if (!fitted.chosen.empty()) json["chosen"] = fitted.chosen;
  json["n_rows"] = fit.n_samples + fit.n_left_out;
  json["n_left_out"] = fit.n_left_out;
  json["left_out"] = Json::object();  // rows by reason
  for (const LeftOutRows& left : fit.left_out) json["left_out"][left.reason] = left.count;
  if (fit.n_contacts > 0) json["n_contacts"] = fit.n_contacts;
  json["n_before_test"] = fitted.n_before_test;
  return json;
}

}  // namespace viscard
