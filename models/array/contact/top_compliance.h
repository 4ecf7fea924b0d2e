#pragma once

#include "models/pillar/mesh/pillar_geometry.h"
#include "models/pillar/system/medium.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// How finely the top of a pillar is cut: equal elements of degree 2 along the radius, and angles. The
// number of angles is even.
struct TopFineness {
  int elements = 12;
  int angles = 32;
};

// A polar grid on the top of a pillar, and how its points move under forces on them, by harmonic of the angle.
struct TopGrid {
  std::vector<double> radius_m;               // of the rings
  Eigen::VectorXd ring_area_m2;               // of each; their sum is the area of the top
  std::vector<Eigen::MatrixXd> harmonic_m_N;  // m = 0 to angles/2
  int angles = 0;
};

// How the top of one pillar on a rigid base sinks under normal forces at the points of a polar grid:
//   u(r_j, theta_a) = sum_m sum_kb S_m(j, k) cos m (theta_a - theta_b) f_kb   (eq. T1)
// with the last harmonic, angles/2, counted half. The point on the axis has no area and no unknown.
struct TopCompliance : TopGrid {
  double plane_modulus_Pa = 0.0;  // E/(1 - nu^2)

  // Sinking under a uniform pressure, m/N; turning about an axis in the top under a traction that grows
  // with the distance from it, rad/(N m).
  double sinking_m_N() const;
  double turning_rad_Nm() const;
  // Adds what the grid or a base that yields leaves out, so that these two become the given ones.
  void adjust(double sinking_m_N, double turning_rad_Nm);
};

// The same under forces in three directions, for tops that stick: motions along r, theta and down under forces
// along them, which vary as (cos m theta, sin m theta, cos m theta), or a quarter of a wave further as (sin, -cos,
// sin). Rows and columns of C_m: rings along r, then theta, then down (eq. T9). What lies below six diameters is left
// out; of longer pillars, adjust() adds it.
struct StickingCompliance : TopGrid {
  // Motion of a top under a pressure, or under a shear along x and a tilting traction, as means over the top.
  struct Means {
    double sinking_m_N = 0.0;
    double sideways_m_N = 0.0;    // along x under a force along x
    double turning_rad_N = 0.0;   // toward +x by that force; and sideways under a moment
    double turning_rad_Nm = 0.0;  // under a moment int p x dA
  };
  Means means() const;
  // Adds what the grid or a base that yields leaves out, so that means() become the given one.
  void adjust(const Means& wanted);
};

// Throws std::invalid_argument for a geometry with a film, a fillet or a mushroom tip, or a bad grid.
TopCompliance top_compliance(const PillarGeometry& pillar, const Medium& medium,
                             const TopFineness& fineness);
StickingCompliance sticking_compliance(const PillarGeometry& pillar, const Medium& medium,
                                       const TopFineness& fineness);

}  // namespace viscard
