#pragma once

#include "models/maths/offset_sums.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace viscard {

// Sums over points of a kernel of their offsets that ends at a reach: sum_j K_kind(j)(x_i - x_j) f_j over the points
// no farther than it. Points may stand anywhere; offsets that repeat, as in a lattice, are asked for once.
class NearSums {
 public:
  // Sums of the points that act; the others only read. Kernels are readings x loads.
  NearSums(const std::vector<SourcePoint>& points, const std::vector<bool>& acts, double reach_m,
           const OffsetSums::Kernel& kernel);

  // Loads by point (points x loads) to readings by point. Loads of points that do not act are left out.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& loads) const;

 private:
  struct Pair {
    std::uint32_t from, to, kernel;
  };
  std::vector<Pair> pairs_;
  std::vector<Eigen::MatrixXd> kernels_;
  Eigen::Index readings_ = 0;
};

}  // namespace viscard
