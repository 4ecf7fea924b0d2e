#pragma once

#include "io/flow/optimise/design_space.h"

#include <functional>
#include <vector>

namespace viscard {

// Scores at a point, as logarithms: the objective, which is minimised, and margins that must not be
// negative.
struct DesignScore {
  double objective = 0.0;
  std::vector<double> margins;
  // Largest violation of a margin; 0 if all are kept.
  double lack() const;
  // With the exact penalty that both stages of the search use.
  double merit() const;
};
using ScoreAt = std::function<DesignScore(const DesignPoint& point)>;

// The best point of a cheap score within `radius` of `centre` (shares of the ranges) and the ranges, by NLopt:
// COBYLA (Powell, Advances in Optimization and Numerical Analysis (1994) 51) with an exact penalty, so that
// where nothing keeps all margins the largest lack is as small as can be.
DesignPoint step_on_model(const ScoreAt& score, const DesignPoint& centre, double radius);

// The best point found in all of the ranges by evolution, ISRES (Runarsson & Yao, IEEE Trans. Syst. Man Cybern. C 35
// (2005) 233), with this seed: the same seed gives the same point.
DesignPoint search_ranges(const ScoreAt& score, std::size_t n_ranges, std::size_t n_margins,
                          std::uint64_t seed);

}  // namespace viscard
