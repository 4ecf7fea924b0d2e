#include "io/scenes/space_sections.h"

#include "io/scenes/pillar_positions.h"
#include "io/scenes/scene_fields.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/touch_steps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

void show_conductor(FieldVisitor& v, HeatConductor& one) {
  v.quantity({.key = "conductivity", .unit = "W/m/K", .range = Range::kPositive},
             one.conductivity_W_mK);
  v.quantity({.key = "capacity", .unit = "J/m3/K", .range = Range::kPositive}, one.capacity_J_m3K);
}

bool has_heat(const HeatScene& heat) {
  return heat.temperature_K != 0.0 || heat.pyroelectric_C_m2K != 0.0 ||
         heat.pillar.conductivity_W_mK > 0.0 || heat.film.conductivity_W_mK > 0.0;
}

// Rows of the file in the order of the pillars.
Eigen::MatrixXd measured_V(const std::filesystem::path& path, const SpaceScene& scene) {
  const auto count = static_cast<Eigen::Index>(scene.pillars.size());
  Eigen::MatrixXd voltages_V = Eigen::MatrixXd::Constant(count, 4, NAN);
  for (const QuadrantVoltages& one : read_quadrant_voltages(path)) {
    const std::string name =
        "[" + std::to_string(one.row) + ", " + std::to_string(one.column) + "]";
    const auto index = index_of(scene, {one.row, one.column});
    if (!index) {
      throw std::runtime_error(path.string() + ": there is no pillar " + name + " in the scene");
    }
    const auto at = static_cast<Eigen::Index>(*index);
    if (!std::isnan(voltages_V(at, 0))) {
      throw std::runtime_error(path.string() + ": gives the voltages of pillar " + name + " twice");
    }
    for (Eigen::Index q = 0; q < 4; ++q)
      voltages_V(at, q) = one.voltage_V.at(static_cast<std::size_t>(q));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!std::isnan(voltages_V(i, 0))) continue;
    const SpacePillar& one = scene.pillars[static_cast<std::size_t>(i)];
    throw std::runtime_error(path.string() + ": has no voltages of pillar [" +
                             std::to_string(one.row) + ", " + std::to_string(one.column) +
                             "]; give all pillars, or name those without in geometry.dead");
  }
  return voltages_V;
}

void refuse_at_rest(const TouchKeys& touch, const ReadoutKeys& readout, const SpaceScene& scene) {
  if (!touch.history.empty()) {
    throw SceneMistake(
        "analysis.history",
        "a load at rest has none; write kind = \"relaxation\" for the depth of a shape "
        "in time, or \"creep\" for its force");
  }
  if (readout.kind && !scene.noise) {
    throw SceneMistake("readout",
                       "charge leaks in time, and [noise] is that of an amplifier; add [noise], or "
                       "write kind = \"relaxation\" or \"creep\", with a "
                       "history and a shape");
  }
}

void check_kind(const std::string& kind, const SpaceScene& scene) {
  if (kind != "relaxation" && kind != "creep") {
    throw SceneMistake("analysis.kind", "cannot be '" + kind +
                                            "': arrays in the plane are answered for loads at "
                                            "rest, kind = \"static\", and under a shape in time, "
                                            "\"relaxation\" and \"creep\"; rows (model = "
                                            "\"plane-stress\") have other analyses too");
  }
  if (!scene.press) {
    throw SceneMistake("analysis.kind", "'" + kind +
                                            "' of an array in the plane needs a [shape] that "
                                            "presses on it, such as kind = \"sphere\"");
  }
  const bool is_force = scene.press->force_N > 0.0;
  if (!is_force && !(scene.press->depth_m > 0.0)) return;
  throw SceneMistake(is_force ? "shape.force" : "shape.depth",
                     "stands in analysis.history: the depth for \"relaxation\", the force for "
                     "\"creep\"");
}

SpaceTouch touch_along(const ShapePath& path) {
  SpaceTouch touch;
  touch.is_creep = !std::isnan(path.front().force_N);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const PathStop& stop = path[i];
    const bool has_depth = !std::isnan(stop.depth_m), has_force = !std::isnan(stop.force_N);
    if (has_depth == has_force || has_force != touch.is_creep) {
      throw SceneMistake("shape.path." + std::to_string(i + 1),
                         "needs a depth or a force, and the same one in all entries, such as { "
                         "time = \"1 s\", x = \"50 um\", y = \"0 um\", depth = \"2 um\" }");
    }
    touch.history.push_back({stop.time_s, touch.is_creep ? stop.force_N : stop.depth_m});
    touch.place_m.emplace_back(stop.x_m, stop.y_m);
  }
  return touch;
}

// What a path says itself.
void refuse_beside_path(const TouchKeys& touch, const SpaceScene& scene) {
  if (!scene.press) throw SceneMistake("shape", "has a path, but no kind, such as \"sphere\"");
  const ShapePress& press = *scene.press;
  const bool is_moved = press.shape.x_m != 0.0 || press.shape.y_m != 0.0;
  const char* key = !touch.history.empty()    ? "analysis.history"
                    : press.depth_m != 0.0    ? "shape.depth"
                    : press.force_N != 0.0    ? "shape.force"
                    : is_moved                ? "shape.at"
                    : !press.before_m.empty() ? "shape.before"
                                              : nullptr;
  if (key != nullptr) {
    throw SceneMistake(key,
                       "cannot stand beside shape.path, which has the times, places and "
                       "depths or forces");
  }
  const bool is_creep = !std::isnan(touch.path->front().force_N);
  if (touch.kind == "static" || touch.kind == (is_creep ? "creep" : "relaxation")) return;
  throw SceneMistake("analysis.kind", "cannot be '" + touch.kind +
                                          "' beside shape.path; leave it out, or write "
                                          "\"relaxation\" for depths and \"creep\" for forces");
}

std::optional<int> small_number(const std::string& text) {
  const bool is_number =
      !text.empty() && text.size() < 7 && text.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::optional<int>(std::stoi(text)) : std::nullopt;
}

// The place in "mean_voltage_3_4", whose map is `map`.
RowColumn place_in(const std::string& name, const std::string& map) {
  const std::string rest = name.substr(map.size() + 1);
  const std::size_t gap = rest.find('_');
  const auto row = small_number(rest.substr(0, gap));
  const auto column = gap == std::string::npos ? std::nullopt : small_number(rest.substr(gap + 1));
  if (row && column) return {*row, *column};
  throw SceneMistake(
      "want.quantities",
      "'" + name + "': a pillar is given by its row and column, such as " + map + "_1_1");
}

}  // namespace

void show_heat(FieldVisitor& v, SpaceScene& scene) {
  HeatScene heat = scene.heat.value_or(HeatScene{});
  bool has_dummy = heat.dummy.has_value();
  DummyElectrode dummy = heat.dummy.value_or(DummyElectrode{});
  v.section("heat", [&](FieldVisitor& h) {
    h.quantity({.key = "temperature", .unit = "K"}, heat.temperature_K);
    h.section("pillar", [&](FieldVisitor& one) { show_conductor(one, heat.pillar); });
    h.section("film", [&](FieldVisitor& one) { show_conductor(one, heat.film); });
    h.quantity({.key = "pyroelectric", .unit = "C/m2/K"}, heat.pyroelectric_C_m2K);
    h.boolean("dummy", has_dummy);
    h.quantity({.key = "dummy_ratio"}, dummy.ratio);
    h.quantity({.key = "dummy_mismatch"}, dummy.mismatch);
    h.quantity({.key = "end_time", .unit = "s", .range = Range::kPositive}, heat.end_time_s);
  });
  if (has_dummy) heat.dummy = dummy;
  if (has_heat(heat)) scene.heat = heat;
}

void show_noise(FieldVisitor& v, SpaceScene& scene) {
  NoiseBand noise = scene.noise.value_or(NoiseBand{.to_Hz = 0.0});  // 0: no noise
  v.section("noise", [&](FieldVisitor& n) {
    n.quantity({.key = "temperature", .unit = "K", .range = Range::kPositive}, noise.temperature_K);
    n.quantity({.key = "from", .unit = "Hz", .range = Range::kPositive}, noise.from_Hz);
    n.quantity({.key = "to", .unit = "Hz", .range = Range::kPositive}, noise.to_Hz);
    n.quantity({.key = "loss_tangent", .range = Range::kNotNegative}, noise.loss_tangent);
    n.quantity({.key = "amplifier", .unit = "V", .range = Range::kNotNegative},
               noise.amplifier_V_rtHz);
  });
  if (noise.to_Hz > 0.0) scene.noise = noise;
}

void show_quadrants(FieldVisitor& v, SceneFile& file, SpaceScene& scene) {
  QuadrantSensing& sensing = scene.quadrants;
  std::string& voltages = file.sources.voltages;
  NodeMeans nodes = sensing.nodes.value_or(NodeMeans{});
  bool has_nodes = sensing.nodes.has_value();
  v.section("quadrants", [&](FieldVisitor& q) {
    q.text({"voltages", "readings.csv"}, voltages);
    q.choice({"neighbours", "deconvolved"}, {{"deconvolved", true}, {"ignored", false}},
             sensing.by_neighbours);
    q.choice({"averages", "area"}, {{"area", false}, {"nodes", true}}, has_nodes);
    q.integer("circles", 1, 1000, nodes.circles);
    q.integer("on_circle", 4, 10000, nodes.on_circle);
    q.quantity({.key = "noise", .unit = "V", .range = Range::kPositive}, sensing.noise_V);
  });
  if (has_nodes) sensing.nodes = nodes;
  v.after_all_keys([&file, &scene, &voltages] {
    if (voltages.empty()) return;
    const auto path = named_file("quadrants.voltages", file, voltages, FileKind::kTable);
    scene.quadrants.measured_V = measured_V(path, scene);
  });
}

std::shared_ptr<TouchKeys> show_touch(FieldVisitor& v, const SpaceScene& scene) {
  const auto keys = std::make_shared<TouchKeys>();
  if (scene.touch) {
    const SpaceTouch& touch = *scene.touch;
    keys->kind = touch.is_creep ? "creep" : "relaxation";
    if (!touch.is_path()) keys->history = pairs_of(touch.history);
    for (std::size_t i = 0; i < touch.place_m.size(); ++i) {
      PathStop stop{.time_s = touch.history[i].time_s,
                    .x_m = touch.place_m[i].first,
                    .y_m = touch.place_m[i].second};
      (touch.is_creep ? stop.force_N : stop.depth_m) = touch.history[i].value;
      keys->path->push_back(stop);
    }
  }
  v.text({"kind", "static"}, keys->kind);
  v.quantity_pairs("history", "s", keys->kind == "creep" ? "N" : "m", keys->history);
  return keys;
}

void show_reading(FieldVisitor& v, SpaceScene& scene, const std::shared_ptr<TouchKeys>& touch) {
  const std::optional<Readout>& now = scene.touch ? scene.touch->readout : scene.noise_readout;
  std::shared_ptr<ReadoutKeys> keys;
  v.section("readout", [&](FieldVisitor& r) { keys = show_readout(r, now, &scene.film); });
  v.after_all_keys([&scene, touch, keys] {
    std::optional<Readout> readout;
    if (keys->kind) readout = readout_of(*keys, scene.film, scene.film_loss);
    if (scene.noise) scene.noise_readout = readout;
    if (!touch->path->empty()) {
      refuse_beside_path(*touch, scene);
      SpaceTouch along = touch_along(*touch->path);
      along.readout = readout;
      return press_in_time(scene, std::move(along));
    }
    if (touch->kind == "static") return refuse_at_rest(*touch, *keys, scene);
    check_kind(touch->kind, scene);
    SpaceTouch in_time{.is_creep = touch->kind == "creep"};
    in_time.history = history_of(touch->history);
    in_time.readout = readout;
    press_in_time(scene, std::move(in_time));
  });
}

void check_space_wanted(const SpaceScene& scene) {
  const std::vector<std::string> maps = result_names(scene);
  for (const std::string& name : scene.wanted) {
    const auto map = std::find_if(maps.begin(), maps.end(), [&](const std::string& one) {
      return name.starts_with(one + "_");
    });
    if (map == maps.end()) {
      check_wanted({name}, maps);
      continue;
    }
    if (name == *map + "_largest" || name == *map + "_smallest") {
      if (*map != "reading") continue;
      throw SceneMistake("want.quantities",
                         "'" + name + "': a reading is that of one pillar, such as reading_1_1");
    }
    const RowColumn place = place_in(name, *map);
    const std::optional<std::size_t> index = index_of(scene, place);
    if (!index) {
      throw SceneMistake("want.quantities", "'" + name + "': there is no pillar in row " +
                                                std::to_string(place.first) + " and column " +
                                                std::to_string(place.second) + " of " +
                                                std::to_string(scene.rows) + " rows and " +
                                                std::to_string(scene.columns) + " columns");
    }
    if (map->starts_with("crosstalk") && is_loaded(scene)[*index]) {
      throw SceneMistake("want.quantities",
                         "'" + name + "': cross-talk is that of a pillar without load");
    }
  }
}

}  // namespace viscard
