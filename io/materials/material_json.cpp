#include "io/materials/material_json.h"

#include "io/basics/words.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();

// One object of a file, which it reads or writes. One function shows every field to it, so that
// reading and writing cannot differ. Messages show the path of the object.
class Fields {
 public:
  Fields(const Json& in, std::string name, std::string prefix)
      : in_(&in), name_(std::move(name)), prefix_(std::move(prefix)) {
    if (!in.is_object()) {
      const std::string what = prefix_.empty() ? "the file" : prefix_.substr(0, prefix_.size() - 1);
      throw std::runtime_error(name_ + ": " + what + " must be an object, { ... }");
    }
  }
  explicit Fields(Json& out) : out_(&out) {}

  bool is_reading() const { return in_ != nullptr; }
  // False on writing.
  bool has(const std::string& key) const {
    return is_reading() && in_->contains(key) && !(*in_)[key].is_null();
  }

  // Of a list or object on reading; 0 without the key.
  std::size_t size_of(const std::string& key) const { return has(key) ? (*in_)[key].size() : 0; }

  // Throws on reading if the key is missing.
  void require(const char* key, const char* what) const {
    if (!is_reading() || has(key)) return;
    if (in_->contains(key)) fail(key, std::string("is null; expected ") + what);
    std::vector<std::string> keys;
    for (const auto& item : in_->items()) keys.push_back(item.key());
    std::string near = nearest_word(key, keys);
    for (const std::string& one : keys) {  // a key without its unit: E0 for E0_Pa
      if (near.empty() && std::string(key).rfind(one + "_", 0) == 0) near = one;
    }
    throw std::runtime_error(name_ + ": '" + prefix_ + key + "' is missing; expected " + what +
                             (near.empty() ? "" : " (the file has '" + near + "')"));
  }

  // On reading, a missing key keeps the value. On writing, the key is left out unless is_written.
  void number(const std::string& key, double& value, bool is_written = true) const {
    if (out_ != nullptr && is_written) (*out_)[key] = value;
    if (has(key)) value = as_number((*in_)[key], key);
  }
  void number(const std::string& key, int& value) const {
    if (out_ != nullptr) (*out_)[key] = value;
    if (!has(key)) return;
    try {
      value = whole_number((*in_)[key]);
    } catch (const std::runtime_error& error) {
      fail(key, error.what());
    }
  }
  void text(const std::string& key, std::string& value, bool is_written = true) const {
    if (out_ != nullptr && is_written) (*out_)[key] = value;
    if (!has(key)) return;
    if (!(*in_)[key].is_string()) fail(key, "expected a text in quotes");
    value = (*in_)[key].get<std::string>();
  }
  void interval(const std::string& key, Interval& value, bool is_written = true) const {
    if (out_ != nullptr && is_written) (*out_)[key] = json_from(value);
    if (!has(key)) return;
    const Json& pair = (*in_)[key];
    if (!pair.is_array() || pair.size() != 2) fail(key, "expected two numbers, [low, high]");
    value.low = pair[0].is_null() ? -kOpen : as_number(pair[0], key);
    value.high = pair[1].is_null() ? kOpen : as_number(pair[1], key);
  }
  void texts(const std::string& key, std::vector<std::string>& values) const {
    if (out_ != nullptr && !values.empty()) (*out_)[key] = values;
    if (!has(key)) return;
    const Json& list = (*in_)[key];
    if (!list.is_array()) fail(key, "expected a list of texts");
    for (const Json& one : list) {
      if (!one.is_string()) fail(key, "expected a list of texts");
      values.push_back(one.get<std::string>());
    }
  }
  void numbers(const std::string& key, std::vector<double>& values) const {
    if (out_ != nullptr && !values.empty()) (*out_)[key] = values;
    if (!has(key)) return;
    const Json& list = (*in_)[key];
    if (!list.is_array()) fail(key, "expected a list of numbers");
    for (const Json& one : list) values.push_back(as_number(one, key));
  }
  void square_matrix(const std::string& key, std::size_t size, Eigen::MatrixXd& matrix) const {
    if (out_ != nullptr) {
      for (const auto& row : matrix.rowwise()) {
        (*out_)[key].push_back(std::vector<double>(row.begin(), row.end()));
      }
      return;
    }
    const std::string what = "expected " + std::to_string(size) + " rows of " +
                             std::to_string(size) + " numbers, one for each parameter";
    const auto check = [&](const Json& list) {
      if (!list.is_array() || list.size() != size) fail(key, what);
    };
    check(has(key) ? (*in_)[key] : Json());
    const auto n = static_cast<Eigen::Index>(size);
    matrix.resize(n, n);
    for (std::size_t i = 0; i < size; ++i) {
      const Json& row = (*in_)[key][i];
      check(row);
      for (std::size_t j = 0; j < size; ++j) {
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = as_number(row[j], key);
      }
    }
  }
  template <typename Show>
  void object(const std::string& key, bool is_written, const Show& show) const {
    if (out_ != nullptr && is_written) show(Fields((*out_)[key] = Json::object()));
    if (has(key)) show(Fields((*in_)[key], name_, prefix_ + key + "."));
  }
  // show(fields, value, index) for every entry.
  template <typename Value, typename Show>
  void objects(const std::string& key, std::vector<Value>& values, const Show& show) const {
    if (out_ != nullptr) {
      Json& list = (*out_)[key] = Json::array();
      for (std::size_t i = 0; i < values.size(); ++i) {
        list.push_back(Json::object());
        show(Fields(list.back()), values[i], i);
      }
    }
    if (!has(key)) return;
    const Json& list = (*in_)[key];
    if (!list.is_array()) fail(key, "expected a list, [ ... ]");
    for (std::size_t i = 0; i < list.size(); ++i) {
      values.emplace_back();
      show(Fields(list[i], name_, prefix_ + key + "[" + std::to_string(i + 1) + "]."),
           values.back(), i);
    }
  }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw std::runtime_error(name_ + ": " + prefix_ + key + ": " + what);
  }

 private:
  double as_number(const Json& json, const std::string& key) const {
    if (json.is_string()) fail(key, "expected a number in SI, without quotes or unit");
    if (!json.is_number()) fail(key, "expected a number");
    return json.get<double>();
  }

  const Json* in_ = nullptr;
  Json* out_ = nullptr;
  std::string name_;
  std::string prefix_;
};

void show_schema(const Fields& file) {
  constexpr const char* kSchema = "viscard-material/1";
  std::string schema = kSchema;  // a file written by hand may leave it out
  file.text("schema", schema);
  if (schema == kSchema) return;
  const bool is_newer = schema.rfind("viscard-material/", 0) == 0;
  file.fail("schema", "is '" + schema + "'; this version of viscard reads '" + kSchema +
                          (is_newer ? "'; update viscard" : "', so this is not a material file"));
}

void show_terms(const Fields& file, Material& material, MaterialUncertainty& uncertainty) {
  file.require("terms", "a list of {\"g\": ..., \"tau_s\": ...}; [] for an elastic material");
  if (file.size_of("terms") > kMostMaterialTerms) {  // before any is read
    file.fail("terms", "has " + std::to_string(file.size_of("terms")) + " terms; at most " +
                           std::to_string(kMostMaterialTerms) + " are taken");
  }
  file.objects("terms", material.terms, [&](const Fields& f, MaterialTerm& term, std::size_t i) {
    f.require("g", "the relative modulus, a number");
    f.require("tau_s", "the relaxation time in s");
    f.number("g", term.g);
    if (f.is_reading()) term.k = term.g;  // constant Poisson ratio, unless k is given
    f.number("k", term.k);
    f.number("tau_s", term.tau_s);
    if (f.is_reading()) uncertainty.terms.emplace_back();
    if (i >= uncertainty.terms.size()) return;
    TermUncertainty& found = uncertainty.terms[i];
    f.number("modulus_se_Pa", found.modulus_se_Pa);
    f.number("ln_tau_se", found.ln_tau_se);
    f.object("interval_95", true, [&](const Fields& intervals) {
      intervals.interval("modulus_Pa", found.modulus_Pa_95);
      intervals.interval("g", found.g_95);
      intervals.interval("tau_s", found.tau_s_95);
    });
  });
}

void show_shift(const Fields& file, Material& material) {
  TemperatureShift shift = material.shift.value_or(TemperatureShift{});
  file.object("shift", material.shift.has_value(), [&](const Fields& f) {
    std::string law = shift.law == ShiftLaw::kWlf ? "wlf" : "arrhenius";
    f.require("law", "\"wlf\" or \"arrhenius\"");
    f.text("law", law);
    const bool is_wlf = law == "wlf";
    if (!is_wlf && law != "arrhenius") {
      f.fail("law", "is '" + law + "'; expected 'wlf' or 'arrhenius'");
    }
    shift.law = is_wlf ? ShiftLaw::kWlf : ShiftLaw::kArrhenius;
    const auto constant = [&](const std::string& key, bool is_used, double& value,
                              Interval& range) {
      f.number(key, value, is_used);
      f.interval(key + "_interval_95", range, is_used && (range.low != 0.0 || range.high != 0.0));
    };
    constant("C1", is_wlf, shift.C1, shift.C1_95);
    constant("C2_K", is_wlf, shift.C2_K, shift.C2_K_95);
    constant("activation_J_mol", !is_wlf, shift.activation_J_mol, shift.activation_J_mol_95);
    if (f.is_reading() && material.T_ref_C) shift.T_ref_C = *material.T_ref_C;
    f.number("T_ref_C", shift.T_ref_C);
    if (!material.T_ref_C && f.has("T_ref_C")) material.T_ref_C = shift.T_ref_C;
    const bool has_range = shift.T_max_C > shift.T_min_C;
    f.number("T_min_C", shift.T_min_C, has_range);
    f.number("T_max_C", shift.T_max_C, has_range);
  });
  if (file.has("shift")) material.shift = shift;
}

void show_uncertainty(const Fields& file, Material& material, MaterialUncertainty& uncertainty) {
  file.object("uncertainty", material.uncertainty.has_value(), [&](const Fields& f) {
    f.interval("E0_interval_95", uncertainty.E0_Pa_95);
    f.interval("E_inf_interval_95", uncertainty.E_inf_Pa_95);
    f.number("systematic_relative", uncertainty.systematic_relative);
    const auto show_part = [](const Fields& part, SystematicPart& cause, std::size_t) {
      part.text("cause", cause.cause);
      part.number("E0", cause.E0);
      part.numbers("g", cause.g);
      part.numbers("tau_s", cause.tau);
    };
    std::vector<SystematicPart>& parts = uncertainty.systematic_parts;
    if (f.is_reading() || !parts.empty()) f.objects("systematic_parts", parts, show_part);
    f.texts("covariance_parameters", uncertainty.covariance_parameters);
    const std::size_t size = uncertainty.covariance_parameters.size();
    if (size > 0) f.square_matrix("covariance", size, uncertainty.covariance);
  });
  if (file.has("uncertainty")) material.uncertainty = uncertainty;
}

void show_provenance(const Fields& f, Provenance& provenance) {
  f.text("created_by", provenance.created_by);
  f.text("created_at", provenance.created_at, !provenance.created_at.empty());
  f.text("command", provenance.command);
  f.objects("raw_files", provenance.raw_files, [](const Fields& raw, RawFile& file, std::size_t) {
    raw.text("path", file.path);
    raw.text("sha256", file.sha256);
  });
  f.number("fit_from_s", provenance.fit_from_s);
  f.number("fit_to_s", provenance.fit_to_s);
  f.text("nu_origin", provenance.nu_origin);
  f.text("bulk_origin", provenance.bulk_origin);
}

void show_material(const Fields& file, Material& material) {
  MaterialUncertainty uncertainty = material.uncertainty.value_or(MaterialUncertainty{});
  show_schema(file);
  file.text("name", material.name, !material.name.empty());
  file.require("E0_Pa", "the instantaneous Young's modulus in Pa");
  file.require("nu", "the Poisson ratio");
  file.number("E0_Pa", material.E0_Pa);
  file.number("nu", material.nu);
  file.number("rho_kg_m3", material.rho_kg_m3, material.rho_kg_m3 > 0.0);
  show_terms(file, material, uncertainty);
  file.number("mixing_ratio", material.mixing_ratio, material.mixing_ratio > 0.0);
  file.text("specimen_id", material.specimen_id, !material.specimen_id.empty());
  double T_ref_C = material.T_ref_C.value_or(0.0);
  file.number("T_ref_C", T_ref_C, material.T_ref_C.has_value());
  if (file.has("T_ref_C")) material.T_ref_C = T_ref_C;
  show_shift(file, material);
  file.object("valid", true, [&](const Fields& f) {
    f.number("t_min_s", material.valid.t_min_s);
    f.number("t_max_s", material.valid.t_max_s);
    f.number("strain_max", material.valid.strain_max);
  });
  show_uncertainty(file, material, uncertainty);
  file.objects("flags", material.flags, [](const Fields& f, MaterialFlag& flag, std::size_t) {
    f.text("name", flag.name);
    f.number("term", flag.term);
    f.text("text", flag.text);
  });
  file.object("provenance", true,
              [&](const Fields& f) { show_provenance(f, material.provenance); });
}

}  // namespace

Material material_from(const Json& json, const std::string& name) {
  Material material;
  show_material(Fields(json, name, ""), material);
  return material;
}

Json json_from(const Material& material) {
  Material shown = material;
  Json out = Json::object();
  show_material(Fields(out), shown);
  return out;
}

}  // namespace viscard
