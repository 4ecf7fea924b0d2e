#include "io/flow/design/required_values.h"
#include "io/flow/design/single_bodies.h"
#include "models/pillar/time/readout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kUnit_Pa = 1.0;  // answers are linear in the load

RequiredValue no_reading(const std::string& why) {
  return {.how = why};
}

// One number of an answer.
struct Reading {
  double value = 0.0, error = 0.0;
};

std::optional<Reading> reading_in(const SceneAnswer& answer, const std::string& name) {
  const SceneResult* found = result_in(answer, name);
  if (found == nullptr) return std::nullopt;
  return Reading{found->value, found->error_estimate};
}

std::optional<Reading> at_pillar(const SceneAnswer& answer, const std::string& map,
                                 std::size_t pillar) {
  for (const SceneMap& one : answer.maps) {
    if (one.name != map) continue;
    const auto at = std::find(one.pillar.begin(), one.pillar.end(), pillar);
    if (at == one.pillar.end()) continue;
    const auto i = static_cast<std::size_t>(at - one.pillar.begin());
    return Reading{one.value[i], one.error.empty() ? 0.0 : one.error[i]};
  }
  return std::nullopt;
}

const char* disc_voltage(const SpaceScene& scene) {
  return is_metal(scene.electrode) ? "electrode_voltage" : "mean_voltage";
}

// A pressure on one pillar, or on all without a place; nothing else.
SpaceScene pressed(SpaceScene array, std::optional<std::size_t> pillar) {
  array.press.reset();
  array.touch.reset();
  if (array.electrode == SpaceElectrode::kQuadrants) array.electrode = SpaceElectrode::kSampled;
  array.pressure_Pa = kUnit_Pa;
  array.shear_x_Pa = array.shear_y_Pa = 0.0;
  array.loaded.clear();
  if (pillar) array.loaded = {{array.pillars[*pillar].row, array.pillars[*pillar].column}};
  array.effects.clear();
  array.wanted = {disc_voltage(array)};
  return array;
}

ArrayScene pressed(ArrayScene row, std::optional<int> pillar) {
  row.press.reset();
  row.drive = RowStatic{};
  row.load = ArrayLoad::kPressure;
  row.load_Pa = kUnit_Pa;
  row.loaded.clear();
  if (pillar) row.loaded = {*pillar};
  row.effects.clear();
  row.wanted.clear();
  return row;
}

int middle_of(const ArrayScene& row) {
  return (row.geometry.count + 1) / 2;
}

constexpr const char* kOne = "one pillar has no neighbours";
constexpr const char* kLayer = "a layer has no pillars";
constexpr const char* kSilent = "the film has no electrode or is not piezoelectric";

RequiredValue crosstalk_of(const ArrayScene& given, const SceneSolver& solve) {
  if (given.geometry.count < 2) return no_reading(kOne);
  if (!is_electric(given)) return no_reading(kSilent);
  ArrayScene row = pressed(given, middle_of(given));
  row.wanted = {"crosstalk_percent"};
  RequiredValue out{.how = "mean over electrodes, one pillar loaded"};
  for (const SceneResult& one : solve(row).results) {
    if (!one.name.starts_with("crosstalk_percent_")) continue;
    if (out.is_answered && std::abs(one.value) <= 100.0 * out.value) continue;
    out.is_answered = true;
    out.value = 0.01 * std::abs(one.value);
    out.error_estimate = 0.01 * one.error_estimate;
  }
  return out.is_answered ? out : no_reading("the row gives no cross-talk");
}

RequiredValue crosstalk_of(const SpaceScene& given, const SceneSolver& solve) {
  const auto middle = middle_pillar(given);
  if (given.pillars.size() < 2 || !middle) return no_reading(kOne);
  SpaceScene array = pressed(given, middle);
  array.wanted = {"crosstalk_percent"};
  RequiredValue out{.how = "mean over electrodes, one pillar loaded"};
  for (const SceneMap& map : solve(array).maps) {
    if (map.name != "crosstalk_percent") continue;
    for (std::size_t i = 0; i < map.value.size(); ++i) {
      if (out.is_answered && std::abs(map.value[i]) <= 100.0 * out.value) continue;
      out.is_answered = true;
      out.value = 0.01 * std::abs(map.value[i]);
      out.error_estimate = 0.01 * (map.error.empty() ? 0.0 : map.error[i]);
    }
  }
  return out.is_answered ? out : no_reading("the array gives no cross-talk");
}

RequiredValue crosstalk_of(const PillarScene&, const SceneSolver&) {
  return no_reading(kOne);
}
RequiredValue crosstalk_of(const LayerScene&, const SceneSolver&) {
  return no_reading(kLayer);
}

RequiredValue all_of(const ArrayScene& given, const SceneSolver& solve) {
  if (given.geometry.count < 2 && given.geometry.ends != FilmEnds::kMirror) return no_reading(kOne);
  if (!is_electric(given)) return no_reading(kSilent);
  ArrayScene row = pressed(given, std::nullopt);
  const std::string name = "neighbours_percent_" + std::to_string(middle_of(row));
  row.wanted = {"neighbours_percent"};
  const auto found = reading_in(solve(row), name);
  if (!found) return no_reading("the row gives no " + name);
  return {true, 0.01 * std::abs(found->value), 0.01 * found->error,
          "all pillars loaded, at the middle"};
}

RequiredValue all_of(const SpaceScene& given, const SceneSolver& solve) {
  const auto middle = middle_pillar(given);
  if (given.pillars.size() < 2 || !middle) return no_reading(kOne);
  const SpaceScene all = pressed(given, std::nullopt), one = pressed(given, middle);
  const auto of_all = at_pillar(solve(all), disc_voltage(all), *middle);
  const auto of_one = at_pillar(solve(one), disc_voltage(one), *middle);
  if (!of_all || !of_one || of_one->value == 0.0) return no_reading(kSilent);
  const double ratio = of_all->value / of_one->value;
  return {true, std::abs(ratio - 1.0),
          (of_all->error + std::abs(ratio) * of_one->error) / std::abs(of_one->value),
          "all pillars loaded, at the middle"};
}

RequiredValue all_of(const PillarScene&, const SceneSolver&) {
  return no_reading(kOne);
}
RequiredValue all_of(const LayerScene&, const SceneSolver&) {
  return no_reading(kLayer);
}

// Volts per pascal on the tops of all pillars.
std::optional<Reading> volts_of(const PillarScene& given, const SceneSolver& solve) {
  if (!given.electrodes || given.electrodes->quadrants) return std::nullopt;
  PillarScene one = given;
  one.drive = StaticDrive{.pressure_Pa = kUnit_Pa};
  one.readout.reset();
  one.effects.clear();
  const char* const name =
      given.electrodes->electrode_radius_m > 0.0 ? "electrode_voltage" : "potential_mean";
  one.wanted = {name};
  return reading_in(solve(one), name);
}

std::optional<Reading> volts_of(const ArrayScene& given, const SceneSolver& solve) {
  if (!is_electric(given)) return std::nullopt;
  ArrayScene row = pressed(given, std::nullopt);
  const std::string stem = row.electrodes.is_equipotential ? "electrode_voltage" : "mean_voltage";
  row.wanted = {stem};
  return reading_in(solve(row), stem + "_" + std::to_string(middle_of(row)));
}

std::optional<Reading> volts_of(const SpaceScene& given, const SceneSolver& solve) {
  const SpaceScene array = pressed(given, std::nullopt);
  const auto middle = middle_pillar(array);
  if (!middle) return std::nullopt;
  return at_pillar(solve(array), disc_voltage(array), *middle);
}

std::optional<Reading> volts_of(const LayerScene&, const SceneSolver&) {
  return std::nullopt;
}

// The array in the plane with the results of [heat] or [noise] that are named.
SceneAnswer sensing_answer(const SpaceScene& given, const std::vector<std::string>& wanted,
                           const SceneSolver& solve) {
  SpaceScene array = pressed(given, middle_pillar(given));
  array.wanted.insert(array.wanted.end(), wanted.begin(), wanted.end());
  return solve(array);
}

constexpr const char* kNoNoise =
    "needs an array in the plane (model = \"space\") with equipotential electrodes, [noise] and "
    "[readout]";

RequiredValue noise_result(const Scene& scene, const char* name, const SceneSolver& solve) {
  const auto* array = std::get_if<SpaceScene>(&scene);
  if (array == nullptr || !array->noise) return no_reading(kNoNoise);
  const auto found = reading_in(sensing_answer(*array, {name}, solve), name);
  if (!found) return no_reading(kNoNoise);
  return {true, found->value, found->error, "noise of the electrode and its amplifier"};
}

RequiredValue cut_off(double time_constant_s, double error_s) {
  const double frequency_Hz = 1.0 / (2.0 * std::numbers::pi * time_constant_s);
  return {true, frequency_Hz, frequency_Hz * error_s / time_constant_s,
          "charge leaks through film and amplifier"};
}

}  // namespace

RequiredValue required_crosstalk(const Scene& scene, const Requirements&,
                                 const SceneSolver& solve) {
  return std::visit([&](const auto& body) { return crosstalk_of(body, solve); }, scene);
}

RequiredValue required_crosstalk_all(const Scene& scene, const Requirements&,
                                     const SceneSolver& solve) {
  return std::visit([&](const auto& body) { return all_of(body, solve); }, scene);
}

RequiredValue required_voltage_per_pressure(const Scene& scene, const Requirements&,
                                            const SceneSolver& solve) {
  if (std::holds_alternative<LayerScene>(scene)) {
    return no_reading("an even pressure on a layer without end is not computed");
  }
  const auto share = pressure_share(scene);
  if (!share) return no_reading("needs the area of one pillar: a full square or hexagonal lattice");
  const auto volts = std::visit([&](const auto& body) { return volts_of(body, solve); }, scene);
  if (!volts) return no_reading(kSilent);
  return {true, *share * std::abs(volts->value) / kUnit_Pa, *share * volts->error / kUnit_Pa,
          "all pillars loaded, open circuit"};
}

RequiredValue required_pressure_resolution(const Scene& scene, const Requirements&,
                                           const SceneSolver& solve) {
  return noise_result(scene, "resolution_pressure", solve);
}

RequiredValue required_force_resolution(const Scene& scene, const Requirements&,
                                        const SceneSolver& solve) {
  return noise_result(scene, "resolution_force", solve);
}

RequiredValue required_pressure_per_kelvin(const Scene& scene, const Requirements&,
                                           const SceneSolver& solve) {
  const auto* array = std::get_if<SpaceScene>(&scene);
  if (array == nullptr || !array->heat) {
    return no_reading("needs an array in the plane (model = \"space\") with [heat]");
  }
  const bool has_electrodes = is_metal(array->electrode);
  const std::string name = has_electrodes ? "heat_electrode_pressure" : "heat_mean_pressure";
  const auto found = reading_in(sensing_answer(*array, {name}, solve), name);
  if (!found) return no_reading("the scene gives no " + name);
  const double T_K = std::abs(array->heat->temperature_K);
  return {true, std::abs(found->value) / T_K, found->error / T_K,
          "tops warmer than the base, at rest"};
}

RequiredValue required_lowest_frequency(const Scene& scene, const Requirements&,
                                        const SceneSolver& solve) {
  if (const auto* given = std::get_if<PillarScene>(&scene)) {
    if (!given->readout || !given->electrodes)
      return no_reading("needs an electrode and [readout]");
    PillarScene one = *given;
    one.drive = StaticDrive{.pressure_Pa = kUnit_Pa};
    one.effects.clear();
    one.wanted = {"readout_time_constant"};
    const auto found = reading_in(solve(one), "readout_time_constant");
    if (!found) return {true, 0.0, 0.0, "nothing leaks: the readout states no resistance"};
    return cut_off(found->value, found->error);
  }
  const auto* array = std::get_if<SpaceScene>(&scene);
  if (array == nullptr || !array->noise || !array->noise_readout) {
    return no_reading(
        "needs an electrode and [readout] (one pillar), or an array in the plane with [noise]");
  }
  const auto found =
      reading_in(sensing_answer(*array, {"electrode_capacitance"}, solve), "electrode_capacitance");
  if (!found || !(found->value > 0.0)) return no_reading(kNoNoise);
  const ReadoutFilter filter = readout_filter(*array->noise_readout, found->value);
  if (std::isinf(filter.time_constant_s)) return {true, 0.0, 0.0, "nothing leaks"};
  const double more_s =
      readout_filter(*array->noise_readout, found->value + found->error).time_constant_s;
  return cut_off(filter.time_constant_s, std::abs(more_s - filter.time_constant_s));
}

}  // namespace viscard
