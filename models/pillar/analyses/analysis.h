#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/effect_estimate.h"
#include "models/scene/common/error_control.h"
#include "models/scene/common/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

// What an analysis does with a body that nothing holds.
enum class FreeBottom {
  kRefused,  // the load would move the body away as a whole
  kPinned,   // needs a load that balances itself; one point is pinned
  kFloats    // rigid motions are left out of the answer
};

// The value that a history gives in time.
enum class HistoryOf { kNothing, kPressure, kShortening };

// One analysis of a pillar: what it needs, what it may be asked for, and its answer on one mesh.
// All other code reads this row and never asks which analysis it is. A new analysis is a drive
// (models/pillar/scene/*_drive.h), a file here and a row of the table in analysis.cpp; README.md
// has the recipe.
struct Analysis {
  const char* name;   // the word in a scene file
  PillarDrive drive;  // its alternative of the variant, with default values

  bool has_inertia = false;  // vibration: needs densities
  bool relaxes = false;      // uses the Prony series; the others use the instantaneous moduli
  bool bends = false;        // the answer is how the pillar bends, under any load
  HistoryOf history = HistoryOf::kNothing;
  FreeBottom free_bottom = FreeBottom::kRefused;
  double share_left = ErrorControl::kShareLeft;  // error_control.h

  // Throws std::invalid_argument naming what this analysis lacks.
  void (*check)(const PillarScene& scene) = nullptr;
  // Everything that may stand under [want]: the names of results, and of curves, which stand for
  // the results read off them.
  std::vector<std::string> (*result_names)(const PillarScene& scene) = nullptr;
  // Results, modes and curves without mesh errors, on `answer`, whose discretisation is set.
  void (*run)(const PillarScene& scene, SceneAnswer& answer) = nullptr;

  // The rest may be null.

  // Changes the answer once its errors are known.
  void (*finish)(const PillarScene& scene, SceneAnswer& answer) = nullptr;
  // Largest push on the top, Pa, that must stay below the buckling pressure; null: none does.
  double (*push_Pa)(const PillarScene& scene) = nullptr;
  // Pressure that the analysis itself finds, Pa; null: the load's.
  double (*found_pressure_Pa)(const PillarScene& scene) = nullptr;
  // The solution on a mesh, to be looked at; null: has no picture.
  std::vector<SectionGrid> (*fields)(const PillarScene& scene,
                                     const Discretisation& mesh) = nullptr;
  // Why the film's field must act back on its strain, if the potential is asked for; nullptr: it
  // need not. Without this function: voltages in time need both ways.
  const char* (*why_two_way)(const PillarScene& scene) = nullptr;

  // Estimates of effects that this analysis makes itself; `usual` is the estimate otherwise.
  using Estimate = EffectEstimate (*)(const PillarScene& scene, const EffectEstimate& usual);
  Estimate relaxation = nullptr;           // of a material that relaxes
  Estimate film_compliance = nullptr;      // of a film whose potential is not asked for
  Estimate geometric_stiffness = nullptr;  // usual: p/p_cr of the load, absent
};

const std::vector<Analysis>& analyses();
const Analysis& analysis_of(const PillarScene& scene);

// The pieces that the analyses share.
PillarMedia media_of(const PillarScene& scene);  // pillar with its instantaneous moduli
Motion axial_motion(const PillarScene& scene);
Motion lateral_motion(const PillarScene& scene);
ModelOptions options_of(const PillarScene& scene, Motion motion);
// On the answer's discretisation; the caller counts the unknowns of what it solves.
PillarModel model_of(const PillarScene& scene, Motion motion, const SceneAnswer& answer);
void count_unknowns(const PillarModel& model, SceneAnswer& answer);

// The rows of the table, each in its own file.
Analysis static_analysis();
Analysis modal_analysis();
Analysis buckling_analysis();
Analysis relaxation_analysis();
Analysis creep_analysis();
Analysis harmonic_analysis();
Analysis transient_analysis();

}  // namespace viscard
