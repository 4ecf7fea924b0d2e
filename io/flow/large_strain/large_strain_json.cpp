#include "fit/intervals/fitted_law.h"
#include "fit/large_strain/large_strain_result.h"
#include "io/basics/atomic_file.h"
#include "io/flow/large_strain/large_strain_files.h"
#include "models/hyperelastic/law_stability.h"
#include "models/material/material.h"
#include "models/maths/interval.h"

#include <nlohmann/json.hpp>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_interval(const Interval& interval) {
  return Json::array({interval.low, interval.high});
}

// An end that the search did not reach is null.
Json json_of_range(const StableRange& range) {
  return Json::array({range.low_is_open ? Json(nullptr) : Json(range.low),
                      range.high_is_open ? Json(nullptr) : Json(range.high)});
}

Json json_of_flags(const std::vector<MaterialFlag>& flags) {
  Json json = Json::array();
  for (const MaterialFlag& flag : flags) {
    json.push_back({{"name", flag.name}, {"text", flag.text}});
    if (flag.term > 0) json.back()["term"] = flag.term;
  }
  return json;
}

Json json_of_matrix(const Eigen::MatrixXd& matrix) {
  Json json = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    json.push_back(row);
  }
  return json;
}

Json json_of_terms(const std::vector<FittedRubberTerm>& terms) {
  Json json = Json::array();
  for (const FittedRubberTerm& term : terms) {
    json.push_back({{"g", term.g},
                    {"g_interval_95", json_of_interval(term.g_interval_95)},
                    {"tau_s", term.tau_s},
                    {"tau_s_interval_95", json_of_interval(term.tau_s_interval_95)}});
  }
  return json;
}

Json json_of_law(const FittedRubber& fitted) {
  Json json;
  json["name"] = name_of(fitted.law.form);
  json["parameters"] = Json::array();
  for (const LawParameter& one : fitted.parameters) {
    json["parameters"].push_back({{"name", one.name},
                                  {"value", one.value},
                                  {"se", one.se},
                                  {"interval_95", json_of_interval(one.interval_95)}});
  }
  json["covariance"] = json_of_matrix(fitted.covariance);
  json["E0_Pa"] = fitted.E0_Pa;
  json["E0_interval_95"] = json_of_interval(fitted.E0_interval_95);
  json["E_inf_Pa"] = fitted.E_inf_Pa;
  json["E_inf_interval_95"] = json_of_interval(fitted.E_inf_interval_95);
  json["terms"] = json_of_terms(fitted.terms);
  json["series_covariance"] = json_of_matrix(fitted.series_covariance);
  json["orders"] = Json::array();
  for (const RubberOrder& order : fitted.orders) {
    json["orders"].push_back({{"n_terms", order.n_terms},
                              {"bic", order.bic},
                              {"eligible", order.is_eligible},
                              {"chosen", order.is_chosen}});
  }
  json["n_parameters"] = fitted.n_parameters;
  json["rss_Pa2"] = fitted.rss;
  json["rms_relative"] = fitted.rms_relative;
  json["aicc"] = fitted.aicc;
  json["bic"] = fitted.bic;
  json["inflation"] = fitted.inflation;
  for (std::size_t d = 0; d < fitted.stable.size(); ++d) {
    json["stable_stretch"][deformation_names()[d]] = json_of_range(fitted.stable[d]);
  }
  json["flags"] = json_of_flags(fitted.flags);
  json["trustworthy"] = fitted.is_trustworthy;
  return json;
}

// The shortest step and the duration; null without times.
Json json_of_times(const LargeStrainTest& test) {
  if (!has_times(test)) return nullptr;
  double step_s = 0.0;
  for (std::size_t i = 1; i < test.time_s.size(); ++i) {
    const double step = test.time_s[i] - test.time_s[i - 1];
    if (step > 0.0 && (step_s == 0.0 || step < step_s)) step_s = step;
  }
  return Json::array({step_s, test.time_s.back() - test.time_s.front()});
}

}  // namespace

nlohmann::ordered_json json_from_large_strain(const FittedLargeStrain& fitted) {
  const LargeStrainResult& result = fitted.result;
  Json json;
  json["schema"] = "viscard-hyperelastic/1";
  json["law"] = name_of(result.best().law.form);
  json["trustworthy"] = result.best().is_trustworthy;
  json["laws"] = Json::array();
  for (const FittedRubber& law : result.laws) json["laws"].push_back(json_of_law(law));
  json["tests"] = Json::array();
  for (std::size_t i = 0; i < result.tests.size(); ++i) {
    const RubberTestSummary& test = result.tests[i];
    json["tests"].push_back(
        {{"name", test.name},
         {"deformation", name_of(test.deformation)},
         {"file", fitted.files[i].path},
         {"sha256", sha256_of_file(fitted.files[i].path)},
         {"n_readings", test.n_readings},
         {"stretch", Json::array({test.least_stretch, test.largest_stretch})},
         {"rms_Pa", test.rms_Pa},
         {"time_s", json_of_times(fitted.tests[i])},
         {"n_cycles", fitted.cycles[i].n_cycles},
         {"cycle", fitted.cycles[i].fitted},
         {"n_left_out", fitted.cycles[i].n_left_out},
         {"softening",
          fitted.cycles[i].softening ? Json(*fitted.cycles[i].softening) : Json(nullptr)}});
  }
  json["flags"] = json_of_flags(result.notes);
  return json;
}

}  // namespace viscard
