#pragma once

#include "fit/large_strain/foam_rows.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>

namespace viscard {

// A foam with what the least squares left.
struct FoamPoint {
  FoamLaw law;
  bool has_one_nu = true;                                // of all terms
  bool fits_nu = true;                                   // false: it was given
  double rss = std::numeric_limits<double>::infinity();  // of the rows
  bool is_converged = false;

  // Number of parameters: the mu, the alpha, and one nu, one for each term, or none.
  Eigen::Index size() const;
};

// Bounds of alpha and nu. Moduli are not negative, so that a law with nu of 0 or more is stable.
inline constexpr double kMostAlpha = 40.0, kLeastNu = -0.45, kMostNu = 0.495;

// The best law of n terms with one nu for all, or the nu that is given: with one nu the stress is linear in
// the moduli, which are solved on a grid of exponents and nu; the best few points are refined in all
// parameters (Ceres, derivatives by differences).
FoamPoint best_foam(Eigen::Index n_terms, const FoamRows& rows, std::optional<double> nu);
// From such a law one with a nu of each term.
FoamPoint with_own_nu(const FoamRows& rows, const FoamPoint& start);
// Both search on at most this number of readings, and refine the best law on all of them.
inline constexpr std::size_t kSearchedReadings = 300;

// Derivative of the rows' model by mu (Pa), alpha and nu.
Eigen::MatrixXd foam_jacobian(const FoamRows& rows, const FoamPoint& point);

}  // namespace viscard
