#include "models/answer/scene_mistake.h"
#include "models/array/contact/press_notes.h"
#include "models/array/film/disc_coupling.h"
#include "models/array/layer/layer_scene.h"
#include "models/maths/text_of_number.h"

#include <cmath>
#include <string>

namespace viscard {
namespace {

// Thinner layers let through waves that are short beside the film, which would take too many elements.
constexpr double kThinnest = 0.25;  // of the film's thickness
constexpr double kThickest = 1e4;   // of the film's thickness
constexpr double kWidestNu = 0.4999;
constexpr std::size_t kMostElectrodes = 100;

void check_material(const LayerScene& scene) {
  at_key("materials.layer", [&] { validate(scene.pillar); });
  if (scene.pillar.nu > kWidestNu) {
    throw SceneMistake("materials.layer.nu", "is " + text_of(scene.pillar.nu) +
                                                 "; a bonded layer needs a Poisson ratio up to "
                                                 "0.4999, because it yields only as much as its "
                                                 "volume can change");
  }
  check_read_film(scene.film, scene.film_thickness_m, "a layer");
}

void check_sizes(const LayerScene& scene) {
  const double ratio = scene.thickness_m / scene.film_thickness_m;
  if (!(ratio >= kThinnest && ratio <= kThickest)) {
    throw SceneMistake("geometry.thickness", "the layer is " + text_of(ratio, 3) +
                                                 " times as thick as the film; it must be 0.25 to "
                                                 "10000 times");
  }
}

void check_electrodes(const LayerScene& scene) {
  if (scene.electrodes_m.empty() || scene.electrodes_m.size() > kMostElectrodes) {
    throw SceneMistake("geometry.electrode.at", "needs 1 to 100 places");
  }
  if (!(scene.electrode_radius_m > 0.0)) {
    throw SceneMistake("geometry.electrode.radius", "must be positive");
  }
  if (scene.is_plane() && scene.electrode != SpaceElectrode::kSampled) {
    throw SceneMistake("geometry.electrode",
                       "of a section is a strip that is sampled; quadrants and "
                       "equipotential discs need model = \"space\"");
  }
  for (std::size_t i = 0; i < scene.electrodes_m.size(); ++i) {
    const auto& [x_m, y_m] = scene.electrodes_m[i];
    if (scene.is_plane() && y_m != 0.0) {
      throw SceneMistake("geometry.electrode.at", "of a section have y = 0");
    }
    if (scene.electrode != SpaceElectrode::kEquipotential) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_m =
          std::hypot(x_m - scene.electrodes_m[j].first, y_m - scene.electrodes_m[j].second);
      check_electrode_gap(
          "geometry.electrode.at", std::to_string(j + 1) + " and " + std::to_string(i + 1), apart_m,
          scene.electrode_radius_m, least_gap_m(scene.film_thickness_m, scene.electrode_radius_m));
    }
  }
}

// Shapes that touch an endless layer along an endless line or half-plane.
bool is_endless(const LayerScene& scene) {
  const RigidShape& shape = scene.press.shape;
  switch (shape.kind) {
    case ShapeKind::kPlane:
    case ShapeKind::kEdge:
      return true;
    case ShapeKind::kCylinder:
      return !scene.is_plane();
    case ShapeKind::kWedge:
      return !scene.is_plane() || std::hypot(shape.tilt_x, shape.tilt_y) >= shape.slope;
    default:
      return false;
  }
}

void check_layer_press(const LayerScene& scene) {
  const ShapePress& press = scene.press;
  at_key("shape", [&] { validate(press.shape); });
  if (press.work_of_adhesion_J_m2 > 0.0 || !press.before_m.empty()) {
    throw SceneMistake(
        press.before_m.empty() ? "shape.work_of_adhesion" : "shape.before",
        "is answered for tops of pillars, which let go at once; leave it out for a layer");
  }
  if (press.friction != Friction::kNone) {
    throw SceneMistake("shape.friction",
                       "sticks, which is answered for rows of pillars in the plane; say friction = "
                       "\"none\"");
  }
  if ((press.depth_m > 0.0) == (press.force_N > 0.0)) {
    throw SceneMistake("shape",
                       "needs either a depth, such as depth = \"3 um\", or a force, such "
                       "as force = \"5 mN\"");
  }
  if (press.depth_m >= scene.thickness_m) {
    throw SceneMistake("shape.depth", "is not less than the layer's thickness of " +
                                          micrometres(scene.thickness_m));
  }
  if (scene.is_plane()) check_in_section(press.shape);
  if (scene.width_m == 0.0 && (is_endless(scene) || !scene.feels_contact)) {
    throw SceneMistake("geometry",
                       "needs a width, such as width = \"500 um\": the shape has no end, and an "
                       "endless layer under it would bear any force");
  }
}

}  // namespace

void validate(const LayerScene& scene) {
  check_tolerance(scene.tolerance, LayerScene::kTolerances);
  check_material(scene);
  check_sizes(scene);
  check_electrodes(scene);
  check_layer_press(scene);
}

}  // namespace viscard
