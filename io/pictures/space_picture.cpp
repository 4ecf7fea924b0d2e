#include "io/pictures/picture_numbers.h"
#include "io/pictures/scene_drawing.h"
#include "io/pictures/scene_picture.h"
#include "models/array/space/space_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace viscard {
namespace {

constexpr double kPlanWidth_px = 760.0;
constexpr std::size_t kMostDrawn = 2500;
constexpr const char* kUnloaded = R"(fill="#bcd4e6" stroke="#2b5d7d" stroke-width="0.7")";
constexpr const char* kLoaded = R"(fill="#0072b2" stroke="#003a5c" stroke-width="0.7")";

// The round length of a fifth to a half of the view.
double scale_length_m(double width_m) {
  const double rough = 0.5 * width_m;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  return (rough >= 5.0 * decade ? 5.0 : rough >= 2.0 * decade ? 2.0 : 1.0) * decade;
}

bool has_room_for_parts(const SpaceScene& scene) {
  return std::max(scene.rows, scene.columns) <= 20;
}

// The electrode under a pillar, and its quarters.
void draw_electrode(SceneDrawing& d, const SpaceScene& scene, const SpacePillar& one) {
  const double radius_m = electrode_radius_m(scene);
  const char* const ink = R"(stroke="#d55e00" stroke-width="1.2")";
  d.disc(one.x_m, one.y_m, radius_m, R"(fill="none" stroke="#d55e00" stroke-width="1.2")");
  if (!has_quarters(scene.electrode)) return;
  d.line(d.x(one.x_m - radius_m), d.y(one.y_m), d.x(one.x_m + radius_m), d.y(one.y_m), ink);
  d.line(d.x(one.x_m), d.y(one.y_m - radius_m), d.x(one.x_m), d.y(one.y_m + radius_m), ink);
}

void draw_shear(SceneDrawing& d, const SpaceScene& scene, const SpacePillar& one) {
  const double size_Pa = std::hypot(scene.shear_x_Pa, scene.shear_y_Pa);
  if (size_Pa == 0.0) return;
  const double reach_m = 0.9 * smallest_pitch_m(scene) / size_Pa;
  d.arrow(d.x(one.x_m), d.y(one.y_m), d.x(one.x_m + reach_m * scene.shear_x_Pa),
          d.y(one.y_m + reach_m * scene.shear_y_Pa), false);
}

void draw_pillars(SceneDrawing& d, const SpaceScene& scene) {
  const std::vector<bool> loaded = is_loaded(scene);
  const bool is_close = has_room_for_parts(scene);
  for (const bool of_loaded : {false, true}) {  // arrows lie above all pillars
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      if (loaded[i] != of_loaded) continue;
      const SpacePillar& one = scene.pillars[i];
      d.disc(one.x_m, one.y_m, 0.5 * class_of(scene, one).diameter_m,
             of_loaded ? kLoaded : kUnloaded);
      if (is_close) draw_electrode(d, scene, one);
    }
  }
  for (std::size_t i = 0; i < scene.pillars.size() && is_close; ++i) {
    if (loaded[i]) draw_shear(d, scene, scene.pillars[i]);
  }
}

// Draws arrays whose pillars are too small for the picture: their field, and the loaded pillars if
// they are few.
void draw_field(SceneDrawing& d, const SpaceScene& scene) {
  const FilmExtent film = film_extent(scene);
  const std::vector<bool> loaded = is_loaded(scene);
  const auto count = static_cast<std::size_t>(std::count(loaded.begin(), loaded.end(), true));
  const double edge_m = scene.film_edge_m;
  d.box(film.left_m + edge_m, film.right_m - edge_m, film.low_m + edge_m, film.high_m - edge_m,
        count > kMostDrawn ? kLoaded : kUnloaded);
  for (std::size_t i = 0; i < scene.pillars.size() && count <= kMostDrawn; ++i) {
    const SpacePillar& one = scene.pillars[i];
    if (loaded[i]) d.disc(one.x_m, one.y_m, 0.5 * class_of(scene, one).diameter_m, kLoaded);
  }
}

// The film near the pillars: a wide one would leave them no room.
FilmExtent film_near_pillars(const SpaceScene& scene) {
  constexpr double kMargin = 0.25;  // of the array's width
  FilmExtent film = film_extent(scene);
  const double edge_m = scene.film_edge_m;
  const double width_m =
      std::max(film.right_m - film.left_m, film.high_m - film.low_m) - 2.0 * edge_m;
  const double cut_m =
      edge_m - std::min(edge_m, std::max(kMargin * width_m, 2.0 * smallest_pitch_m(scene)));
  return {film.left_m + cut_m, film.right_m - cut_m, film.low_m + cut_m, film.high_m - cut_m};
}

std::string words_of_array(const SpaceScene& scene) {
  std::string words = fmt::format("pillars d {}, l {}", in_unit(scene.diameter_m, "m"),
                                  in_unit(scene.length_m, "m"));
  if (scene.pillars.size() > 1) {
    words += ", smallest gap " + in_unit(smallest_gap_m(scene), "m");
  }
  if (!scene.others.empty()) words += fmt::format(", {} other classes", scene.others.size());
  words += fmt::format("; film t {}, edge {}", in_unit(scene.film_thickness_m, "m"),
                       in_unit(scene.film_edge_m, "m"));
  if (!scene.backing) return words;
  return words + ", on a half-space of " + in_unit(scene.backing->young_modulus_Pa, "Pa");
}

std::string words_of_loads(const SpaceScene& scene) {
  if (scene.press) return words_of_press(*scene.press);
  std::string words;
  const auto add = [&](const char* name, double Pa) {
    if (Pa != 0.0) words += (words.empty() ? "" : ", ") + (name + in_unit(Pa, "Pa"));
  };
  add("pressure ", scene.pressure_Pa);
  add("shear x ", scene.shear_x_Pa);
  add("shear y ", scene.shear_y_Pa);
  const std::vector<bool> loaded = is_loaded(scene);
  const auto count = std::count(loaded.begin(), loaded.end(), true);
  if (static_cast<std::size_t>(count) == loaded.size()) return words + " on every pillar";
  words += fmt::format(" on {} pillar{} (dark)", count, count > 1 ? "s" : "");
  if (count > 3) return words;
  for (const RowColumn& place : scene.loaded) {
    words += fmt::format(" [{}, {}]", place.first, place.second);
  }
  return words;
}

}  // namespace

std::string words_of_press(const ShapePress& press) {
  const char* const names[] = {"plane", "cylinder", "sphere", "paraboloid",
                               "wedge", "edge",     "table"};
  const char* const name =
      press.shape.table.is_random ? "rough surface" : names[static_cast<int>(press.shape.kind)];
  std::string words = fmt::format("a rigid {}", name);
  if (press.shape.radius_m > 0.0) words += " of radius " + in_unit(press.shape.radius_m, "m");
  if (press.force_N > 0.0) return words + (" pressed with " + in_unit(press.force_N, "N"));
  if (press.depth_m < 0.0) {
    return words + " lifted to " + in_unit(-press.depth_m, "m") + " above first contact";
  }
  return words + " pressed " + in_unit(press.depth_m, "m") + " deep";
}

std::string svg_from_scene(const SpaceScene& scene, const std::string& title) {
  const FilmExtent film = film_near_pillars(scene);
  SceneDrawing d(film.left_m, film.right_m, film.low_m, film.high_m, kPlanWidth_px);
  d.box(film.left_m, film.right_m, film.low_m, film.high_m, R"(fill="#e6c88a" stroke="#7a5c1e")");
  scene.pillars.size() > kMostDrawn ? draw_field(d, scene) : draw_pillars(d, scene);
  const double low_px = d.y(film.low_m);
  const double bar_m = scale_length_m(film.right_m - film.left_m);
  d.length_mark(film.left_m, film.left_m + bar_m, low_px + 30.0, in_unit(bar_m, "m"));
  const double corner_px = d.x(film.right_m) + 24.0;
  d.arrow(corner_px, low_px, corner_px + 34.0, low_px, false);
  d.arrow(corner_px, low_px, corner_px, low_px - 34.0, false);
  d.text(corner_px + 38.0, low_px + 4.0, "x");
  d.text(corner_px - 4.0, low_px - 40.0, "y");
  d.text(12.0, 40.0, words_of_array(scene));
  d.text(12.0, 60.0, words_of_loads(scene));
  d.text(d.width_px() - 12.0, 20.0,
         scene.columns > 1 ? fmt::format("{} pillars in {} rows and {} columns, from above",
                                         scene.pillars.size(), scene.rows, scene.columns)
                           : fmt::format("{} pillars, from above", scene.pillars.size()),
         "end");
  if (scene.pillars.size() > kMostDrawn) d.legend("too many pillars to draw: the field they fill");
  if (has_room_for_parts(scene)) {
    d.legend(fmt::format("orange: {} on the {} of the film, radius {}; the other face is grounded",
                         !has_quarters(scene.electrode) ? "discs that are read"
                         : is_metal(scene.electrode)    ? "quarters of metal"
                                                        : "quarters that are read",
                         scene.grounded == FilmFace::kTop ? "bottom" : "top",
                         in_unit(electrode_radius_m(scene), "m")));
  }
  return d.document(title);
}

}  // namespace viscard
