// Heat and noise of one pillar's electrode (models/array/sensing).
#include "models/answer/scene_mistake.h"
#include "models/array/film/disc_charge.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_maps.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

namespace viscard {
namespace {

constexpr int kModes = 6, kSensedFilmDegree = 10;

// At constant stress, eps^S + e c^-1 e^t, as pyroelectric coefficients are measured too.
double free_permittivity_F_m(const Medium& film) {
  const Eigen::VectorXd e = film.piezo_C_m2.row(2).transpose();
  const Eigen::VectorXd strain = Cholesky(film.stiffness_Pa).solve(e);
  return film.permittivity_F_m(2, 2) + e.dot(strain);
}

HeatPath heat_path(const SpaceScene& scene) {
  const HeatScene& heat = *scene.heat;
  return {.radius_m = 0.5 * scene.diameter_m,
          .length_m = scene.length_m,
          .pillar = heat.pillar,
          .thickness_m = scene.film_thickness_m,
          .film = heat.film,
          .pyroelectric_C_m2K = heat.pyroelectric_C_m2K,
          .permittivity_F_m = free_permittivity_F_m(scene.film)};
}

MetalQuarters metal_quarters(const SpaceArray& array) {
  return {array.film, array.electrode_radius_m, array.electrode_gap_m,
          space_accuracies(array)[2].quarters};
}

ElectrodeWeight weight_of(const SpaceScene& scene, const SpaceArray& array,
                          const std::string& reading) {
  if (reading == "centre") return [](double) { return 1.0; };
  const double a_m = array.electrode_radius_m;
  if (scene.electrode == SpaceElectrode::kMetalQuadrants) {
    const auto quarters = std::make_shared<const MetalQuarters>(metal_quarters(array));
    return [quarters](double k_1_m) { return quarters->weight(k_1_m); };
  }
  if (scene.electrode == SpaceElectrode::kEquipotential) {
    const auto charge =
        std::make_shared<const DiscCharge>(array.film, a_m, 1, kModes, kSensedFilmDegree);
    return [charge](double k_1_m) { return charge->weight(k_1_m); };
  }
  return disc_mean(a_m);
}

std::vector<double> heat_times_s(double first_s, double end_s) {
  constexpr int kTimes = 61;
  std::vector<double> times;
  for (int i = 0; i < kTimes; ++i) {
    times.push_back(first_s * std::pow(end_s / first_s, i / (kTimes - 1.0)));
  }
  return times;
}

// One reading of a pillar: its response to the temperature of the top, and the pressure with the
// same reading.
class HeatResults {
 public:
  HeatResults(const SpaceScene& scene, SceneAnswer& answer)
      : scene_(&scene), path_(heat_path(scene)), answer_(&answer) {}

  void add(const std::string& reading, const ElectrodeWeight& weight, double own_V_Pa) {
    const double T_K = scene_->heat->temperature_K;
    const SteadyHeat steady = steady_heat(path_, weight);
    const double share = steady.quadrature_error + steady.flux_error;
    const double of_load = share + answer_->largest_relative_error;
    const std::string name = "heat_" + reading;
    const double own_V = T_K * steady.own_V;
    put(name + "_voltage", own_V, "V", share);
    put(name + "_pressure", own_V / own_V_Pa, "Pa", of_load);
    const double pitch_m = smallest_pitch_m(*scene_);
    if (scene_->pillars.size() > 1) {
      const double away_V = heat_at_distance_V(path_, weight, pitch_m);
      put(name + "_crosstalk_percent", 100.0 * away_V / steady.own_V, "%", share);
    }
    if (scene_->heat->dummy) {
      const DummyElectrode& dummy = *scene_->heat->dummy;
      put(name + "_dummy_touch", T_K * touch_left_V(path_, weight, dummy, pitch_m), "V", share);
      put(name + "_dummy_drift", T_K * drift_left_V(path_, dummy), "V", 0.0);
    }
    if (scene_->heat->end_time_s > 0.0) add_curve(name + "_step", weight, share);
  }

  void add_common() {
    const SteadyHeat steady = steady_heat(path_, [](double) { return 1.0; });
    const double T_K = scene_->heat->temperature_K;
    put("heat_foot_temperature", T_K * steady.foot_K, "K",
        steady.quadrature_error + steady.flux_error);
    put("heat_uniform_voltage", T_K * uniform_heat_V(path_), "V", 0.0);
    put("heat_pillar_time", pillar_time_s(path_), "s", 0.0);
    put("heat_film_time", film_time_s(path_), "s", 0.0);
  }

 private:
  void put(const std::string& name, double value, const char* unit, double share) {
    answer_->results.push_back({name, value, unit, share * std::abs(value), 0.0, false});
  }

  void add_curve(const std::string& name, const ElectrodeWeight& weight, double share) {
    const double first_s = std::min(0.05 * pillar_time_s(path_), 0.1 * scene_->heat->end_time_s);
    SceneCurve curve{.name = name, .unit = "V"};
    curve.x = heat_times_s(first_s, scene_->heat->end_time_s);
    const HeatCurve step = heat_step(path_, weight, curve.x);
    const double T_K = scene_->heat->temperature_K;
    double largest_V = 0.0;
    for (const double value : step.value_V) {
      curve.value.push_back(T_K * value);
      largest_V = std::max(largest_V, std::abs(T_K * value));
    }
    curve.error.assign(curve.x.size(), share * largest_V + std::abs(T_K) * step.error_V);
    curve.is_watched = false;
    answer_->curves.push_back(std::move(curve));
  }

  const SpaceScene* scene_;
  HeatPath path_;
  SceneAnswer* answer_;
};

// Noise of one electrode. A quarter of a charge-free face has a quarter of that, apart from the effect of the gaps
// between quarters.
double noisy_capacitance_F(const SpaceScene& scene, const SpaceArray& array) {
  if (scene.electrode == SpaceElectrode::kMetalQuadrants)
    return metal_quarters(array).capacitance_F();
  const DiscCharge charge(array.film, array.electrode_radius_m, 1, kModes, kSensedFilmDegree);
  return scene.electrode == SpaceElectrode::kQuadrants ? 0.25 * charge.capacitance_F()
                                                       : charge.capacitance_F();
}

// With what the film's material states of its leakage.
Readout noisy_readout(const SpaceScene& scene) {
  Readout readout = *scene.noise_readout;
  readout.film_leakage_s = std::min(readout.film_leakage_s, scene.film_loss.leakage_s);
  return readout;
}

void add_noise(const SpaceScene& scene, double own_V_Pa, SceneAnswer& answer) {
  const SpaceArray array = array_of(scene);
  const double capacitance_F = noisy_capacitance_F(scene, array);
  const ThermalNoise noise = thermal_noise(*scene.noise, noisy_readout(scene), capacitance_F);
  const double area_m2 = 0.25 * std::numbers::pi * scene.diameter_m * scene.diameter_m;
  const double signal_V_Pa = std::abs(noise.gain * own_V_Pa);
  const auto put = [&](const char* name, double value, const char* unit) {
    answer.results.push_back(
        {name, value, unit, answer.largest_relative_error * std::abs(value), 0.0, false});
  };
  put("electrode_capacitance", capacitance_F, "F");
  put("noise_bias", noise.bias_V, "V");
  put("noise_loss", noise.loss_V, "V");
  put("noise_amplifier", noise.amplifier_V, "V");
  put("noise_voltage", noise.total_V(), "V");
  put("reading_per_pressure", signal_V_Pa, "V/Pa");
  put("resolution_pressure", noise.total_V() / signal_V_Pa, "Pa");
  put("resolution_force", noise.total_V() / signal_V_Pa * area_m2, "N");
  put("reset_noise", noise.reset_V, "V");
  put("reset_pressure", noise.reset_V / std::abs(own_V_Pa), "Pa");
}

void check_conductor(const std::string& key, const HeatConductor& one) {
  if (one.conductivity_W_mK > 0.0 && one.capacity_J_m3K > 0.0) return;
  throw SceneMistake(key,
                     "needs conductivity and capacity (density times specific heat), such as { "
                     "conductivity = \"0.15 W/m/K\", capacity = \"1.4e6 J/m3/K\" }");
}

}  // namespace

std::vector<std::string> sensing_results(const SpaceScene& scene) {
  std::vector<std::string> names;
  if (scene.noise) {
    names = {"electrode_capacitance", "noise_bias",       "noise_loss",
             "noise_amplifier",       "noise_voltage",    "reading_per_pressure",
             "resolution_pressure",   "resolution_force", "reset_noise",
             "reset_pressure"};
  }
  if (!scene.heat) return names;
  for (const char* common : {"foot_temperature", "uniform_voltage", "pillar_time", "film_time"}) {
    names.push_back(std::string("heat_") + common);
  }
  for (const std::string& reading : reading_names(scene.electrode)) {
    if (reading.starts_with("quadrant")) continue;
    for (const char* what :
         {"_voltage", "_pressure", "_crosstalk_percent", "_dummy_touch", "_dummy_drift", "_step"}) {
      names.push_back("heat_" + reading + what);
    }
  }
  return names;
}

void check_heat_and_noise(const SpaceScene& scene) {
  if (scene.heat) {
    check_conductor("heat.pillar", scene.heat->pillar);
    check_conductor("heat.film", scene.heat->film);
    if (scene.heat->pyroelectric_C_m2K == 0.0) {
      throw SceneMistake("heat.pyroelectric",
                         "is needed, with its sign: the charge on the upper face per area and "
                         "kelvin, such as \"-30e-6 C/m2/K\" of PVDF");
    }
    if (scene.heat->temperature_K == 0.0) {
      throw SceneMistake("heat.temperature",
                         "is needed: how much warmer than the base the tops are, such as \"1 K\"");
    }
    if (scene.grounded != FilmFace::kTop) {
      throw SceneMistake("heat",
                         "is answered for electrodes below: geometry.electrode.face = "
                         "\"bottom\"");
    }
  }
  if (!scene.noise) return;
  at_key("noise", [&] { validate(*scene.noise); });
  if (!scene.noise_readout || scene.electrode == SpaceElectrode::kSampled) {
    throw SceneMistake("noise",
                       "is that of an amplifier at an electrode: say electrode = { kind = "
                       "\"equipotential\", ... } (or quadrants = true) and [readout]");
  }
  at_key("readout", [&] { validate(*scene.noise_readout); });
}

double quarter_noise_V(const SpaceScene& scene) {
  if (!scene.noise) return scene.quadrants.noise_V;
  const ThermalNoise noise = thermal_noise(*scene.noise, noisy_readout(scene),
                                           noisy_capacitance_F(scene, array_of(scene)));
  return noise.total_V() / noise.gain;
}

void add_heat_and_noise(const SpaceScene& scene, SceneAnswer& answer) {
  if (!scene.heat && !scene.noise) return;
  const SpaceArray array = array_of(scene);
  const SpaceResponse response(array, without_coupling(space_accuracies(array)[2]));
  const auto kernel = response.kernel(0, 0.0, 0.0);
  const std::vector<std::string> names = reading_names(scene.electrode);
  if (scene.heat) {
    HeatResults heat(scene, answer);
    heat.add_common();
    for (std::size_t r = 0; r < names.size(); ++r) {
      if (names[r].starts_with("quadrant")) continue;
      heat.add(names[r], weight_of(scene, array, names[r]),
               kernel(static_cast<Eigen::Index>(r), static_cast<int>(TopLoad::kPressure)));
    }
  }
  if (scene.noise) {
    const Eigen::Index own = has_quarters(scene.electrode) ? first_quarter(scene.electrode) : 0;
    add_noise(scene, kernel(own, static_cast<int>(TopLoad::kPressure)), answer);
  }
}

}  // namespace viscard
