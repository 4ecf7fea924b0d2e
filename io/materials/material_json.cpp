#include "io/materials/material_json.h"

#include <cmath>
#include <map>
#include <set>

namespace viscard {
namespace {

// JSON has no infinity; null stands for an end without bound.
Json json_from(const Interval& interval) {
  const auto bound = [](double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  };
  return Json::array({bound(interval.low), bound(interval.high)});
}

Json json_from(const TermUncertainty& term) {
  return {{"modulus_Pa", json_from(term.modulus_Pa_95)},
          {"g", json_from(term.g_95)},
          {"tau_s", json_from(term.tau_s_95)}};
}

Json terms_json(const Material& material) {
  Json terms = Json::array();
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    const MaterialTerm& term = material.terms[i];
    Json one = {{"g", term.g}, {"k", term.k}, {"tau_s", term.tau_s}};
    if (material.uncertainty && i < material.uncertainty->terms.size()) {
      const TermUncertainty& uncertainty = material.uncertainty->terms[i];
      one["modulus_se_Pa"] = uncertainty.modulus_se_Pa;
      one["ln_tau_se"] = uncertainty.ln_tau_se;
      one["interval_95"] = json_from(uncertainty);
    }
    terms.push_back(one);
  }
  return terms;
}

Json json_from(const MaterialUncertainty& uncertainty) {
  Json out = {{"E0_interval_95", json_from(uncertainty.E0_Pa_95)},
              {"E_inf_interval_95", json_from(uncertainty.E_inf_Pa_95)},
              {"systematic_relative", uncertainty.systematic_relative}};
  if (uncertainty.covariance_parameters.empty()) return out;
  out["covariance_parameters"] = uncertainty.covariance_parameters;
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < uncertainty.covariance.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < uncertainty.covariance.cols(); ++j) {
      row.push_back(uncertainty.covariance(i, j));
    }
    rows.push_back(row);
  }
  out["covariance"] = rows;
  return out;
}

Json json_from(const TemperatureShift& shift) {
  Json out;
  const auto add = [&](const char* key, double value, const Interval& interval_95) {
    out[key] = value;
    if (interval_95.low == 0.0 && interval_95.high == 0.0) return;
    out[std::string(key) + "_interval_95"] = json_from(interval_95);
  };
  if (shift.law == ShiftLaw::kWlf) {
    out["law"] = "wlf";
    add("C1", shift.C1, shift.C1_95);
    add("C2_K", shift.C2_K, shift.C2_K_95);
  } else {
    out["law"] = "arrhenius";
    add("activation_J_mol", shift.activation_J_mol, shift.activation_J_mol_95);
  }
  out["T_ref_C"] = shift.T_ref_C;
  if (shift.T_max_C > shift.T_min_C) {
    out["T_min_C"] = shift.T_min_C;
    out["T_max_C"] = shift.T_max_C;
  }
  return out;
}

Json json_from(const Provenance& provenance) {
  Json raw_files = Json::array();
  for (const RawFile& raw : provenance.raw_files) {
    raw_files.push_back({{"path", raw.path}, {"sha256", raw.sha256}});
  }
  Json out = {{"created_by", provenance.created_by}};
  if (!provenance.created_at.empty()) out["created_at"] = provenance.created_at;
  out["command"] = provenance.command;
  out["raw_files"] = raw_files;
  out["fit_from_s"] = provenance.fit_from_s;
  out["fit_to_s"] = provenance.fit_to_s;
  out["nu_origin"] = provenance.nu_origin;
  out["bulk_origin"] = provenance.bulk_origin;
  return out;
}

const std::set<std::string>& known_keys(const std::string& section) {
  static const std::map<std::string, std::set<std::string>> kKnown{
      {"",
       {"schema", "name", "E0_Pa", "nu", "rho_kg_m3", "terms", "T_ref_C", "valid", "uncertainty",
        "flags", "provenance", "mixing_ratio", "shift"}},
      {"shift",
       {"law", "C1", "C2_K", "activation_J_mol", "T_ref_C", "T_min_C", "T_max_C", "C1_interval_95",
        "C2_K_interval_95", "activation_J_mol_interval_95"}},
      {"terms", {"g", "k", "tau_s", "modulus_se_Pa", "ln_tau_se", "interval_95"}},
      {"interval_95", {"modulus_Pa", "g", "tau_s"}},
      {"valid", {"t_min_s", "t_max_s", "strain_max"}},
      {"uncertainty",
       {"E0_interval_95", "E_inf_interval_95", "systematic_relative", "covariance_parameters",
        "covariance"}},
      {"flags", {"name", "term", "text"}},
      {"provenance",
       {"created_by", "created_at", "command", "raw_files", "fit_from_s", "fit_to_s", "nu_origin",
        "bulk_origin"}},
      {"raw_files", {"path", "sha256"}}};
  static const std::set<std::string> kNone;
  const auto found = kKnown.find(section);
  return found == kKnown.end() ? kNone : found->second;
}

void carry_unknown(const Json& original, Json& fresh, const std::string& section) {
  const auto& known = known_keys(section);
  for (const auto& [key, value] : original.items()) {
    if (known.count(key) == 0) {
      fresh[key] = value;
    } else if (fresh.contains(key) && value.is_object() && fresh[key].is_object()) {
      carry_unknown(value, fresh[key], key);
    } else if (fresh.contains(key) && value.is_array() && fresh[key].is_array() &&
               value.size() == fresh[key].size()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (value[i].is_object() && fresh[key][i].is_object()) {
          carry_unknown(value[i], fresh[key][i], key);
        }
      }
    }
  }
}

}  // namespace

Json json_from(const Material& material) {
  Json out = {{"schema", "viscard-material/1"}};
  if (!material.name.empty()) out["name"] = material.name;
  out["E0_Pa"] = material.E0_Pa;
  out["nu"] = material.nu;
  if (material.rho_kg_m3 > 0.0) out["rho_kg_m3"] = material.rho_kg_m3;
  out["terms"] = terms_json(material);
  if (material.mixing_ratio > 0.0) out["mixing_ratio"] = material.mixing_ratio;
  if (material.T_ref_C) out["T_ref_C"] = *material.T_ref_C;
  if (material.shift) out["shift"] = json_from(*material.shift);
  out["valid"] = {{"t_min_s", material.valid.t_min_s},
                  {"t_max_s", material.valid.t_max_s},
                  {"strain_max", material.valid.strain_max}};
  if (material.uncertainty) out["uncertainty"] = json_from(*material.uncertainty);
  out["flags"] = Json::array();
  for (const MaterialFlag& flag : material.flags) {
    out["flags"].push_back({{"name", flag.name}, {"term", flag.term}, {"text", flag.text}});
  }
  out["provenance"] = json_from(material.provenance);
  return out;
}

void carry_unknown_keys(const Json& original, Json& fresh) {
  carry_unknown(original, fresh, "");
}

}  // namespace viscard
