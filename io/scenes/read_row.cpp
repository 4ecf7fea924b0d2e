#include "io/scenes/scene_drive.h"
#include "io/scenes/scene_fields.h"
#include "models/answer/drive_parts.h"
#include "models/array/plane/array_analysis.h"
#include "models/array/plane/simulate_array.h"
#include "models/scene/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

void show_geometry(FieldVisitor& v, SceneFile& file, ArrayScene& scene) {
  ArrayGeometry& g = scene.geometry;
  // Files of before call it an array.
  v.choice({"kind", ArrayScene::kKind}, {{ArrayScene::kKind, false}, {SpaceScene::kKind, true}},
           file.row_is_called_array);
  v.choice({"model", "plane-stress"},
           {{"plane-stress", PlaneState::kStress}, {"plane-strain", PlaneState::kStrain}},
           scene.plane);
  v.integer("count", 1, 4096, g.count);
  v.quantity(length_key("spacing"), g.spacing_m);
  v.quantity(length_key("diameter", true), g.diameter_m);
  v.quantity(length_key("length", true), g.length_m);
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(length_key("thickness", true), g.film_thickness_m);
    f.choice({"ends", "free"}, {{"free", FilmEnds::kFree}, {"mirror", FilmEnds::kMirror}}, g.ends);
    f.quantity({.key = "edge", .unit = "m", .range = Range::kNotNegative}, g.film_edge_m);
    show_film_material(f, file);
    f.only("bottom", "fixed");
  });
  v.section("electrode", [&](FieldVisitor& e) {
    e.choice({"face", "bottom"}, grounded_by_electrode_face(), scene.electrodes.grounded);
    e.choice({"kind", "sampled"}, {{"equipotential", true}, {"sampled", false}},
             scene.electrodes.is_equipotential);
    e.quantity(length_key("radius"), scene.electrodes.half_width_m);
  });
  show_poling(v, file);
}

void show_sweep(FieldVisitor& v, ArraySweep& sweep) {
  const auto values = [](const char* key) {
    QuantityField field = length_key(key);
    field.is_exact = true;
    return field;
  };
  v.quantities(values("diameter"), sweep.diameter_m);
  v.quantities(values("spacing"), sweep.spacing_m);
  v.quantities(values("thickness"), sweep.thickness_m);
  v.quantity({.key = "length_over_diameter", .range = Range::kPositive, .is_exact = true},
             sweep.length_over_diameter);
  v.quantity({.key = "limit_percent", .range = Range::kPositive, .is_exact = true},
             sweep.limit_percent);
}

constexpr double kAllPillars = -1.0;  // the file names no single ones

// What stands in analysis.load of a row.
struct RowLoadKeys {
  double pressure_Pa = 0.0, shear_Pa = 0.0;
  bool has_place = false, is_lateral = false;
  std::vector<double> pillars;
};

void fill_load(const RowLoadKeys& keys, ArrayScene& scene) {
  const bool is_in_history = has_part(
      scene.drive, [](const auto& d) requires requires { d.history; } {});
  const bool has_load = keys.pressure_Pa != 0.0 || keys.shear_Pa != 0.0 || is_in_history;
  if (has_load && !keys.has_place) {
    throw SceneMistake("analysis.load", "the load has no place; write on = \"top\"");
  }
  if (keys.pressure_Pa != 0.0 && keys.shear_Pa != 0.0) {
    throw SceneMistake("analysis.load", "has both a pressure and a shear; give one of them");
  }
  const bool is_shear = keys.shear_Pa != 0.0 || keys.is_lateral;
  if (keys.pressure_Pa != 0.0 && is_shear) {
    throw SceneMistake("analysis.load.direction", "a pressure is axial; give a shear instead");
  }
  if (is_in_history && (keys.pressure_Pa != 0.0 || keys.shear_Pa != 0.0)) {
    throw SceneMistake("analysis.load", std::string("the pressure or shear of a ") +
                                            analysis_of(scene).name +
                                            " analysis is its history or pulse; write "
                                            "only on and direction = \"axial\" or \"lateral\"");
  }
  scene.load = is_shear ? ArrayLoad::kShear : ArrayLoad::kPressure;
  scene.load_Pa = keys.shear_Pa != 0.0 ? keys.shear_Pa : keys.pressure_Pa;
  if (keys.pillars == std::vector<double>{kAllPillars}) return;
  if (keys.pillars.empty()) {
    throw SceneMistake("analysis.load.pillars",
                       "names no pillar; give their numbers, such as [4], or leave it out to load "
                       "all of them");
  }
  for (const double number : keys.pillars) {
    if (number != std::floor(number) || number > 4096.0) {
      throw SceneMistake("analysis.load.pillars", "are numbers of pillars, such as [4]");
    }
    scene.loaded.push_back(static_cast<int>(number));
  }
}

void show_load(FieldVisitor& v, ArrayScene& scene) {
  const auto keys = std::make_shared<RowLoadKeys>();
  keys->is_lateral = scene.load == ArrayLoad::kShear;
  (keys->is_lateral ? keys->shear_Pa : keys->pressure_Pa) = scene.load_Pa;
  keys->pillars.assign(scene.loaded.begin(), scene.loaded.end());
  if (v.reads()) keys->pillars = {kAllPillars};
  std::string on = v.reads() ? "" : "top";
  v.section("load", [&](FieldVisitor& l) {
    l.quantity({.key = "pressure", .unit = "Pa"}, keys->pressure_Pa);
    l.quantity({.key = "shear", .unit = "Pa"}, keys->shear_Pa);
    l.word({"on", "top"}, {"top"}, on);
    l.choice({"direction", "axial"}, {{"axial", false}, {"lateral", true}}, keys->is_lateral);
    l.quantities({.key = "pillars", .range = Range::kPositive}, keys->pillars);
  });
  keys->has_place = !on.empty();
  v.after_all_keys([&scene, keys] { fill_load(*keys, scene); });
}

// "centre_voltage_4" asks for pillar 4 alone.
void check_wanted(const ArrayScene& scene) {
  for (const std::string& name : scene.wanted) {
    const std::size_t end = name.find_last_not_of("0123456789");
    const bool is_numbered = end != std::string::npos && end + 1 < name.size() && name[end] == '_';
    viscard::check_wanted({is_numbered ? name.substr(0, end) : name}, result_names(scene));
    if (!is_numbered) continue;
    const std::string digits = name.substr(end + 1);
    if (digits.size() > 4 || std::stoi(digits) < 1 || std::stoi(digits) > scene.geometry.count) {
      throw SceneMistake("want.quantities", "'" + name + "': there is no pillar " + digits +
                                                "; they are numbered from 1 to " +
                                                std::to_string(scene.geometry.count));
    }
  }
}

// Sweeps have one number for each result and point. All points are planned before the first is
// answered, and a hundred thousand take a second for that.
void check_sweep(const ArraySweep& sweep, const ArrayScene& scene) {
  if (sweep.is_empty()) return;
  if (scene.press) {
    throw SceneMistake("sweep", "cannot stand beside a shape; sweeps compare rows under a load");
  }
  if (analysis_of(scene).relaxes) {
    throw SceneMistake("sweep", "sweeps are made of static and modal analyses");
  }
  double points = 1.0;
  for (const auto* list : {&sweep.diameter_m, &sweep.spacing_m, &sweep.thickness_m}) {
    points *= static_cast<double>(std::max<std::size_t>(list->size(), 1));
  }
  constexpr double kMostPoints = 1e5;
  if (points <= kMostPoints) return;
  throw SceneMistake("sweep", fmt::format("combines {:.6g} points; at most {:.6g} are answered in "
                                          "one sweep. Shorten the lists, or make several sweeps",
                                          points, kMostPoints));
}

}  // namespace

void show_fields(FieldVisitor& v, SceneFile& file, ArrayScene& scene) {
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, file, scene); });
  show_materials(v, "pillar", file, [&](FieldVisitor& m) {
    m.quantity({.key = "surface_energy", .unit = "J/m2", .range = Range::kPositive},
               scene.surface_energy_J_m2);
  });
  v.after_all_keys([&file, &scene] { scene.film = film_of(file); });
  v.section("analysis", [&](FieldVisitor& a) {
    show_analysis(a, scene);
    show_load(a, scene);
  });
  const auto touchable = [&scene] {
    const ArrayGeometry& g = scene.geometry;
    const double half_m = place_m(g, g.count - 1) + 0.5 * g.diameter_m + g.film_edge_m;
    return RoughExtent{-half_m, half_m, 0.0, 0.0};
  };
  show_shape(v, file, scene.press ? &*scene.press : nullptr, touchable,
             [&scene](const ShapePress& press) { scene.press = press; });
  v.section("sweep", [&](FieldVisitor& w) { show_sweep(w, file.sweep); });
  show_common(v, "centre_voltage", file);
  v.after_all_keys([&file, &scene] {
    check_sweep(file.sweep, scene);
    for (const SweepPoint& point : points_of(scene, file.sweep)) plan_effects(point.scene);
    check_wanted(scene);
  });
}

std::vector<SweepPoint> points_of(const ArrayScene& scene, const ArraySweep& sweep) {
  const ArrayGeometry& own = scene.geometry;
  const auto values = [](const std::vector<double>& list, double single) {
    return list.empty() ? std::vector<double>{single} : list;
  };
  std::vector<SweepPoint> points;
  for (const double diameter_m : values(sweep.diameter_m, own.diameter_m)) {
    for (const double thickness_m : values(sweep.thickness_m, own.film_thickness_m)) {
      for (const double spacing_m : values(sweep.spacing_m, own.spacing_m)) {
        SweepPoint point{scene, ""};
        ArrayGeometry& g = point.scene.geometry;
        g.diameter_m = diameter_m;
        g.film_thickness_m = thickness_m;
        g.spacing_m = spacing_m;
        if (sweep.length_over_diameter > 0.0) g.length_m = sweep.length_over_diameter * diameter_m;
        const auto name = [&](const char* what, const std::vector<double>& list, double value_m) {
          if (list.empty()) return;
          point.label +=
              fmt::format("{}{} {:.6g} um", point.label.empty() ? "" : ", ", what, value_m * 1e6);
        };
        name("diameter", sweep.diameter_m, diameter_m);
        name("thickness", sweep.thickness_m, thickness_m);
        name("spacing", sweep.spacing_m, spacing_m);
        points.push_back(std::move(point));
      }
    }
  }
  return points;
}

}  // namespace viscard
