#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// All readings of all tests as one weighted least-squares problem, and a known modulus as one more
// row: data - columns(shapes) * moduli. Stresses are in units of the largest one.
class LargeStrainRows {
 public:
  LargeStrainRows(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options);

  struct Columns {
    Eigen::MatrixXd values;               // rows x moduli
    std::vector<Eigen::MatrixXd> slopes;  // by each shape, of the same size
  };
  Columns columns(HyperelasticForm form, const Eigen::VectorXd& shapes, bool with_slopes) const;

  const Eigen::VectorXd& data() const { return data_; }
  Eigen::Index n_readings() const { return static_cast<Eigen::Index>(readings_.size()); }
  double stress_scale_Pa() const { return scale_Pa_; }
  // Largest I1 - 3 of the data.
  double largest_excess() const { return largest_excess_; }
  // A modulus known with an error counts against readings of this weighted scatter.
  void set_scatter(double scatter);
  // At most this number of readings, evenly among those of each test, for a search of starts.
  LargeStrainRows thinned(std::size_t most) const;

 private:
  struct Reading {
    Deformation deformation = Deformation::kUniaxial;
    double stretch = 1.0, weight = 1.0, value = 0.0;  // value: weighted
  };
  void fill_data();

  std::vector<Reading> readings_;
  Eigen::VectorXd data_;
  double scale_Pa_ = 1.0, largest_excess_ = 0.0;
  // Known modulus at rest and its standard error; weight 0: none.
  double modulus_ = 0.0, modulus_se_ = 0.0, modulus_weight_ = 0.0;
};

}  // namespace viscard
