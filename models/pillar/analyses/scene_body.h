#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

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

// Filter between the electrode's open-circuit voltage (a quadrant's charge) and the reading; adds
// time constant and capacitance to the results. Only with an electrode and a readout.
ReadoutFilter readout_of(const PillarScene& scene, const SceneBody& body, SceneAnswer& answer);

}  // namespace viscard
