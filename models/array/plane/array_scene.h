#pragma once

#include "models/array/plane/array_statics.h"
#include "models/material/material.h"
#include "models/pillar/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

enum class ArrayAnalysis { kStatic, kModal, kHarmonic, kTransient };

// A row of pillars, what is done to it, and how well the answer must be known.
struct ArrayScene {
  double tolerance = 1e-3;  // relative; for voltages beside the largest, for per cents beside 10
  ArrayGeometry geometry;
  ArrayElectrodes electrodes;
  Material pillar;
  Medium film;
  PlaneState plane = PlaneState::kStress;
  ArrayAnalysis analysis = ArrayAnalysis::kStatic;
  ArrayLoad load = ArrayLoad::kPressure;
  double load_Pa = 0.0;
  std::vector<int> loaded;             // numbers from 1; empty: all
  int modes = 3;                       // clusters of each family
  std::vector<double> frequencies_Hz;  // harmonic, ascending; the load is load_Pa
  std::vector<HistoryPoint> history;   // transient: load in Pa against time
  double end_time_s = 0.0;
  int outputs = 1000;  // transient: equal intervals

  EffectChoices effects;              // what the plan may not decide itself
  double surface_energy_J_m2 = 0.02;  // of the pillars, which may stick together; PDMS
  // Set by the plan (array_plan.h): each pillar as if it stood alone; on a rigid base.
  bool feels_neighbours = true;
  bool feels_film = true;
  std::vector<std::string>
      wanted;  // results, with or without a pillar's number; empty: all cheap ones
  std::function<void(double)> progress;
};

// Throws SceneMistake naming what is missing or contradictory.
void validate(const ArrayScene& scene);

// One pillar of the row, a strip on a rigid base, without load.
Scene single_pillar(const ArrayScene& scene);

// What a scene may ask for, without the pillars' numbers (simulate_array()).
std::vector<std::string> result_names(const ArrayScene& scene);

// Answers the scene on meshes of rising degree as simulate() does for one pillar. Results of pillar
// i carry its number: centre_voltage_i and mean_voltage_i of a charge-free face,
// electrode_voltage_i and electrode_charge_i (shorted) of equipotential electrodes,
// midway_voltage_i between i and i + 1, top_displacement_i, and in per cent
//   coupling_percent_i        100 (V_midway/2)/V, V the mean of the two loaded neighbours' centres
//   crosstalk_percent_i       mean or electrode voltage of an unloaded pillar over that of the
//   loaded crosstalk_centre_percent_i  the same of the centres neighbours_percent_i      what the
//   other loaded pillars add to the centre (electrode) voltage deviation_percent_i       centre
//   (electrode) voltage beside that of a lone pillar on a wide film;
//                             only when wanted, for it is a second model
// Harmonic and transient analyses give, for each pillar, curves of its top's displacement and of
// its voltage (array_dynamics.h). Throws std::runtime_error if the finest mesh does not meet the
// tolerance.
SceneAnswer simulate_array(const ArrayScene& scene);

// The scene on one mesh, without mesh errors, and the meshes that simulate_array() goes through.
SceneAnswer array_answer_on(const ArrayScene& scene, const Discretisation& mesh);
std::vector<Discretisation> array_meshes(const ArrayScene& scene);
ArrayMedia media_of(const ArrayScene& scene);

// `points` are answered with the effects of their plans, on all cores; done(i, answer) is called
// one at a time, in the order in which they end. The first exception is thrown once all running
// ones have ended.
void simulate_arrays(const std::vector<ArrayScene>& points,
                     const std::function<void(std::size_t, const SceneAnswer&)>& done);

}  // namespace viscard
