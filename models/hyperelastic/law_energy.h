#pragma once

#include "models/hyperelastic/hyperelastic_law.h"

#include <Eigen/Core>

namespace viscard {

// Strain energy of a law per volume at rest for a unit of each modulus, and its derivative by each shape
// (rows: moduli, columns: shapes), at principal logarithmic strains of unit volume. Formulas and sources
// stand above HyperelasticForm; 0 at rest. nan beyond the largest stretch of gent.
struct EnergyColumns {
  Eigen::VectorXd values;
  Eigen::MatrixXd shape_slopes;
};
EnergyColumns energy_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                             const Eigen::Vector3d& log_strain);

// The strain energy of a law, J/m3, which is Pa.
double energy_Pa(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain);

}  // namespace viscard
