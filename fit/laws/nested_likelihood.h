#pragma once

#include "models/material/ratio_model.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace viscard {

// One number of one record (a touch on a specimen).
struct NestedRecord {
  double value = 0.0;
  double variance = 0.0;  // of the record's own fit, > 0
  int specimen = 0;       // records of one specimen have the same number, and the same ratio
  double ratio = 0.0;
};

// Standard deviations between touches, specimens and ratios.
using Deviations = std::array<double, 3>;

// Restricted likelihood of nested records. Each evaluation takes O(records): touches are pooled to
// their specimen and specimens to their ratio, which leaves generalised least squares over ratios.
class NestedLikelihood {
 public:
  NestedLikelihood(const std::vector<NestedRecord>& records, const RatioModel& law, int degree);

  // -2 ln L but for a constant.
  double minus_twice(const Deviations& deviations) const;

  // Degrees of freedom of the three levels.
  const std::array<int, 3>& degrees_of_freedom() const { return degrees_; }
  double scale() const { return scale_; }  // typical size of the deviations

 private:
  struct Member {
    double value, variance;
  };
  using Specimen = std::vector<Member>;  // its touches
  std::vector<std::vector<Specimen>> ratios_;
  Eigen::MatrixXd design_;  // one row per ratio
  std::array<int, 3> degrees_{};
  double scale_ = 0.0;
};

}  // namespace viscard
