#pragma once

#include "models/material/material.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/scene/effect_choice.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/readout.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One pillar, what is done to it, and how well the answer must be known.
enum class AnalysisKind { kStatic, kRelaxation, kCreep, kHarmonic, kTransient, kModal, kBuckling };

// Where and which way the pillar is driven in harmonic and transient analyses.
enum class LoadPlace { kTop, kBase };
enum class LoadDirection { kAxial, kLateral };

struct Scene {
  double tolerance = 1e-3;  // relative error of the results
  PillarGeometry geometry;
  Material pillar;
  std::optional<Medium> film;
  std::optional<ElectrodeOptions> electrodes;
  PiezoMatrix film_charge_C_N = PiezoMatrix::Zero();
  std::optional<PlaneState> plane;  // a strip 1 m thick instead of a cylinder
  // Of the film, or of the pillar where it has none. Of a free body modes are told, without its
  // rigid motions, and how a voltage moves the top, seen from the middle of the bottom.
  bool fixed_bottom = true;

  AnalysisKind kind = AnalysisKind::kStatic;
  double pressure_Pa = 0.0;              // static; also the prestress of a modal analysis
  std::optional<double> displacement_m;  // static: of the top along +z (sideways +x); no pressure
  bool plate_on_top = false;  // buckling: pressed by a rigid frictionless plate that stays level
  int modes = 4;              // per family
  std::vector<HistoryPoint> history;  // creep: pressure in Pa; relaxation: shortening in m

  std::vector<std::string> wanted;               // names of results; empty: all
  std::optional<Discretisation> discretisation;  // finest mesh; none: the tolerance decides
  EffectChoices effects;                         // what the plan may not decide itself
  // Set by the plan (plan.h) for effects that are left out or insisted on:
  double condense_pressures_from = kNearlyIncompressible;  // Poisson ratio
  bool one_way_potential = false;  // the film's potential follows its strain and does not act back

  // Harmonic and transient: pressure (axial) or shear (lateral) on the top, pressure_Pa or history
  // in Pa; or the base shaken, base_acceleration_m_s2 or history in m/s^2.
  LoadPlace load_place = LoadPlace::kTop;
  LoadDirection direction = LoadDirection::kAxial;
  double base_acceleration_m_s2 = 0.0;
  std::vector<double> frequencies_Hz;  // harmonic, ascending
  double end_time_s = 0.0;             // transient
  int outputs = 1000;                  // transient: equal intervals
  double drive_V = 0.0;                // static: voltage put on the electrode (actuator)
  std::optional<Readout> readout;      // what the electrode is wired to; none: open circuit

  std::function<void(double)> progress;  // called with the fraction done; may be empty
};

struct SceneResult {
  std::string name;
  double value = 0.0;
  std::string unit;
  double error_estimate = 0.0;  // absolute, in the unit
  double scale = 0.0;           // the error is judged against this where |value| is smaller
  bool is_wanted = true;        // false: not asked for, and its error not watched
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
  double estimate = 0.0;  // relative error of leaving it out
  std::string number;     // what decides, and its value
  double value = 0.0;
  bool is_forced = false;   // by the scene
  bool is_counted = false;  // left out, and its estimate is part of the reported error
};

// A quantity against time or frequency. Curves of one scene share their abscissa from mesh to mesh.
struct SceneCurve {
  std::string name;  // of the second column
  std::string unit;
  std::vector<double> x;
  std::vector<double> value;
  std::string x_name = "time_s";
  std::vector<double> error;    // estimate at each point, in the unit
  std::vector<double> allowed;  // size at each point that the tolerance refers to; empty: the peak
  bool is_watched = true;       // false: derived from a watched one, with its error set by it
};

struct SceneAnswer {
  std::vector<SceneResult> results;
  std::vector<SceneMode> modes;
  std::vector<SceneEffect> effects;
  std::vector<SceneCurve> curves;
  std::vector<std::string> notes;  // what a reader should know, plain sentences
  Discretisation discretisation;   // that met the tolerance
  int unknowns = 0;                // largest system
  double largest_relative_error = 0.0;
  double step_error = 0.0;  // relative, of time steps and reduced bases; part of the errors above
};

// Throws std::invalid_argument naming what is missing or contradictory.
void validate(const Scene& scene);

// Throws SceneMistake if the largest pressure would buckle the pillar: by its own buckling pressure
// on a coarse mesh where Euler's formula comes near, for a strip by Engesser's formula (eq. E6). A
// straight answer has no meaning there, unless the scene forces geometric_stiffness off.
void refuse_beyond_buckling(const Scene& scene);

// Answers the scene (analysis.h) on meshes of rising degree and grading until every result meets
// the tolerance (error_control.h). Throws std::runtime_error, with the reason, when the finest mesh
// does not, or the pillar would buckle under the load.
SceneAnswer simulate(const Scene& scene);

}  // namespace viscard
