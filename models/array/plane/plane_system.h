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

}  // namespace viscard
