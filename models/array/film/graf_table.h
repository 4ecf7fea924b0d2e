#pragma once

#include "models/maths/chebyshev_panel.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Functions around an axis as sums over waves: function c is the sum over i of amplitude(i, c)
// J_order[c](k_i r), times a cosine or a sine of order[c] times the angle.
struct RadialWaves {
  std::vector<int> order;     // of each function; equal ones side by side
  Eigen::MatrixXd amplitude;  // waves x functions
};

// One of them with its angle: times cos(order alpha), or sin(order alpha).
struct AngularFunction {
  Eigen::Index radial = 0;  // index of the function of the radius
  int order = 0;
  bool is_sine = false;
};

// How functions around one axis look from another one, by Graf's addition theorem (Abramowitz & Stegun
// (1964), 9.1.79), with d and beta the distance and the direction of the other axis:
//   J_m(k r) exp(i m alpha) = sum over n of J_(m-n)(k d) exp(i (m - n) beta) J_n(k r') exp(i n alpha').
// The sums over the waves of source times receiver times J_(m-+n)(k d) are tabled over the distance.
class GrafTable {
 public:
  // Distances of the axes from the nearest to the farthest. Up to `singular_m` the functions may be
  // anything; beyond it they are analytic in the distance.
  struct Range {
    double nearest_m = 0.0, reach_m = 0.0, singular_m = 0.0;
  };
  GrafTable(const std::vector<double>& k_1_m, const RadialWaves& receivers,
            const RadialWaves& sources, const Range& range);

  // What each receiver sees of each source whose axis is at (-x, -y) from the receiver's: the sum over the
  // waves of its amplitude times the coefficient of J_n(k r') cos(n alpha'), or the sine. Zero beyond
  // the reach; nothing nearer than the nearest is asked for.
  Eigen::MatrixXd between(const std::vector<AngularFunction>& receivers,
                          const std::vector<AngularFunction>& sources, double x_m,
                          double y_m) const;

 private:
  Eigen::RowVectorXd values_at(double distance_m, const std::vector<double>& k_1_m,
                               const RadialWaves& receivers, const RadialWaves& sources) const;

  double reach_m_ = 0.0;
  int orders_ = 0;  // Bessel functions: one more than the largest order
  Eigen::Index receivers_ = 0;
  // Receivers (fastest) x sources with J_(m - n), then with (-1)^n J_(m + n).
  ChebyshevPanels panels_;
};

}  // namespace viscard
