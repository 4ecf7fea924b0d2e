#include "io/flow/json/fit_json_parts.h"

namespace viscard {
namespace {

// The fit of this test by itself.
Json alone(const FittedTest& test) {
  const std::string unit = test.is_stiffness ? "_N_m" : "_Pa";
  const std::string letter = test.is_stiffness ? "K" : "E";
  return {{"n_terms", test.own_terms},
          {letter + "0" + unit, json_number(test.own_E0_Pa)},
          {letter + "0_interval_95", json_from(test.own_E0_95)},
          {letter + "_inf" + unit, json_number(test.own_E_inf_Pa)},
          {letter + "_inf_interval_95", json_from(test.own_E_inf_95)},
          {"rss", json_number(test.own_rss)}};
}

// What the common fit predicts of this test beside its own fit.
Json difference(const FittedTest& test) {
  return {
      {"relative", json_number(test.difference)}, {"interval_95", json_from(test.difference_95)},
      {"worst", json_number(test.worst)},         {"p_value", json_number(test.p_value)},
      {"degrees_of_freedom", test.freedom},       {"disagrees", test.disagrees}};
}

Json residuals(const FittedTest& test) {
  const FitCurves& curves = test.curves;
  Json row;
  row[test.kind == FitKind::kDma ? "frequency_Hz" : "time_s"] = curves.time_s;
  row["measured"] = curves.measured;
  row["fitted"] = curves.fitted;
  row["sigma"] = curves.sigma;
  if (!curves.loss_measured.empty()) {
    row["loss_measured"] = curves.loss_measured;
    row["loss_fitted"] = curves.loss_fitted;
    row["loss_sigma"] = curves.loss_sigma;
  }
  return row;
}

}  // namespace

Json json_of_tests(const FittedFile& fitted) {
  Json tests = Json::array();
  for (std::size_t k = 0; k < fitted.result.tests.size(); ++k) {
    const FittedTest& test = fitted.result.tests[k];
    Json row{{"name", test.name}, {"kind", name_of_kind(test.kind)}};
    if (k < fitted.tests.size()) row["file"] = fitted.tests[k].path;
    row["n_samples"] = test.n_samples;
    row["unit"] = test.kind == FitKind::kDma ? "relative" : test.fitted_unit;
    row["rss"] = json_number(test.rss);
    row["noise"] = {{"sigma", json_number(test.noise.sigma)},
                    {"inflation", json_number(test.noise.inflation)}};
    row["from_s"] = json_number(test.from_s);
    row["to_s"] = json_number(test.to_s);
    if (test.has_scale) {
      row["scale"] = json_number(test.scale);
      row["scale_interval_95"] = json_from(test.scale_95);
    }
    row["alone"] = alone(test);
    row["difference"] = difference(test);
    row["residuals"] = residuals(test);
    tests.push_back(row);
  }
  return tests;
}

}  // namespace viscard
