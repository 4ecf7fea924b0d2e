#include "io/materials/hyperelastic_file.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/inputs.h"
#include "io/basics/json_string.h"
#include "io/materials/material_json.h"
#include "io/materials/plausible_numbers.h"
#include "models/maths/text_of_number.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

using RubberJson = nlohmann::json;

constexpr const char* kHyperelasticSchema = "viscard-hyperelastic/1";

template <typename Names>
std::size_t index_in(const Names& names, const std::string& name, const char* what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::invalid_argument("there is no " + std::string(what) + " '" + name + "'");
  return static_cast<std::size_t>(found - names.begin());
}

const RubberJson& chosen_law(const RubberJson& json) {
  const std::string name = json.at("law");
  for (const RubberJson& law : json.at("laws")) {
    if (law.at("name") == name) return law;
  }
  throw std::invalid_argument("'laws' has no '" + name + "', which 'law' names");
}

HyperelasticLaw law_from(const RubberJson& json) {
  HyperelasticLaw law;
  law.form = hyperelastic_forms()[index_in(hyperelastic_names(), json.at("name"), "law")];
  std::vector<std::string> names = modulus_names(law.form);
  law.moduli_Pa.resize(n_moduli(law.form));
  law.shapes.resize(n_shapes(law.form));
  for (const std::string& name : shape_names(law.form)) names.push_back(name);
  const RubberJson& parameters = json.at("parameters");
  if (parameters.size() != names.size()) {
    throw std::invalid_argument("'parameters' must be " + std::to_string(names.size()) +
                                " in number");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (parameters[i].at("name") != names[i]) {
      throw std::invalid_argument("parameter " + std::to_string(i + 1) + " must be " + names[i]);
    }
    const double value = parameters[i].at("value");
    const auto k = static_cast<Eigen::Index>(i);
    (k < n_moduli(law.form) ? law.moduli_Pa[k] : law.shapes[k - n_moduli(law.form)]) = value;
  }
  validate(law);
  return law;
}

// Parameters by name: mu_1_Pa, alpha_1, then nu, or nu_1 ... of each term.
FoamLaw foam_from(const RubberJson& json, Eigen::Index n_terms) {
  const auto value_of = [&](const std::string& name) -> std::optional<double> {
    for (const RubberJson& one : json.at("parameters")) {
      if (one.at("name") == name) return one.at("value").get<double>();
    }
    return std::nullopt;
  };
  const auto needed = [&](const std::string& name) {
    const auto value = value_of(name);
    if (!value) throw std::invalid_argument("the foam has no parameter " + name);
    return *value;
  };
  FoamLaw law{Eigen::VectorXd(n_terms), Eigen::VectorXd(n_terms), Eigen::VectorXd(n_terms)};
  for (Eigen::Index i = 0; i < n_terms; ++i) {
    const std::string number = std::to_string(i + 1);
    law.mu_Pa[i] = needed("mu_" + number + "_Pa");
    law.alpha[i] = needed("alpha_" + number);
    const auto common = value_of("nu");
    law.nu[i] = common ? *common : needed("nu_" + number);
  }
  validate(law);
  return law;
}

// Files of elastic laws may lack the key.
std::vector<RubberTerm> terms_from(const RubberJson& json) {
  std::vector<RubberTerm> terms;
  if (!json.contains("terms")) return terms;
  for (const RubberJson& term : json["terms"]) terms.push_back({term.at("g"), term.at("tau_s")});
  validate(terms);
  return terms;
}

// Only laws with damage have the key.
std::optional<MullinsDamage> damage_from(const RubberJson& json) {
  if (!json.contains("damage")) return std::nullopt;
  const RubberJson& stored = json["damage"];
  if (stored.at("name") != kMullinsName) {
    throw std::invalid_argument("there is no damage " + stored.at("name").dump() +
                                "; viscard knows " + kMullinsName);
  }
  std::vector<double> values;
  for (const std::string& name : damage_parameter_names()) {
    const auto& parameters = stored.at("parameters");
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const auto& one) { return one.at("name") == name; });
    if (found == parameters.end())
      throw std::invalid_argument("the damage has no parameter " + name);
    values.push_back(found->at("value"));
  }
  const MullinsDamage damage{values[0], values[1], values[2]};
  validate(damage);
  return damage;
}

// Files of elastic laws may lack some of the intervals; {0, 0} then.
void add_moduli(const RubberJson& json, HyperelasticFile& file) {
  const auto interval_of = [&](const char* key) {
    const bool is_given = json.contains(key) && json[key].at(0).is_number();
    return is_given ? Interval{json[key].at(0), json[key].at(1)} : Interval{};
  };
  file.E0_Pa = file.foam ? youngs_modulus_Pa(*file.foam) : youngs_modulus_Pa(file.law);
  file.E0_interval_95 = interval_of("E0_interval_95");
  file.E_inf_Pa = file.E0_Pa;
  for (const RubberTerm& term : file.terms) file.E_inf_Pa -= term.g * file.E0_Pa;
  file.E_inf_interval_95 =
      file.terms.empty() ? file.E0_interval_95 : interval_of("E_inf_interval_95");
}

void add_tests(const RubberJson& json, HyperelasticFile& file) {
  for (const RubberJson& test : json.at("tests")) {
    const double low = test.at("stretch").at(0), high = test.at("stretch").at(1);
    const std::string kind = test.at("deformation");
    file.raw_files.push_back({test.at("file"), test.at("sha256")});
    if (file.foam) {
      (void)index_in(foam_test_names(), kind, "test of a foam");
      file.foam_tests += (file.foam_tests.empty() ? "" : ", ") + kind + " " + text_of(low, 4) +
                         " to " + text_of(high, 4);
      continue;
    }
    auto& range = file.measured[index_in(deformation_names(), kind, "deformation")];
    range = range ? HyperelasticFile::Range{std::min(range->low, low), std::max(range->high, high)}
                  : HyperelasticFile::Range{low, high};
    if (test.contains("time_s") && !test["time_s"].is_null()) {
      const double step_s = test["time_s"].at(0), all_s = test["time_s"].at(1);
      file.t_min_s = file.t_min_s > 0.0 ? std::min(file.t_min_s, step_s) : step_s;
      file.t_max_s = std::max(file.t_max_s, all_s);
    }
  }
}

}  // namespace

namespace {

bool says_plausible_off(const RubberJson& json) {
  const RubberJson flags = json.value("flags", RubberJson::array());
  return std::any_of(flags.begin(), flags.end(), [](const RubberJson& flag) {
    return flag.value("name", "") == kPlausibleOff;
  });
}

}  // namespace

std::string name_of(const HyperelasticFile& file) {
  return file.foam ? foam_name(file.foam->mu_Pa.size()) : name_of(file.law.form);
}

std::string json_from_card_of_rubber(const HyperelasticFile& file) {
  Json parameters = Json::array(), terms = Json::array();
  const auto add = [&](const std::string& name, double value) {
    parameters.push_back({{"name", name}, {"value", value}});
  };
  const auto moduli = modulus_names(file.law.form), shapes = shape_names(file.law.form);
  for (std::size_t i = 0; i < moduli.size() && !file.foam; ++i)
    add(moduli[i], file.law.moduli_Pa[static_cast<Eigen::Index>(i)]);
  for (std::size_t i = 0; i < shapes.size() && !file.foam; ++i)
    add(shapes[i], file.law.shapes[static_cast<Eigen::Index>(i)]);
  for (Eigen::Index i = 0; file.foam && i < file.foam->mu_Pa.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    add("mu_" + number + "_Pa", file.foam->mu_Pa[i]);
    add("alpha_" + number, file.foam->alpha[i]);
    add("nu_" + number, file.foam->nu[i]);
  }
  for (const RubberTerm& term : file.terms) terms.push_back({{"g", term.g}, {"tau_s", term.tau_s}});
  Json law{{"name", name_of(file)}, {"parameters", parameters}};
  if (!terms.empty()) law["terms"] = terms;
  if (file.damage) {
    const double values[] = {file.damage->r, file.damage->m_Pa, file.damage->beta};
    Json constants = Json::array();
    for (std::size_t i = 0; i < 3; ++i)
      constants.push_back({{"name", damage_parameter_names()[i]}, {"value", values[i]}});
    law["damage"] = {{"name", kMullinsName}, {"parameters", constants}};
  }
  law["trustworthy"] = true;
  law["flags"] = Json::array();
  if (file.is_edited) law["flags"].push_back({{"name", kEdited}, {"text", kEditedText}});
  if (!file.card_doubt.empty())
    law["flags"].push_back({{"name", kUncheckedCardFlag}, {"text", file.card_doubt}});
  Json json{{"schema", kHyperelasticSchema}, {"law", name_of(file)}};
  json["trustworthy"] = true;
  json["laws"] = Json::array({law});
  json["tests"] = Json::array();
  if (file.bulk_Pa) json["bulk_modulus_Pa"] = *file.bulk_Pa;
  if (file.density_kg_m3) json["density_kg_m3"] = *file.density_kg_m3;
  for (const HyperelasticFile::RawFile& raw : file.raw_files)
    json["imported_from"] = {{"file", raw.file}, {"sha256", raw.sha256}};
  add_body_sum(json);
  return json.dump(1) + "\n";
}

bool looks_like_hyperelastic_file(const std::filesystem::path& path) {
  const RubberJson json = json_or_discarded(read_file(path));
  return json.is_object() && json.contains("schema") && json["schema"] == kHyperelasticSchema;
}

HyperelasticFile read_hyperelastic(const std::filesystem::path& path, Plausible judged) {
  return hyperelastic_from_json(read_file(path), path.string(), judged);
}

HyperelasticFile hyperelastic_from_json(const std::string& text, const std::string& name,
                                        Plausible judged) {
  return read_as(FileKind::kRubberLaw, text, name, [&] {
    try {
      const Json ordered = parse_json(text, name);
      const RubberJson json = RubberJson(ordered);
      const RubberJson& law = chosen_law(json);
      HyperelasticFile file;
      if (const auto n_terms = foam_terms_of(law.at("name"))) {
        file.foam = foam_from(law, *n_terms);
      } else {
        file.law = law_from(law);
      }
      file.terms = terms_from(law);
      file.damage = damage_from(law);
      if (file.damage && !file.terms.empty())
        throw std::invalid_argument("damage and terms of relaxation stand beside one law");
      add_moduli(law, file);
      file.is_trustworthy = law.at("trustworthy");
      file.is_edited = is_edited(ordered, name);
      for (const RubberJson& flag : law.at("flags")) {
        file.defects.push_back(flag.at("text"));
        if (flag.value("name", "") == kEdited) file.is_edited = true;
        if (flag.value("name", "") == kUncheckedCardFlag) {
          file.card_doubt = flag.at("text");
          note_input(name, file.card_doubt);
        }
      }
      add_tests(json, file);
      if (json.contains("bulk_modulus_Pa")) file.bulk_Pa = json["bulk_modulus_Pa"].get<double>();
      if (json.contains("density_kg_m3")) file.density_kg_m3 = json["density_kg_m3"].get<double>();
      if (json.contains("imported_from")) {
        const RubberJson& card = json["imported_from"];
        file.raw_files.push_back({card.at("file"), card.at("sha256")});
      }
      file.accepts_implausible = judged == Plausible::kOff || says_plausible_off(json);
      if (!file.accepts_implausible) {
        refuse_implausible(name, "E0_Pa", quantities::kModulus, file.E0_Pa, judged);
        if (file.bulk_Pa)
          refuse_implausible(name, "bulk_modulus_Pa", quantities::kBulkModulus, *file.bulk_Pa,
                             judged);
        if (file.density_kg_m3)
          refuse_implausible(name, "density_kg_m3", quantities::kDensity, *file.density_kg_m3,
                             judged);
      }
      return file;
    } catch (const nlohmann::json::exception& error) {
      throw std::runtime_error(
          name + ": is not a law of rubber as viscard fit writes it: " + reason_of(error));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(name + ": " + error.what());
    }
  });
}

}  // namespace viscard
