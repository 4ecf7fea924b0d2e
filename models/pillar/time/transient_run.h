#pragma once

#include "models/pillar/time/load_history.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// A load whose factor varies in time.
struct TransientRequest {
  Eigen::VectorXd load;  // of the small body; multiplied by the factor
  Course history;        // the factor
  double end_s = 0.0;
  int outputs = 1000;         // equal intervals between outputs
  double first_step_s = 0.0;  // longest step of the coarsest level
  double tolerance = 1e-4;    // relative to the largest value of each output
  int most_steps = 4000000;

  double spacing_s() const { return end_s / outputs; }
};

// One interval without corners of the load: length, and load factors at its ends, linear between.
struct TransientPiece {
  double length_s = 0.0;
  double first = 0.0;
  double last = 0.0;
  bool ends_with_output = false;
};
// Pieces from 0 to the end. They end at the outputs and at the corners of the load.
std::vector<TransientPiece> pieces_of(const TransientRequest& request);

// Outputs and their rates at the ends of all pieces, from 0: at outputs and corners of the load.
struct TransientMotion {
  std::vector<double> time_s;
  Eigen::MatrixXd values, rates;  // observers x times
};

struct TransientResult {
  std::vector<double> time_s;  // outputs + 1 equal steps from 0
  Eigen::MatrixXd values;      // observers x times
  TransientMotion motion;
  double error_estimate = 0.0;  // relative to the largest value of each output
  bool converged = false;
  int steps = 0;  // all levels together
};
// A motion with the times of the pieces, all values 0.
TransientMotion empty_motion(const std::vector<TransientPiece>& pieces, Eigen::Index observers);
// Takes the values at the outputs from the motion.
TransientResult result_of(const TransientRequest& request,
                          const std::vector<TransientPiece>& pieces, TransientMotion motion);

// Runs from rest. Rows of `observers` are linear outputs. A body whose whole stiffness relaxes with
// one relative modulus is solved by its modes (modal_response.h), any other by the exponential of
// its matrix, or by time steps if that matrix would be too large. Modes and exponential are exact.
TransientResult run_transient(const ViscoelasticSystem& small, const TransientRequest& request,
                              const Eigen::MatrixXd& observers);

// Runs a body that nothing holds: its rigid motions are the load over their masses, integrated twice
// exactly, and its other unknowns, which they do not meet, are run as a body of their own.
TransientResult run_floating(const ViscoelasticSystem& small, const TransientRequest& request,
                             const Eigen::MatrixXd& observers);

// The part of a small body that its rigid motions do not meet.
ViscoelasticSystem without_rigid_motions(const ViscoelasticSystem& small);

// Runs by the matrix exponential over the interval between outputs (state_transition.h).
TransientResult run_exactly(const ViscoelasticSystem& small, const TransientRequest& request,
                            const Eigen::MatrixXd& observers);

// Runs by time steps. All steps are halved until the extrapolated answer (Richardson, fourth order)
// changes by less than the tolerance.
TransientResult run_by_steps(const ViscoelasticSystem& small, const TransientRequest& request,
                             const Eigen::MatrixXd& observers);

}  // namespace viscard
