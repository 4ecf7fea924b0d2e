#include "io/scenes/scene_words.h"
#include "io/scenes/shape_section.h"
#include "models/array/layer/simulate_layer.h"
#include "models/scene/effects.h"
#include "models/scene/plan.h"

#include <map>

namespace viscard {
namespace {

// The values of the file before they are checked.
struct RawLayer {
  double tolerance = 1e-3;
  std::string kind = "layer", model = "space";
  double thickness_m = 0.0, width_m = 0.0;
  double film_thickness_m = 0.0;
  std::string film_material, film_bottom = "fixed", poling = "+z";
  std::string electrode_face = "bottom", electrode_kind = "sampled";
  double electrode_radius_m = 20e-6;
  std::vector<std::pair<double, double>> electrodes_m;
  bool quadrants = false;
  RawMaterial layer, film;
  std::string analysis = "static";
  RawShape shape;
  std::map<std::string, std::string> effects;
  std::vector<std::string> quantities;
  std::vector<PrintedValue> printed;
};

QuantityField metres(const char* key, bool is_required = false) {
  return {.key = key, .unit = "m", .range = Range::kPositive, .is_required = is_required};
}

void show_layer_geometry(FieldVisitor& v, RawLayer& s) {
  v.text({"kind", "layer"}, s.kind);
  v.text({"model", "space"}, s.model);
  v.quantity(metres("thickness", true), s.thickness_m);
  v.quantity(metres("width"), s.width_m);
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(metres("thickness", true), s.film_thickness_m);
    f.text({"material", "pvdf", true}, s.film_material);
    f.text({"bottom", "fixed"}, s.film_bottom);
  });
  v.section("electrode", [&](FieldVisitor& e) {
    e.text({"face", "bottom"}, s.electrode_face);
    e.text({"kind", "sampled"}, s.electrode_kind);
    e.quantity(metres("radius"), s.electrode_radius_m);
    e.boolean("quadrants", s.quadrants);
    e.quantity_pairs("at", "m", "m", s.electrodes_m);
  });
  v.text({"poling", "+z"}, s.poling);
}

void show_layer(FieldVisitor& v, RawLayer& s) {
  v.quantity({.key = "tolerance", .range = Range::kPositive}, s.tolerance);
  v.section("geometry", [&](FieldVisitor& g) { show_layer_geometry(g, s); });
  v.section("materials", [&](FieldVisitor& m) {
    m.section("layer", [&](FieldVisitor& one) { show_material(one, s.layer); });
    m.section(s.film_material.c_str(), [&](FieldVisitor& one) { show_material(one, s.film); });
  });
  v.section("analysis", [&](FieldVisitor& a) { a.text({"kind", "static"}, s.analysis); });
  v.section("shape", [&](FieldVisitor& one) { show_shape(one, s.shape); });
  v.section("effects", [&](FieldVisitor& e) {
    for (const Effect& effect : effects()) e.text({effect.name, "auto"}, s.effects[effect.name]);
  });
  v.section("want", [&](FieldVisitor& w) {
    w.texts({"quantities", "contact_force"}, s.quantities);
  });
  show_printed(v, s.printed);
}

void fill_layer_electrodes(const RawLayer& raw, LayerScene& scene) {
  scene.grounded = choice<FilmFace>("geometry.electrode.face", raw.electrode_face,
                                    {{"bottom", FilmFace::kTop}, {"top", FilmFace::kBottom}});
  scene.electrode = choice<SpaceElectrode>(
      "geometry.electrode.kind", raw.electrode_kind,
      {{"sampled", SpaceElectrode::kSampled}, {"equipotential", SpaceElectrode::kEquipotential}});
  if (raw.quadrants && scene.electrode == SpaceElectrode::kEquipotential) {
    throw SceneMistake("geometry.electrode.kind",
                       "quadrants are read on a charge-free face; say kind = \"sampled\", or leave "
                       "quadrants out");
  }
  if (raw.quadrants) scene.electrode = SpaceElectrode::kQuadrants;
  scene.electrode_radius_m = raw.electrode_radius_m;
  if (!raw.electrodes_m.empty()) scene.electrodes_m = raw.electrodes_m;
}

LayerScene layer_from(const RawLayer& raw, const std::filesystem::path& folder) {
  LayerScene scene;
  scene.tolerance = raw.tolerance;
  scene.model = choice<LayerModel>("geometry.model", raw.model,
                                   {{"space", LayerModel::kSpace},
                                    {"plane-strain", LayerModel::kPlaneStrain},
                                    {"plane-stress", LayerModel::kPlaneStress}});
  scene.thickness_m = raw.thickness_m;
  scene.width_m = raw.width_m;
  at_key("materials.layer",
         [&] { scene.pillar = pillar_material(raw.layer, folder, "materials.layer"); });
  choice<bool>("geometry.film.bottom", raw.film_bottom, {{"fixed", true}});
  scene.film = film_medium("materials." + raw.film_material, raw.film, folder).medium;
  if (choice<bool>("geometry.poling", raw.poling, {{"+z", false}, {"-z", true}})) {
    scene.film = with_reversed_poling(scene.film);
  }
  scene.film_thickness_m = raw.film_thickness_m;
  fill_layer_electrodes(raw, scene);
  if (raw.analysis != "static") {
    throw SceneMistake("analysis.kind", "cannot be '" + raw.analysis +
                                            "': layers are answered at rest, kind = \"static\"");
  }
  const double half_m = 0.5 * raw.width_m;
  const double across_m = scene.is_plane() ? 0.0 : half_m;
  if (raw.shape.kind == "rough" && !(half_m > 0.0)) {
    throw SceneMistake("geometry",
                       "needs a width, such as width = \"1 mm\": a rough surface has no "
                       "end");
  }
  const std::optional<ShapePress> press =
      press_from(raw.shape, folder, {-half_m, half_m, -across_m, across_m});
  if (!press) {
    throw SceneMistake("geometry.kind",
                       "is a layer, which needs a [shape] that presses on it, such as kind = "
                       "\"sphere\", radius and depth");
  }
  scene.press = *press;
  scene.effects = choices_of(raw.effects);
  scene.wanted = raw.quantities;
  return scene;
}

// "mean_voltage" is that of every electrode, "mean_voltage_2" of the second.
void check_layer_wanted(const LayerScene& scene) {
  std::vector<std::string> known = result_names(scene);
  for (const std::string& name : voltage_names(scene)) {
    for (std::size_t e = 1; e <= scene.electrodes_m.size(); ++e) {
      known.push_back(name + "_" + std::to_string(e));
    }
  }
  check_wanted(scene.wanted, known);
}

}  // namespace

void read_layer(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file) {
  RawLayer raw;
  read([&](FieldVisitor& v) { show_layer(v, raw); });
  file.printed = raw.printed;
  const LayerScene scene = layer_from(raw, folder);
  file.scene = scene;
  plan_effects(scene);
  check_layer_wanted(scene);
}

}  // namespace viscard
