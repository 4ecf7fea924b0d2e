#include "models/array/layer/layer_readings.h"

#include "models/array/film/disc_charge.h"
#include "models/array/film/metal_quarters.h"
#include "models/array/space/potential_spectrum.h"

#include <algorithm>
#include <cmath>
#include <memory>

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
    factors_.emplace_back([&scene](double k_1_m) {
      return mean_of_wave(scene.is_plane(), k_1_m * scene.electrode_radius_m);
    });
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

// The potential is smooth over a quarter.
double LayerReadings::quarter_mean_V(const LayerPressure& pressed, const LayerKernel& kernel,
                                     double x_m, double y_m, int quarter) const {
  const QuarterRule rule = quarter_means(scene_->electrode_radius_m, 4);
  double mean_V = 0.0;
  for (std::size_t p = 0; p < rule.points_m.size(); ++p) {
    const double weight = rule.weights(quarter - 1, static_cast<Eigen::Index>(p));
    if (weight == 0.0) continue;
    const Eigen::Vector2d& at_m = rule.points_m[p];
    mean_V += weight * potential_V(pressed, kernel, x_m + at_m.x(), y_m + at_m.y(), kPoint);
  }
  return mean_V;
}

void LayerReadings::add(const LayerPressure& pressed, const LayerKernel& kernel,
                        double relative_error, SceneAnswer& answer) const {
  const std::vector<std::string> names = voltage_names(scene_->electrode);
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
