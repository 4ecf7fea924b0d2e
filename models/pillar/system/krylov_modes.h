#pragma once

#include <Eigen/Core>

#include <functional>

namespace viscard {

// The largest eigenvalues mu of op v = mu v, where op is self-adjoint in the inner product x'By, by
// a block Krylov space with full reorthogonalisation and Rayleigh-Ritz. A block finds as many equal
// eigenvalues as it has columns, so clusters are returned whole.
// Source: Golub & Underwood, in Mathematical Software III (1977), 361.
struct EigenPairs {
  Eigen::VectorXd values;   // descending
  Eigen::MatrixXd vectors;  // columns, v'Bv = 1
  double residual = 1.0;    // largest, over its value
  bool converged = false;
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
// op given Bx beside x: an op = A^-1 B then needs no product of its own.
using PencilMap =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& Bx)>;

struct KrylovOptions {
  int block = 2;
  double tolerance = 1e-8;  // residual over eigenvalue; the value's own error is its square
  int largest_space = 400;
};

// Throws std::invalid_argument for count < 1 or > size.
EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options = {});
EigenPairs largest_eigenpairs(const LinearMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options = {});

}  // namespace viscard
