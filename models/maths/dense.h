#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

// Decompositions of dense matrices of any size, compiled once. Eigen's are templates: each file that
// uses one directly compiles it again, which takes 2 to 7 s per decomposition and file. All methods
// and their accuracy are described in Golub & Van Loan, Matrix Computations (2013), ch. 3 to 5, 8.
namespace viscard {

// A = L L^T of a symmetric matrix; reads the lower triangle.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const Eigen::MatrixXd& matrix);

  bool is_definite() const;
  // Smallest diagonal entry of L: for columns of unit length, the distance of a column to the span
  // of those before it. Infinite for an empty matrix.
  double smallest_pivot() const;
  double log_determinant() const;
  // A^-1 right, for one right-hand side or for each column.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  // The same for each column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  Eigen::VectorXd solve_lower(const Eigen::VectorXd& right) const;   // L^-1 right
  Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& right) const;   // the same for each column
  Eigen::MatrixXd over_upper(const Eigen::MatrixXd& columns) const;  // columns L^-T

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

// A = P^T L D L^T P of a symmetric matrix that may be semidefinite; reads the lower triangle.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const Eigen::MatrixXd& matrix);

  double log_determinant() const;
  // A^-1 right, for one right-hand side or for each column.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  // The same for each column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

// A = Q R of a matrix with at least as many rows as columns.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& matrix);

  double smallest_pivot() const;                                  // smallest |R_jj|
  Eigen::MatrixXd upper_inverse() const;                          // R^-1
  Eigen::MatrixXd basis() const;                                  // Q, as many columns as A
  Eigen::MatrixXd rotated(const Eigen::MatrixXd& vectors) const;  // Q^T vectors, all rows

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> factor_;
};

// A P = Q R with column pivoting, for least squares with dependent columns.
class PivotedQr {
 public:
  PivotedQr() = default;
  explicit PivotedQr(const Eigen::MatrixXd& matrix);

  Eigen::Index rank() const;
  // A^-1 right, for one right-hand side or for each column.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;      // least squares
  Eigen::MatrixXd basis() const;                                  // rank() orthonormal columns
  Eigen::MatrixXd rotated(const Eigen::MatrixXd& vectors) const;  // Q^T vectors

 private:
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor_;
};

// P A = L U of a square matrix.
class LuFactor {
 public:
  explicit LuFactor(const Eigen::MatrixXd& matrix);
  // A^-1 right, for one right-hand side or for each column.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  // The same for each column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

// P A = L U of a square complex matrix.
class ComplexLuFactor {
 public:
  explicit ComplexLuFactor(const Eigen::MatrixXcd& matrix);
  Eigen::Index size() const { return factor_.rows(); }
  // A^-1 right.
  Eigen::VectorXcd solve(const Eigen::VectorXcd& right) const;
  // The same for each column.
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const;
  Eigen::VectorXcd solve_adjoint(const Eigen::VectorXcd& right) const;  // (A^H)^-1 right

 private:
  Eigen::PartialPivLU<Eigen::MatrixXcd> factor_;
};

// Eigenvalues and eigenvectors.
struct EigenSystem {
  Eigen::VectorXd values;   // ascending
  Eigen::MatrixXd vectors;  // columns
};

// A v = lambda v of a symmetric matrix; reads the lower triangle. Vectors of unit length.
EigenSystem symmetric_eigen(const Eigen::MatrixXd& matrix);
// A v = lambda B v, both symmetric (the lower triangles are read), B definite, v^T B v = 1. Throws
// std::runtime_error if the iteration does not converge.
EigenSystem generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Largest first, as many as the shorter side of the matrix.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

// The pseudo-inverse, by a complete orthogonal decomposition.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

}  // namespace viscard
