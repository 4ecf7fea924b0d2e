#include "models/answer/scene_answer.h"

#include "models/maths/result_visitor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viscard {
void add_sweep(const std::string& name, const std::string& unit,
               const std::vector<double>& frequencies_Hz, const Sweep& sweep, SceneAnswer& answer) {
  const auto add = [&](const char* part, const std::string& part_unit, bool is_watched,
                       auto&& number) {
    SceneCurve curve{name + part, part_unit, frequencies_Hz, {}, "frequency_Hz"};
    for (const std::complex<double>& y : sweep.value) curve.value.push_back(number(y));
    if (is_watched) curve.allowed = sweep.allowed;
    curve.is_watched = is_watched;
    answer.curves.push_back(std::move(curve));
  };
  add("_real", unit, true, [](const auto& y) { return y.real(); });
  add("_imaginary", unit, true, [](const auto& y) { return y.imag(); });
  add("_magnitude", unit, true, [](const auto& y) { return std::abs(y); });
  add("_phase", "rad", false, [](const auto& y) { return std::arg(y); });
  answer.results.push_back(
      {name + "_at_lowest", std::abs(sweep.value.front()), unit, 0.0, sweep.allowed.front()});
  if (frequencies_Hz.size() < 2) return;
  answer.results.push_back(
      {name + "_at_highest", std::abs(sweep.value.back()), unit, 0.0, sweep.allowed.back()});
}

void set_left_out(std::span<const double> shares, const std::vector<std::vector<double>>& parts,
                  SceneCurve& curve) {
  curve.left_out.assign(curve.value.size(), 0.0);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double factor = shares[k] / (1.0 - shares[k]);
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      const double change = std::abs(curve.value[i] - parts[k][i]);
      curve.left_out[i] = std::max(curve.left_out[i], factor * change);
    }
  }
}

double largest_size(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double size_of(const SceneMap& map) {
  return std::max(largest_size(map.value), map.scale);
}

namespace {

void show_mode(ResultVisitor& v, const SceneMode& mode) {
  v.when(mode.damping_ratio.has_value(), [&] {
    v("damping_error", mode.damping_error, "error of the damping");
    v("damping_ratio", mode.damping_ratio.value_or(0.0), "its damping");
  });
  v("error_estimate", mode.error_estimate, "in Hz");
  v("family", mode.family, "bending, torsion, axial, breathing ...");
  v("frequency_Hz", mode.frequency_Hz, "its frequency");
  v("harmonic", mode.harmonic, "around the axis");
}

void show_map(ResultVisitor& v, const SceneArray& array, const SceneMap& map) {
  const auto [low, high] = std::minmax_element(map.value.begin(), map.value.end());
  const bool has_values = !map.value.empty();
  v("error_estimate", largest_size(map.error), "largest error");
  v("largest", has_values ? *high : 0.0, "largest value");
  v("name", map.name, "its name");
  v("smallest", has_values ? *low : 0.0, "smallest value");
  v("unit", map.unit, "its unit");
  v("values", by_pillar(array, map, map.value), "in the order of pillars; null: no pillar");
}

}  // namespace

bool acts(const SceneEffect& effect) {
  return effect.on || effect.estimate > 0.0;
}

void show_keys(ResultVisitor& v, const SceneEffect& effect) {
  const bool has_number = !effect.number.empty();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  v("choice", effect.is_choice, "whether it can be switched");
  v("counted", effect.is_counted, "whether it counts in left_out");
  v("estimate", acts(effect) ? effect.estimate : kNone,
    "relative error of leaving it out; null: it does not act");
  v("forced", effect.is_forced, "by [effects] of the scene");
  v("name", effect.name, "of the effect");
  v.or_null("number", has_number ? std::optional(effect.number) : std::nullopt,
            "the number that decides");
  v("on", effect.on, "whether it is computed");
  v("reason", effect.reason, "why");
  v("value", has_number ? effect.value : kNone, "its value");
}

void show_solution(ResultVisitor& v, const SceneAnswer& answer) {
  v.object("discretisation", "the mesh that met the tolerance", [&] {
    v("degree", answer.discretisation.degree, "of the elements");
    v("layers", answer.discretisation.layers, "at the rim");
  });
  v("effects", answer.effects, "every effect and why it is on or off");
  v.when(!answer.maps.empty(), [&] {
    v.list("maps", "quantities over the pillars of an array in the plane", answer.maps,
           [&](const SceneMap& map) { show_map(v, answer.array, map); });
  });
  v.list("modes", "modes, lowest first", answer.modes,
         [&](const SceneMode& mode) { show_mode(v, mode); });
}

void show_notes(ResultVisitor& v, const SceneAnswer& answer) {
  v("notes", answer.notes, "what to keep in mind");
  v.when(!answer.maps.empty(), [&] {
    std::vector<int> row, column;
    std::vector<double> x_m, y_m;
    for (const ScenePillar& one : answer.array.pillars) {
      row.push_back(one.row);
      column.push_back(one.column);
      x_m.push_back(one.x_m);
      y_m.push_back(one.y_m);
    }
    v.object("pillars", "of an array in the plane", [&] {
      v("column", column, "from 1");
      v("row", row, "from 1");
      v("x_m", x_m, "position");
      v("y_m", y_m, "position");
    });
  });
}

void show_results(ResultVisitor& v, const SceneAnswer& answer) {
  std::vector<SceneResult> results = answer.results;
  std::stable_sort(results.begin(), results.end(),
                   [](const SceneResult& a, const SceneResult& b) { return a.name < b.name; });
  v.map("results", "by name", results, [&](const SceneResult& result) {
    v.object(result.name, "one result", [&] {
      v("error_estimate", result.error_estimate, "in unit");
      v("unit", result.unit, "its unit; 1: a plain number");
      v("value", result.value, "in unit");
    });
  });
}

std::vector<double> by_pillar(const SceneArray& array, const SceneMap& map,
                              const std::vector<double>& numbers) {
  std::vector<double> all(array.pillars.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t at = 0; at < map.pillar.size() && at < numbers.size(); ++at) {
    all[map.pillar[at]] = numbers[at];
  }
  return all;
}

}  // namespace viscard
