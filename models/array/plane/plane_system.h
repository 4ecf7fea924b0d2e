#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/medium.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Elements in the plane that pieces of a row are made of.

inline constexpr int kAcross = 0;  // fields of the plane motion
inline constexpr int kUp = 1;
inline constexpr int kPotential = 2;

// The plane motion without any symmetry: pieces reach to both sides of x = 0.
Kinematics whole_plane();

// Its unknowns, with the base of the section held or free.
DofMap plane_dofs(const Section& section, bool holds_base);

// Displacement form of a medium, and the bulk modulus whose pressures are condensed beside it.
struct PlaneForm {
  Eigen::MatrixXd form;
  double condensed_bulk_Pa = 0.0;
};

PlaneForm plane_form(const Medium& medium, PlaneState plane, bool is_electric);

SymmetricSparse stiffness_of(const DiscreteSystem& system, const PlaneForm& form);

// Unknowns of the nodes on a line of the grid, node by node, without the held ones.
std::vector<int> dofs_on(const DiscreteSystem& system, const std::vector<int>& nodes,
                         int field_count);
std::vector<int> nodes_on_end(const Section& section, bool right);

// Eliminates all unknowns except those in `kept` (-1: none, a row of zeros in the answer) from the symmetric matrix [A F; F' B] by partial L
// D L^T, and returns the Schur complement S on [kept, columns of F] (README.md, eq. A1). The
// columns of F are ports: unit loads, and at the same time readings of the displacement they work
// on. With the right side r on the kept unknowns and amplitudes a on the ports, the equilibrium A u
// = r + F a becomes S_kk u_k = r + S_kp a, and the readings F'u are S_kp' u_k - S_pp a. B is the
// S_pp of an earlier condensation of the ports, else zero. A is positive or quasi-definite, stored
// as its lower triangle (StiffnessFactor). Sources: Przemieniecki, AIAA J. 1 (1963) 138
// (substructures); Vanderbei, SIAM J. Optim. 5 (1995) 100. Throws std::runtime_error if the
// eliminated part is singular.
Eigen::MatrixXd condensed(const SymmetricSparse& A, const std::vector<int>& kept,
                          const Eigen::MatrixXd& F, const Eigen::MatrixXd& B);

}  // namespace viscard
