#pragma once

#include "models/answer/scene_common.h"
#include "models/array/layer/layer_contact.h"
#include "models/array/space/space_array.h"
#include "models/array/space/space_scene.h"

#include <utility>
#include <vector>

namespace viscard {

// In how many dimensions a layer is answered.
enum class LayerModel {
  kSpace,        // a face in x and y
  kPlaneStrain,  // a section in x and z, endless along y; forces are per length
  kPlaneStress
};

// A layer of one elastic material (SceneCommon::pillar) on the film, without lateral ends, under a
// rigid shape without friction.
struct LayerScene : SceneCommon {
  LayerModel model = LayerModel::kSpace;
  double thickness_m = 120e-6;
  double width_m =
      0.0;  // of the part of the face under the shape, a square around x = y = 0; 0: all

  Medium film;
  double film_thickness_m = 25e-6;
  FilmFace grounded = FilmFace::kTop;
  SpaceElectrode electrode = SpaceElectrode::kSampled;
  double electrode_radius_m = 20e-6;  // half of a strip's width
  std::vector<std::pair<double, double>> electrodes_m = {
      {0.0, 0.0}};  // places x, y of their middles

  ShapePress press;

  // Set by the plan (models/scene/plan.h): the shape can only push. Otherwise the face follows the
  // shape wherever the shape covers it, even if it must be pulled.
  bool feels_contact = true;

  bool is_plane() const { return model != LayerModel::kSpace; }

  static constexpr const char* kKind = "layer";
  static constexpr ToleranceRange kTolerances{1e-5, "1e-5 and 1 for a layer"};
};

// Throws SceneMistake naming what is missing or contradictory.
void validate(const LayerScene& scene);

// Film and layer, from the bottom upward.
LayeredFilm stack_of(const LayerScene& scene);
LayerPress press_of(const LayerScene& scene);

// E/(1 - nu^2), in plane stress E: the modulus of a half-space of the layer's material.
double contact_modulus_Pa(const LayerScene& scene);
// E (1 - nu)/((1 + nu)(1 - 2 nu)), in plane stress E/(1 - nu^2): modulus of the layer when it
// cannot widen.
double bonded_modulus_Pa(const LayerScene& scene);

}  // namespace viscard
