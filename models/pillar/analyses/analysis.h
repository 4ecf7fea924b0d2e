#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/scene.h"

namespace viscard {

// One analysis of a scene: what it needs, and its answer on one mesh. A new analysis is a new file
// and a new row of the table in analysis.cpp.
struct Analysis {
  AnalysisKind kind;
  const char* name;  // the word in a scene file
  bool has_inertia;
  bool relaxes;  // uses the Prony series; the others use the instantaneous moduli
  // Throws std::invalid_argument naming what this analysis lacks.
  void (*check)(const Scene& scene);
  // Results, modes and curves without mesh errors, on `answer`, whose discretisation is set.
  void (*run)(const Scene& scene, SceneAnswer& answer);
};

const std::vector<Analysis>& analyses();
const Analysis& analysis_of(AnalysisKind kind);

// The pieces the analyses share.
PillarMedia media_of(const Scene& scene);  // pillar with its instantaneous moduli
Motion axial_motion(const Scene& scene);
ModelOptions options_of(const Scene& scene, Motion motion);
// On the answer's discretisation; the caller counts the unknowns of what it solves.
PillarModel model_of(const Scene& scene, Motion motion, const SceneAnswer& answer);
void count_unknowns(const PillarModel& model, SceneAnswer& answer);

// The families of motion a modal analysis answers, and the modes of one on a model of it.
struct ModeFamily {
  const char* name;
  Motion motion;
  int harmonic;
};
std::vector<ModeFamily> mode_families(const Scene& scene);
std::vector<PillarMode> family_modes(const Scene& scene, const ModeFamily& family,
                                     const PillarModel& model, const SceneAnswer& on_mesh);

// The rows of the table.
void check_static(const Scene& scene);
void run_static(const Scene& scene, SceneAnswer& answer);
// Under a shear on the top (LoadDirection::kLateral).
bool is_sideways(const Scene& scene);
PillarModel sideways_model(const Scene& scene, const SceneAnswer& on_mesh);
PillarState sideways_state(const Scene& scene, const PillarModel& model);
void check_sideways(const Scene& scene);
// The same load in time or frequency: whether an electrode in quadrants reads it.
bool reads_quadrants(const Scene& scene);
void check_sideways_in_time(const Scene& scene);
void run_sideways(const Scene& scene, SceneAnswer& answer);
void check_modal(const Scene& scene);
void run_modal(const Scene& scene, SceneAnswer& answer);
void check_buckling(const Scene& scene);
void run_buckling(const Scene& scene, SceneAnswer& answer);
void check_history(const Scene& scene);
void run_creep_or_relaxation(const Scene& scene, SceneAnswer& answer);
void check_harmonic(const Scene& scene);
void run_harmonic(const Scene& scene, SceneAnswer& answer);
void check_transient(const Scene& scene);
void run_transient_scene(const Scene& scene, SceneAnswer& answer);

}  // namespace viscard
