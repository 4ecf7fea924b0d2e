#include "io/pictures/picture_numbers.h"
#include "io/pictures/scene_drawing.h"
#include "io/pictures/scene_picture.h"
#include "io/pictures/shown_row.h"
#include "models/array/plane/array_analysis.h"

#include <fmt/format.h>

#include <set>

namespace viscard {
namespace {

constexpr double kAboveTops = 1.3;  // of the length: as high as a shape is drawn

void draw_pillar(SceneDrawing& d, const ArrayGeometry& g, double middle_m, bool is_image) {
  d.box(middle_m - 0.5 * g.diameter_m, middle_m + 0.5 * g.diameter_m, 0.0, g.length_m,
        is_image ? R"(fill="#eef4f9" stroke="#a9bfd0" stroke-dasharray="4 3")"
                 : R"(fill="#bcd4e6" stroke="#2b5d7d")");
}

void draw_mirrors(SceneDrawing& d, const ArrayGeometry& g, const ShownRow& row) {
  const double pitch_m = g.diameter_m + g.spacing_m;
  draw_pillar(d, g, row.pillars.front().second - pitch_m, true);
  draw_pillar(d, g, row.pillars.back().second + pitch_m, true);
  for (const double at_m : {row.left_m, row.right_m}) {
    d.line(d.x(at_m), d.y(g.length_m), d.x(at_m), d.y(-g.film_thickness_m) + 12.0,
           R"(stroke="#444" stroke-dasharray="10 3 2 3")");
  }
}

// The numbers of the pillars stand below the film.
void draw_row(SceneDrawing& d, const ArrayScene& scene, const ShownRow& row) {
  const ArrayGeometry& g = scene.geometry;
  const double half_m = electrode_half_width_m(g, scene.electrodes);
  const bool has_electrodes = scene.electrodes.is_equipotential;
  const bool is_top = scene.electrodes.grounded == FilmFace::kBottom;
  const bool is_electric = viscard::is_electric(scene);
  for (const auto& [number, middle_m] : row.pillars) draw_pillar(d, g, middle_m, false);
  if (is_electric) {
    d.ground(row.left_m, row.right_m, g.film_thickness_m, scene.electrodes.grounded);
  }
  const std::set<int> loaded(scene.loaded.begin(), scene.loaded.end());
  for (const auto& [number, middle_m] : row.pillars) {
    if (is_electric) {
      d.electrode(middle_m - half_m, middle_m + half_m, g.film_thickness_m,
                  is_top ? FilmFace::kTop : FilmFace::kBottom);
    }
    d.text(d.x(middle_m), d.y(-g.film_thickness_m) + 24.0, std::to_string(number), "middle");
    const bool has_load = analysis_of(scene).is_loaded && !scene.press;
    if (has_load && (loaded.empty() || loaded.count(number) > 0)) {
      d.load_arrows(middle_m, 0.5 * g.diameter_m, g.length_m, scene.load == ArrayLoad::kShear);
    }
  }
  if (!is_electric) return;
  d.legend(fmt::format("orange: {}, {} wide; dashed: ground",
                       has_electrodes ? "one electrode under each pillar"
                                      : "charge-free face, its potential read over each pillar",
                       in_unit(2.0 * half_m, "m")));
}

std::string words_of_load(const ArrayScene& scene) {
  if (!analysis_of(scene).is_loaded) return "free vibration";
  if (scene.press) return words_of_press(*scene.press) + (scene.press->force_N > 0.0 ? "/m" : "");
  std::string words =
      scene.load_Pa != 0.0 ? in_unit(scene.load_Pa, "Pa") : std::string("a history in time");
  if (scene.load == ArrayLoad::kShear) words += ", sideways,";
  if (scene.loaded.empty()) return words + (scene.geometry.count > 1 ? " on every pillar" : "");
  words += scene.loaded.size() > 1 ? " on pillars" : " on pillar";
  std::string numbers;
  for (const int number : scene.loaded) {
    numbers += (numbers.empty() ? " " : ", ") + std::to_string(number);
    if (numbers.size() > 60) return words + numbers + " ...";
  }
  return words + numbers;
}

// Beside the lengths in words: marks where the drawing has room for them.
void draw_lengths(SceneDrawing& d, const ArrayGeometry& g, const ShownRow& row) {
  const double half_m = 0.5 * g.diameter_m;
  const double y_px = d.y(0.4 * g.length_m);
  const auto mark = [&](double from_m, double to_m, const std::string& words) {
    constexpr double kCharacter_px = 7.0, kGaps_px = 16.0;
    const double room_px = kCharacter_px * static_cast<double>(words.size()) + kGaps_px;
    d.length_mark(from_m, to_m, y_px,
                  d.x(to_m) - d.x(from_m) < room_px ? words.substr(0, words.find(' ')) : words);
  };
  const bool is_endless = g.ends == FilmEnds::kMirror;
  if (row.pillars.size() > 1 || is_endless) {
    const double from_m = row.pillars.front().second + half_m;
    mark(from_m, from_m + g.spacing_m, "s " + in_unit(g.spacing_m, "m"));
  }
  if (!is_endless && g.film_edge_m > 0.0) {
    mark(row.pillars.back().second + half_m, row.right_m, "edge " + in_unit(g.film_edge_m, "m"));
  }
}

std::string words_of_lengths(const ArrayGeometry& g) {
  std::string words =
      fmt::format("pillars d {}, l {}", in_unit(g.diameter_m, "m"), in_unit(g.length_m, "m"));
  if (g.count > 1 || g.ends == FilmEnds::kMirror) {
    words += fmt::format(", s {} from edge to edge", in_unit(g.spacing_m, "m"));
  }
  words += fmt::format("; film t {}", in_unit(g.film_thickness_m, "m"));
  if (g.ends == FilmEnds::kFree) words += ", edge " + in_unit(g.film_edge_m, "m");
  return words;
}

}  // namespace

std::string svg_from_scene(const ArrayScene& scene, const std::string& title) {
  const ArrayGeometry& g = scene.geometry;
  const ShownRow row = shown_row(g);
  const bool is_endless = g.ends == FilmEnds::kMirror;
  const double image_m = is_endless ? 0.5 * g.spacing_m + g.diameter_m : 0.0;
  // Places of a long row are not to scale.
  const bool has_shape = scene.press && !row.is_cut;
  const double top_m = (has_shape ? kAboveTops : 1.0) * g.length_m;
  SceneDrawing d(row.left_m - image_m, row.right_m + image_m, -g.film_thickness_m, top_m,
                 kRowWidth_px);
  d.film(row.left_m - image_m, row.right_m + image_m, g.film_thickness_m);
  if (is_endless) draw_mirrors(d, g, row);
  draw_row(d, scene, row);
  if (has_shape) {
    const ShapePress& press = *scene.press;
    d.rigid(row.left_m, row.right_m, 0.0, top_m, [&](double x_m) {
      return g.length_m - press.depth_m + height_m(press.shape, x_m, press.shape.y_m);
    });
  }
  if (row.is_cut) {
    d.text(d.x(row.cut_m), d.y(0.5 * g.length_m), fmt::format("... {} ...", g.count), "middle");
  }
  draw_lengths(d, g, row);
  d.text(12.0, 40.0, words_of_lengths(g));
  d.text(0.5 * d.width_px(), 60.0, words_of_load(scene), "middle");
  d.text(d.width_px() - 12.0, 20.0,
         fmt::format("{} pillar{}, {}{}", g.count, g.count > 1 ? "s" : "",
                     scene.plane == PlaneState::kStress ? "plane stress" : "plane strain",
                     is_endless ? ", between mirrors: an endless row" : ""),
         "end");
  return d.document(title);
}

}  // namespace viscard
