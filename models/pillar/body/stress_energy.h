#pragma once

#include "models/pillar/body/pillar_model.h"

namespace viscard {

// The work of a stress on motions, v' K_sigma v (eq. 21), without its matrix. The stress is that of an axial
// model under a pressure on its top.
class StressEnergy {
 public:
  // Solves the axial model, which must outlive this.
  explicit StressEnergy(const PillarModel& axial);
  // Of a motion of a model with the same mesh, in J for a motion in m, per Pa of pressure.
  double per_Pa(const PillarModel& model, const Eigen::VectorXd& motion) const;

 private:
  const PillarModel& axial_;
  PillarState state_;
};

// The stress (Voigt) as a form of the nine gradients of kinematics().gradient.
Eigen::MatrixXd gradient_form(const Eigen::VectorXd& stress);

}  // namespace viscard
