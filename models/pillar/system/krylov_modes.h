#pragma once

#include <Eigen/Core>

#include <functional>

namespace viscard {

// The largest eigenvalues mu of op v = mu v, where op is self-adjoint in the inner product x'By,
// by Spectra's Lanczos method with implicit restarts. Values that are equal to rounding may be
// found once only: families of motion are solved apart so that symmetry makes no such pairs.
// Source: Calvetti, Reichel & Sorensen, Electron. Trans. Numer. Anal. 2 (1994) 1.
struct EigenPairs {
  Eigen::VectorXd values;   // descending; rough without convergence
  Eigen::MatrixXd vectors;  // columns, v'Bv = 1; none without convergence
  bool converged = false;
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
// op given Bx beside x: an op = A^-1 B then needs no product of its own.
using PencilMap =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& Bx)>;

struct KrylovOptions {
  double tolerance = 1e-8;  // residual over eigenvalue; the value's own error is its square
  int largest_space = 400;  // vectors at a time
};

// Throws std::invalid_argument for count < 1 or > size.
EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options = {});
EigenPairs largest_eigenpairs(const LinearMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options = {});

}  // namespace viscard
