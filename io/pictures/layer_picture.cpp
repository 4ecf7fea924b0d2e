#include "io/pictures/picture_numbers.h"
#include "io/pictures/scene_drawing.h"
#include "io/pictures/scene_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kLayerWidth_px = 760.0;

// Half of the section: the electrodes, the part under the shape, and the layer's thickness beside them.
double half_width_m(const LayerScene& scene) {
  const ShapePress& press = scene.press;
  double half_m = 0.5 * scene.width_m;
  const double depth_m = press.depth_m > 0.0 ? press.depth_m : 0.05 * scene.thickness_m;
  if (press.shape.radius_m > 0.0) {
    half_m = std::max(half_m,
                      std::abs(press.shape.x_m) + std::sqrt(2.0 * press.shape.radius_m * depth_m));
  }
  for (const auto& [x_m, y_m] : scene.electrodes_m) {
    half_m = std::max(half_m, std::abs(x_m) + scene.electrode_radius_m);
  }
  return half_m + 1.5 * scene.thickness_m;
}

void draw_shape(SceneDrawing& d, const LayerScene& scene, double half_m, double top_m) {
  const ShapePress& press = scene.press;
  const double tip_m = scene.thickness_m - press.depth_m;
  const double end_m = scene.width_m > 0.0 ? std::min(0.5 * scene.width_m, half_m) : half_m;
  d.rigid(-end_m, end_m, 0.0, top_m,
          [&](double x_m) { return tip_m + height_m(press.shape, x_m, press.shape.y_m); });
}

}  // namespace

std::string svg_from_scene(const LayerScene& scene, const std::string& title) {
  const double half_m = half_width_m(scene);
  const double top_m = 1.6 * scene.thickness_m;
  const double t_m = scene.film_thickness_m;
  SceneDrawing d(-half_m, half_m, -t_m, top_m, kLayerWidth_px);
  d.box(-half_m, half_m, 0.0, scene.thickness_m, R"(fill="#bcd4e6" stroke="#2b5d7d")");
  d.film(-half_m, half_m, t_m);
  const bool is_on_bottom = scene.grounded == FilmFace::kTop;
  for (const auto& [x_m, y_m] : scene.electrodes_m) {
    d.electrode(x_m - scene.electrode_radius_m, x_m + scene.electrode_radius_m, t_m,
                is_on_bottom ? FilmFace::kBottom : FilmFace::kTop);
  }
  d.ground(-half_m, half_m, t_m, scene.grounded);
  draw_shape(d, scene, half_m, top_m);
  d.text(12.0, 40.0,
         fmt::format("layer {} on film t {}", in_unit(scene.thickness_m, "m"), in_unit(t_m, "m")));
  d.text(12.0, 60.0, words_of_press(scene.press));
  const char* const models[] = {"section along x of a layer in space", "plane strain",
                                "plane stress"};
  d.text(d.width_px() - 12.0, 20.0, models[static_cast<int>(scene.model)], "end");
  return d.document(title);
}

}  // namespace viscard
