#pragma once

#include "tests/benchmarks/factor_peers/peer_choice.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>

#define VISCARD_FACTOR_IS_CHOSEN  // bench_factors.cpp checks that it was compiled with this header

namespace viscard {

// Stands in for the product's header of the same name when the pillar solver is compiled for
// bench_factors: the same class, which hands its work to the factorisation chosen at run time.
class SupernodalFactor {
 public:
  void analyse(const Eigen::SparseMatrix<double>& lower);
  bool factor(const Eigen::SparseMatrix<double>& lower);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  Eigen::MatrixXd forward(const Eigen::MatrixXd& right_sides) const;
  const Eigen::VectorXd& pivots() const { return chosen_->pivots(); }
  Eigen::Index entries() const { return chosen_->entries(); }

 private:
  std::shared_ptr<peers::Factor> chosen_;  // copies share it, so a shared one is not factored again
};

}  // namespace viscard
