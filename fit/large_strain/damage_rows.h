#pragma once

#include "fit/large_strain/hyperelastic_search.h"
#include "fit/large_strain/large_strain_rows.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// What the readings went through, in the unit of the rows' stress: the energy of the undamaged law and its
// largest value so far in the test, which begins at rest.
struct EnergyHistory {
  Eigen::VectorXd now, largest;
  bool is_damaged(Eigen::Index reading) const { return now[reading] < largest[reading]; }
};

// All readings of all tests in the order of time, as rows of a law with damage (models/hyperelastic/
// mullins_damage.h). Each test is of a specimen that was never loaded before.
class DamageRows {
 public:
  // Both must outlive this object; rows must hold the readings of the tests.
  DamageRows(const LargeStrainRows& rows, const std::vector<LargeStrainTest>& tests);

  const LargeStrainRows& undamaged() const { return rows_; }
  EnergyHistory history(HyperelasticForm form, const HyperelasticPoint& point) const;

  // The weighted model, and its derivative by moduli, shapes, r, m and beta. The point has damage, with m
  // in the unit of the rows' stress.
  struct Model {
    Eigen::VectorXd values;
    Eigen::MatrixXd slopes;  // empty unless they are asked for
  };
  Model model(HyperelasticForm form, const HyperelasticPoint& point, bool with_slopes) const;

 private:
  struct Energies;
  Energies energies(HyperelasticForm form, const HyperelasticPoint& point) const;

  const LargeStrainRows& rows_;
  std::vector<Eigen::Vector3d> log_strain_;  // of each reading
  std::vector<Eigen::Index> first_;          // reading of each test, and one behind the last
};

}  // namespace viscard
