#include "io/scenes/pillar_positions.h"
#include "io/scenes/scene_fields.h"
#include "io/scenes/space_sections.h"
#include "models/maths/text_of_number.h"
#include "models/scene/plan.h"

#include <unistd.h>

#include <cmath>

namespace viscard {
namespace {

constexpr std::int64_t kMostRows = 100000;
constexpr double kBytesOfPillar =
    1500.0;  // of an answer: maps, errors and sums; 1.3 GB for 1e6 pillars

// The number of pillars is limited by the memory of this machine only.
void check_memory(double pillars) {
  const double needs_B = kBytesOfPillar * pillars;
  const double has_B =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (!(has_B > 0.0) || needs_B <= has_B) return;
  throw SceneMistake("geometry", "has " + text_of(pillars, 10) + " pillars, which take about " +
                                     text_of(1e-9 * needs_B, 2) +
                                     " GB of memory; this machine has " + text_of(1e-9 * has_B, 2) +
                                     " GB. Take fewer pillars");
}

// Which places of the lattice or of the list have a pillar.
struct PlaceKeys {
  int rows = 0, columns = 0;  // 0: not given
  Pairs dead;
};

PlaceKeys place_keys_of(const SceneSources& sources, const SpaceScene& scene) {
  PlaceKeys keys;
  if (scene.pillars.empty()) return keys;
  if (sources.positions.empty()) keys = {scene.rows, scene.columns, {}};
  for (int row = 1; row <= scene.rows; ++row) {
    for (int column = 1; column <= scene.columns; ++column) {
      if (!index_of(scene, {row, column})) keys.dead.emplace_back(row, column);
    }
  }
  return keys;
}

void place_lattice(const PlaceKeys& keys, const SceneSources& sources, SpaceScene& scene) {
  if (keys.rows == 0 || keys.columns == 0) {
    throw SceneMistake("geometry",
                       "needs rows and columns, or positions = \"file.csv\" with columns x and y");
  }
  if (!(sources.spacing_m > 0.0)) {
    throw SceneMistake("geometry", "needs the spacing of the pillars from edge to edge");
  }
  check_memory(static_cast<double>(keys.rows) * static_cast<double>(keys.columns));
  scene.rows = keys.rows;
  scene.columns = keys.columns;
  scene.pillars = lattice_places(sources.lattice, scene.rows, scene.columns,
                                 scene.diameter_m + sources.spacing_m);
}

void place_list(const PlaceKeys& keys, const SceneFile& file, SpaceScene& scene) {
  if (keys.rows != 0 || keys.columns != 0 || file.sources.spacing_m != 0.0) {
    throw SceneMistake("geometry.positions",
                       "gives the place of each pillar; leave out rows, columns and spacing");
  }
  const auto path =
      named_file("geometry.positions", file, file.sources.positions, FileKind::kTable);
  for (const auto& [x_m, y_m] : read_positions(path)) {
    scene.pillars.push_back({static_cast<int>(scene.pillars.size()) + 1, 1, x_m, y_m, 0});
  }
  scene.rows = static_cast<int>(scene.pillars.size());
  scene.columns = 1;
}

std::size_t standing(const SpaceScene& scene, const std::string& key, RowColumn place) {
  if (const auto index = index_of(scene, place)) return *index;
  throw SceneMistake(key, "there is no pillar " + name_of(place) + " among " +
                              std::to_string(scene.rows) + " rows and " +
                              std::to_string(scene.columns) + " columns");
}

void place_pillars(const PlaceKeys& keys, const SceneFile& file, SpaceScene& scene) {
  file.sources.positions.empty() ? place_lattice(keys, file.sources, scene)
                                 : place_list(keys, file, scene);
  check_memory(static_cast<double>(scene.pillars.size()));
  std::vector<bool> is_dead(scene.pillars.size(), false);
  for (const RowColumn& place : places_of("geometry.dead", keys.dead)) {
    is_dead[standing(scene, "geometry.dead", place)] = true;
  }
  std::size_t index = 0;
  std::erase_if(scene.pillars, [&](const SpacePillar&) { return is_dead[index++]; });
  if (scene.pillars.empty()) throw SceneMistake("geometry.dead", "leaves no pillar");
}

// What stands in [[geometry.classes]] beside the material; 0: as the usual pillars.
struct ClassKeys {
  Pairs pillars;
  double diameter_m = 0.0, length_m = 0.0;
};
using Classes = std::vector<ClassKeys>;

Classes classes_of_file(const SpaceScene& scene) {
  Classes classes;
  for (const SpaceClass& one : scene.others) classes.push_back({{}, one.diameter_m, one.length_m});
  for (const SpacePillar& one : scene.pillars) {
    if (one.of_class == 0) continue;
    classes[static_cast<std::size_t>(one.of_class) - 1].pillars.emplace_back(one.row, one.column);
  }
  return classes;
}

void fill_classes(const Classes& classes, const SceneFile& file, SpaceScene& scene) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const ClassKeys& one = classes[i];
    const std::string key = "geometry.classes." + std::to_string(i + 1);
    if (one.pillars.empty()) {
      throw SceneMistake(key,
                         "names no pillars; give their rows and columns, such as pillars = "
                         "[[1, 1]]");
    }
    const std::string& name = file.sources.of_classes[i];
    Material own = name.empty() ? scene.pillar : pillar_material(file, name);
    if (!name.empty()) bring_to_temperature(file, own);
    scene.others.push_back({one.diameter_m > 0.0 ? one.diameter_m : scene.diameter_m,
                            one.length_m > 0.0 ? one.length_m : scene.length_m, std::move(own)});
    for (const RowColumn& place : places_of(key, one.pillars)) {
      int& of_class = scene.pillars[standing(scene, key, place)].of_class;
      if (of_class != 0) {
        throw SceneMistake(key, "pillar " + name_of(place) + " is in two classes");
      }
      of_class = static_cast<int>(i) + 1;
    }
  }
}

// The film, and what lies under it.
void show_film(FieldVisitor& v, SceneFile& file, SpaceScene& scene) {
  Backing backing = scene.backing.value_or(Backing{0.0, NAN});  // not given
  std::string bottom;
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(length_key("thickness", true), scene.film_thickness_m);
    f.quantity({.key = "edge", .unit = "m", .range = Range::kNotNegative}, scene.film_edge_m);
    show_film_material(f, file);
    f.word({"bottom", "fixed"}, {"fixed"}, bottom);
    f.section_or_word("backing", "rigid", [&](FieldVisitor& b) {
      b.quantity({.key = "E", .unit = quantities::kModulus, .range = Range::kPositive},
                 backing.young_modulus_Pa);
      b.quantity({.key = "nu", .unit = quantities::kPoissonRatio, .range = Range::kNotNegative},
                 backing.poisson_ratio);
    });
  });
  const bool has_E = backing.young_modulus_Pa > 0.0, has_bottom = !bottom.empty();
  if (has_E) scene.backing = backing;
  v.after_all_keys([has_E, has_bottom, has_nu = !std::isnan(backing.poisson_ratio)] {
    if (has_E != has_nu) {
      throw SceneMistake(
          "geometry.film.backing",
          "needs E and nu of the half-space under the film, such as { E = \"4 GPa\", "
          "nu = 0.38 }, or \"rigid\"");
    }
    if (!has_E || !has_bottom) return;
    throw SceneMistake("geometry.film.bottom", "cannot stand beside film.backing; leave one out");
  });
}

void show_geometry(FieldVisitor& v, SceneFile& file, SpaceScene& scene, PlaceKeys& places,
                   Classes& classes) {
  SceneSources& sources = file.sources;
  v.only("kind", SpaceScene::kKind);
  v.only("model", SpaceScene::kModel);
  v.integer("rows", 1, kMostRows, places.rows);
  v.integer("columns", 1, kMostRows, places.columns);
  v.choice({"lattice", "square"},
           {{"square", SpaceLattice::kSquare}, {"hexagonal", SpaceLattice::kHexagonal}},
           sources.lattice);
  v.text({"positions", "pillars.csv"}, sources.positions);
  v.quantity(length_key("spacing"), sources.spacing_m);
  v.quantity(length_key("diameter", true), scene.diameter_m);
  v.quantity(length_key("length", true), scene.length_m);
  v.quantity_pairs("dead", "1", "1", places.dead);
  const auto resize = [&](std::size_t n) {
    classes.resize(n);
    sources.of_classes.resize(n);
  };
  v.list("classes", classes.size(), resize, [&](FieldVisitor& c, std::size_t i) {
    c.quantity_pairs("pillars", "1", "1", classes[i].pillars);
    c.quantity(length_key("diameter"), classes[i].diameter_m);
    c.quantity(length_key("length"), classes[i].length_m);
    c.text({"material", "soft"}, sources.of_classes[i]);
  });
  show_film(v, file, scene);
  v.section("electrode", [&](FieldVisitor& e) {
    show_electrode(e, scene.grounded, scene.electrode, scene.electrode_radius_m,
                   &scene.electrode_gap_m);
  });
  show_poling(v, file);
}

void show_load(FieldVisitor& v, SpaceScene& scene) {
  const auto loaded = std::make_shared<Pairs>(scene.loaded.begin(), scene.loaded.end());
  v.section("load", [&](FieldVisitor& l) {
    l.quantity({.key = "pressure", .unit = "Pa"}, scene.pressure_Pa);
    l.quantity({.key = "shear_x", .unit = "Pa"}, scene.shear_x_Pa);
    l.quantity({.key = "shear_y", .unit = "Pa"}, scene.shear_y_Pa);
    l.only("on", "top");
    l.quantity_pairs("pillars", "1", "1", *loaded);
  });
  v.after_all_keys(
      [&scene, loaded] { scene.loaded = places_of("analysis.load.pillars", *loaded); });
}

// The shape as it stands in the file: in time its depth and force stand in the history.
std::optional<ShapePress> press_in_file(const SpaceScene& scene) {
  std::optional<ShapePress> press = scene.press;
  if (press && scene.touch) press->depth_m = press->force_N = 0.0;
  if (press && scene.touch && scene.touch->is_path()) press->shape.x_m = press->shape.y_m = 0.0;
  return press;
}

}  // namespace

void show_fields(FieldVisitor& v, SceneFile& file, SpaceScene& scene) {
  const auto places = std::make_shared<PlaceKeys>();
  if (!v.reads()) *places = place_keys_of(file.sources, scene);
  const auto classes = std::make_shared<Classes>(classes_of_file(scene));
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, file, scene, *places, *classes); });
  show_materials(v, "pillar", file, [&](FieldVisitor& m) {
    m.quantity({.key = "surface_energy", .unit = "J/m2", .range = Range::kPositive},
               scene.surface_energy_J_m2);
  });
  v.after_all_keys([&file, &scene, places, classes] {
    place_pillars(*places, file, scene);
    fill_classes(*classes, file, scene);
    scene.film = film_of(file);
  });
  std::shared_ptr<TouchKeys> touch;
  v.section("analysis", [&](FieldVisitor& a) {
    touch = show_touch(a, scene);
    show_load(a, scene);
  });
  const auto touchable = [&scene] {
    const FilmExtent film = film_extent(scene);
    return RoughExtent{film.left_m, film.right_m, film.low_m, film.high_m};
  };
  const std::optional<ShapePress> press = press_in_file(scene);
  show_shape(
      v, file, press ? &*press : nullptr, touchable,
      [&scene](const ShapePress& one) { scene.press = one; }, touch->path);
  show_heat(v, scene);
  show_quadrants(v, file, scene);
  show_noise(v, scene);
  show_reading(v, scene, touch);
  show_common(v, "mean_voltage", file);
  v.after_all_keys([&scene] {
    plan_effects(scene);
    check_space_wanted(scene);
  });
}

}  // namespace viscard
