#include "io/scenes/raw_drive.h"
#include "io/scenes/scene_words.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/system/rotated_medium.h"
#include "models/scene/effects.h"

#include <cmath>
#include <map>

namespace viscard {
namespace {

// The values of the file before they are checked.
struct RawScene {
  double tolerance = 1e-3;
  std::string kind = "pillar", model = "axisymmetric";
  double diameter_m = 0.0, length_m = 0.0;
  double film_thickness_m = 0.0, film_radius_m = 0.0;
  std::string film_material, film_bottom, bottom;  // bottoms: empty means fixed
  std::string electrode_face, electrode_kind, poling = "+z";
  double electrode_radius_m = 0.0;
  bool quadrants = false, film_directional = true;
  RawMaterial pillar, film;
  std::string analysis = "static";
  RawDrive drive;
  std::vector<std::string> quantities;
  std::map<std::string, std::string> effects;
  std::vector<PrintedValue> printed;
  Flare foot, tip;
  std::string mesh_kind;
  double element_size_m = 0.0;
  std::int64_t degree = 4, layers = 2;
};

void show_flare(FieldVisitor& v, const char* key, Flare& flare) {
  v.section(key, [&](FieldVisitor& f) {
    f.quantity({.key = "width", .unit = "m"}, flare.width_m);
    f.quantity({.key = "height", .unit = "m", .range = Range::kPositive}, flare.height_m);
  });
}

void show_geometry(FieldVisitor& v, RawScene& s) {
  v.text({"kind", "pillar"}, s.kind);
  v.text({"model", "axisymmetric"}, s.model);
  v.text({"bottom", "fixed"}, s.bottom);
  v.quantity({.key = "diameter", .unit = "m", .range = Range::kPositive, .is_required = true},
             s.diameter_m);
  v.quantity({.key = "length", .unit = "m", .range = Range::kPositive, .is_required = true},
             s.length_m);
  v.section("film", [&](FieldVisitor& f) {
    f.quantity({.key = "thickness", .unit = "m", .range = Range::kPositive}, s.film_thickness_m);
    f.quantity({.key = "radius", .unit = "m", .range = Range::kPositive}, s.film_radius_m);
    f.text({"material", "pvdf"}, s.film_material);
    f.text({"bottom", "fixed"}, s.film_bottom);
    f.boolean("directional", s.film_directional);
  });
  v.section("electrode", [&](FieldVisitor& e) {
    e.text({"face", "bottom"}, s.electrode_face);
    e.text({"kind", "equipotential"}, s.electrode_kind);
    e.quantity({.key = "radius", .unit = "m", .range = Range::kPositive}, s.electrode_radius_m);
    e.boolean("quadrants", s.quadrants);
  });
  v.text({"poling", "+z"}, s.poling);
  show_flare(v, "foot", s.foot);
  show_flare(v, "tip", s.tip);
}

// Unit of a history that acts on the top.
const char* history_unit(const std::string& analysis) {
  for (const Analysis& one : analyses()) {
    if (one.name == analysis && one.history == HistoryOf::kShortening) return "m";
  }
  return "Pa";
}

void show_scene(FieldVisitor& v, RawScene& s) {
  v.quantity({.key = "tolerance", .range = Range::kPositive}, s.tolerance);
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, s); });
  v.section("materials", [&](FieldVisitor& m) {
    m.section("pillar", [&](FieldVisitor& one) { show_material(one, s.pillar); });
    if (!s.film_material.empty()) {
      m.section(s.film_material.c_str(), [&](FieldVisitor& one) { show_material(one, s.film); });
    }
  });
  v.section("analysis", [&](FieldVisitor& a) {
    a.text({"kind", "static"}, s.analysis);
    a.integer("modes", 1, 40, s.drive.modes);
    a.text({"top", "plate"}, s.drive.top);
    show_drive(a, history_unit(s.analysis), s.drive);
  });
  v.section("readout", [&](FieldVisitor& r) { show_readout(r, s.drive); });
  v.section("want", [&](FieldVisitor& w) {
    w.texts({"quantities", "top_displacement"}, s.quantities);
  });
  v.section("discretisation", [&](FieldVisitor& d) {
    d.text({"kind", "graded-p"}, s.mesh_kind);
    d.quantity({.key = "element_size", .unit = "m", .range = Range::kPositive}, s.element_size_m);
    d.integer("degree", 3, 12, s.degree);
    d.integer("layers", 1, 8, s.layers);
  });
  show_printed(v, s.printed);
  v.section("effects", [&](FieldVisitor& e) {
    for (const Effect& effect : effects()) e.text({effect.name, "auto"}, s.effects[effect.name]);
  });
}

void fill_film(const RawScene& raw, const std::filesystem::path& folder, PillarScene& scene) {
  if (!(raw.film_thickness_m > 0.0) || !(raw.film_radius_m > 0.0)) {
    throw SceneMistake("geometry.film", "needs thickness and radius");
  }
  if (raw.film_material.empty()) {
    throw SceneMistake("geometry.film", "needs a material, the name of one under [materials]");
  }
  const std::string material_key = "materials." + raw.film_material;
  if (raw.film.file.empty() && !(raw.film.E_Pa > 0.0)) {
    throw SceneMistake(material_key, "[materials] needs a " + raw.film_material +
                                         ", the film's, with E (and nu, rho) or a file");
  }
  scene.geometry.film = FilmGeometry{raw.film_thickness_m, raw.film_radius_m};
  const MediumFile film = film_medium(material_key, raw.film, folder);
  const bool is_averaged = !raw.film.file.empty() && !scene.plane;
  scene.film = is_averaged ? averaged_about_z(film.medium) : film.medium;
  if (!raw.film.file.empty()) scene.film_charge_C_N = film.charge_C_N;
  if (is_averaged && raw.film_directional && !is_isotropic_about_z(film.medium)) {
    scene.directional_film = film.medium;
  }
  if (choice<bool>("geometry.poling", raw.poling, {{"+z", false}, {"-z", true}})) {
    scene.film = with_reversed_poling(*scene.film);
    if (scene.directional_film) {
      scene.directional_film = with_reversed_poling(*scene.directional_film);
    }
  }
}

// The bottom of the film, or of the pillar if there is no film.
void fill_bottom(const RawScene& raw, PillarScene& scene) {
  if (scene.film && !raw.bottom.empty()) {
    throw SceneMistake("geometry.bottom",
                       "the pillar stands on a film; say bottom = \"fixed\" or \"free\" inside the "
                       "film's braces");
  }
  const std::string& word = scene.film ? raw.film_bottom : raw.bottom;
  if (word.empty()) return;
  scene.fixed_bottom = choice<bool>(scene.film ? "geometry.film.bottom" : "geometry.bottom", word,
                                    {{"fixed", true}, {"free", false}});
}

void fill_electrode(const RawScene& raw, PillarScene& scene) {
  if (raw.electrode_face.empty()) {
    throw SceneMistake("geometry.electrode",
                       "needs the film's face it is on; say face = \"top\" or \"bottom\"");
  }
  const auto electrode_on =
      choice<FilmFace>("geometry.electrode.face", raw.electrode_face,
                       {{"bottom", FilmFace::kBottom}, {"top", FilmFace::kTop}});
  const bool sampled = choice<bool>(
      "geometry.electrode.kind", raw.electrode_kind.empty() ? "equipotential" : raw.electrode_kind,
      {{"equipotential", false}, {"sampled", true}});
  if (!sampled && !(raw.electrode_radius_m > 0.0)) {
    throw SceneMistake("geometry.electrode", "needs a radius");
  }
  const double under_m = 0.5 * scene.geometry.diameter_m;
  if (sampled && raw.electrode_radius_m > 0.0 &&
      std::abs(raw.electrode_radius_m - under_m) > 1e-6 * under_m) {
    throw SceneMistake("geometry.electrode.radius",
                       "a sampled face is read in its middle and over the pillar's radius; leave "
                       "the radius out");
  }
  scene.electrodes =
      ElectrodeOptions{electrode_on == FilmFace::kBottom ? FilmFace::kTop : FilmFace::kBottom,
                       sampled ? 0.0 : raw.electrode_radius_m, raw.quadrants};
}

// A mesh that the user asks for: "graded-p" shrinks toward the rim of the bond; "h1" and "h2" are
// the linear and quadratic elements of ordinary programs, "p" equal ones of any degree.
void fill_mesh(const RawScene& raw, PillarScene& scene) {
  if (raw.mesh_kind.empty()) return;
  const auto degree = static_cast<int>(raw.degree);
  const int uniform = choice<int>("discretisation.kind", raw.mesh_kind,
                                  {{"graded-p", 0}, {"h1", 1}, {"h2", 2}, {"p", degree}});
  Discretisation mesh{.degree = uniform == 0 ? degree : uniform,
                      .layers = static_cast<int>(raw.layers)};
  if (uniform != 0) {
    if (!(raw.element_size_m > 0.0)) {
      throw SceneMistake("discretisation", "this kind needs an element_size, such as \"5 um\"");
    }
    mesh.uniform_m = raw.element_size_m;
  }
  scene.discretisation = mesh;
}

PillarScene scene_from(const RawScene& raw, const std::filesystem::path& folder) {
  PillarScene scene;
  choice<bool>("geometry.kind", raw.kind, {{"pillar", true}});
  scene.plane = choice<std::optional<PlaneState>>("geometry.model", raw.model,
                                                  {{"axisymmetric", std::nullopt},
                                                   {"plane-stress", PlaneState::kStress},
                                                   {"plane-strain", PlaneState::kStrain}});
  scene.tolerance = raw.tolerance;
  scene.geometry.diameter_m = raw.diameter_m;
  scene.geometry.length_m = raw.length_m;
  scene.geometry.foot = raw.foot;
  scene.geometry.tip = raw.tip;
  fill_mesh(raw, scene);
  scene.pillar = pillar_material(raw.pillar, folder);
  if (const auto rubber = pillar_rubber(raw.pillar, folder)) scene.rubber = rubber->law;
  const bool has_film = !raw.film_material.empty() || raw.film_thickness_m > 0.0 ||
                        raw.film_radius_m > 0.0 || !raw.film_bottom.empty();
  if (has_film) fill_film(raw, folder, scene);
  fill_bottom(raw, scene);
  const bool has_electrode = !raw.electrode_face.empty() || !raw.electrode_kind.empty() ||
                             raw.electrode_radius_m > 0.0 || raw.quadrants;
  if (has_electrode) fill_electrode(raw, scene);
  std::map<std::string, PillarDrive> drives;
  for (const Analysis& analysis : analyses()) drives[analysis.name] = analysis.drive;
  scene.drive = choice<PillarDrive>("analysis.kind", raw.analysis, drives);
  fill_modes_and_top(raw.drive, scene);
  scene.wanted = raw.quantities;
  fill_drive(raw.drive, scene);
  fill_readout(raw.drive, scene);
  scene.effects = choices_of(raw.effects);
  validate(scene);
  check_wanted(scene.wanted, result_names(scene));
  return scene;
}

}  // namespace

void read_pillar(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file) {
  RawScene raw;
  read([&](FieldVisitor& v) { show_scene(v, raw); });
  file.printed = raw.printed;
  file.scene = scene_from(raw, folder);
}

}  // namespace viscard
