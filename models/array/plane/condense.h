#pragma once

#include "models/pillar/system/discrete_system.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Eliminates all unknowns but those in `kept` from the symmetric matrix
//   [ A   F ]
//   [ F'  B ]
// by partial L D L^T, and returns the Schur complement S on [kept, columns of F] (README.md, eq.
// A1). The columns of F are ports: unit loads, and at the same time readings of the displacement
// they work on. With the right side r on the kept unknowns and amplitudes a on the ports, the
// equilibrium A u = r + F a becomes  S_kk u_k = r + S_kp a,  and the readings F'u are  S_kp' u_k -
// S_pp a.  B is what an earlier condensation left of the ports in S_pp, else zero. A is positive or
// quasi-definite, of which the lower triangle is stored (StiffnessFactor). Sources: Przemieniecki,
// AIAA J. 1 (1963) 138 (substructures); Vanderbei, SIAM J. Optim. 5 (1995) 100. Throws
// std::runtime_error if what is eliminated is singular.
Eigen::MatrixXd condensed(const SymmetricSparse& A, const std::vector<int>& kept,
                          const Eigen::MatrixXd& F, const Eigen::MatrixXd& B);

}  // namespace viscard
