#pragma once

#include "models/answer/scene_common.h"
#include "models/array/contact/shape_press.h"
#include "models/array/plane/array_statics.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/load_history.h"

#include <optional>
#include <variant>
#include <vector>

namespace viscard {

// What is done to a row of pillars: one alternative for each analysis (array_analysis.h). The load
// itself, its pillars and its direction are in ArrayScene.

// A load at rest.
struct RowStatic {};

// Free vibration.
struct RowModal {
  int modes = 3;  // clusters of each family
};

// Steady oscillation at each of the frequencies.
struct RowHarmonic {
  std::vector<double> frequencies_Hz;  // ascending
};

// A load in time with inertia.
struct RowTransient {
  Course history;  // load in Pa
  double end_time_s = 0.0;
  int outputs = 1000;  // equal intervals
};

// One of these.
using RowDrive = std::variant<RowStatic, RowModal, RowHarmonic, RowTransient>;

// A row of pillars, what is done to it, and the accuracy of the answer. The tolerance refers
// to the largest of the pillars' voltages, and for results in per cent to 10 %.
struct ArrayScene : SceneCommon {
  ArrayGeometry geometry;
  ArrayElectrodes electrodes;
  Medium film;
  PlaneState plane = PlaneState::kStress;

  RowDrive drive;
  ArrayLoad load = ArrayLoad::kPressure;
  double load_Pa = 0.0;     // at rest or amplitude
  std::vector<int> loaded;  // numbers from 1; empty: all

  std::optional<ShapePress> press;  // at rest, instead of the load above; its force in N/m

  double surface_energy_J_m2 = 0.02;  // of the pillars, which may stick together; PDMS

  // Set by the plan (models/scene/plan.h): each pillar as if it stood alone; on a rigid base.
  bool feels_neighbours = true;
  bool feels_film = true;
  // Set by the plan: a shape only pushes. If not, all tops follow it, also where they must be pulled.
  bool feels_contact = true;

  static constexpr const char* kKind = "row";  // geometry.kind in a scene file
  static constexpr ToleranceRange kTolerances{1e-7, "1e-7 and 1 for a row of pillars"};
};

// The history of the load; empty if the drive has none.
const Course& history(const ArrayScene& scene);

// The slowest that the load changes: its lowest frequency, or once over its duration; 0: it is at rest.
double slowest_rad_s(const ArrayScene& scene);

bool is_electric(const ArrayScene& scene);  // the film has a permittivity

// Of the pillar's axis from the middle of the row; pillars are numbered from 0.
double place_m(const ArrayGeometry& geometry, int pillar);

// One pillar of the row, a strip on a rigid base, without load.
PillarScene single_pillar(const ArrayScene& scene);

// The media of pillars and film.
ArrayMedia media_of(const ArrayScene& scene);

}  // namespace viscard
