#include "io/scenes/pillar_positions.h"
#include "io/scenes/quadrants_section.h"
#include "io/scenes/scene_words.h"
#include "io/scenes/sensing_section.h"
#include "io/scenes/shape_section.h"
#include "io/scenes/touch_section.h"
#include "models/array/space/space_scene.h"
#include "models/maths/text_of_number.h"
#include "models/scene/effects.h"
#include "models/scene/plan.h"

#include <unistd.h>

#include <cmath>
#include <map>

namespace viscard {
namespace {

using Pairs = std::vector<std::pair<double, double>>;

struct RawClass {
  Pairs pillars;
  double diameter_m = 0.0, length_m = 0.0;  // 0: as the usual pillars
  std::string material;                     // name under [materials]; empty: the usual one
};

// The values of the file before they are checked.
struct RawSpace {
  double tolerance = 1e-3;
  std::string kind = "array", model, lattice = "square", positions;
  std::int64_t rows = 0, columns = 0;  // 0: not given
  double spacing_m = 0.0, diameter_m = 0.0, length_m = 0.0;
  Pairs dead;
  std::vector<RawClass> classes;
  double film_thickness_m = 0.0, film_edge_m = 100e-6;
  std::string film_material, film_bottom, poling = "+z";  // bottom: as if "fixed"
  double backing_E_Pa = 0.0, backing_nu = -1.0;           // E = 0: rigid
  std::string electrode_face = "bottom", electrode_kind = "sampled";
  double electrode_radius_m = 0.0;
  bool quadrants = false;
  RawMaterial pillar, film;
  std::map<std::string, RawMaterial> materials;  // of classes, by name
  double surface_energy_J_m2 = 0.02;
  std::string analysis = "static", load_on = "top";
  double pressure_Pa = 0.0, shear_x_Pa = 0.0, shear_y_Pa = 0.0;
  Pairs loaded;
  RawShape shape;
  RawDrive drive;  // history and readout
  RawSensing sensing;
  RawQuadrants of_quarters;
  std::map<std::string, std::string> effects;
  std::vector<std::string> quantities;
  std::vector<PrintedValue> printed;
};

constexpr std::int64_t kMostRows = 100000;
constexpr double kBytesOfPillar =
    1500.0;  // of an answer: maps, errors and sums; 1.3 GB for 1e6 pillars

QuantityField size_of(const char* key, bool is_required = false) {
  return {.key = key, .unit = "m", .range = Range::kPositive, .is_required = is_required};
}

void show_class(FieldVisitor& c, RawClass& one) {
  c.quantity_pairs("pillars", "1", "1", one.pillars);
  c.quantity(size_of("diameter"), one.diameter_m);
  c.quantity(size_of("length"), one.length_m);
  c.text({"material", "soft"}, one.material);
}

void show_geometry(FieldVisitor& v, RawSpace& s) {
  v.text({"kind", "array"}, s.kind);
  v.text({"model", SpaceScene::kModel}, s.model);
  v.integer("rows", 1, kMostRows, s.rows);
  v.integer("columns", 1, kMostRows, s.columns);
  v.text({"lattice", "square"}, s.lattice);
  v.text({"positions", "pillars.csv"}, s.positions);
  v.quantity(size_of("spacing"), s.spacing_m);
  v.quantity(size_of("diameter", true), s.diameter_m);
  v.quantity(size_of("length", true), s.length_m);
  v.quantity_pairs("dead", "1", "1", s.dead);
  v.list(
      "classes", s.classes.size(), [&](std::size_t n) { s.classes.resize(n); },
      [&](FieldVisitor& c, std::size_t i) { show_class(c, s.classes[i]); });
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(size_of("thickness", true), s.film_thickness_m);
    f.quantity({.key = "edge", .unit = "m", .range = Range::kNotNegative}, s.film_edge_m);
    f.text({"material", "pvdf", true}, s.film_material);
    f.text({"bottom", "fixed"}, s.film_bottom);
    f.section_or_word("backing", "rigid", [&](FieldVisitor& b) {
      b.quantity({.key = "E", .unit = quantities::kModulus, .range = Range::kPositive},
                 s.backing_E_Pa);
      b.quantity({.key = "nu", .unit = quantities::kPoissonRatio, .range = Range::kNotNegative},
                 s.backing_nu);
    });
  });
  v.section("electrode", [&](FieldVisitor& e) {
    e.text({"face", "bottom"}, s.electrode_face);
    e.text({"kind", "sampled"}, s.electrode_kind);
    e.quantity(size_of("radius"), s.electrode_radius_m);
    e.boolean("quadrants", s.quadrants);
  });
  v.text({"poling", "+z"}, s.poling);
}

void show_materials(FieldVisitor& m, RawSpace& s) {
  m.section("pillar", [&](FieldVisitor& one) { show_material(one, s.pillar); });
  m.section(s.film_material.c_str(), [&](FieldVisitor& one) { show_material(one, s.film); });
  for (const RawClass& one : s.classes) {
    if (one.material.empty() || one.material == "pillar") continue;
    m.section(one.material.c_str(),
              [&](FieldVisitor& f) { show_material(f, s.materials[one.material]); });
  }
  m.quantity({.key = "surface_energy", .unit = "J/m2", .range = Range::kPositive},
             s.surface_energy_J_m2);
}

void show_space(FieldVisitor& v, RawSpace& s) {
  v.quantity({.key = "tolerance", .range = Range::kPositive}, s.tolerance);
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, s); });
  v.section("materials", [&](FieldVisitor& m) { show_materials(m, s); });
  v.section("analysis", [&](FieldVisitor& a) {
    a.text({"kind", "static"}, s.analysis);
    show_touch_history(a, s.analysis, s.drive);
    a.section("load", [&](FieldVisitor& l) {
      l.quantity({.key = "pressure", .unit = "Pa"}, s.pressure_Pa);
      l.quantity({.key = "shear_x", .unit = "Pa"}, s.shear_x_Pa);
      l.quantity({.key = "shear_y", .unit = "Pa"}, s.shear_y_Pa);
      l.text({"on", "top"}, s.load_on);
      l.quantity_pairs("pillars", "1", "1", s.loaded);
    });
  });
  v.section("shape", [&](FieldVisitor& one) { show_shape(one, s.shape, true); });
  v.section("readout", [&](FieldVisitor& r) { show_readout(r, s.drive); });
  v.section("heat", [&](FieldVisitor& h) { show_heat(h, s.sensing); });
  v.section("quadrants", [&](FieldVisitor& q) { show_quadrants(q, s.of_quarters); });
  v.section("noise", [&](FieldVisitor& n) { show_noise(n, s.sensing); });
  v.section("effects", [&](FieldVisitor& e) {
    for (const Effect& effect : effects()) e.text({effect.name, "auto"}, s.effects[effect.name]);
  });
  v.section("want", [&](FieldVisitor& w) {
    w.texts({"quantities", "mean_voltage"}, s.quantities);
  });
  show_printed(v, s.printed);
}

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

void place_lattice(const RawSpace& raw, SpaceScene& scene) {
  if (raw.rows == 0 || raw.columns == 0) {
    throw SceneMistake("geometry",
                       "needs rows and columns, or positions = \"file.csv\" with columns x and y");
  }
  if (!(raw.spacing_m > 0.0)) {
    throw SceneMistake("geometry", "needs the spacing of the pillars from edge to edge");
  }
  const auto lattice = choice<SpaceLattice>(
      "geometry.lattice", raw.lattice,
      {{"square", SpaceLattice::kSquare}, {"hexagonal", SpaceLattice::kHexagonal}});
  check_memory(static_cast<double>(raw.rows) * static_cast<double>(raw.columns));
  scene.rows = static_cast<int>(raw.rows);
  scene.columns = static_cast<int>(raw.columns);
  scene.pillars =
      lattice_places(lattice, scene.rows, scene.columns, raw.diameter_m + raw.spacing_m);
}

void place_list(const RawSpace& raw, const std::filesystem::path& folder, SpaceScene& scene) {
  if (raw.rows != 0 || raw.columns != 0 || raw.spacing_m != 0.0) {
    throw SceneMistake("geometry.positions",
                       "gives the place of each pillar; leave out rows, columns and spacing");
  }
  for (const auto& [x_m, y_m] :
       read_positions(named_file("geometry.positions", folder, raw.positions, FileKind::kTable))) {
    scene.pillars.push_back({static_cast<int>(scene.pillars.size()) + 1, 1, x_m, y_m, 0});
  }
  scene.rows = static_cast<int>(scene.pillars.size());
  scene.columns = 1;
}

std::size_t standing(const SpaceScene& scene, const std::string& key, RowColumn place) {
  if (const auto index = index_of(scene, place)) return *index;
  throw SceneMistake(key, "there is no pillar [" + std::to_string(place.first) + ", " +
                              std::to_string(place.second) + "] among " +
                              std::to_string(scene.rows) + " rows and " +
                              std::to_string(scene.columns) + " columns");
}

void place_pillars(const RawSpace& raw, const std::filesystem::path& folder, SpaceScene& scene) {
  raw.positions.empty() ? place_lattice(raw, scene) : place_list(raw, folder, scene);
  check_memory(static_cast<double>(scene.pillars.size()));
  std::vector<bool> is_dead(scene.pillars.size(), false);
  for (const RowColumn& place : places_of("geometry.dead", raw.dead)) {
    is_dead[standing(scene, "geometry.dead", place)] = true;
  }
  std::size_t index = 0;
  std::erase_if(scene.pillars, [&](const SpacePillar&) { return is_dead[index++]; });
  if (scene.pillars.empty()) throw SceneMistake("geometry.dead", "leaves no pillar");
}

void fill_classes(const RawSpace& raw, const std::filesystem::path& folder, SpaceScene& scene) {
  for (std::size_t i = 0; i < raw.classes.size(); ++i) {
    const RawClass& one = raw.classes[i];
    const std::string key = "geometry.classes." + std::to_string(i + 1);
    if (one.pillars.empty()) {
      throw SceneMistake(key,
                         "names no pillars; give their rows and columns, such as pillars = "
                         "[[1, 1]]");
    }
    const auto named = raw.materials.find(one.material);
    if (named != raw.materials.end() && named->second.file.empty() && !(named->second.E_Pa > 0.0)) {
      throw SceneMistake("materials." + one.material, "needs E (and nu, rho) or a file");
    }
    scene.others.push_back(
        {one.diameter_m > 0.0 ? one.diameter_m : scene.diameter_m,
         one.length_m > 0.0 ? one.length_m : scene.length_m,
         named == raw.materials.end()
             ? scene.pillar
             : pillar_material(named->second, folder, "materials." + named->first)});
    for (const RowColumn& place : places_of(key, one.pillars)) {
      int& of_class = scene.pillars[standing(scene, key, place)].of_class;
      if (of_class != 0) {
        throw SceneMistake(key, "pillar [" + std::to_string(place.first) + ", " +
                                    std::to_string(place.second) + "] is in two classes");
      }
      of_class = static_cast<int>(i) + 1;
    }
  }
}

void fill_electrode(const RawSpace& raw, SpaceScene& scene) {
  scene.grounded = choice<FilmFace>("geometry.electrode.face", raw.electrode_face,
                                    {{"bottom", FilmFace::kTop}, {"top", FilmFace::kBottom}});
  scene.electrode = electrode_from(raw.electrode_kind, raw.quadrants);
  scene.electrode_radius_m = raw.electrode_radius_m;
}

void fill_load(const RawSpace& raw, SpaceScene& scene) {
  choice<bool>("analysis.load.on", raw.load_on, {{"top", true}});
  scene.pressure_Pa = raw.pressure_Pa;
  scene.shear_x_Pa = raw.shear_x_Pa;
  scene.shear_y_Pa = raw.shear_y_Pa;
  scene.loaded = places_of("analysis.load.pillars", raw.loaded);
}

void fill_base(const RawSpace& raw, SpaceScene& scene) {
  const bool has_E = raw.backing_E_Pa > 0.0, has_bottom = !raw.film_bottom.empty();
  if (has_bottom) choice<bool>("geometry.film.bottom", raw.film_bottom, {{"fixed", true}});
  if (has_E != (raw.backing_nu >= 0.0)) {
    throw SceneMistake("geometry.film.backing",
                       "needs E and nu of the half-space under the film, such as { E = \"4 GPa\", "
                       "nu = 0.38 }, or \"rigid\"");
  }
  if (has_E) scene.backing = Backing{raw.backing_E_Pa, raw.backing_nu};
  if (!has_E || !has_bottom) return;
  throw SceneMistake("geometry.film.bottom", "cannot stand beside film.backing; leave one out");
}

SpaceScene scene_from(const RawSpace& raw, const std::filesystem::path& folder) {
  SpaceScene scene;
  scene.tolerance = raw.tolerance;
  scene.diameter_m = raw.diameter_m;
  scene.length_m = raw.length_m;
  scene.pillar = pillar_material(raw.pillar, folder);
  place_pillars(raw, folder, scene);
  fill_classes(raw, folder, scene);
  fill_base(raw, scene);
  scene.film = film_medium("materials." + raw.film_material, raw.film, folder).medium;
  if (choice<bool>("geometry.poling", raw.poling, {{"+z", false}, {"-z", true}})) {
    scene.film = with_reversed_poling(scene.film);
  }
  scene.film_thickness_m = raw.film_thickness_m;
  scene.film_edge_m = raw.film_edge_m;
  fill_electrode(raw, scene);
  scene.surface_energy_J_m2 = raw.surface_energy_J_m2;
  fill_load(raw, scene);
  const FilmExtent film = film_extent(scene);
  scene.press = press_from(raw.shape, folder, {film.left_m, film.right_m, film.low_m, film.high_m});
  fill_sensing(raw.sensing, raw.drive, scene);
  fill_quadrants(raw.of_quarters, folder, scene);
  fill_touch(raw.analysis, raw.drive, raw.shape, scene);
  scene.effects = choices_of(raw.effects);
  scene.wanted = raw.quantities;
  return scene;
}

}  // namespace

void read_space(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file) {
  RawSpace raw;
  read([&](FieldVisitor& v) { show_space(v, raw); });
  file.printed = raw.printed;
  const SpaceScene scene = scene_from(raw, folder);
  file.scene = scene;
  plan_effects(scene);
  check_space_wanted(scene);
}

}  // namespace viscard
