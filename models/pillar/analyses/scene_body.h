#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/readout.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace viscard {

// A linear output of a scene's body: row.u for unknowns u.
struct BodyOutput {
  std::string name;
  std::string unit;
  Eigen::VectorXd row;
};

// One scene on one mesh as a viscoelastic body: matrices, the unit force on its top (1 N), and its
// outputs. The first output is the displacement of the top; with electrodes comes the
// open-circuit voltage, or the potential at the centre of a charge-free face; sideways the charge
// of a shorted quadrant, or its mean voltage on a charge-free face.
struct SceneBody {
  std::unique_ptr<PillarModel> model;
  ViscoelasticSystem system;
  std::vector<BodyOutput> outputs;
};

struct SceneBodyOptions {
  bool rigid_top = false;
  bool with_mass = false;
};
SceneBody body_of(const PillarScene& scene, Motion motion, const SceneBodyOptions& options,
                  SceneAnswer& answer);

// What follows an output behind that of the top through a filter: the output itself, whose film may
// lose (eq. 37), and the reading of the circuit on the electrode (a quadrant's charge).
struct BodyReading {
  std::size_t output = 1;
  std::string name;
  std::string unit;
  ReadoutFilter filter = {};
  // Relative: its charge is taken as that without losses of the film (permittivity_change()).
  double film_error = 0.0;
};
// Adds the circuit's time constant and the electrode's capacitance to the results.
std::vector<BodyReading> readings_of(const PillarScene& scene, const SceneBody& body,
                                     SceneAnswer& answer);
// Adds the error of the film to all that is called as the reading is.
void note_film_error(const BodyReading& reading, SceneAnswer& answer);

}  // namespace viscard
