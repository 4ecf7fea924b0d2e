#include "io/scenes/scene_drive.h"
#include "io/scenes/scene_fields.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/system/rotated_medium.h"

#include <cmath>

namespace viscard {
namespace {

void show_flare(FieldVisitor& v, const char* key, Flare& flare) {
  v.section(key, [&](FieldVisitor& f) {
    f.quantity({.key = "width", .unit = "m"}, flare.width_m);
    f.quantity({.key = "height", .unit = "m", .range = Range::kPositive}, flare.height_m);
  });
}

// The film with its material, whether it and the pillar above lie on a held base. A film may be there or not.
void fill_film(SceneFile& file, PillarScene& scene) {
  const FilmGeometry& geometry = *scene.geometry.film;
  const SceneSources& sources = file.sources;
  if (!(geometry.thickness_m > 0.0) || !(geometry.radius_m > 0.0)) {
    throw SceneMistake("geometry.film", "needs thickness and radius");
  }
  if (sources.film.empty()) {
    throw SceneMistake("geometry.film", "needs a material, the name of one under [materials]");
  }
  const NamedMaterial& material = sources.materials.at(sources.film);
  if (material.file.empty() && !(material.E_Pa > 0.0)) {
    throw SceneMistake(
        "materials." + sources.film,
        "[materials] needs a " + sources.film + ", the film's, with E (and nu, rho) or a file");
  }
  const MediumFile film = film_medium(file, sources.film);
  const bool is_averaged = !material.file.empty() && !scene.plane;
  scene.film = is_averaged ? averaged_about_z(film.medium) : film.medium;
  if (!material.file.empty()) scene.film_charge_C_N = film.charge_C_N;
  if (is_averaged && sources.film_is_directional && !is_isotropic_about_z(film.medium)) {
    scene.directional_film = film.medium;
  }
  if (sources.film_is_reversed) {
    scene.film = with_reversed_poling(*scene.film);
    if (scene.directional_film) {
      scene.directional_film = with_reversed_poling(*scene.directional_film);
    }
  }
}

// The film, which may be missing, and the bottom of the film or of the pillar without one.
void show_film(FieldVisitor& v, SceneFile& file, PillarScene& scene) {
  static const WordTable<bool> kBottoms = {{"fixed", true}, {"free", false}};
  FilmGeometry film = scene.geometry.film.value_or(FilmGeometry{});
  std::optional<bool> of_film, of_pillar;
  if (!v.reads()) (scene.geometry.film ? of_film : of_pillar) = scene.fixed_bottom;
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(length_key("thickness"), film.thickness_m);
    f.quantity(length_key("radius"), film.radius_m);
    f.text({"material", "pvdf"}, file.sources.film);
    f.choice({"bottom", "fixed"}, kBottoms, of_film);
    f.boolean("directional", file.sources.film_is_directional);
  });
  v.choice({"bottom", "fixed"}, kBottoms, of_pillar);
  if (!v.reads()) return;
  const bool has_film =
      !file.sources.film.empty() || film.thickness_m > 0.0 || film.radius_m > 0.0 || of_film;
  if (has_film) scene.geometry.film = film;
  scene.fixed_bottom = (has_film ? of_film : of_pillar).value_or(true);
  v.after_all_keys([&file, &scene, of_pillar] {
    if (!scene.geometry.film) return;
    fill_film(file, scene);
    if (!of_pillar) return;
    throw SceneMistake(
        "geometry.bottom",
        "the pillar stands on a film; write bottom = \"fixed\" or \"free\" inside the "
        "film's braces");
  });
}

// What stands in geometry.electrode.
struct ElectrodeKeys {
  std::optional<FilmFace> grounded;
  std::optional<bool> is_sampled;
  double radius_m = 0.0;
  bool quadrants = false;
};

void fill_electrode(const ElectrodeKeys& keys, PillarScene& scene) {
  if (!keys.grounded) {
    throw SceneMistake("geometry.electrode",
                       "needs the film's face it is on; write face = \"top\" or \"bottom\"");
  }
  const bool is_sampled = keys.is_sampled.value_or(false);
  if (!is_sampled && !(keys.radius_m > 0.0)) {
    throw SceneMistake("geometry.electrode", "needs a radius");
  }
  const double under_m = 0.5 * scene.geometry.diameter_m;
  if (is_sampled && keys.radius_m > 0.0 && std::abs(keys.radius_m - under_m) > 1e-6 * under_m) {
    throw SceneMistake("geometry.electrode.radius",
                       "a sampled face is read in its middle and over the pillar's radius; leave "
                       "the radius out");
  }
  scene.electrodes =
      ElectrodeOptions{*keys.grounded, is_sampled ? 0.0 : keys.radius_m, keys.quadrants};
}

void show_electrode(FieldVisitor& v, PillarScene& scene) {
  const auto keys = std::make_shared<ElectrodeKeys>();
  if (const auto& now = scene.electrodes) {
    *keys = {now->grounded, now->electrode_radius_m == 0.0, now->electrode_radius_m,
             now->quadrants};
  }
  v.section("electrode", [&](FieldVisitor& e) {
    e.choice({"face", "bottom"}, grounded_by_electrode_face(), keys->grounded);
    e.choice({"kind", "equipotential"}, {{"equipotential", false}, {"sampled", true}},
             keys->is_sampled);
    e.quantity(length_key("radius"), keys->radius_m);
    e.boolean("quadrants", keys->quadrants);
  });
  v.after_all_keys([&scene, keys] {
    const bool is_given =
        keys->grounded || keys->is_sampled || keys->radius_m > 0.0 || keys->quadrants;
    if (is_given) fill_electrode(*keys, scene);
  });
}

void show_geometry(FieldVisitor& v, SceneFile& file, PillarScene& scene) {
  PillarGeometry& g = scene.geometry;
  v.only("kind", PillarScene::kKind);
  v.choice<std::optional<PlaneState>>({"model", "axisymmetric"},
                                      {{"axisymmetric", std::nullopt},
                                       {"plane-stress", PlaneState::kStress},
                                       {"plane-strain", PlaneState::kStrain}},
                                      scene.plane);
  v.quantity(length_key("diameter", true), g.diameter_m);
  v.quantity(length_key("length", true), g.length_m);
  show_film(v, file, scene);
  show_poling(v, file);
  show_electrode(v, scene);
  show_flare(v, "foot", g.foot);
  show_flare(v, "tip", g.tip);
}

// A mesh that the user asks for: "graded-p" shrinks toward the rim of the bond; "h1" and "h2" are
// the linear and quadratic elements of ordinary programs, "p" equal ones of any degree.
void show_mesh(FieldVisitor& v, PillarScene& scene) {
  enum class Mesh { kGraded, kLinear, kQuadratic, kUniform };
  Discretisation mesh = scene.discretisation.value_or(Discretisation{});
  std::optional<Mesh> kind;
  if (scene.discretisation) {
    kind = !(mesh.uniform_m > 0.0) ? Mesh::kGraded
           : mesh.degree == 1      ? Mesh::kLinear
           : mesh.degree == 2      ? Mesh::kQuadratic
                                   : Mesh::kUniform;
  }
  v.section("discretisation", [&](FieldVisitor& d) {
    d.choice({"kind", "graded-p"},
             {{"graded-p", Mesh::kGraded},
              {"h1", Mesh::kLinear},
              {"h2", Mesh::kQuadratic},
              {"p", Mesh::kUniform}},
             kind);
    d.quantity({.key = "element_size", .unit = "m", .range = Range::kPositive, .is_exact = true},
               mesh.uniform_m);
    d.integer("degree", 3, 12, mesh.degree);
    d.integer("layers", 1, 8, mesh.layers);
  });
  if (!kind || !v.reads()) return;
  if (*kind == Mesh::kLinear) mesh.degree = 1;
  if (*kind == Mesh::kQuadratic) mesh.degree = 2;
  if (*kind == Mesh::kGraded) mesh.uniform_m = 0.0;
  scene.discretisation = mesh;
  v.after_all_keys([needs_size = *kind != Mesh::kGraded && !(mesh.uniform_m > 0.0)] {
    if (!needs_size) return;
    throw SceneMistake("discretisation", "this kind needs an element_size, such as \"5 um\"");
  });
}

void show_wiring(FieldVisitor& v, PillarScene& scene) {
  std::shared_ptr<ReadoutKeys> keys;
  v.section("readout", [&](FieldVisitor& r) {
    keys = show_readout(r, scene.readout, scene.film ? &*scene.film : nullptr);
  });
  v.after_all_keys([&scene, keys] {
    if (!keys->kind) return;
    if (!scene.electrodes || scene.electrodes->electrode_radius_m == 0.0) {
      throw SceneMistake("readout", "needs an electrode with a radius to be wired to");
    }
    scene.readout = readout_of(*keys, *scene.film, scene.film_loss);
    at_key("readout", [&] { validate(*scene.readout); });
  });
}

}  // namespace

void show_fields(FieldVisitor& v, SceneFile& file, PillarScene& scene) {
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, file, scene); });
  show_mesh(v, scene);
  show_materials(v, "pillar", file);
  v.section("analysis", [&](FieldVisitor& a) { show_analysis(a, scene); });
  show_wiring(v, scene);
  show_common(v, "top_displacement", file);
  v.after_all_keys([&file, &scene] {
    if (const auto rubber = pillar_rubber(file, "pillar")) scene.rubber = rubber->law;
    validate(scene);
    check_wanted(scene.wanted, result_names(scene));
  });
}

}  // namespace viscard
