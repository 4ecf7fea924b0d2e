#pragma once

#include "models/pillar/time/transient_request.h"
#include "models/pillar/time/viscoelastic_system.h"

namespace viscard {

// Runs from rest. Rows of `observers` are linear outputs. A body whose whole stiffness relaxes with
// one relative modulus is solved exactly (modal_response.h), any other by time steps.
TransientResult run_transient(const ViscoelasticSystem& small, const TransientRequest& request,
                              const Eigen::MatrixXd& observers);

// Runs by time steps. All steps are halved until the extrapolated answer (Richardson, fourth order)
// changes by less than the tolerance.
TransientResult run_by_steps(const ViscoelasticSystem& small, const TransientRequest& request,
                             const Eigen::MatrixXd& observers);

}  // namespace viscard
