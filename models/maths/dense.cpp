#include "models/maths/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double smallest_of(const VectorXd& pivots) {
  return pivots.size() > 0 ? pivots.minCoeff() : std::numeric_limits<double>::infinity();
}

}  // namespace

Cholesky::Cholesky(const MatrixXd& matrix) : factor_(matrix) {}

bool Cholesky::is_definite() const {
  return factor_.info() == Eigen::Success;
}

double Cholesky::smallest_pivot() const {
  return smallest_of(factor_.matrixLLT().diagonal());
}

double Cholesky::log_determinant() const {
  return 2.0 * factor_.matrixLLT().diagonal().array().log().sum();
}

VectorXd Cholesky::solve(const VectorXd& right) const {
  return factor_.solve(right);
}

MatrixXd Cholesky::solve(const MatrixXd& right) const {
  return factor_.solve(right);
}

VectorXd Cholesky::solve_lower(const VectorXd& right) const {
  return factor_.matrixL().solve(right);
}

MatrixXd Cholesky::solve_lower(const MatrixXd& right) const {
  return factor_.matrixL().solve(right);
}

MatrixXd Cholesky::over_upper(const MatrixXd& columns) const {
  return factor_.matrixU().solve<Eigen::OnTheRight>(columns);
}

SymmetricFactor::SymmetricFactor(const MatrixXd& matrix) : factor_(matrix) {}

double SymmetricFactor::log_determinant() const {
  return factor_.vectorD().array().log().sum();
}

VectorXd SymmetricFactor::solve(const VectorXd& right) const {
  return factor_.solve(right);
}

MatrixXd SymmetricFactor::solve(const MatrixXd& right) const {
  return factor_.solve(right);
}

HouseholderQr::HouseholderQr(const MatrixXd& matrix) : factor_(matrix) {}

double HouseholderQr::smallest_pivot() const {
  return smallest_of(factor_.matrixQR().diagonal().cwiseAbs());
}

MatrixXd HouseholderQr::upper_inverse() const {
  const Eigen::Index n = factor_.cols();
  return factor_.matrixQR().topRows(n).triangularView<Eigen::Upper>().solve(
      MatrixXd::Identity(n, n));
}

MatrixXd HouseholderQr::basis() const {
  return factor_.householderQ() * MatrixXd::Identity(factor_.rows(), factor_.cols());
}

MatrixXd HouseholderQr::rotated(const MatrixXd& vectors) const {
  if (vectors.cols() == 0) return vectors;  // Eigen counts on from the null pointer of no numbers
  return factor_.householderQ().adjoint() * vectors;
}

PivotedQr::PivotedQr(const MatrixXd& matrix) : factor_(matrix) {}

Eigen::Index PivotedQr::rank() const {
  return factor_.rank();
}

VectorXd PivotedQr::solve(const VectorXd& right) const {
  return factor_.solve(right);
}

MatrixXd PivotedQr::basis() const {
  return factor_.householderQ() * MatrixXd::Identity(factor_.rows(), factor_.rank());
}

MatrixXd PivotedQr::rotated(const MatrixXd& vectors) const {
  return factor_.householderQ().adjoint() * vectors;
}

LuFactor::LuFactor(const MatrixXd& matrix) : factor_(matrix) {}

VectorXd LuFactor::solve(const VectorXd& right) const {
  return factor_.solve(right);
}

MatrixXd LuFactor::solve(const MatrixXd& right) const {
  return factor_.solve(right);
}

ComplexLuFactor::ComplexLuFactor(const Eigen::MatrixXcd& matrix) : factor_(matrix) {}

Eigen::VectorXcd ComplexLuFactor::solve(const Eigen::VectorXcd& right) const {
  return factor_.solve(right);
}

Eigen::MatrixXcd ComplexLuFactor::solve(const Eigen::MatrixXcd& right) const {
  return factor_.solve(right);
}

Eigen::VectorXcd ComplexLuFactor::solve_adjoint(const Eigen::VectorXcd& right) const {
  return factor_.adjoint().solve(right);
}

EigenSystem symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

EigenSystem generalized_eigen(const MatrixXd& a, const MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(a, b);
  if (solver.info() != Eigen::Success) {
    throw std::runtime_error("the eigenvalues of a pair of matrices did not converge");
  }
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd singular_values(const MatrixXd& matrix) {
  return Eigen::JacobiSVD<MatrixXd>(matrix).singularValues();
}

MatrixXd pseudo_inverse(const MatrixXd& matrix) {
  return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace viscard
