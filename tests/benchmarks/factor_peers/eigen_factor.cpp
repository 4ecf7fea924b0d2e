#include "tests/benchmarks/factor_peers/peer_choice.h"

#include <Eigen/SparseCholesky>

namespace viscard::peers {
namespace {

class EigenFactor : public Factor {
 public:
  void analyse(const Sparse& lower) override { ldlt_.analyzePattern(lower); }
  bool factor(const Sparse& lower) override {
    ldlt_.factorize(lower);
    if (ldlt_.info() != Eigen::Success) return false;
    pivots_ = ldlt_.vectorD();
    return pivots_.allFinite() && (pivots_.array() != 0.0).all();
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const override {
    return ldlt_.solve(right_side);
  }
  Eigen::MatrixXd forward(const Eigen::MatrixXd& right_sides) const override {
    Eigen::MatrixXd x = ldlt_.permutationP() * right_sides;
    ldlt_.matrixL().solveInPlace(x);
    return x;
  }
  const Eigen::VectorXd& pivots() const override { return pivots_; }
  Eigen::Index entries() const override { return ldlt_.matrixL().nestedExpression().nonZeros(); }

 private:
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt_;
  Eigen::VectorXd pivots_;
};

}  // namespace

std::unique_ptr<Factor> eigen_factor() {
  return std::make_unique<EigenFactor>();
}

}  // namespace viscard::peers
