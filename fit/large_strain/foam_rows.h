#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "models/hyperelastic/foam_law.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// All readings of all tests of a foam as rows: for each test its stresses, in units of its largest one, then
// the logarithms of its lateral stretches, if they were measured, in units of their largest.
class FoamRows {
 public:
  // Throws std::runtime_error for lateral stretches that are not positive or never leave 1.
  explicit FoamRows(const std::vector<LargeStrainTest>& tests);

  const Eigen::VectorXd& data() const { return data_; }
  // The same of a law.
  Eigen::VectorXd model(const FoamLaw& law) const;
  // At most this number of readings, evenly among all, for a search of starts.
  FoamRows thinned(std::size_t most) const;
  // Largest stress of all tests, Pa.
  double stress_scale_Pa() const { return scale_Pa_; }

 private:
  struct Reading {
    FoamTest test = FoamTest::kUniaxial;
    double measured = 1.0;
    Eigen::Index stress_row = 0, lateral_row = -1;  // -1: not measured
    double stress_scale_Pa = 1.0, lateral_scale = 1.0;
    double stress_Pa = 0.0, log_lateral = 0.0;
  };
  FoamRows() = default;
  void fill_data();

  std::vector<Reading> readings_;
  Eigen::VectorXd data_;
  double scale_Pa_ = 1.0;
};

}  // namespace viscard
