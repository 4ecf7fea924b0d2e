#include "models/pillar/krylov_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

// Rounding in a stiff system (a slender body, a stiff volume) may hold residuals above the
// tolerance. Values whose residual is below this, so that their own error is below its square, and
// that have stopped moving, are taken.
constexpr double kSettledResidual = 1e-4;
constexpr double kSettledChange = 1e-11;

bool is_settled(const EigenPairs& now, const EigenPairs& before) {
  return now.residual <= kSettledResidual && before.values.size() == now.values.size() &&
         ((now.values - before.values).array().abs() <= kSettledChange * now.values.array().abs())
             .all();
}

// Grows a B-orthonormal basis and keeps what has been applied to it.
class KrylovSpace {
 public:
  KrylovSpace(const PencilMap& op, const LinearMap& B, int size, int capacity)
      : op_(op),
        B_(B),
        basis_(size, capacity),
        B_basis_(size, capacity),
        image_(size, capacity),
        projected_(Eigen::MatrixXd::Zero(capacity, capacity)) {}

  int count() const { return count_; }

  // Adds the part of v that is new; false if there is none.
  bool add(Eigen::VectorXd v) {
    if (count_ == basis_.cols()) return false;
    double removed = 0.0;                   // square of the B norm of what is not new
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Kahan; Parlett 1980, 6.9)
      if (count_ == 0) break;
      const Eigen::VectorXd known = B_basis_.leftCols(count_).transpose() * v;
      v -= basis_.leftCols(count_) * known;
      removed += known.squaredNorm();
    }
    Eigen::VectorXd Bv = B_(v);
    const double norm = std::sqrt(std::max(v.dot(Bv), 0.0));
    if (!(norm > 1e-12 * std::sqrt(removed)) || !std::isfinite(norm)) return false;
    basis_.col(count_) = v / norm;
    B_basis_.col(count_) = Bv / norm;
    image_.col(count_) = op_(basis_.col(count_), B_basis_.col(count_));
    ++count_;
    const Eigen::VectorXd column = B_basis_.leftCols(count_).transpose() * image_.col(count_ - 1);
    projected_.col(count_ - 1).head(count_) = column;
    projected_.row(count_ - 1).head(count_) = column.transpose();
    return true;
  }
  Eigen::VectorXd image(int column) const { return image_.col(column); }

  // The `wanted` largest Ritz pairs; converged when every residual is small beside its value.
  EigenPairs ritz(int wanted, double tolerance) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        projected_.topLeftCorner(count_, count_));
    const int n = std::min(wanted, count_);
    EigenPairs pairs;
    pairs.values = solver.eigenvalues().tail(n).reverse();
    const Eigen::MatrixXd coefficient = solver.eigenvectors().rightCols(n).rowwise().reverse();
    pairs.vectors = basis_.leftCols(count_) * coefficient;
    if (n < wanted) return pairs;
    pairs.residual = 0.0;
    for (int i = 0; i < n && pairs.residual <= kSettledResidual; ++i) {
      const Eigen::VectorXd residual =
          image_.leftCols(count_) * coefficient.col(i) - pairs.values[i] * pairs.vectors.col(i);
      const double size = std::sqrt(std::abs(residual.dot(B_(residual))));
      pairs.residual = std::max(pairs.residual, size / std::abs(pairs.values[i]));
    }
    pairs.converged = pairs.residual <= tolerance;
    return pairs;
  }

 private:
  const PencilMap& op_;
  const LinearMap& B_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd B_basis_;
  Eigen::MatrixXd image_;
  Eigen::MatrixXd projected_;
  int count_ = 0;
};

}  // namespace

EigenPairs largest_eigenpairs(const LinearMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options) {
  const PencilMap of_both = [&op](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return op(x);
  };
  return largest_eigenpairs(of_both, B, size, count, options);
}

EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options) {
  if (count < 1 || count > size) {
    throw std::invalid_argument(std::to_string(count) + " modes asked of a system of " +
                                std::to_string(size) + " unknowns");
  }
  std::mt19937_64 random(1);  // a fixed start: the same answer every time
  std::normal_distribution<double> normal;
  KrylovSpace space(op, B, size, std::min(options.largest_space, size));
  const auto add_random = [&] {
    Eigen::VectorXd start(size);
    for (double& x : start) x = normal(random);
    return space.add(
        op(start, B(start)));  // op first: the start then has no part outside its range
  };
  for (int i = 0; i < options.block; ++i) add_random();
  int next = 0;  // first column whose image is not yet in the space
  int next_check = 2 * count + 4;
  EigenPairs pairs;
  while (!pairs.converged) {
    bool grew = false;
    const int end = space.count();
    for (; next < end; ++next) grew = space.add(space.image(next)) || grew;
    const bool is_full = !grew && !add_random();
    if (space.count() >= next_check || is_full) {
      const EigenPairs before = std::move(pairs);
      pairs = space.ritz(count, options.tolerance);
      pairs.converged = pairs.converged || is_settled(pairs, before);
      next_check = space.count() + std::max(2 * options.block, count / 2);
      if (is_full) break;
    }
  }
  return pairs;
}

}  // namespace viscard
