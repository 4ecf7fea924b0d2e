#include "io/scenes/raw_drive.h"
#include "io/scenes/scene_words.h"
#include "io/scenes/shape_section.h"
#include "models/answer/drive_parts.h"
#include "models/array/plane/array_analysis.h"
#include "models/array/plane/simulate_array.h"
#include "models/scene/effects.h"
#include "models/scene/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace viscard {
namespace {

constexpr double kAllPillars = -1.0;  // the file names no single ones

// The values of the file before they are checked.
struct RawArray {
  double tolerance = 1e-3;
  std::string kind = "array", model = "plane-stress";
  ArrayGeometry geometry;
  std::int64_t count = 8;
  std::string film_material, film_bottom = "fixed", film_ends = "free", poling = "+z";
  std::string electrode_face = "bottom", electrode_kind = "sampled";
  ArrayElectrodes electrodes;
  RawMaterial pillar, film;
  std::string analysis = "static", load_on, direction = "axial";
  double pressure_Pa = 0.0, shear_Pa = 0.0;
  std::vector<double> pillars = {kAllPillars};
  RawDrive times{.modes = 3};
  RawShape shape;
  double surface_energy_J_m2 = 0.02;
  std::map<std::string, std::string> effects;
  std::vector<std::string> quantities;
  ArraySweep sweep;
  std::vector<PrintedValue> printed;
};

QuantityField length(const char* key, bool is_required = false) {
  return {.key = key, .unit = "m", .range = Range::kPositive, .is_required = is_required};
}

void show_geometry(FieldVisitor& v, RawArray& s) {
  ArrayGeometry& g = s.geometry;
  v.text({"kind", "array"}, s.kind);
  v.text({"model", "plane-stress"}, s.model);
  v.integer("count", 1, 4096, s.count);
  v.quantity(length("spacing"), g.spacing_m);
  v.quantity(length("diameter", true), g.diameter_m);
  v.quantity(length("length", true), g.length_m);
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(length("thickness", true), g.film_thickness_m);
    f.text({"ends", "free"}, s.film_ends);
    f.quantity({.key = "edge", .unit = "m", .range = Range::kNotNegative}, g.film_edge_m);
    f.text({"material", "pvdf", true}, s.film_material);
    f.text({"bottom", "fixed"}, s.film_bottom);
  });
  v.section("electrode", [&](FieldVisitor& e) {
    e.text({"face", "bottom"}, s.electrode_face);
    e.text({"kind", "sampled"}, s.electrode_kind);
    e.quantity(length("radius"), s.electrodes.half_width_m);
  });
  v.text({"poling", "+z"}, s.poling);
}

void show_array(FieldVisitor& v, RawArray& s) {
  v.quantity({.key = "tolerance", .range = Range::kPositive}, s.tolerance);
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, s); });
  v.section("materials", [&](FieldVisitor& m) {
    m.section("pillar", [&](FieldVisitor& one) { show_material(one, s.pillar); });
    m.section(s.film_material.c_str(), [&](FieldVisitor& one) { show_material(one, s.film); });
    m.quantity({.key = "surface_energy", .unit = "J/m2", .range = Range::kPositive},
               s.surface_energy_J_m2);
  });
  v.section("analysis", [&](FieldVisitor& a) {
    a.text({"kind", "static"}, s.analysis);
    a.integer("modes", 1, 12, s.times.modes);
    show_times(a, "Pa", s.times);
    a.section("load", [&](FieldVisitor& l) {
      l.quantity({.key = "pressure", .unit = "Pa"}, s.pressure_Pa);
      l.quantity({.key = "shear", .unit = "Pa"}, s.shear_Pa);
      l.text({"on", "top"}, s.load_on);
      l.text({"direction", "axial"}, s.direction);
      l.quantities({.key = "pillars", .range = Range::kPositive}, s.pillars);
    });
  });
  v.section("shape", [&](FieldVisitor& one) { show_shape(one, s.shape); });
  v.section("sweep", [&](FieldVisitor& w) {
    w.quantities(length("diameter"), s.sweep.diameter_m);
    w.quantities(length("spacing"), s.sweep.spacing_m);
    w.quantities(length("thickness"), s.sweep.thickness_m);
    w.quantity({.key = "length_over_diameter", .range = Range::kPositive},
               s.sweep.length_over_diameter);
    w.quantity({.key = "limit_percent", .range = Range::kPositive}, s.sweep.limit_percent);
  });
  v.section("effects", [&](FieldVisitor& e) {
    for (const Effect& effect : effects()) e.text({effect.name, "auto"}, s.effects[effect.name]);
  });
  v.section("want", [&](FieldVisitor& w) {
    w.texts({"quantities", "centre_voltage"}, s.quantities);
  });
  show_printed(v, s.printed);
}

Medium film_of(const RawArray& raw, const std::filesystem::path& folder) {
  const Medium film = film_medium("materials." + raw.film_material, raw.film, folder).medium;
  const bool is_reversed =
      choice<bool>("geometry.poling", raw.poling, {{"+z", false}, {"-z", true}});
  return is_reversed ? with_reversed_poling(film) : film;
}

void fill_load(const RawArray& raw, ArrayScene& scene) {
  const bool is_in_history = has_part(
      scene.drive, [](const auto& d) requires requires { d.history; } {});
  const bool has_load = raw.pressure_Pa != 0.0 || raw.shear_Pa != 0.0 || is_in_history;
  if (has_load && raw.load_on.empty()) {
    throw SceneMistake("analysis.load", "the load has no place; say on = \"top\"");
  }
  if (!raw.load_on.empty()) choice<bool>("analysis.load.on", raw.load_on, {{"top", true}});
  if (raw.pressure_Pa != 0.0 && raw.shear_Pa != 0.0) {
    throw SceneMistake("analysis.load", "has both a pressure and a shear; give one of them");
  }
  const bool is_shear =
      raw.shear_Pa != 0.0 ||
      choice<bool>("analysis.load.direction", raw.direction, {{"axial", false}, {"lateral", true}});
  if (raw.pressure_Pa != 0.0 && is_shear) {
    throw SceneMistake("analysis.load.direction", "a pressure is axial; give a shear instead");
  }
  if (is_in_history && (raw.pressure_Pa != 0.0 || raw.shear_Pa != 0.0)) {
    throw SceneMistake("analysis.load", std::string("the pressure or shear of a ") +
                                            analysis_of(scene).name +
                                            " analysis is its history or pulse; say "
                                            "only on and direction = \"axial\" or \"lateral\"");
  }
  scene.load = is_shear ? ArrayLoad::kShear : ArrayLoad::kPressure;
  scene.load_Pa = raw.shear_Pa != 0.0 ? raw.shear_Pa : raw.pressure_Pa;
  if (raw.pillars == std::vector<double>{kAllPillars}) return;
  if (raw.pillars.empty()) {
    throw SceneMistake("analysis.load.pillars",
                       "names no pillar; give their numbers, such as [4], or leave it out to load "
                       "all of them");
  }
  for (const double number : raw.pillars) {
    if (number != std::floor(number) || number > 4096.0) {
      throw SceneMistake("analysis.load.pillars", "are numbers of pillars, such as [4]");
    }
    scene.loaded.push_back(static_cast<int>(number));
  }
}

ArrayScene scene_from(const RawArray& raw, const std::filesystem::path& folder) {
  ArrayScene scene;
  scene.tolerance = raw.tolerance;
  scene.geometry = raw.geometry;
  scene.geometry.count = static_cast<int>(raw.count);
  scene.geometry.ends =
      choice<FilmEnds>("geometry.film.ends", raw.film_ends,
                       {{"free", FilmEnds::kFree}, {"mirror", FilmEnds::kMirror}});
  scene.plane = choice<PlaneState>(
      "geometry.model", raw.model,
      {{"plane-stress", PlaneState::kStress}, {"plane-strain", PlaneState::kStrain}});
  choice<bool>("geometry.film.bottom", raw.film_bottom, {{"fixed", true}});
  scene.electrodes = raw.electrodes;
  scene.electrodes.grounded =
      choice<FilmFace>("geometry.electrode.face", raw.electrode_face,
                       {{"bottom", FilmFace::kTop}, {"top", FilmFace::kBottom}});
  scene.electrodes.is_equipotential = choice<bool>("geometry.electrode.kind", raw.electrode_kind,
                                                   {{"equipotential", true}, {"sampled", false}});
  scene.pillar = pillar_material(raw.pillar, folder);
  scene.film = film_of(raw, folder);
  std::map<std::string, RowDrive> drives;
  for (const ArrayAnalysis& analysis : array_analyses()) drives[analysis.name] = analysis.drive;
  scene.drive = choice<RowDrive>("analysis.kind", raw.analysis, drives);
  scene.wanted = raw.quantities;
  scene.surface_energy_J_m2 = raw.surface_energy_J_m2;
  scene.effects = choices_of(raw.effects);
  fill_drive(raw.times, scene);
  fill_load(raw, scene);
  const ArrayGeometry& g = scene.geometry;
  const double half_m = place_m(g, g.count - 1) + 0.5 * g.diameter_m + g.film_edge_m;
  scene.press = press_from(raw.shape, folder, {-half_m, half_m, 0.0, 0.0});
  return scene;
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

void read_row(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file) {
  RawArray raw;
  read([&](FieldVisitor& v) { show_array(v, raw); });
  file.sweep = raw.sweep;
  file.printed = raw.printed;
  const ArrayScene scene = scene_from(raw, folder);
  file.scene = scene;
  check_sweep(file.sweep, scene);
  for (const SweepPoint& point : points_of(scene, file.sweep)) plan_effects(point.scene);
  check_wanted(scene);
}

}  // namespace viscard
