#pragma once

#include "models/array/layer/layer_waves.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// The face of a layer under a pressure on one square cell of a grid (in a plane: on a strip), and the
// potential under a point load (eq. L2 to L4). There is no period: the layer has no lateral end.
class LayerKernel {
 public:
  // A factor of the potential under the integral over k, such as the mean over a disc.
  using Reading = std::function<double(double k_1_m)>;

  // Points up to `reach_m` from a load; the potential for each reading.
  LayerKernel(const LayerWaves& waves, bool is_plane, double reach_m,
              const std::vector<Reading>& readings);

  bool is_plane() const { return is_plane_; }
  double reach_m() const { return reach_m_; }
  // How far the middle of a cell at an offset sinks, m per Pa on the cell.
  double sinking_m_Pa(double x_m, double y_m, double cell_m) const;
  // The same for all offsets of a grid, 0 to count - 1 cells along x (rows) and y.
  Eigen::MatrixXd sinking_m_Pa(int count, double cell_m) const;
  // V per N (in a plane: per N/m) of a point load at the offset.
  double potential_V_N(double x_m, double y_m, std::size_t reading) const;

 private:
  // Functions of the distance, one per column: the smooth part of the sinking, and three harmonics of
  // each reading.
  double radial(double r_m, Eigen::Index column) const;

  bool is_plane_;
  double reach_m_;
  double thickness_m_;
  double reference_m_Pa_;
  double step_m_ = 0.0;
  Eigen::MatrixXd table_;
};

// Mean of a wave over a disc of radius R around its crest; in a plane, over a strip of that half-width.
// kR: R times the wave number, a pure number.
double mean_of_wave(bool is_plane, double kR);

}  // namespace viscard
