#pragma once

#include "models/answer/scene_common.h"
#include "models/array/contact/shape_press.h"
#include "models/array/quadrants/quadrant_gains.h"
#include "models/array/sensing/heat_response.h"
#include "models/array/sensing/thermal_noise.h"
#include "models/array/space/space_array.h"
#include "models/array/space/touch_drive.h"
#include "models/pillar/scene/pillar_scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// A pillar that stands, with its place in the maps.
struct SpacePillar {
  int row = 1;  // from 1; y grows with the row, x with the column
  int column = 1;
  double x_m = 0.0;
  double y_m = 0.0;
  int of_class = 0;  // 0: the usual pillars; n: SpaceScene::others[n - 1]
};

// Row and column of a pillar, from 1.
using RowColumn = std::pair<int, int>;

// How the pillars of an array stand.
enum class SpaceLattice { kSquare, kHexagonal };

// Places around the middle of the array, row by row. The pitch is the distance of nearest axes; in a
// hexagonal lattice every second row is shifted by half a pitch.
std::vector<SpacePillar> lattice_places(SpaceLattice lattice, int rows, int columns,
                                        double pitch_m);

// Shape and material of some pillars.
struct SpaceClass {
  double diameter_m = 40e-6;
  double length_m = 120e-6;
  Material material;
};

// An array of pillars in the plane on one film, loaded at rest, and the accuracy of the answer. The
// tolerance refers to the largest value of each map (of the four quarters together), and for results in
// per cent to 10 %.
struct SpaceScene : SceneCommon {
  int rows = 1, columns = 1;         // of the maps, which have gaps where no pillar stands
  std::vector<SpacePillar> pillars;  // ascending by row, then column
  double diameter_m = 40e-6;         // of the usual pillars, whose material is `pillar`
  double length_m = 120e-6;
  std::vector<SpaceClass> others;

  Medium film;
  double film_thickness_m = 25e-6;
  double film_edge_m = 100e-6;     // film beyond the outer pillars' faces
  std::optional<Backing> backing;  // an elastic half-space under the film; nothing: rigid
  FilmFace grounded = FilmFace::kTop;
  SpaceElectrode electrode = SpaceElectrode::kSampled;
  double electrode_radius_m = 0.0;  // 0: that of the usual pillars
  double electrode_gap_m = 0.0;     // between quarters of metal

  double pressure_Pa = 0.0;  // on the tops of the loaded pillars
  double shear_x_Pa = 0.0;
  double shear_y_Pa = 0.0;
  std::vector<RowColumn> loaded;  // empty: all

  std::optional<ShapePress> press;  // instead of the loads above
  std::optional<SpaceTouch> touch;  // of the press in time; see press_in_time(), touch_steps.h

  std::optional<HeatScene> heat;   // results of one of the usual pillars, beside those of the loads
  std::optional<NoiseBand> noise;  // of an electrode with this amplifier
  std::optional<Readout> noise_readout;

  QuadrantSensing quadrants;  // of electrodes in quarters: how forces are found from voltages

  double surface_energy_J_m2 = 0.02;  // of the pillars, which may stick together; PDMS

  // Set by the plan (models/scene/plan.h): each pillar as if it stood alone.
  bool feels_neighbours = true;
  // Set by the plan: the film lies on its backing instead of a rigid base.
  bool feels_backing = true;
  // Set by the plan: a shape can only push. Otherwise all tops follow the shape, even if they must
  // be pulled.
  bool feels_contact = true;

  // Word of geometry.kind in a scene file, the same as for a row: geometry.model = "space" selects
  // this kind (io/scenes).
  static constexpr const char* kKind = "array";
  static constexpr const char* kModel = "space";
  static constexpr ToleranceRange kTolerances{1e-6, "1e-6 and 1 for an array in the plane"};
};

// Index into scene.pillars; nothing if no pillar stands there.
std::optional<std::size_t> index_of(const SpaceScene& scene, RowColumn place);

// "[3, 4]"
std::string name_of(RowColumn place);

// A load of its own, or pillars that it acts on, are named.
bool has_load(const SpaceScene& scene);
// Pillars bend: by a shear, or by a shape, which turns the tops.
bool is_sheared(const SpaceScene& scene);

// Shape and material of a pillar.
SpaceClass class_of(const SpaceScene& scene, const SpacePillar& pillar);
std::vector<SpaceClass> classes_of(const SpaceScene& scene);  // of_class is the index
// The pull that a top of this class bears at most (models/sensor, eq. D5).
double class_pull_off_N(const SpaceClass& one, double work_J_m2);
// Radius of the electrodes, for the default that of the usual pillars.
double electrode_radius_m(const SpaceScene& scene);

// The array as it is solved, and its loads: pillars x TopLoad.
SpaceArray array_of(const SpaceScene& scene);
TopLoads loads_of(const SpaceScene& scene);
std::vector<bool> is_loaded(const SpaceScene& scene);  // by pillar

// One pillar of a class on a rigid base, without load.
PillarScene single_pillar(const SpaceScene& scene, const SpaceClass& one);

// The film, a rectangle around the outer pillars.
struct FilmExtent {
  double left_m = 0.0, right_m = 0.0, low_m = 0.0, high_m = 0.0;
};
FilmExtent film_extent(const SpaceScene& scene);

// Smallest gap between the faces of two pillars; infinite for a single one.
double smallest_gap_m(const SpaceScene& scene);
// Smallest distance of two axes; twice the diameter for a single pillar.
double smallest_pitch_m(const SpaceScene& scene);

}  // namespace viscard
