#pragma once

#include <vector>

namespace viscard {

// One term of a linear differential operator on a section: factor * x^-inverse_x * d^dx d^dz
// (field).
struct OperatorTerm {
  int field = 0;
  int inverse_x = 0;  // 0 or 1
  int dx = 0;         // 0 or 1
  int dz = 0;         // 0 or 1
  double factor = 1.0;
};
using OperatorRow = std::vector<OperatorTerm>;

// How the unknown fields of a family of motions make displacement, strain and electric field. Every
// matrix of the solver is a quadratic form in such rows, so a new family is a new table, no new
// code. The x of plane motion is the r of axisymmetric motion.
//
// Fourier family m >= 1: u_r = (a + b)/2 cos(m t), u_t = (a - b)/2 sin(m t), u_z = w cos(m t) with
// fields a, b, w: regularity on the axis is then a plain condition on single fields (eq. 12).
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
};

Kinematics longitudinal_kinematics();         // m = 0, fields u_r, u_z
Kinematics torsion_kinematics();              // m = 0, field u_theta
Kinematics fourier_kinematics(int harmonic);  // m >= 1, fields a, b, w
// Fields u_x, u_z, thickness 1 m. Plane stress differs only in the moduli (plane_stress_moduli).
Kinematics plane_kinematics();

// The same family with an electric potential as its last field.
Kinematics with_potential(Kinematics kinematics);

// Fields that must vanish on the axis x = 0 for the displacement to be smooth there (eq. 12).
std::vector<int> fields_zero_on_axis(const Kinematics& kinematics);

}  // namespace viscard
