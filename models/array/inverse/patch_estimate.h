#pragma once

#include "models/array/inverse/pillar_patches.h"
#include "models/array/inverse/read_array.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace viscard {

// What an estimate of the loads p keeps small besides what it leaves of the voltages, p^T L p (eq. I1).
enum class Penalty {
  kSize,   // L = 1
  kSlope,  // L = D^T D, D the differences between pillars that stand next to each other
};

// The estimate of the loads on one pillar, linear in the voltages under those around it (eq. I2). Loads x columns.
struct PillarEstimate {
  Eigen::MatrixXd gain_Pa_V;     // by pillar of the patch, then reading; 0 where nothing is read
  Eigen::VectorXd noise_Pa2_V2;  // variance per variance of each reading
  Eigen::VectorXd bias_Pa2_V2;   // of what the penalty takes away, per the same (eq. I3)
  Eigen::VectorXd disturbed_Pa2_Pa2;  // variance per variance of each disturbing load
  Eigen::MatrixXd
      share;  // of the same load on each pillar of the patch: a row of the resolution matrix (eq. I6)
};

// The equations of a pillar and those around it.
class PatchEquations {
 public:
  PatchEquations(OffsetKernels& kernels, std::span<const std::uint32_t> around, Penalty penalty);

  // Throws std::runtime_error if the readings do not determine the loads at this weight.
  PillarEstimate estimate(double weight) const;
  // The voltages under the pillar that the estimate explains, per reading of the patch: readings x columns.
  Eigen::MatrixXd explained(double weight) const;
  // Largest singular value of the readings over the smallest one.
  double condition() const;

 private:
  Eigen::MatrixXd solved(double weight, const Eigen::MatrixXd& right) const;

  Eigen::Index readings_, loads_;
  double scale_V_Pa_;
  Eigen::MatrixXd reads_, disturbs_;  // readings of the patch x loads of the patch, over the scale
  Eigen::MatrixXd gram_, penalty_;
};

}  // namespace viscard
