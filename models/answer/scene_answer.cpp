#include "models/answer/scene_answer.h"

#include <algorithm>
#include <cmath>
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

}  // namespace viscard
