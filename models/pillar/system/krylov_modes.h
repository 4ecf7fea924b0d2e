#pragma once

#include <Eigen/Core>

#include <functional>

namespace viscard {

// The largest eigenvalues mu of op v = mu v, where op is self-adjoint in the inner product x'By, by
// Spectra's implicitly restarted Lanczos method. Eigenvalues that are equal to rounding may be
// found only once; families of motion are solved separately so that symmetry causes no such pairs.
// Source: Calvetti, Reichel & Sorensen, Electron. Trans. Numer. Anal. 2 (1994) 1.
struct EigenPairs {
  Eigen::VectorXd values;   // descending; approximate if not converged
  Eigen::MatrixXd vectors;  // columns, v'Bv = 1; if not converged, those of the leading values
  bool converged = false;
  int leading = 0;  // values from the first one on that have converged
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
// op receives Bx together with x, so that op = A^-1 B needs no product of its own.
using PencilMap =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& Bx)>;

struct KrylovOptions {
  double tolerance = 1e-8;  // residual over eigenvalue; the error of the eigenvalue is its square
  int largest_space = 400;  // vectors kept at a time
  bool is_quick = false;    // ends after a small space, with what has converged there
};

// Throws std::invalid_argument for count < 1 or > size.
EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options = {});

}  // namespace viscard
