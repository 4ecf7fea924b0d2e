#include "io/flow/planning/scene_quantity.h"

#include "io/scenes/scene_file.h"
#include "models/scene/simulate.h"

#include <cmath>
#include <memory>
#include <stdexcept>

namespace viscard {
namespace {

// E_inf, E_i, tau_i; the logarithms are the arguments of the power law.
std::vector<double> logarithms_of(const PronySeries& series) {
  std::vector<double> logarithms{std::log(series.equilibrium_modulus_Pa)};
  for (const MaxwellTerm& term : series.terms) logarithms.push_back(std::log(term.modulus_Pa));
  for (const MaxwellTerm& term : series.terms) {
    logarithms.push_back(std::log(term.relaxation_time_s));
  }
  return logarithms;
}

Material material_of(const std::vector<double>& logarithms, const Material& like) {
  const std::size_t n = (logarithms.size() - 1) / 2;
  Material material = like;
  material.terms.clear();
  material.uncertainty.reset();
  material.E0_Pa = 0.0;
  for (std::size_t i = 0; i <= n; ++i) material.E0_Pa += std::exp(logarithms[i]);
  const bool is_bulk_elastic = !like.terms.empty() && !has_constant_poisson_ratio(like);
  for (std::size_t i = 1; i <= n; ++i) {
    const double g = std::exp(logarithms[i]) / material.E0_Pa;
    material.terms.push_back({g, is_bulk_elastic ? 0.0 : g, std::exp(logarithms[n + i])});
  }
  return material;
}

const SceneResult* result_named(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& result : answer.results) {
    if (result.name == name || (name == "voltage" && result.unit == "V")) return &result;
  }
  return nullptr;
}

double result_at(Scene scene, const std::vector<double>& logarithms, const std::string& name) {
  common(scene).pillar = material_of(logarithms, common(scene).pillar);
  // Its own error cancels in differences of logarithms.
  const SceneAnswer answer = answer_on(scene, Discretisation{});
  const SceneResult* result = result_named(answer, name);
  if (result == nullptr || result->value == 0.0) {
    std::string names;
    for (const SceneResult& one : answer.results) names += (names.empty() ? "" : ", ") + one.name;
    throw std::invalid_argument("'" + name +
                                "' is wanted, but it is neither E0, E_inf, sum_g, E_i, g_i "
                                "or tau_i nor a result of the scene that is not zero; it has " +
                                names);
  }
  return std::abs(result->value);
}

}  // namespace

bool is_of_material(const std::string& name) {
  const PronySeries many{1.0, std::vector<MaxwellTerm>(999, {1.0, 1.0})};
  try {
    value_of({name, 1.0}, many);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

void take_results_of_scene(const std::string& path, const Material& guess,
                           std::vector<WantedQuantity>& wanted) {
  const Scene scene = read_scene(path).scene;
  const std::vector<double> at = logarithms_of(young_series(guess));
  for (WantedQuantity& one : wanted) {
    if (is_of_material(one.name)) continue;
    constexpr double kStep = 0.01;
    std::vector<double> exponents;
    for (std::size_t j = 0; j < at.size(); ++j) {
      std::vector<double> up = at, down = at;
      up[j] += kStep;
      down[j] -= kStep;
      exponents.push_back(
          std::log(result_at(scene, up, one.name) / result_at(scene, down, one.name)) /
          (2.0 * kStep));
    }
    one.value = [at, exponents](const PronySeries& series) {
      const std::vector<double> now = logarithms_of(series);
      double logarithm = 0.0;
      for (std::size_t j = 0; j < at.size(); ++j) logarithm += exponents[j] * (now[j] - at[j]);
      return std::exp(logarithm);
    };
  }
}

}  // namespace viscard
