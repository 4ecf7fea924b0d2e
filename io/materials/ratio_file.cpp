#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/inputs.h"
#include "io/basics/json_string.h"
#include "io/materials/material_file.h"
#include "io/materials/material_json.h"
#include "io/materials/plausible_numbers.h"
#include "io/materials/scatter_json.h"
#include "io/results/result_json.h"
#include "models/maths/failure_text.h"

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

void show_degree(ResultVisitor& v, const char* key, int degree) {
  const char* what = "degree of the law, or \"per-ratio\"";
  degree == kPerRatio ? v(key, "per-ratio", what) : v(key, degree, what);
}

void show_form(ResultVisitor& v, const RatioForm& form) {
  v.object("form", "of the law", [&] {
    v("name", form_name(form), "its name");
    for (const auto& [variable, word] : variable_words()) {
      if (variable != form.variable) continue;
      v.word("variable", word, {"ln-ratio", "ratio", "crosslinker-share"}, "of the polynomials");
    }
    show_degree(v, "E0_degree", form.E0_degree);
    show_degree(v, "g_degree", form.g_degree);
    show_degree(v, "tau_degree", form.tau_degree);
    v.when(!form.same.empty(),
           [&] { v("same", form.same, "parameters that are the same at all ratios"); });
    v("text", form_in_words(form), "in words");
  });
}

void show_spreads(ResultVisitor& v, const char* key, const char* what, double ln_E0, double ln_g,
                  double ln_tau) {
  v.object(key, what, [&] {
    v("ln_E0", ln_E0, "of ln E0; null: unknown");
    v("ln_g", ln_g, "of the ln g_i");
    v("ln_tau", ln_tau, "of the ln tau_i");
  });
}

void show_model(ResultVisitor& v, const char* key, const char* what, const RatioModel& model) {
  const auto spread = [&](double value, int parameter) {
    const bool is_known = parameter > 2 * model.n_terms || has_known_spread(model, parameter);
    return is_known ? value : number_or_null(std::nullopt);
  };
  v.object(key, what, [&] {
    show_form(v, model.form);
    v("n_terms", model.n_terms, "number of terms");
    v("ratios", model.ratios, "that were measured");
    v("coefficients", std::vector<double>(model.coefficients.begin(), model.coefficients.end()),
      "of the law");
    v("covariance", model.covariance, "of the coefficients");
    show_spreads(v, "between_specimens", "standard deviations about the law",
                 spread(model.spread_ln_E0, 0), spread(model.spread_ln_g, 1),
                 spread(model.spread_ln_tau, model.n_terms + 1));
    v("n_specimens", model.n_specimens, "number of specimens");
    v("n_parameters", model.n_parameters, "number of parameters");
    v("log_likelihood", model.log_likelihood, "of the records");
    v("bic", model.bic, "Bayes criterion");
    v.when(!model.own_terms.empty(), [&] { v("own_terms", model.own_terms, "of each ratio"); });
    v.when(model.touch_ln_E0 > 0.0 || model.touch_ln_g > 0.0 || model.touch_ln_tau > 0.0, [&] {
      show_spreads(v, "between_touches", "standard deviations on one specimen", model.touch_ln_E0,
                   model.touch_ln_g, model.touch_ln_tau);
    });
  });
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

void show_keys(ResultVisitor& v, const RatioFit& fit) {
  std::vector<std::string> materials;
  for (const double ratio : fit.best.ratios) {
    const Material material = material_at_ratio(fit, ratio);
    validate(material);
    materials.push_back(text_from_json(json_from(material)));
  }
  v("summary", fit.best.ratios.empty() ? "" : law_in_words(fit), "the law in words");
  show_model(v, "best", "the form that describes the records best", fit.best);
  show_model(v, "law", "the law that answers at other ratios", fit.law);
  v.list("forms", "the forms that were compared", fit.forms, [&](const RatioComparison& row) {
    show_form(v, row.form);
    v("n_parameters", row.n_parameters, "number of parameters");
    v("log_likelihood", row.log_likelihood, "of the records");
    v("bic", row.bic, "Bayes criterion");
    v("bic_above_best", fit.forms.empty() ? 0.0 : row.bic - fit.forms.front().bic, "difference");
  });
  v.list("specimens", "the records", fit.specimens, [&](const RatioSpecimen& one) {
    v("name", one.name, "its file or name");
    v("mixing_ratio", one.mixing_ratio, "parts of base to one of curing agent");
    v("E0_Pa", one.E0_Pa, "instantaneous modulus");
    v("ln_E0_se", one.ln_E0_se, "standard error of ln E0");
    v("specimen", one.specimen, "number of the specimen");
    v("touch", one.touch, "number of the touch");
  });
  show_scatter(v, fit.scatter);
  v("flags", fit.flags, "what limits the trust in the result");
  v.document("common", text_from_json(json_from(fit.common)),
             "the material of all ratios together, as in a material file");
  v.documents("materials", materials, "one for each ratio, as in a material file");
}

std::string json_from_ratio_fit(const RatioFit& fit) {
  Json out{{"schema", kSchema}};
  out.update(json_from_result(fit));
  add_body_sum(out);
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
    throw std::runtime_error(name +
                             ": is not a valid joint fit: " + failure_text(error, "reading it"));
  }
  if (!json.contains("common"))
    throw std::runtime_error(name +
                             ": 'common' is missing; make the file again with viscard fit --joint");
  fit.common = material_from(json["common"], name);
  if (!fit.common.terms.empty()) {
    throw std::runtime_error(name +
                             ": common.terms: must be empty; the terms are those of the law");
  }
  if (is_edited(json, name)) {
    fit.flags.push_back({kEdited, 0, kEditedText});
    fit.common.flags.push_back({kEdited, 0, kEditedText});
  }
  for (const MaterialFlag& flag : fit.flags) {
    if (is_doubt_of_record(flag)) note_input(name, flag.text);
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
