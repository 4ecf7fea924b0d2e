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
  for (const MaterialFlag& flag : flags) json.push_back({{"name", flag.name}, {"text", flag.text}});
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
  json["covariance"] = Json::array();
  for (Eigen::Index i = 0; i < fitted.covariance.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < fitted.covariance.cols(); ++j)
      row.push_back(fitted.covariance(i, j));
    json["covariance"].push_back(row);
  }
  json["E0_Pa"] = fitted.E0_Pa;
  json["E0_interval_95"] = json_of_interval(fitted.E0_interval_95);
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
