#pragma once

#include <Eigen/Core>

namespace viscard {

// Sums sum_j K(i - j) f_j over a grid by Fourier transforms. The grid is padded with as many zeros, so
// that the sums are those of a grid without neighbours: Hockney, Methods in Computational Physics 9
// (1970) 135. K is even along both axes.
class GridConvolution {
 public:
  // K by offset, from 0 to the size of the grid less one; a single column for a line of points.
  explicit GridConvolution(const Eigen::MatrixXd& kernel);
  Eigen::MatrixXd apply(const Eigen::MatrixXd& values) const;

 private:
  Eigen::Index rows_, columns_;  // of the grid
  Eigen::MatrixXd spectrum_;     // real, since K is even: waves along a column x waves along a row
};

}  // namespace viscard
