#pragma once

#include "models/array/contact/rigid_shape.h"
#include "models/array/layer/layer_kernel.h"
#include "models/maths/grid_convolution.h"

#include <Eigen/Core>

namespace viscard {

// Square cells (in a plane: strips) around a point of the face; rows of a matrix are x, columns y.
struct LayerGrid {
  double x_m = 0.0, y_m = 0.0;  // of its middle
  double width_m = 0.0;
  int count = 0;  // of cells along each axis
  double cell_m() const { return width_m / count; }
  // Middle of cell i of an axis along which the middle of the part is at middle_m.
  double place_m(double middle_m, Eigen::Index i) const {
    return middle_m + (static_cast<double>(i) + 0.5) * cell_m() - 0.5 * width_m;
  }
  // The cell of such an axis that a place lies in, of two beside a face the one nearer the middle, so
  // that profiles of symmetric answers are symmetric and both ends belong to the grid; -1 outside.
  Eigen::Index cell_at(double middle_m, double at_m) const;
};

// What presses on the face.
struct LayerPress {
  RigidShape shape;
  double width_m = 0.0;  // of the part of the face that the shape covers, around x = y = 0; 0: all
  bool follows = false;  // the face follows the shape wherever it covers it, and is pulled too
};

// Pressures on the cells of a grid.
struct LayerPressure {
  LayerGrid grid;
  Eigen::MatrixXd pressure_Pa;
  double depth_m = 0.0;
  double force_N = 0.0;     // N/m in a plane
  double contact_m2 = 0.0;  // of the cells that are pressed; m in a plane
  int iterations = 0;
  bool touches_rim() const;  // of the grid
};

// The pressure between a rigid shape and the face of a layer, without friction: p >= 0, sinking less
// overlap >= 0, and their product is 0 (eq. L5).
class LayerContact {
 public:
  LayerContact(const LayerKernel& kernel, LayerPress press, const LayerGrid& grid);

  // The point `at` of the shape stands `depth_m` below the face. Iterations begin with `guess_Pa`.
  // Throws std::runtime_error if they do not converge.
  LayerPressure to_depth(double depth_m, const Eigen::MatrixXd& guess_Pa = {}) const;
  // With a force (in a plane: per length), to rounding; the search begins at a depth with this step.
  LayerPressure with_force(double force_N, double depth_m, double step_m,
                           const Eigen::MatrixXd& guess_Pa = {}) const;

  const LayerGrid& grid() const { return grid_; }

 private:
  bool is_plane_;
  LayerPress press_;
  LayerGrid grid_;
  Eigen::MatrixXd height_m_;  // of the shape over each cell; infinite where it has none
  GridConvolution sinking_;
};

// The pressure at the cells of another grid: that of the cell around each place, 0 outside.
Eigen::MatrixXd pressure_on(const LayerPressure& pressure, const LayerGrid& grid, bool is_plane);

// Potential at a point, V.
double potential_V(const LayerPressure& pressure, const LayerKernel& kernel, double x_m, double y_m,
                   std::size_t reading);

}  // namespace viscard
