#pragma once

#include "models/maths/grid_convolution.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace viscard {

// A point that acts on the others, with the kind of its action.
struct SourcePoint {
  double x_m = 0.0, y_m = 0.0;
  int kind = 0;
};

// What a mirrored offset does to a kernel: K(-x, y)(r, l) = reading_sign[r] K(x, y)(reading[r], l)
// load_sign[l].
struct KernelMirror {
  std::vector<int> reading;
  Eigen::VectorXd reading_sign, load_sign;
};

// Sums over points of a kernel of their offsets, sum_j K_kind(j)(x_i - x_j) f_j with several readings and
// loads. Points of a lattice, also with gaps, are summed by FFT (GridConvolution), others one by one.
class OffsetSums {
 public:
  // Readings x loads at an offset from a point of the kind. Mirrors along x and along y.
  using Kernel = std::function<Eigen::MatrixXd(int kind, double x_m, double y_m)>;

  OffsetSums(const std::vector<SourcePoint>& points, int kinds, const Kernel& kernel,
             const std::array<KernelMirror, 2>& mirrors);

  // Loads by point (points x loads) to readings by point.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& loads) const;

  // True if the points are of a lattice, or few enough to be summed one by one.
  static bool can_sum(const std::vector<SourcePoint>& points);

 private:
  struct Lattice {
    double x_m = 0.0, y_m = 0.0, step_x_m = 0.0, step_y_m = 0.0;
    Eigen::Index nx = 0, ny = 0;  // 0: no lattice
    bool is_turned = false;       // the grid's rows run along x, or along y for a single column
    std::vector<Eigen::Index> row, column;  // of each point
  };
  static Lattice lattice_of(const std::vector<SourcePoint>& points);
  void set_grids(const Kernel& kernel, const std::array<KernelMirror, 2>& mirrors);
  void set_pairs(const Kernel& kernel);
  Eigen::MatrixXd apply_grids(const Eigen::MatrixXd& loads) const;

  std::vector<SourcePoint> points_;
  int kinds_ = 0;
  Eigen::Index readings_ = 0, loads_ = 0;
  Lattice lattice_;
  std::vector<GridConvolution> grids_;  // by kind, reading and load, the load fastest
  std::vector<Eigen::MatrixXd> pairs_;  // by reading and load: points x points
};

}  // namespace viscard
