#include "io/scenes/scene_fields.h"
#include "models/array/layer/simulate_layer.h"
#include "models/scene/plan.h"

namespace viscard {
namespace {

void show_geometry(FieldVisitor& v, SceneFile& file, LayerScene& scene) {
  v.only("kind", LayerScene::kKind);
  v.choice({"model", "space"},
           {{"space", LayerModel::kSpace},
            {"plane-strain", LayerModel::kPlaneStrain},
            {"plane-stress", LayerModel::kPlaneStress}},
           scene.model);
  v.quantity(length_key("thickness", true), scene.thickness_m);
  v.quantity(length_key("width"), scene.width_m);
  v.section("film", [&](FieldVisitor& f) {
    f.quantity(length_key("thickness", true), scene.film_thickness_m);
    show_film_material(f, file);
    f.only("bottom", "fixed");
  });
  v.section("electrode", [&](FieldVisitor& e) {
    show_electrode(e, scene.grounded, scene.electrode, scene.electrode_radius_m);
    e.quantity_pairs("at", "m", "m", scene.electrodes_m);
  });
  show_poling(v, file);
}

// "mean_voltage" is that of every electrode, "mean_voltage_2" of the second.
void check_layer_wanted(const LayerScene& scene) {
  std::vector<std::string> known = result_names(scene);
  for (const std::string& name : voltage_names(scene.electrode)) {
    for (std::size_t e = 1; e <= scene.electrodes_m.size(); ++e) {
      known.push_back(name + "_" + std::to_string(e));
    }
  }
  check_wanted(scene.wanted, known);
}

}  // namespace

void show_fields(FieldVisitor& v, SceneFile& file, LayerScene& scene) {
  v.section("geometry", [&](FieldVisitor& g) { show_geometry(g, file, scene); });
  show_materials(v, "layer", file);
  v.after_all_keys([&file, &scene] { scene.film = film_of(file); });
  std::string analysis = "static";
  v.section("analysis", [&](FieldVisitor& a) { a.text({"kind", "static"}, analysis); });
  const auto touchable = [&scene] {
    const double half_m = 0.5 * scene.width_m, across_m = scene.is_plane() ? 0.0 : half_m;
    if (!(half_m > 0.0)) {
      throw SceneMistake("geometry",
                         "needs a width, such as width = \"1 mm\": a rough surface has no "
                         "end");
    }
    return RoughExtent{-half_m, half_m, -across_m, across_m};
  };
  const auto is_pressed = std::make_shared<bool>(false);
  show_shape(v, file, v.reads() ? nullptr : &scene.press, touchable,
             [&scene, is_pressed](const ShapePress& press) {
               scene.press = press;
               *is_pressed = true;
             });
  show_common(v, "contact_force", file);
  v.after_all_keys([&scene, analysis, is_pressed] {
    if (analysis != "static") {
      throw SceneMistake("analysis.kind", "cannot be '" + analysis +
                                              "': layers are answered at rest, kind = \"static\"");
    }
    if (!*is_pressed) {
      throw SceneMistake("geometry.kind",
                         "is a layer, which needs a [shape] that presses on it, such as kind = "
                         "\"sphere\", radius and depth");
    }
    plan_effects(scene);
    check_layer_wanted(scene);
  });
}

}  // namespace viscard
