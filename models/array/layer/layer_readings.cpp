#include "models/array/layer/layer_readings.h"

#include "models/array/film/disc_charge.h"
#include "models/array/space/potential_spectrum.h"
#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace viscard {
namespace {

constexpr std::size_t kWhole = 1;  // the reading of the whole electrode
constexpr int kChargeModes = 6;
constexpr int kChargeDegree = 8;  // of the film's elements

}  // namespace

LayerReadings::LayerReadings(const LayerScene& scene) : scene_(&scene) {
  factors_.emplace_back([](double) { return 1.0; });
  if (scene.electrode == SpaceElectrode::kEquipotential) {
    add_equipotential();
  } else {
    factors_.push_back(layer_mean(scene.electrode_radius_m, scene.is_plane()));
  }
}

// The charge is that of the film alone: a layer of a modulus E_l above changes it by E_l/E_film at most,
// and so what it weighs by less.
void LayerReadings::add_equipotential() {
  LayeredFilm film = stack_of(*scene_);
  film.layers.pop_back();
  const auto charge = std::make_shared<DiscCharge>(film, scene_->electrode_radius_m, 1,
                                                   kChargeModes, kChargeDegree);
  factors_.emplace_back([charge](double k_1_m) { return charge->weight(k_1_m); });
  error_ = scene_->pillar.E0_Pa / scene_->film.stiffness_Pa(2, 2);
  std::vector<SourcePoint> points;
  for (const auto& [x_m, y_m] : scene_->electrodes_m) points.push_back({x_m, y_m, 0});
  error_ +=
      influence_of_all(film, *charge, points, {.film_degree = kChargeDegree, .largest_kt = 10.0});
}

// Mean over a quarter of the disc by Gauss points over radius and angle; the potential is smooth there.
double LayerReadings::quarter_mean_V(const LayerPressure& pressed, const LayerKernel& kernel,
                                     double x_m, double y_m, int quarter) const {
  constexpr int kPoints = 4;
  const QuadratureRule rule = gauss_legendre(kPoints);
  const double R_m = scene_->electrode_radius_m;
  double mean_V = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const auto a = static_cast<std::size_t>(i);
    for (int j = 0; j < kPoints; ++j) {
      const auto b = static_cast<std::size_t>(j);
      const double r_m = R_m * rule.points[a];
      const double angle = 0.5 * std::numbers::pi * (quarter - 1 + rule.points[b]);
      mean_V += 2.0 * rule.points[a] * rule.weights[a] * rule.weights[b] *
                potential_V(pressed, kernel, x_m + r_m * std::cos(angle),
                            y_m + r_m * std::sin(angle), kPoint);
    }
  }
  return mean_V;
}

void LayerReadings::add(const LayerPressure& pressed, const LayerKernel& kernel,
                        double relative_error, SceneAnswer& answer) const {
  const std::vector<std::string> names = voltage_names(*scene_);
  const std::size_t first = answer.results.size();
  for (const std::string& name : names) {
    for (std::size_t e = 0; e < scene_->electrodes_m.size(); ++e) {
      const std::string one = name + "_" + std::to_string(e + 1);
      if (!asks_for(*scene_, name) && !asks_for(*scene_, one)) continue;
      const auto& [x_m, y_m] = scene_->electrodes_m[e];
      double value_V = 0.0;
      if (name.starts_with("quadrant_")) {
        value_V = quarter_mean_V(pressed, kernel, x_m, y_m, name[9] - '0');
      } else {
        value_V =
            potential_V(pressed, kernel, x_m, y_m, name.starts_with("centre") ? kPoint : kWhole);
      }
      answer.results.push_back({one, value_V, "V"});
    }
  }
  // Errors refer to the largest voltage of a kind, but at least to 1 % of the potential under the
  // contact: electrodes far from it read nearly nothing. What the waves lack is a share of that potential.
  constexpr double kLeast = 0.01;
  const LayerGrid& grid = pressed.grid;
  const double under_V = std::abs(potential_V(pressed, kernel, grid.x_m, grid.y_m, kPoint));
  for (const char* const kind : {"centre", "mean", "quadrant", "electrode"}) {
    double largest_V = kLeast * under_V;
    const auto is_kind = [&](const SceneResult& one) { return one.name.starts_with(kind); };
    for (std::size_t i = first; i < answer.results.size(); ++i) {
      if (is_kind(answer.results[i])) {
        largest_V = std::max(largest_V, std::abs(answer.results[i].value));
      }
    }
    for (std::size_t i = first; i < answer.results.size(); ++i) {
      SceneResult& one = answer.results[i];
      if (!is_kind(one)) continue;
      one.scale = largest_V;
      if (one.value != 0.0) one.unresolved = relative_error * under_V / std::abs(one.value);
    }
  }
}

}  // namespace viscard
