#include "io/pictures/picture_numbers.h"
#include "io/pictures/scene_drawing.h"
#include "io/pictures/scene_picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace viscard {
namespace {

constexpr double kPillarWidth_px = 640.0;
const char* const kPillarStyle = R"(fill="#bcd4e6" stroke="#2b5d7d")";

std::vector<std::pair<double, double>> pillar_outline(const PillarGeometry& g) {
  constexpr int kPieces = 96;
  std::vector<std::pair<double, double>> corners;
  for (int i = 0; i <= kPieces; ++i) {
    const double z_m = g.length_m * i / kPieces;
    corners.emplace_back(radius_at_m(g, z_m), z_m);
  }
  for (int i = kPieces; i >= 0; --i) {
    const auto [x_m, z_m] = corners[static_cast<std::size_t>(i)];
    corners.emplace_back(-x_m, z_m);
  }
  return corners;
}

double widest_m(const PillarGeometry& g) {
  double widest = 0.0;
  for (const auto& [x_m, z_m] : pillar_outline(g)) widest = std::max(widest, x_m);
  return widest;
}

void draw_electrodes(SceneDrawing& d, const PillarScene& scene) {
  const FilmGeometry& film = *scene.geometry.film;
  const double R = scene.electrodes->electrode_radius_m;
  const FilmFace grounded = scene.electrodes->grounded;
  d.ground(-film.radius_m, film.radius_m, film.thickness_m, grounded);
  const FilmFace face = grounded == FilmFace::kTop ? FilmFace::kBottom : FilmFace::kTop;
  const bool is_divided = scene.electrodes->quadrants && R > 0.0;
  if (is_divided) {
    constexpr double kGap = 0.05;  // of the radius, so that the parts can be told apart
    d.electrode(-R, -kGap * R, film.thickness_m, face);
    d.electrode(kGap * R, R, film.thickness_m, face);
    d.quarters(d.width_px() - 70.0, 70.0);
  } else if (R > 0.0) {
    d.electrode(-R, R, film.thickness_m, face);
  }
  const std::string what = is_divided ? "electrode in quarters" : "electrode";
  d.legend((R > 0.0 ? "orange: " + what + ", radius " + in_unit(R, "m")
                    : std::string("the other face is free of charge and read")) +
           "; dashed: ground");
}

void draw_load(SceneDrawing& d, const PillarScene& scene, double low_m) {
  const PillarGeometry& g = scene.geometry;
  const bool is_sideways = is_lateral(scene);
  const bool is_driven = pressure_Pa(scene) != 0.0 || displacement_m(scene).value_or(0.0) != 0.0 ||
                         !history(scene).empty();
  const double words_px = d.y(g.length_m) - 38.0;
  if (load_place(scene) == LoadPlace::kBase) {
    d.base_arrow(0.0, low_m, is_sideways);
    const std::string words =
        history(scene).empty()
            ? with_minus(fmt::format("base shaken, {:.4g} m/s2", base_acceleration_m_s2(scene)))
            : std::string("base shaken, a history in time");
    d.text(d.x(0.0) + 52.0, d.y(low_m) + 26.0, words);
  } else if (is_driven) {
    d.load_arrows(0.0, radius_at_m(g, g.length_m), g.length_m, is_sideways);
    d.text(d.x(0.0), words_px,
           displacement_m(scene)       ? "moved by " + in_unit(*displacement_m(scene), "m")
           : pressure_Pa(scene) != 0.0 ? in_unit(pressure_Pa(scene), "Pa")
                                       : std::string("a history in time"),
           "middle");
  } else if (drive_V(scene) != 0.0) {
    d.text(d.x(0.0), words_px, in_unit(drive_V(scene), "V") + " on the electrode", "middle");
  }
}

// Beside the pillar, or below the title if two lines are higher than it.
void draw_sizes(SceneDrawing& d, const PillarGeometry& g) {
  const std::string length = "l " + in_unit(g.length_m, "m");
  const std::string diameter = "d " + in_unit(g.diameter_m, "m");
  constexpr double kTwoLines_px = 50.0;
  if (d.y(0.0) - d.y(g.length_m) < kTwoLines_px) {
    d.text(12.0, 42.0, "pillar " + diameter + ", " + length);
    return;
  }
  const double words_px = d.x(widest_m(g)) + 8.0;
  d.text(words_px, d.y(0.5 * g.length_m), length);
  d.text(words_px, d.y(0.5 * g.length_m) + 18.0, diameter);
}

}  // namespace

std::string svg_from_scene(const PillarScene& scene, const std::string& title) {
  const PillarGeometry& g = scene.geometry;
  const double half_m = std::max(g.film ? g.film->radius_m : g.diameter_m, widest_m(g));
  const double low_m = g.film ? -g.film->thickness_m : 0.0;
  SceneDrawing d(-half_m, half_m, low_m, g.length_m, kPillarWidth_px);
  if (g.film) {
    d.film(-g.film->radius_m, g.film->radius_m, g.film->thickness_m, scene.fixed_bottom);
  } else if (scene.fixed_bottom) {
    d.held(-g.diameter_m, g.diameter_m, 0.0);
  }
  if (!scene.fixed_bottom) d.text(d.x(0.0), d.y(low_m) + 16.0, "free", "middle");
  d.outline(pillar_outline(g), kPillarStyle);
  d.line(d.x(0.0), d.y(g.length_m), d.x(0.0), d.y(0.0),
         R"(stroke="#2b5d7d" stroke-dasharray="8 3 2 3")");
  if (g.film && scene.electrodes) draw_electrodes(d, scene);
  draw_sizes(d, g);
  if (g.film) {
    d.text(d.x(half_m), d.y(low_m) + 28.0, "film radius " + in_unit(g.film->radius_m, "m"), "end");
  }
  draw_load(d, scene, low_m);
  if (scene.plane) d.text(d.width_px() - 12.0, 20.0, "a strip, in the plane", "end");
  return d.document(title);
}

}  // namespace viscard
