#pragma once

#include "models/pillar/time/transient_request.h"
#include "models/pillar/time/viscoelastic_system.h"

namespace viscard {

// Runs from rest. Rows of `observers` are linear outputs. Bodies whose stiffness relaxes all alike
// are answered exactly (modal_response.h), others by steps.
TransientResult run_transient(const ViscoelasticSystem& small, const TransientRequest& request,
                              const Eigen::MatrixXd& observers);

// By steps: all are halved until the extrapolated answer (Richardson, fourth order) changes by less
// than the tolerance.
TransientResult run_by_steps(const ViscoelasticSystem& small, const TransientRequest& request,
                             const Eigen::MatrixXd& observers);

}  // namespace viscard
