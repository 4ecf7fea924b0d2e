#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/plane/array_scene.h"
#include "models/array/plane/array_transfer.h"

#include <string>
#include <vector>

namespace viscard {

// One analysis of a row of pillars: what it needs, which results it offers, and its answer on one
// mesh. All other code reads this row and never asks which analysis it is (README.md).
struct ArrayAnalysis {
  const char* name;  // the word in a scene file
  RowDrive drive;    // its alternative of the variant, with default values

  bool has_inertia = false;  // vibration: needs densities
  bool relaxes = false;      // in time or frequency, with the Prony series
  bool is_loaded = true;     // false: free vibration

  void (*check)(const ArrayScene& scene) = nullptr;  // throws SceneMistake; may be null
  std::vector<std::string> (*result_names)(const ArrayScene& scene) = nullptr;
  SceneAnswer (*run)(const ArrayScene& scene, const Discretisation& mesh) = nullptr;
  // Throws std::runtime_error for an answer that no mesh improves enough; may be null.
  void (*check_answer)(const ArrayScene& scene, const SceneAnswer& answer) = nullptr;
  // The drive of each pillar alone if the plan leaves the film out; null: the plan never does.
  PillarDrive (*alone)(const ArrayScene& scene) = nullptr;
};

const std::vector<ArrayAnalysis>& array_analyses();
const ArrayAnalysis& analysis_of(const ArrayScene& scene);

// True if the scene asks for more than the motion of the tops, and the film has potentials.
bool asks_for_voltages(const ArrayScene& scene);

// The rows of the table, each in its own file.
ArrayAnalysis array_static_analysis();
ArrayAnalysis array_modal_analysis();
ArrayAnalysis array_harmonic_analysis();
ArrayAnalysis array_transient_analysis();

// Throw SceneMistake: for a pressure beyond buckling, under `key`; for a load that is zero or
// beyond buckling.
void check_pressure(const ArrayScene& scene, double pressure_Pa, const char* key);
void check_load(const ArrayScene& scene);

// The row on a mesh; without neighbours, one of its pillars alone.
ArrayModel model_of(const ArrayScene& scene, const Discretisation& mesh,
                    const PillarPorts& extra = {});

// The parts that harmonic and transient analyses of a row share. Outputs are those of
// ArrayTransfer: the tops, then the voltages.

// Number of modes of each pillar in use. It rises with the mesh, so that the change from mesh to
// mesh contains the contribution of the modes left out. For a sweep: about twice the modes of the
// rod and of the shear beam below its highest frequency; 0: no such frequency.
int modes_for(const ArrayScene& scene, const Discretisation& mesh, double highest_Hz);

// Relative error of a film without inertia: (f/f_film)^2 of its motion, f_film = c_s/(4 t) (eq.
// A2). It applies to a voltage in full, to the displacement of a top only in the film's share.
// Refused above the tolerance.
double film_error(const ArrayScene& scene, const ArrayTransfer& transfer, double frequency_Hz);
// Lets the film lose, and the relative error of a voltage that this makes (bonded_port()).
void let_film_lose(const ArrayScene& scene, ArrayTransfer& transfer);
double film_loss_error(const ArrayScene& scene, const ArrayTransfer& transfer);
// Throws with what the film's inertia may change and the way out; no mesh reduces that error.
void refuse_moving_film(const ArrayScene& scene, double error, const std::string& what,
                        const std::string& instead);

std::vector<int> loaded_of(const ArrayScene& scene);  // 0-based
std::string name_of(const ArrayScene& scene, Eigen::Index output);

// The results that a row in time or frequency may be asked for.
std::vector<std::string> names_in_time(const ArrayScene& scene);

}  // namespace viscard
