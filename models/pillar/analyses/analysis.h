#pragma once

#include "models/answer/effect_estimate.h"
#include "models/answer/error_control.h"
#include "models/answer/scene_answer.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/scene/pillar_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace viscard {

// How an analysis treats a body with a free bottom.
enum class FreeBottom {
  kRefused,  // the load would move the body away as a whole
  kPinned,   // needs a load that balances itself; one point is pinned
  kFloats,   // rigid motions are left out of the answer
  kMoves     // the load moves the body as a whole, and only its mass resists
};

// The value that a history gives in time.
enum class HistoryOf { kNothing, kPressure, kShortening };

// Geometric stiffness weights the squares of gradients by a stress that is itself singular. If
// displacements grow as r^lambda, the error of the displacements falls as r^(2 lambda), but that of
// the geometric stiffness only as r^(3 lambda - 1). lambda is 0.60 at a bonded rim for nu -> 0.5
// (Williams, J. Appl. Mech. 19 (1952) 526) and 0.7 at 0.33, so a layer of ratio 0.15 leaves up to
// 0.23 of the error (share_left of error_control.h).
constexpr double kShareLeftOfStress = 0.3;

// One analysis of a pillar: what it needs, which results it offers, and its answer on one mesh. All
// other code reads this row and never asks which analysis it is. README.md explains how to add one.
struct Analysis {
  const char* name;   // the word in a scene file
  PillarDrive drive;  // its alternative of the variant, with default values

  bool has_inertia = false;    // vibration: needs densities
  bool relaxes = false;        // uses the Prony series; the others use the instantaneous moduli
  bool bends = false;          // the answer is how the pillar bends, under any load
  bool load_stays = false;     // a pressure on the top may stay until the pillar buckles in creep
  bool follows_creep = false;  // the time at which that happens limits the history
  // The lowest frequency of an oscillating load; null: the load does not oscillate.
  double (*swings_from_Hz)(const PillarScene& scene) = nullptr;
  HistoryOf history = HistoryOf::kNothing;
  FreeBottom free_bottom = FreeBottom::kRefused;
  bool weighs_stress = false;    // uses the geometric stiffness of a stress: kShareLeftOfStress
  bool weighs_pressure = false;  // does so if a pressure acts on the top

  // Throws std::invalid_argument naming what this analysis lacks.
  void (*check)(const PillarScene& scene) = nullptr;
  // Everything that may stand under [want]: the names of results, and the names of curves. A
  // curve's name also selects the results read off it.
  std::vector<std::string> (*result_names)(const PillarScene& scene) = nullptr;
  // Results, modes and curves without mesh errors, on `answer`, whose discretisation is set.
  void (*run)(const PillarScene& scene, SceneAnswer& answer) = nullptr;

  // The following members may be null.

  // Largest push on the top, Pa, that must stay below the buckling pressure; null: none does.
  double (*push_Pa)(const PillarScene& scene) = nullptr;
  // Pressure that the analysis itself finds, Pa; null: the load's.
  double (*found_pressure_Pa)(const PillarScene& scene) = nullptr;
  // The solution on a mesh, for pictures; null: has no picture.
  std::vector<SectionGrid> (*fields)(const PillarScene& scene,
                                     const Discretisation& mesh) = nullptr;
  // The pillars whose solutions or modes give answers to first order in all that differs, on a mesh; null
  // or an empty list: this analysis or scene has no such answers.
  NearbyPillars (*solve_nearby)(const PillarScene& scene, const Discretisation& mesh) = nullptr;
  // The reason why the field must act back on the film's strain if the potential is asked for, or
  // nullptr if it need not. Without this function it must, because voltages in time need it.
  const char* (*why_two_way)(const PillarScene& scene) = nullptr;

  // A clause that says why a scene with a law of rubber is not answered at large strain, or nullptr
  // if it is. Without this function none is.
  const char* (*why_small_strain)(const PillarScene& scene) = nullptr;

  // Estimates of effects that this analysis makes itself; `usual` is the estimate otherwise.
  using Estimate = EffectEstimate (*)(const PillarScene& scene, const EffectEstimate& usual);
  Estimate relaxation = nullptr;           // of a material that relaxes
  Estimate film_compliance = nullptr;      // of a film whose potential is not asked for
  Estimate geometric_stiffness = nullptr;  // usual: p/p_cr of the load, absent
};

const std::vector<Analysis>& analyses();
const Analysis& analysis_of(const PillarScene& scene);

// The pieces that the analyses share.

// Names of results in time or frequency, each followed by the same with every ending: the motion of
// the top (`first`), then the voltages or charges of the film.
std::vector<std::string> moving_names(const PillarScene& scene, const std::string& first,
                                      const std::vector<std::string>& endings);
PillarMedia media_of(const PillarScene& scene);  // pillar with its instantaneous moduli
Motion axial_motion(const PillarScene& scene);
Motion lateral_motion(const PillarScene& scene);
ModelOptions options_of(const PillarScene& scene, Motion motion);
// model_of() and electric_model_of() do not count unknowns; the caller does.
PillarModel model_of(const PillarScene& scene, Motion motion, const Discretisation& mesh);
PillarModel electric_model_of(const PillarScene& scene, Motion motion, const Discretisation& mesh);
// The nearby pillar in a family of motion; null unless the scene is answered to first order.
const NearbyPillar* nearby_of(const PillarScene& scene, Motion motion, bool is_electric,
                              NearbyRole role = NearbyRole::kAnswers);
// The same with all that first-order answers need, not solved.
std::unique_ptr<NearbyPillar> nearby_model_of(const PillarScene& scene, Motion motion,
                                              const Discretisation& mesh);
std::unique_ptr<NearbyPillar> nearby_electric_model_of(const PillarScene& scene, Motion motion,
                                                       const Discretisation& mesh);
void count_unknowns(const PillarModel& model, SceneAnswer& answer);
// Spectrum of a curve over equally spaced times, without its last point.
SceneCurve spectrum_of(const SceneCurve& curve);
// Adds the readout's time constant to the results, unless it is infinite.
void add_time_constant(double time_constant_s, SceneAnswer& answer);

// A solid that relaxes in every deformation at least as much as this one does in any deformation:
// each term has the larger of its shear and bulk parts. Relative to E_0.
PronySeries largest_relaxation(const Material& material);
// First axial frequency of the pillar as a rod that is clamped at one end, Hz (eq. E7).
double first_rod_frequency_Hz(const PillarScene& scene);

// The rows of the table, each in its own file.
Analysis static_analysis();
Analysis modal_analysis();
Analysis buckling_analysis();
Analysis relaxation_analysis();
Analysis creep_analysis();
Analysis harmonic_analysis();
Analysis transient_analysis();

// The traction at the bond is not uniform, so that the film yields a little more than under a
// uniform one; the largest such factor seen over random scenes is 1.3 (tests/models/scene).
inline constexpr double kUnevenTraction = 1.5;

struct FilmElasticity {
  double young_Pa = 0.0, shear_Pa = 0.0, nu = 0.0;  // of the most compliant direction
};
FilmElasticity elasticity_of(const Medium& film);

// Share of the deflection under each kind of load that the film adds to the pillar's own (eq. E1).
struct FilmShares {
  double axial = 0.0, bending = 0.0, shear = 0.0, torsion = 0.0;
  double lateral() const { return 2.0 * bending + shear; }
};
FilmShares film_shares(const PillarScene& scene);

}  // namespace viscard
