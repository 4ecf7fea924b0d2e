#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// The homogeneous deformations of an incompressible sheet or block by which rubber is tested. The
// first principal stretch is the one that is measured, and compression is uniaxial below 1.
enum class Deformation {
  kUniaxial,    // stretches s, 1/sqrt(s), 1/sqrt(s); force along s
  kPlanar,      // s, 1, 1/s; force along s (pure shear)
  kEquibiaxial  // s, s, 1/s^2; equal forces along both
};

// "uniaxial", "planar", "equibiaxial", in the order of Deformation.
const std::vector<std::string>& deformation_names();
const std::string& name_of(Deformation deformation);

// Change of the principal logarithmic strains with the logarithm of the measured stretch; sums to 0.
Eigen::Vector3d strain_direction(Deformation deformation);

// Number of directions along which the measured force works: 2 for equibiaxial, otherwise 1.
double n_loaded_directions(Deformation deformation);

}  // namespace viscard
