#include "io/basics/number_text.h"
#include "io/flow/predict_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Object = nlohmann::ordered_json;

Object finite_or_null(double value) {
  return std::isfinite(value) ? Object(value) : Object(nullptr);
}

Object agreement_of(const Agreement& found) {
  return {{"quantity", found.name},
          {"n", found.at.size()},
          {"n_left_out", found.n_left_out},
          {"rms", finite_or_null(found.rms)},
          {"rms_relative", finite_or_null(found.rms_relative)},
          {"worst", finite_or_null(found.worst)},
          {"worst_at", finite_or_null(found.worst_at)},
          {"share_inside_band", finite_or_null(found.share_inside_band)},
          {"share_inside_band_and_noise", finite_or_null(found.share_inside_band_and_noise)},
          {"noise_sigma", finite_or_null(found.noise_sigma)},
          {"noise_is_relative", found.is_noise_relative},
          {"n_inside_window", found.n_inside_window},
          {"rms_inside_window", finite_or_null(found.rms_inside_window)}};
}

// All columns of the prediction with their names, in the order of the table.
struct NamedColumn {
  std::string name;
  const std::vector<double>* values;
};
std::vector<NamedColumn> columns_of(const TestPrediction& prediction) {
  std::vector<NamedColumn> columns{{prediction.argument, &prediction.at}};
  if (!prediction.input_name.empty()) columns.push_back({prediction.input_name, &prediction.input});
  for (const PredictedCurve& one : prediction.curves) {
    columns.push_back({one.name, &one.curve.value});
    if (one.curve.low_95.empty()) continue;
    columns.push_back({one.name + "_low_95", &one.curve.low_95});
    columns.push_back({one.name + "_high_95", &one.curve.high_95});
  }
  return columns;
}

}  // namespace

nlohmann::ordered_json json_from_prediction(const PredictedFile& predicted) {
  const TestPrediction& prediction = predicted.prediction;
  Object json;
  json["material"] = predicted.name;
  json["file"] = predicted.path;
  json["test"] = names_of_predicted_tests()[static_cast<std::size_t>(prediction.test)];
  json["window"] = nullptr;
  if (prediction.is_window_known) {
    json["window"] = {{"t_min_s", prediction.t_min_s}, {"t_max_s", prediction.t_max_s}};
  }
  json["n_outside_window"] =
      std::count(prediction.is_inside.begin(), prediction.is_inside.end(), false);
  json["has_band"] = predicted.has_band;
  json["trustworthy"] = predicted.is_trustworthy;
  json["flags"] = Object::array();
  for (const MaterialFlag& flag : predicted.flags) {
    Object row{{"name", flag.name}};
    if (flag.term > 0) row["term"] = flag.term;
    row["text"] = flag.text;
    json["flags"].push_back(std::move(row));
  }
  json["systematic_relative"] = finite_or_null(predicted.systematic_relative);
  for (const NamedColumn& column : columns_of(prediction)) {
    Object values = Object::array();
    for (const double value : *column.values) values.push_back(finite_or_null(value));
    json["curve"][column.name] = std::move(values);
  }
  json["curve"]["inside_window"] = prediction.is_inside;
  if (!predicted.against.empty()) {
    json["against"]["file"] = predicted.against;
    json["against"]["quantities"] = Object::array();
    for (const Agreement& found : predicted.agreement) {
      json["against"]["quantities"].push_back(agreement_of(found));
    }
  }
  json["notes"] = predicted.notes;
  return json;
}

std::string csv_from_prediction(const PredictedFile& predicted, const std::string& command) {
  const TestPrediction& prediction = predicted.prediction;
  const std::vector<NamedColumn> columns = columns_of(prediction);
  std::string text = "# " + command + " (viscard " VISCARD_VERSION ")\n";
  for (const NamedColumn& column : columns) text += column.name + ",";
  text += "inside_window\n";
  for (std::size_t i = 0; i < prediction.at.size(); ++i) {
    for (const NamedColumn& column : columns) text += text_from_number((*column.values)[i]) + ",";
    text += prediction.is_inside[i] ? "1\n" : "0\n";
  }
  return text;
}

}  // namespace viscard
