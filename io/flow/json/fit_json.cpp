#include "fit/intervals/viscosity.h"
#include "io/flow/json/fit_json_parts.h"
#include "io/flow/json/flow_json.h"

#include <cmath>

namespace viscard {

Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

namespace {

Json terms_of(const FitResult& fit, const std::string& unit) {
  Json terms = Json::array();
  const std::string stem = unit == "_N" ? "force" : fit.is_stiffness ? "stiffness" : "modulus";
  for (const FittedTerm& term : fit.terms) {
    Json row;
    row[stem + unit] = json_number(term.modulus_Pa);
    row["g"] = json_number(term.g);
    row["tau_s"] = json_number(term.tau_s);
    row[stem + "_se" + unit] = json_number(term.modulus_se_Pa);
    row["ln_tau_se"] = json_number(term.ln_tau_se);
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
                      {"rss", json_number(row.rss)},
                      {"aicc", json_number(row.aicc)},
                      {"bic", json_number(row.bic)},
                      {"cv", json_number(row.cv)},
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

Json json_of(const FractionalDiagnosis& fractional) {
  return {{"E_inf_Pa", json_number(fractional.model.equilibrium_Pa)},
          {"E_1_Pa", json_number(fractional.model.branch_Pa)},
          {"tau_s", json_number(fractional.model.tau_s)},
          {"alpha", json_number(fractional.model.alpha)},
          {"chi_square", json_number(fractional.chi_square)},
          {"series_chi_square", json_number(fractional.series_chi_square)},
          {"bic_difference", json_number(fractional.bic_difference)}};
}

Json laws_of(const FitResult& fit) {
  Json laws = Json::array();
  for (const FittedLaw& law : fit.laws) {
    Json row{{"name", law.name},
             {"n_parameters", law.n_parameters},
             {"rss", json_number(law.rss)},
             {"bic", json_number(law.bic)},
             {"bic_difference", json_number(law.bic_difference)},
             {"at_bound", law.is_at_bound}};
    row["parameters"] = Json::object();
    for (const LawParameter& one : law.parameters) {
      row["parameters"][one.name] = {{"value", json_number(one.value)},
                                     {"se", json_number(one.se)},
                                     {"interval_95", json_from(one.interval_95)}};
    }
    row["series"] = {{"n_terms", law.series.terms.size()},
                     {"largest_error", json_number(law.series_error)},
                     {"t_min_s", json_number(law.t_min_s)},
                     {"t_max_s", json_number(law.t_max_s)}};
    laws.push_back(row);
  }
  return laws;
}

Json json_of(const RunTemperature& measured) {
  return {{"mean_C", json_number(measured.mean_C)},
          {"min_C", json_number(measured.min_C)},
          {"max_C", json_number(measured.max_C)},
          {"n_readings", measured.n_readings}};
}

// Letter and unit of the keys of moduli. They are forces if the depth is unknown, stiffnesses if the
// geometry is.
struct ModulusKeys {
  std::string letter, unit;
};

ModulusKeys keys_of(const FittedFile& fitted) {
  if (fitted.has_no_depth) return {"F", "_N"};
  return fitted.result.is_stiffness ? ModulusKeys{"K", "_N_m"} : ModulusKeys{"E", "_Pa"};
}

void add_moduli(const FitResult& fit, const ModulusKeys& keys, Json& json) {
  const auto& [letter, unit] = keys;
  json[letter + "0" + unit] = json_number(fit.E0_Pa);
  json[letter + "_inf" + unit] = json_number(fit.E_inf_Pa);
  json[letter + "0_se" + unit] = json_number(fit.E0_se_Pa);
  json[letter + "_inf_se" + unit] = json_number(fit.E_inf_se_Pa);
  json[letter + "0_interval_95"] = json_from(fit.E0_interval_95);
  json[letter + "_inf_interval_95"] = json_from(fit.E_inf_interval_95);
  if (const auto viscosity = viscosity_of(fit)) {
    json["viscosity_Pa_s"] = json_number(viscosity->value_Pa_s);
    json["viscosity_interval_95"] = json_from(viscosity->interval_95);
  }
  json["sum_g"] = json_number(fit.sum_g);
  json["sum_g_interval_95"] = json_from(fit.sum_g_95);
  json["terms"] = terms_of(fit, unit);
}

void add_quality(const FitResult& fit, Json& json) {
  json["rss"] = json_number(fit.rss);
  json["n_samples"] = fit.n_samples;
  json["n_averages"] = fit.n_averages;
  json["n_terms"] = fit.terms.size();
  json["orders"] = orders_of(fit);
  if (fit.bic_liquid_minus_solid) {
    json["bic_liquid_minus_solid"] = json_number(*fit.bic_liquid_minus_solid);
  }
  json["flags"] = flags_of(fit);
  json["noise"] = {{"sigma", json_number(fit.noise.sigma)},
                   {"inflation", json_number(fit.noise.inflation)}};
}

void add_systematic(const FitResult& fit, const std::string& letter, Json& json) {
  json["systematic_relative"] = json_number(fit.systematic_relative);
  Json& parts = json["systematic_parts"] = Json::array();
  for (const SystematicPart& p : fit.systematic_parts) {
    parts.push_back({{"cause", p.cause}, {"E0", p.E0}, {"g", p.g}, {"tau_s", p.tau}});
  }
  json["gain_drift_relative"] = json_number(fit.gain_drift_relative);
  const ModulusIntervals combined = combined_intervals(fit);
  json[letter + "0_combined_interval_95"] = json_from(combined.E0_Pa);
  json[letter + "_inf_combined_interval_95"] = json_from(combined.E_inf_Pa);
}

// Moduli at the ends of what was measured: at the first sample and at the highest frequency.
void add_measured_ends(const FitResult& fit, const ModulusKeys& keys, Json& json) {
  const auto& [letter, unit] = keys;
  if (fit.first) {
    json[letter + "_first_sample" + unit] = json_number(fit.first->modulus_Pa);
    json[letter + "_first_sample_interval_95"] = json_from(fit.first->interval_95);
    json["first_sample_s"] = json_number(fit.first->time_s);
  }
  if (fit.highest) {
    json[letter + "_storage_highest" + unit] = json_number(fit.highest->modulus_Pa);
    json[letter + "_storage_highest_interval_95"] = json_from(fit.highest->interval_95);
    json["highest_frequency_Hz"] = json_number(fit.highest->frequency_Hz);
  }
}

void add_lack_of_fit(const FitResult& fit, const std::string& fitted_unit, Json& json) {
  if (fit.drift) {
    json["drift"] = {{"per_s", json_number(fit.drift->per_s)},
                     {"se_per_s", json_number(fit.drift->se_per_s)},
                     {"unit", fitted_unit + "/s"}};
  }
  if (fit.lack_of_fit) {
    json["lack_of_fit"] = {{"structure", json_number(fit.lack_of_fit->structure)},
                           {"noise", json_number(fit.lack_of_fit->noise)},
                           {"significant", fit.lack_of_fit->is_significant}};
  }
}

// The part that was fitted, and what the fit found out about the rig.
void add_rig(const FitResult& fit, Json& json) {
  json["fit_from_s"] = json_number(fit.fit_from_s);
  json["fit_to_s"] = json_number(fit.fit_to_s);
  if (fit.contact_position_m) json["contact_position_m"] = json_number(*fit.contact_position_m);
  if (fit.stage_speed) json["stage_speed"] = json_number(*fit.stage_speed);
  if (fit.stage_speed) json["stage_speed_se"] = json_number(fit.stage_speed_se);
  if (fit.dashpot_Pa_s) json["dashpot_Pa_s"] = json_number(*fit.dashpot_Pa_s);
  if (fit.dashpot_Pa_s) json["dashpot_se_Pa_s"] = json_number(fit.dashpot_se_Pa_s);
  if (const auto& two = fit.two_point) {
    json["two_point"] = {{"modulus_Pa", json_number(two->modulus_Pa)},
                         {"se_Pa", json_number(two->se_Pa)},
                         {"half_space_modulus_Pa", json_number(two->half_space_modulus_Pa)},
                         {"bias", two->bias}};
  }
}

void add_wanted(const FittedFile& fitted, Json& json) {
  const FitResult& fit = fitted.result;
  if (fit.n_bootstrap > 0) json["n_bootstrap"] = fit.n_bootstrap;
  if (!fit.profiles.empty()) json["profiles"] = profiles_of(fit);
  if (fitted.master) json["shift"] = json_from(*fitted.master);
  if (fitted.fractional) json["fractional_zener"] = json_of(*fitted.fractional);
  if (!fit.laws.empty()) json["laws"] = laws_of(fit);
  if (!fitted.model.empty()) json["model"] = fitted.model;
  if (!fit.tests.empty()) json["tests"] = json_of_tests(fitted);
}

void add_rows(const FittedFile& fitted, Json& json) {
  const FitResult& fit = fitted.result;
  json["n_spikes"] = fit.n_spikes;
  if (!fitted.chosen.empty()) json["chosen"] = fitted.chosen;
  json["n_rows"] = fit.n_samples + fit.n_left_out;
  json["n_left_out"] = fit.n_left_out;
  json["left_out"] = Json::object();  // rows by reason
  for (const LeftOutRows& left : fit.left_out) json["left_out"][left.reason] = left.count;
  if (fit.n_contacts > 0) json["n_contacts"] = fit.n_contacts;
  json["n_before_test"] = fitted.n_before_test;
}

}  // namespace

Json json_from_fit(const FittedFile& fitted) {
  const FitResult& fit = fitted.result;
  const ModulusKeys keys = keys_of(fitted);
  Json json;
  json["file"] = fitted.path;
  if (!fitted.maker.empty()) json["maker"] = fitted.maker;
  json["kind"] = name_of_kind(fit.kind);
  json["trustworthy"] = fit.is_trustworthy;
  add_moduli(fit, keys, json);
  add_quality(fit, json);
  add_systematic(fit, keys.letter, json);
  if (fitted.temperature) json["temperature"] = json_of(*fitted.temperature);
  add_measured_ends(fit, keys, json);
  add_lack_of_fit(fit, fitted.fitted_unit, json);
  add_rig(fit, json);
  add_wanted(fitted, json);
  add_rows(fitted, json);
  return json;
}

}  // namespace viscard
