#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// What every pillar of an array seems to bear, Pa, where each is read by its own four voltages alone, if the pillars
// bear these loads: pillars x loads to pillars x loads, linear, near the identity (eq. Q2).
using SeemingLoads = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& loads_Pa)>;

// Loads of the pillars from what they seem to bear.
struct Decoupled {
  Eigen::MatrixXd loads_Pa;  // pillars x loads
  double residual =
      0.0;  // largest voltage, as load, that the loads leave unexplained, over the largest that was seen
  int iterations = 0;
};

// Solves seeming(loads) = seen by GMRES without restarts: Saad & Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856. Stops
// at the residual; throws std::runtime_error where the neighbours are read so much that no solution is found.
Decoupled decouple(const SeemingLoads& seeming, const Eigen::MatrixXd& seen_Pa,
                   double residual = 1e-10);

// How noise grows where the loads of many pillars are found together (eq. Q4), of one pillar amid its neighbours.
struct NoiseGrowth {
  Eigen::VectorXd factor;  // by load: standard deviation over that of the pillar read alone
  double condition =
      1.0;  // of the matrix of seeming loads, its largest singular value over the smallest
};
// From the dense matrix of a patch of pillars, loads of a pillar side by side; of the pillar at `index`. `gains` are loads x
// voltages of one pillar (quadrant_gains.h), whose noise is independent.
NoiseGrowth noise_growth(const Eigen::MatrixXd& seeming, const Eigen::MatrixXd& gains,
                         Eigen::Index index);

}  // namespace viscard
