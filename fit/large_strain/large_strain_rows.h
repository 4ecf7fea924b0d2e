#pragma once

#include "fit/large_strain/large_strain_data.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <Eigen/Core>

#include <memory>
#include <utility>
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

  // From now on columns() are those of the law with these terms, which need tests with times.
  void set_terms(std::vector<RubberTerm> terms) { terms_ = std::move(terms); }
  // Of a law with moduli in the rows' unit: the readings of its stress at once and, one column for each
  // time, of the part that relaxed with it (H of finite_viscoelasticity.h) with its derivative by ln tau.
  struct Parts {
    Eigen::VectorXd at_once;
    Eigen::MatrixXd relaxed, by_ln_tau;
  };
  Parts parts(const HyperelasticLaw& law, const std::vector<double>& tau_s, bool with_slopes) const;
  // Shortest time between readings, and the longest time from the first to the last.
  double least_step_s() const { return least_step_s_; }
  double longest_test_s() const { return longest_test_s_; }

  const Eigen::VectorXd& data() const { return data_; }
  Eigen::Index n_readings() const { return static_cast<Eigen::Index>(readings_.size()); }
  double stress_scale_Pa() const { return scale_Pa_; }
  // Largest I1 - 3 of the data.
  double largest_excess() const { return largest_excess_; }
  // A modulus known with an error counts against readings of this weighted scatter.
  void set_scatter(double scatter);
  // A known modulus weighs at most `share` times as much as all readings together.
  void limit_known_modulus(double share);
  bool has_known_modulus() const { return modulus_ > 0.0; }
  // That share of an exact modulus, for elastic laws and for those with terms.
  static constexpr double kExact = 1e6, kExactWithTerms = 1e3;
  // At most this number of readings, evenly among those of each test, for a search of starts.
  LargeStrainRows thinned(std::size_t most) const;

 private:
  struct Reading {
    Deformation deformation = Deformation::kUniaxial;
    double stretch = 1.0, weight = 1.0, value = 0.0;  // value: weighted
    std::size_t test = 0, point = 0;                  // in the histories
  };
  void fill_data();
  Columns relaxed_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                          bool with_slopes) const;
  // Adds the row of a known modulus to columns.
  void add_modulus_row(HyperelasticForm form, const Eigen::VectorXd& shapes, Columns& out) const;
  // The share of the known modulus that the law of the terms has: all of it, or what never relaxes.
  double modulus_share() const;

  std::vector<Reading> readings_;
  Eigen::VectorXd data_;
  double scale_Pa_ = 1.0, largest_excess_ = 0.0;
  // Known modulus at rest and its standard error; weight 0: none.
  double modulus_ = 0.0, modulus_se_ = 0.0, modulus_weight_ = 0.0;
  double known_weight_ = 0.0;  // by its error; modulus_weight_ has its limit
  bool is_long_term_ = false;
  std::vector<RubberTerm> terms_;
  std::shared_ptr<const std::vector<StretchCourse>> courses_;  // of the tests, if all have times
  double least_step_s_ = 0.0, longest_test_s_ = 0.0;
};

}  // namespace viscard
