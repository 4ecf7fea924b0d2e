#pragma once

#include "fit/intervals/fitted_law.h"
#include "models/hyperelastic/law_stability.h"
#include "models/material/material.h"
#include "models/maths/interval.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace viscard {

// One law fitted to all tests.
struct FittedRubber {
  HyperelasticLaw law;
  std::vector<LawParameter> parameters;  // moduli, then shapes
  Eigen::MatrixXd covariance;            // of them, in that order; rows of held ones are zero
  double E0_Pa = 0.0, E0_se_Pa = 0.0;    // Young's modulus at rest
  Interval E0_interval_95;
  int n_parameters = 0;
  double rss = 0.0;           // Pa^2, unweighted, over all readings
  double rms_relative = 0.0;  // root of rss over the sum of squared stresses
  double aicc = 0.0, bic = 0.0;
  double inflation = 1.0;  // of variances, by the memory that its residuals have along each test
  std::array<StableRange, 3> stable;  // in the order of Deformation
  std::vector<MaterialFlag> flags;
  bool is_trustworthy = true;
};

// What one test shows of the chosen law.
struct RubberTestSummary {
  std::string name;
  Deformation deformation = Deformation::kUniaxial;
  std::size_t n_readings = 0;
  double least_stretch = 1.0, largest_stretch = 1.0;
  double rms_Pa = 0.0;  // of its residuals
};

// All laws, the chosen one, and what the tests show.
struct LargeStrainResult {
  std::vector<FittedRubber> laws;  // in the order of the options
  std::size_t chosen = 0;
  std::vector<RubberTestSummary> tests;
  std::vector<MaterialFlag> notes;  // about the data

  const FittedRubber& best() const { return laws[chosen]; }
};

}  // namespace viscard
