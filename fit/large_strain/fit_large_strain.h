#pragma once

#include "fit/intervals/fitted_law.h"
#include "fit/large_strain/large_strain_data.h"
#include "models/hyperelastic/law_stability.h"
#include "models/material/material.h"

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
  double noise_Pa = 0.0;  // of a reading, from third differences; 0: not known
  double rms_Pa = 0.0;    // of its residuals
};

struct LargeStrainResult {
  std::vector<FittedRubber> laws;  // in the order of the options
  std::size_t chosen = 0;
  std::vector<RubberTestSummary> tests;
  std::vector<MaterialFlag> notes;  // about the data

  const FittedRubber& best() const { return laws[chosen]; }
};

// Fits the laws to all tests together and chooses by BIC among those that converge, are stable in the
// measured range and do not end on a bound (all of them, if none is left). Intervals are from the
// covariance at the best point, with the scatter of the residuals and its memory. Flags of a law:
// unstable-in-range, misfit, on-bound (a shape ended at the end of its range), not-converged;
// notes: unstable-beyond, one-deformation, few-readings, modulus-disagrees. The first four make the
// law untrustworthy.
// Throws std::runtime_error for a test with fewer than 3 readings, a stretch that is not positive, a
// number that is not finite, all stretches 1, or compression with a positive stress throughout.
LargeStrainResult fit_large_strain(const std::vector<LargeStrainTest>& tests,
                                   const LargeStrainOptions& options = {});

}  // namespace viscard
