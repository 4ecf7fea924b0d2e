#pragma once

#include "fit/curves/master_model.h"
#include "fit/samples/fit_data.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <vector>

namespace viscard {

// Shifts of all segments, and the relative scatter of the rows about the best spectrum there.
struct ShiftCandidate {
  Eigen::VectorXd ln_a, ln_b;
  double scatter = std::numeric_limits<double>::infinity();
};

// Scatter about the best non-negative spectrum on a grid of times at given shifts, without a
// search. Unless the options forbid vertical shifts, the level of each segment follows the spectrum
// (ln_b), so that only the shapes are compared.
class SpectrumScatter {
 public:
  SpectrumScatter(const std::vector<MasterSegment>& segments, std::size_t reference,
                  const FitOptions& options)
      : segments_(segments), reference_(reference), options_(options) {}

  ShiftCandidate at(const Eigen::VectorXd& ln_a) const;

 private:
  const std::vector<MasterSegment>& segments_;
  std::size_t reference_;
  const FitOptions& options_;
};

}  // namespace viscard
