#include "io/materials/scatter_json.h"

#include "models/maths/result_visitor.h"

namespace viscard {
namespace {

void show_level(ResultVisitor& v, const char* key, const char* what, const ScatterLevel& level) {
  const bool is_known = is_identified(level);
  v.object(key, what, [&] {
    v.or_null("deviation", is_known ? std::optional(level.deviation) : std::nullopt,
              "standard deviation; null: these records cannot identify it");
    v.or_null("interval_95", is_known ? std::optional(level.interval_95) : std::nullopt,
              "its 95 % interval, [low, high]");
    v("degrees_of_freedom", level.degrees_of_freedom, "0: not identified");
    v.when(!level.note.empty(),
           [&] { v("note", level.note, "why not, or which other scatter it includes"); });
  });
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

void show_scatter(ResultVisitor& v, const std::vector<Scatter>& scatter) {
  v.map("scatter", "by quantity: how it scatters at three levels", scatter,
        [&](const Scatter& one) {
          v.object(one.quantity, "one quantity", [&] {
            v("mean", one.mean, "of all records");
            v("own_error", one.own_error, "median standard error of the fit of a record");
            show_level(v, "touch", "between touches on one specimen", one.touch);
            show_level(v, "specimen", "between specimens of one ratio", one.specimen);
            show_level(v, "ratio", "of ratios about the law", one.ratio);
          });
        });
}

void read_scatter(const Json& json, std::vector<Scatter>& scatter) {
  for (const auto& [quantity, one] : json.items()) {
    scatter.push_back({quantity, one.at("mean").get<double>(), one.at("own_error").get<double>(),
                       level_from(one.at("touch")), level_from(one.at("specimen")),
                       level_from(one.at("ratio"))});
  }
}

}  // namespace viscard
