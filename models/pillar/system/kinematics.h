#pragma once

#include <vector>

namespace viscard {

// One term of a linear differential operator on a section:
//  factor * x^-inverse_x * d^dx d^dz (field).
struct OperatorTerm {
  int field = 0;
  int inverse_x = 0;    // 0 or 1
  int dx = 0;           // 0 or 1
  int dz = 0;           // 0 or 1
  double factor = 1.0;  // a pure number
};
// The sum of its terms.
using OperatorRow = std::vector<OperatorTerm>;

// How the unknown fields of a family of motion form displacement, strain and electric field. Every
// matrix of the solver is a quadratic form in such rows, so a new family needs a new table but no
// new code. The x of plane motion is the r of axisymmetric motion.
//
// Fourier family m >= 1: u_r = (a + b)/2 cos(m t), u_t = (a - b)/2 sin(m t), u_z = w cos(m t) with
// the fields a, b, w. Regularity on the axis is then a condition on single fields (eq. 12).
// Source: Bernardi, Dauge & Maday, Spectral Methods for Axisymmetric Domains (1999), ch. II.
struct Kinematics {
  int field_count = 0;
  int harmonic = 0;      // m
  int x_power = 1;       // weight x^x_power dx dz: 1 axisymmetric, 0 plane
  double measure = 1.0;  // 2 pi for m = 0, pi for m >= 1, thickness in m for plane motion
  std::vector<OperatorRow> displacement;    // 3: x (r), y (theta), z
  std::vector<OperatorRow> strain;          // 6: xx yy zz yz xz xy, engineering shears
  std::vector<OperatorRow> gradient;        // 9: d u_i/d x_j, i slowest
  OperatorRow divergence;                   // xx + yy + zz
  std::vector<OperatorRow> electric_field;  // 3: -grad phi; empty without a potential
  int potential_field = -1;

  std::vector<OperatorRow> strain_and_field() const;  // [strain; electric field]
  // Fields that vanish on x = 0: on an axis because u is smooth (eq. 12), in a plane by symmetry.
  std::vector<int> zero_on_axis;
};

// The families of motion of a pillar. Plane families describe the half x >= 0 of a strip under
// symmetric or antisymmetric loads; `measure` counts both halves, 1 m thick.
enum class Motion {
  kLongitudinal,       // m = 0, fields u_r, u_z
  kTorsion,            // m = 0, field u_theta
  kLateral,            // m = 1, fields a, b, w
  kOvalling,           // m = 2
  kPlaneSymmetric,     // fields u_x, u_z; "longitudinal" of a strip
  kPlaneAntisymmetric  // "lateral" of a strip
};
Kinematics kinematics_of(Motion motion);
Kinematics fourier_kinematics(int harmonic);  // any m >= 1; otherwise throws std::invalid_argument

// The same family with an electric potential as its last field, in units of scale_V
// (potential_scale_V() in medium.h). Without this scaling the elimination loses all digits.
Kinematics with_potential(Kinematics kinematics, double scale_V);

}  // namespace viscard
