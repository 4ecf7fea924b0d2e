#include "io/materials/scatter_json.h"

namespace viscard {
namespace {

Json level_json(const ScatterLevel& level) {
  const bool is_known = is_identified(level);
  Json out{{"deviation", is_known ? Json(level.deviation) : Json(nullptr)},
           {"interval_95", is_known ? json_from(level.interval_95) : Json(nullptr)},
           {"degrees_of_freedom", level.degrees_of_freedom}};
  if (!level.note.empty()) out["note"] = level.note;
  return out;
}

ScatterLevel level_from(const Json& json) {
  ScatterLevel level;
  level.degrees_of_freedom = whole_number(json.at("degrees_of_freedom"));
  level.note = json.value("note", "");
  if (!is_identified(level)) return level;
  level.deviation = json.at("deviation").get<double>();
  level.interval_95 = {json.at("interval_95").at(0).get<double>(),
                       json.at("interval_95").at(1).get<double>()};
  return level;
}

}  // namespace

Json json_from(const std::vector<Scatter>& scatter) {
  Json out = Json::object();
  for (const Scatter& one : scatter) {
    out[one.quantity] = {{"mean", one.mean},
                         {"own_error", one.own_error},
                         {"touch", level_json(one.touch)},
                         {"specimen", level_json(one.specimen)},
                         {"ratio", level_json(one.ratio)}};
  }
  return out;
}

void read_scatter(const Json& json, std::vector<Scatter>& scatter) {
  for (const auto& [quantity, one] : json.items()) {
    scatter.push_back({quantity, one.at("mean").get<double>(), one.at("own_error").get<double>(),
                       level_from(one.at("touch")), level_from(one.at("specimen")),
                       level_from(one.at("ratio"))});
  }
}

}  // namespace viscard
