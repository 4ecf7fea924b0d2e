#pragma once

#include <Eigen/Core>

namespace viscard {

// Sums sum_j K(i - j) f_j over a grid by Fourier transforms. The grid is padded with as many zeros, so
// that the sums are those of a grid without neighbours: Hockney, Methods in Computational Physics 9
// (1970) 135.
class GridConvolution {
 public:
  // K by offset, from 0 to the size of the grid less one, where K is even along both axes; a single column
  // for a line of points.
  explicit GridConvolution(const Eigen::MatrixXd& kernel);
  // K by offset from -(size - 1) to size - 1 along both axes, of any symmetry.
  static GridConvolution of_all_offsets(const Eigen::MatrixXd& kernel);

  // K * values.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& values) const;

  // The same in steps, so that several sums share their transforms: waves of a load on the grid, waves of
  // the sum, and its values.
  Eigen::MatrixXcd waves_of(const Eigen::MatrixXd& values) const;
  // Adds the waves of K * values.
  void add_product(const Eigen::MatrixXcd& waves, Eigen::MatrixXcd& sum) const;
  // The sum on the grid.
  Eigen::MatrixXd values_of(const Eigen::MatrixXcd& waves) const;

 private:
  GridConvolution(Eigen::Index rows, Eigen::Index columns) : rows_(rows), columns_(columns) {}

  Eigen::Index rows_, columns_;  // of the grid
  Eigen::MatrixXcd spectrum_;    // waves along a row x waves along a column
};

}  // namespace viscard
