#pragma once

#include "models/material.h"
#include "models/pillar/load_history.h"
#include "models/pillar/piezo_static.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One pillar, what is done to it, and how well the answer must be known.
enum class AnalysisKind { kStatic, kRelaxation, kCreep, kModal, kBuckling };

struct Scene {
  double tolerance = 1e-3;  // relative error of the results
  PillarGeometry geometry;
  Material pillar;
  std::optional<Medium> film;
  std::optional<ElectrodeOptions> electrodes;
  PiezoMatrix film_charge_C_N = PiezoMatrix::Zero();
  std::optional<PlaneState> plane;  // a strip 1 m thick instead of a cylinder

  AnalysisKind kind = AnalysisKind::kStatic;
  double pressure_Pa = 0.0;           // static; also the prestress of a modal analysis
  int modes = 4;                      // per family
  std::vector<HistoryPoint> history;  // creep: pressure in Pa; relaxation: shortening in m
};

struct SceneResult {
  std::string name;
  double value = 0.0;
  std::string unit;
  double error_estimate = 0.0;  // absolute, in the unit
};

struct SceneMode {
  std::string family;
  int harmonic = 0;
  double frequency_Hz = 0.0;
  double error_estimate = 0.0;  // Hz
};

struct SceneEffect {
  std::string name;
  bool on = false;
  std::string reason;
};

struct SceneCurve {
  std::string name;  // of the second column
  std::string unit;
  std::vector<double> time_s;
  std::vector<double> value;
};

struct SceneAnswer {
  std::vector<SceneResult> results;
  std::vector<SceneMode> modes;
  std::vector<SceneEffect> effects;
  std::vector<SceneCurve> curves;
  Discretisation discretisation;  // that met the tolerance
  int unknowns = 0;               // largest system
  double largest_relative_error = 0.0;
};

// Throws std::invalid_argument naming what is missing or contradictory.
void validate(const Scene& scene);

// Answers the scene on meshes of rising degree and grading until every result changes by less than
// the tolerance; the change is the error estimate. Throws std::runtime_error, with the reason, when
// the finest mesh does not meet it, or the pillar would buckle under the load.
SceneAnswer simulate(const Scene& scene);

}  // namespace viscard
