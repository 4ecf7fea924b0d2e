#include "io/basics/words.h"
#include "io/materials/material_json.h"

#include <limits>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

// One object of the file with its path, which messages show.
class Fields {
 public:
  Fields(const Json& json, std::string name, std::string prefix)
      : json_(json), name_(std::move(name)), prefix_(std::move(prefix)) {
    if (!json.is_object()) {
      const std::string what = prefix_.empty() ? "the file" : prefix_.substr(0, prefix_.size() - 1);
      throw std::runtime_error(name_ + ": " + what + " must be an object, { ... }");
    }
  }

  bool has(const char* key) const { return json_.contains(key) && !json_[key].is_null(); }

  void require(const char* key, const char* what) const {
    if (has(key)) return;
    if (json_.contains(key)) fail(key, std::string("is null; expected ") + what);
    std::vector<std::string> keys;
    for (const auto& item : json_.items()) keys.push_back(item.key());
    std::string near = nearest_word(key, keys);
    for (const std::string& one : keys) {  // a key without its unit: E0 for E0_Pa
      if (near.empty() && std::string(key).rfind(one + "_", 0) == 0) near = one;
    }
    throw std::runtime_error(name_ + ": '" + prefix_ + key + "' is missing; expected " + what +
                             (near.empty() ? "" : " (the file has '" + near + "')"));
  }

  // Keeps the value if the key is missing.
  void number(const char* key, double& value) const {
    if (has(key)) value = as_number(json_[key], key);
  }
  void number(const char* key, int& value) const {
    if (!has(key)) return;
    if (!json_[key].is_number_integer()) fail(key, "expected a whole number");
    value = json_[key].get<int>();
  }
  void text(const char* key, std::string& value) const {
    if (!has(key)) return;
    if (!json_[key].is_string()) fail(key, "expected a text in quotes");
    value = json_[key].get<std::string>();
  }
  // [low, high]; null stands for an end without bound.
  void interval(const char* key, Interval& value) const {
    if (!has(key)) return;
    const Json& pair = json_[key];
    if (!pair.is_array() || pair.size() != 2) fail(key, "expected two numbers, [low, high]");
    constexpr double kOpen = std::numeric_limits<double>::infinity();
    value.low = pair[0].is_null() ? -kOpen : as_number(pair[0], key);
    value.high = pair[1].is_null() ? kOpen : as_number(pair[1], key);
  }
  Fields object(const char* key) const { return {json_[key], name_, prefix_ + key + "."}; }
  std::vector<Fields> objects(const char* key) const {
    std::vector<Fields> out;
    if (!has(key)) return out;
    if (!json_[key].is_array()) fail(key, "expected a list, [ ... ]");
    for (std::size_t i = 0; i < json_[key].size(); ++i) {
      out.emplace_back(json_[key][i], name_, prefix_ + key + "[" + std::to_string(i + 1) + "].");
    }
    return out;
  }
  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> out;
    if (!has(key)) return out;
    if (!json_[key].is_array()) fail(key, "expected a list of texts");
    for (const Json& one : json_[key]) {
      if (!one.is_string()) fail(key, "expected a list of texts");
      out.push_back(one.get<std::string>());
    }
    return out;
  }
  Eigen::MatrixXd square_matrix(const char* key, std::size_t size) const {
    const auto n = static_cast<Eigen::Index>(size);
    const std::string what = "expected " + std::to_string(size) + " rows of " +
                             std::to_string(size) + " numbers, one for each parameter";
    Eigen::MatrixXd out(n, n);
    if (!has(key) || !json_[key].is_array() || json_[key].size() != size) fail(key, what);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Json& row = json_[key][static_cast<std::size_t>(i)];
      if (!row.is_array() || row.size() != size) fail(key, what);
      for (Eigen::Index j = 0; j < n; ++j) {
        out(i, j) = as_number(row[static_cast<std::size_t>(j)], key);
      }
    }
    return out;
  }

  [[noreturn]] void fail(const char* key, const std::string& what) const {
    throw std::runtime_error(name_ + ": " + prefix_ + key + ": " + what);
  }

 private:
  double as_number(const Json& json, const char* key) const {
    if (json.is_string()) fail(key, "expected a number in SI, without quotes or unit");
    if (!json.is_number()) fail(key, "expected a number");
    return json.get<double>();
  }

  const Json& json_;
  std::string name_;
  std::string prefix_;
};

TermUncertainty uncertainty_from(const Fields& term) {
  TermUncertainty out;
  term.number("modulus_se_Pa", out.modulus_se_Pa);
  term.number("ln_tau_se", out.ln_tau_se);
  if (term.has("interval_95")) {
    const Fields intervals = term.object("interval_95");
    intervals.interval("modulus_Pa", out.modulus_Pa_95);
    intervals.interval("g", out.g_95);
    intervals.interval("tau_s", out.tau_s_95);
  }
  return out;
}

void read_terms(const Fields& file, Material& material, MaterialUncertainty& uncertainty) {
  file.require("terms", "a list of {\"g\": ..., \"tau_s\": ...}; [] for an elastic material");
  for (const Fields& fields : file.objects("terms")) {
    MaterialTerm term;
    fields.require("g", "the relative modulus, a number");
    fields.require("tau_s", "the relaxation time in s");
    fields.number("g", term.g);
    fields.number("tau_s", term.tau_s);
    term.k = term.g;  // constant Poisson ratio, unless k is given
    fields.number("k", term.k);
    material.terms.push_back(term);
    uncertainty.terms.push_back(uncertainty_from(fields));
  }
}

void read_uncertainty(const Fields& file, Material& material, MaterialUncertainty uncertainty) {
  if (!file.has("uncertainty")) return;
  const Fields fields = file.object("uncertainty");
  fields.interval("E0_interval_95", uncertainty.E0_Pa_95);
  fields.interval("E_inf_interval_95", uncertainty.E_inf_Pa_95);
  fields.number("systematic_relative", uncertainty.systematic_relative);
  uncertainty.covariance_parameters = fields.texts("covariance_parameters");
  if (!uncertainty.covariance_parameters.empty()) {
    uncertainty.covariance =
        fields.square_matrix("covariance", uncertainty.covariance_parameters.size());
  }
  material.uncertainty = std::move(uncertainty);
}

void read_provenance(const Fields& file, Provenance& provenance) {
  if (!file.has("provenance")) return;
  const Fields fields = file.object("provenance");
  fields.text("created_by", provenance.created_by);
  fields.text("created_at", provenance.created_at);
  fields.text("command", provenance.command);
  for (const Fields& raw : fields.objects("raw_files")) {
    RawFile one;
    raw.text("path", one.path);
    raw.text("sha256", one.sha256);
    provenance.raw_files.push_back(one);
  }
  fields.number("fit_from_s", provenance.fit_from_s);
  fields.number("fit_to_s", provenance.fit_to_s);
  fields.text("nu_origin", provenance.nu_origin);
  fields.text("bulk_origin", provenance.bulk_origin);
}

void read_shift(const Fields& file, Material& material) {
  if (!file.has("shift")) return;
  const Fields fields = file.object("shift");
  TemperatureShift shift;
  std::string law;
  fields.require("law", "\"wlf\" or \"arrhenius\"");
  fields.text("law", law);
  if (law != "wlf" && law != "arrhenius") {
    fields.fail("law", "is '" + law + "'; expected 'wlf' or 'arrhenius'");
  }
  shift.law = law == "wlf" ? ShiftLaw::kWlf : ShiftLaw::kArrhenius;
  if (material.T_ref_C) shift.T_ref_C = *material.T_ref_C;
  fields.number("T_ref_C", shift.T_ref_C);
  if (!material.T_ref_C && fields.has("T_ref_C")) material.T_ref_C = shift.T_ref_C;
  fields.number("C1", shift.C1);
  fields.number("C2_K", shift.C2_K);
  fields.number("activation_J_mol", shift.activation_J_mol);
  fields.interval("C1_interval_95", shift.C1_95);
  fields.interval("C2_K_interval_95", shift.C2_K_95);
  fields.interval("activation_J_mol_interval_95", shift.activation_J_mol_95);
  fields.number("T_min_C", shift.T_min_C);
  fields.number("T_max_C", shift.T_max_C);
  material.shift = shift;
}

void check_schema(const Fields& file) {
  constexpr const char* kSchema = "viscard-material/1";
  std::string schema = kSchema;  // a file written by hand may leave it out
  file.text("schema", schema);
  if (schema == kSchema) return;
  const bool is_newer = schema.rfind("viscard-material/", 0) == 0;
  file.fail("schema", "is '" + schema + "'; this version of viscard reads '" + kSchema +
                          (is_newer ? "'; update viscard" : "', so this is not a material file"));
}

}  // namespace

Json parse_json(const std::string& text, const std::string& name) {
  std::vector<std::set<std::string>> keys;  // of the objects not yet closed
  std::string repeated;
  bool is_deep = false;  // deeper nesting could overflow the stack when the text is written again
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    is_deep = is_deep || depth > 64;
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key &&
        !keys.back().insert(parsed.get<std::string>()).second) {
      repeated = parsed.get<std::string>();
    }
    return true;
  };
  Json json;
  try {
    json = Json::parse(text, watch);
  } catch (const Json::exception& error) {
    std::string what = error.what();  // "[json.exception.parse_error.101] parse error at line ..."
    const std::size_t tag = what.find("] ");
    if (tag != std::string::npos) what.erase(0, tag + 2);
    throw std::runtime_error(name + ": is not JSON: " + what);
  }
  if (is_deep) throw std::runtime_error(name + ": is nested deeper than 64 levels, the limit");
  if (!repeated.empty()) throw std::runtime_error(name + ": key '" + repeated + "' is given twice");
  return json;
}

Material material_from(const Json& json, const std::string& name) {
  const Fields file(json, name, "");
  check_schema(file);
  Material material;
  MaterialUncertainty uncertainty;
  file.text("name", material.name);
  file.require("E0_Pa", "the instantaneous Young's modulus in Pa");
  file.require("nu", "the Poisson ratio");
  file.number("E0_Pa", material.E0_Pa);
  file.number("nu", material.nu);
  file.number("rho_kg_m3", material.rho_kg_m3);
  read_terms(file, material, uncertainty);
  if (file.has("T_ref_C")) {
    double temperature_C = 0.0;
    file.number("T_ref_C", temperature_C);
    material.T_ref_C = temperature_C;
  }
  file.number("mixing_ratio", material.mixing_ratio);
  read_shift(file, material);
  if (file.has("valid")) {
    const Fields valid = file.object("valid");
    valid.number("t_min_s", material.valid.t_min_s);
    valid.number("t_max_s", material.valid.t_max_s);
    valid.number("strain_max", material.valid.strain_max);
  }
  read_uncertainty(file, material, std::move(uncertainty));
  for (const Fields& fields : file.objects("flags")) {
    MaterialFlag flag;
    fields.text("name", flag.name);
    fields.number("term", flag.term);
    fields.text("text", flag.text);
    material.flags.push_back(flag);
  }
  read_provenance(file, material.provenance);
  return material;
}

}  // namespace viscard
