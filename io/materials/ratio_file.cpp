#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/json_string.h"
#include "io/materials/material_file.h"
#include "io/materials/material_json.h"
#include "io/materials/plausible_numbers.h"
#include "io/materials/scatter_json.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr const char* kSchema = "viscard-joint/1";

const std::vector<std::pair<RatioVariable, const char*>>& variable_words() {
  static const std::vector<std::pair<RatioVariable, const char*>> kWords{
      {RatioVariable::kLogRatio, "ln-ratio"},
      {RatioVariable::kRatio, "ratio"},
      {RatioVariable::kCrosslinkerShare, "crosslinker-share"}};
  return kWords;
}

Json degree_json(int degree) {
  return degree == kPerRatio ? Json("per-ratio") : Json(degree);
}

Json json_from(const RatioForm& form) {
  Json out{{"name", form_name(form)}};
  for (const auto& [variable, word] : variable_words()) {
    if (variable == form.variable) out["variable"] = word;
  }
  out["E0_degree"] = degree_json(form.E0_degree);
  out["g_degree"] = degree_json(form.g_degree);
  out["tau_degree"] = degree_json(form.tau_degree);
  if (!form.same.empty()) out["same"] = form.same;
  out["text"] = form_in_words(form);
  return out;
}

Json json_from(const RatioModel& model) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < model.covariance.rows(); ++i) {
    const Eigen::VectorXd row = model.covariance.row(i);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  const auto spread = [&](double value, int parameter) {  // null if unknown
    const bool is_known = parameter > 2 * model.n_terms || has_known_spread(model, parameter);
    return is_known ? Json(value) : Json(nullptr);
  };
  Json out{
      {"form", json_from(model.form)},
      {"n_terms", model.n_terms},
      {"ratios", model.ratios},
      {"coefficients", std::vector<double>(model.coefficients.begin(), model.coefficients.end())},
      {"covariance", rows},
      {"between_specimens",
       {{"ln_E0", spread(model.spread_ln_E0, 0)},
        {"ln_g", spread(model.spread_ln_g, 1)},
        {"ln_tau", spread(model.spread_ln_tau, model.n_terms + 1)}}},
      {"n_specimens", model.n_specimens},
      {"n_parameters", model.n_parameters},
      {"log_likelihood", model.log_likelihood},
      {"bic", model.bic}};
  if (!model.own_terms.empty()) out["own_terms"] = model.own_terms;
  if (model.touch_ln_E0 > 0.0 || model.touch_ln_g > 0.0 || model.touch_ln_tau > 0.0) {
    out["between_touches"] = {
        {"ln_E0", model.touch_ln_E0}, {"ln_g", model.touch_ln_g}, {"ln_tau", model.touch_ln_tau}};
  }
  return out;
}

Json forms_json(const RatioFit& fit) {
  Json out = Json::array();
  for (const RatioComparison& row : fit.forms) {
    out.push_back({{"form", json_from(row.form)},
                   {"n_parameters", row.n_parameters},
                   {"log_likelihood", row.log_likelihood},
                   {"bic", row.bic},
                   {"bic_above_best", row.bic - fit.forms.front().bic}});
  }
  return out;
}

int degree_from(const Json& json) {
  if (json == "per-ratio") return kPerRatio;
  const int degree = whole_number(json);
  if (degree < 0) throw std::runtime_error("a degree must be \"per-ratio\" or a number from 0");
  return degree;
}

RatioVariable variable_from(const Json& json) {
  for (const auto& [variable, word] : variable_words()) {
    if (json == word) return variable;
  }
  throw std::runtime_error("the variable must be \"ln-ratio\", \"ratio\" or \"crosslinker-share\"");
}

RatioForm form_from(const Json& json) {
  RatioForm form;
  form.variable = variable_from(json.at("variable"));
  form.E0_degree = degree_from(json.at("E0_degree"));
  form.g_degree = degree_from(json.at("g_degree"));
  form.tau_degree = degree_from(json.at("tau_degree"));
  if (json.contains("same")) form.same = json.at("same").get<std::vector<std::string>>();
  return form;
}

// Checks numbers that would allocate arrays of arbitrary size, or empty ones. Every parameter has
// at least one coefficient.
void check_sizes(const RatioModel& model) {
  const auto coefficients = static_cast<int>(model.coefficients.size());
  if (model.n_terms < 0 || model.n_terms > (coefficients - 1) / 2) {
    throw std::runtime_error("there are fewer coefficients than its terms need");
  }
  for (const int degree : {model.form.E0_degree, model.form.g_degree, model.form.tau_degree}) {
    if (degree >= coefficients) throw std::runtime_error("a degree exceeds the coefficients");
  }
  double below = 0.0;
  for (const double ratio : model.ratios) {
    if (!(ratio > below)) throw std::runtime_error("the ratios must be positive and ascend");
    below = ratio;
  }
  if (model.ratios.empty()) throw std::runtime_error("there are no ratios");
  const auto& own = model.own_terms;
  const bool is_own_right =
      own.empty() ||
      (own.size() == model.ratios.size() &&
       std::all_of(own.begin(), own.end(), [&](int n) { return n >= 0 && n <= model.n_terms; }));
  if (!is_own_right) {
    throw std::runtime_error("own_terms must be one number for each ratio, 0 to n_terms");
  }
}

RatioModel model_from(const Json& json) {
  RatioModel model;
  model.form = form_from(json.at("form"));
  model.n_terms = whole_number(json.at("n_terms"));
  model.ratios = json.at("ratios").get<std::vector<double>>();
  for (const Json& own : json.value("own_terms", Json::array())) {
    model.own_terms.push_back(whole_number(own));
  }
  const auto beta = json.at("coefficients").get<std::vector<double>>();
  const auto rows = json.at("covariance").get<std::vector<std::vector<double>>>();
  const auto size = static_cast<Eigen::Index>(beta.size());
  model.coefficients = Eigen::Map<const Eigen::VectorXd>(beta.data(), size);
  check_sizes(model);
  if (rows.size() != beta.size()) {
    throw std::runtime_error("the numbers of coefficients and of covariance rows differ");
  }
  model.covariance.resize(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    if (row.size() != beta.size()) throw std::runtime_error("the covariance is not square");
    model.covariance.row(i) = Eigen::Map<const Eigen::VectorXd>(row.data(), size);
  }
  const auto spread = [&](const char* name) {
    const Json& value = json.at("between_specimens").at(name);
    return value.is_null() ? 0.0 : value.get<double>();
  };
  model.spread_ln_E0 = spread("ln_E0");
  model.spread_ln_g = spread("ln_g");
  model.spread_ln_tau = spread("ln_tau");
  if (json.contains("between_touches")) {
    const Json& touch = json.at("between_touches");
    model.touch_ln_E0 = touch.at("ln_E0").get<double>();
    model.touch_ln_g = touch.at("ln_g").get<double>();
    model.touch_ln_tau = touch.at("ln_tau").get<double>();
  }
  model.n_specimens = whole_number(json.at("n_specimens"));
  model.n_parameters = whole_number(json.at("n_parameters"));
  model.log_likelihood = json.at("log_likelihood").get<double>();
  model.bic = json.at("bic").get<double>();
  if (design_at(model, model.ratios.front()).cols() != size) {
    throw std::runtime_error("the number of coefficients does not match the form");
  }
  return model;
}

void read_lists(const Json& json, RatioFit& fit) {
  for (const Json& row : json.at("forms")) {
    fit.forms.push_back({form_from(row.at("form")), whole_number(row.at("n_parameters")),
                         row.at("log_likelihood").get<double>(), row.at("bic").get<double>()});
  }
  for (const Json& row : json.at("specimens")) {
    fit.specimens.push_back(
        {row.at("name").get<std::string>(), row.at("mixing_ratio").get<double>(),
         row.at("E0_Pa").get<double>(), row.at("ln_E0_se").get<double>(),
         whole_number(row.value("specimen", Json(0))), whole_number(row.value("touch", Json(1)))});
  }
  if (json.contains("scatter")) read_scatter(json.at("scatter"), fit.scatter);
  for (const Json& row : json.at("flags")) {
    fit.flags.push_back({row.at("name").get<std::string>(), 0, row.at("text").get<std::string>()});
  }
}

}  // namespace

std::string json_from_ratio_fit(const RatioFit& fit) {
  Json out{{"schema", kSchema}, {"summary", law_in_words(fit)}};
  out["best"] = json_from(fit.best);
  out["law"] = json_from(fit.law);
  out["forms"] = forms_json(fit);
  out["specimens"] = Json::array();
  for (const RatioSpecimen& one : fit.specimens) {
    out["specimens"].push_back({{"name", one.name},
                                {"mixing_ratio", one.mixing_ratio},
                                {"E0_Pa", one.E0_Pa},
                                {"ln_E0_se", one.ln_E0_se},
                                {"specimen", one.specimen},
                                {"touch", one.touch}});
  }
  out["scatter"] = json_from(fit.scatter);
  out["flags"] = Json::array();
  for (const MaterialFlag& flag : fit.flags) {
    out["flags"].push_back({{"name", flag.name}, {"text", flag.text}});
  }
  out["common"] = json_from(fit.common);
  out["materials"] = Json::array();
  for (const double ratio : fit.best.ratios) {
    const Material material = material_at_ratio(fit, ratio);
    validate(material);
    out["materials"].push_back(json_from(material));
  }
  return text_from_json(out, 2) + "\n";
}

RatioFit read_ratio_fit(const std::filesystem::path& path, Plausible judged) {
  return ratio_fit_from_json(read_file(path), path.string(), judged);
}

namespace {

RatioFit ratio_fit_from(const std::string& text, const std::string& name) {
  const Json json = parse_json(text, name);
  if (!json.is_object() || json.value("schema", "") != kSchema) {
    throw std::runtime_error(name + ": schema is not '" + kSchema +
                             "', so this is not a joint fit; make one with viscard fit --joint");
  }
  RatioFit fit;
  try {
    fit.best = model_from(json.at("best"));
    fit.law = model_from(json.at("law"));
    read_lists(json, fit);
  } catch (const Json::exception& error) {
    throw std::runtime_error(name + ": is not a complete joint fit: " + reason_of(error));
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": is not a valid joint fit: " + error.what());
  }
  if (!json.contains("common"))
    throw std::runtime_error(name +
                             ": 'common' is missing; make the file again with viscard fit --joint");
  fit.common = material_from(json["common"], name);
  if (!fit.common.terms.empty()) {
    throw std::runtime_error(name +
                             ": common.terms: must be empty; the terms are those of the law");
  }
  return fit;
}

}  // namespace

RatioFit ratio_fit_from_json(const std::string& text, const std::string& name, Plausible judged) {
  RatioFit fit =
      read_as(FileKind::kJointFit, text, name, [&] { return ratio_fit_from(text, name); });
  if (judged == Plausible::kOff) {
    flag_plausible_off(fit.flags);
    flag_plausible_off(fit.common.flags);
  }
  if (accepts_implausible(fit.flags)) return fit;
  refuse_implausible(name, "rho_kg_m3", quantities::kDensity, fit.common.rho_kg_m3, judged);
  for (const RatioSpecimen& one : fit.specimens) {
    refuse_implausible(name, "specimens: E0_Pa", quantities::kModulus, one.E0_Pa, judged);
  }
  return fit;
}

bool looks_like_ratio_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string head(256, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(kSchema) != std::string::npos;
}

}  // namespace viscard
