#include "models/pillar/system/krylov_modes.h"

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

// A B-orthonormal basis, op projected on it, and what op brought forth outside of it: the next
// block. Residuals of Ritz pairs lie in that block alone, so that they cost no products.
class KrylovSpace {
 public:
  KrylovSpace(const PencilMap& op, const LinearMap& B, int size, int capacity)
      : op_(op), B_(B), capacity_(capacity), basis_(size, 0), B_basis_(size, 0) {}

  int count() const { return count_; }
  bool has_room(int columns) const { return count_ + columns <= capacity_; }

  // Takes the next block into the basis and applies op to it; false if nothing in it is new.
  bool grow() {
    const int before = count_;
    for (Eigen::Index i = 0; i < outside_.cols(); ++i)
      take(outside_.col(i), B_outside_.col(i), size_before_[i], before);
    apply_from(before);
    return count_ > before;
  }
  // The same with vectors of one's own.
  bool grow(const Eigen::MatrixXd& vectors) {
    const int before = count_;
    for (const auto& column : vectors.colwise()) {
      Eigen::VectorXd v = column;
      const double removed = orthogonalise(v);
      const Eigen::VectorXd Bv = B_(v);
      take(v, Bv, std::hypot(removed, norm(v, Bv)), before);
    }
    apply_from(before);
    return count_ > before;
  }

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
    const Eigen::MatrixXd gram = outside_.transpose() * B_outside_;
    const auto last = coefficient.bottomRows(outside_.cols());
    const Eigen::VectorXd square = (last.transpose() * gram * last).diagonal();
    pairs.residual =
        (square.cwiseAbs().cwiseSqrt().array() / pairs.values.array().abs()).maxCoeff();
    pairs.converged = pairs.residual <= tolerance;
    return pairs;
  }

 private:
  static double norm(const Eigen::VectorXd& v, const Eigen::VectorXd& Bv) {
    return std::sqrt(std::max(v.dot(Bv), 0.0));
  }

  // Removes what is known; returns its B norm.
  double orthogonalise(Eigen::VectorXd& v) const {
    double removed = 0.0;
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Kahan; Parlett 1980, 6.9)
      const Eigen::VectorXd known = B_basis_.leftCols(count_).transpose() * v;
      v.noalias() -= basis_.leftCols(count_) * known;
      removed += known.squaredNorm();
    }
    return std::sqrt(removed);
  }

  // Adds the part of v that is new; v is orthogonal to the columns before its block. `size` is that
  // of the vector v is a remainder of: what is left of it by rounding alone is nothing new.
  void take(Eigen::VectorXd v, Eigen::VectorXd Bv, double size, int block_start) {
    const double whole = norm(v, Bv);
    const int in_block = count_ - block_start;
    const Eigen::VectorXd known = B_basis_.middleCols(block_start, in_block).transpose() * v;
    v -= basis_.middleCols(block_start, in_block) * known;
    Bv -= B_basis_.middleCols(block_start, in_block) * known;
    if (!(norm(v, Bv) > 1e-2 * whole)) {  // too much has cancelled for Bv to be B v still
      orthogonalise(v);
      Bv = B_(v);
    }
    const double left = norm(v, Bv);
    if (!(left > 1e-12 * size) || !std::isfinite(left)) return;
    if (count_ == basis_.cols()) reserve(std::max(16, 2 * count_));
    basis_.col(count_) = v / left;
    B_basis_.col(count_) = Bv / left;
    ++count_;
  }

  void reserve(int columns) {
    basis_.conservativeResize(Eigen::NoChange, columns);
    B_basis_.conservativeResize(Eigen::NoChange, columns);
    projected_.conservativeResize(columns, columns);
  }

  void apply_from(int first) {
    const int added = count_ - first;
    outside_.resize(basis_.rows(), added);
    B_outside_.resize(basis_.rows(), added);
    size_before_.resize(added);
    for (int i = 0; i < added; ++i) {
      Eigen::VectorXd image = op_(basis_.col(first + i), B_basis_.col(first + i));
      const Eigen::VectorXd column = B_basis_.leftCols(count_).transpose() * image;
      projected_.col(first + i).head(count_) = column;
      projected_.row(first + i).head(count_) = column.transpose();
      size_before_[i] = orthogonalise(image);
      outside_.col(i) = image;
      B_outside_.col(i) = B_(image);
    }
  }

  const PencilMap& op_;
  const LinearMap& B_;
  int capacity_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd B_basis_;
  Eigen::MatrixXd projected_;
  Eigen::MatrixXd outside_,
      B_outside_;                // images of the last block, without their part in the basis
  Eigen::VectorXd size_before_;  // of each image
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
  // A space of all unknowns ends by itself.
  const bool is_limited = options.largest_space < size;
  KrylovSpace space(op, B, size, is_limited ? options.largest_space : size + options.block);
  const auto random_vectors = [&](int columns) {
    Eigen::MatrixXd vectors(size, columns);
    for (int i = 0; i < columns; ++i) {
      Eigen::VectorXd start(size);
      for (double& x : start) x = normal(random);
      vectors.col(i) = op(start, B(start));  // the start then has no part outside op's range
    }
    return vectors;
  };
  space.grow(random_vectors(options.block));
  int next_check = 2 * count + 4;
  EigenPairs pairs;
  while (!pairs.converged) {
    const bool is_full =
        !space.has_room(options.block) || (!space.grow() && !space.grow(random_vectors(1)));
    if (space.count() >= next_check || is_full) {
      const EigenPairs before = std::move(pairs);
      pairs = space.ritz(count, options.tolerance);
      pairs.converged = pairs.converged || is_settled(pairs, before);
      next_check = space.count() + std::max(options.block, count / 4);
      if (is_full) break;
    }
  }
  return pairs;
}

}  // namespace viscard
