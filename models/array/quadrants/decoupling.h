#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// Apparent loads of the pillars of an array, Pa: the loads that result if each pillar is read by
// its own four voltages alone. Maps true loads (pillars x loads) to apparent loads, linear and near
// the identity (eq. Q2).
using SeemingLoads = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& loads_Pa)>;

// True loads of the pillars from the apparent ones.
struct Decoupled {
  Eigen::MatrixXd loads_Pa;  // pillars x loads
  double residual =
      // Largest voltage, as load, that the solution leaves unexplained, over the largest one seen.
      0.0;
  int iterations = 0;
};

// Solves seeming(loads) = seen by GMRES without restarts: Saad & Schultz, SIAM J. Sci. Stat.
// Comput. 7 (1986) 856. Stops at the residual. Throws std::runtime_error if the neighbours'
// influence on the readings is so large that no solution is found.
Decoupled decouple(const SeemingLoads& seeming, const Eigen::MatrixXd& seen_Pa,
                   double residual = 1e-10);

// Amplification of noise for one pillar amid its neighbours, if the loads of many pillars are found
// together (eq. Q4).
struct NoiseGrowth {
  Eigen::VectorXd factor;  // by load: standard deviation over that of the pillar read alone
  double condition =
      1.0;  // of the matrix of apparent loads: largest singular value over the smallest
};
// From the dense matrix of a patch of pillars, loads of a pillar side by side; of the pillar at `index`. `gains` are loads x
// voltages of one pillar (quadrant_gains.h), whose noise is independent.
NoiseGrowth noise_growth(const Eigen::MatrixXd& seeming, const Eigen::MatrixXd& gains,
                         Eigen::Index index);

}  // namespace viscard
