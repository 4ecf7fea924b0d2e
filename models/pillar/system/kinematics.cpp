#include "models/pillar/system/kinematics.h"

#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

OperatorTerm value_of(int field, double factor = 1.0) {
  return {field, 0, 0, 0, factor};
}
OperatorTerm over_x(int field, double factor = 1.0) {
  return {field, 1, 0, 0, factor};
}
OperatorTerm d_dx(int field, double factor = 1.0) {
  return {field, 0, 1, 0, factor};
}
OperatorTerm d_dz(int field, double factor = 1.0) {
  return {field, 0, 0, 1, factor};
}

OperatorRow sum(const OperatorRow& a, const OperatorRow& b) {
  OperatorRow row = a;
  row.insert(row.end(), b.begin(), b.end());
  return row;
}

// Strain from the nine gradients: xx yy zz yz xz xy.
void strain_from_gradient(Kinematics& k) {
  const std::vector<OperatorRow>& g = k.gradient;
  k.strain = {g[0], g[4], g[8], sum(g[5], g[7]), sum(g[2], g[6]), sum(g[1], g[3])};
  k.divergence = sum(sum(g[0], g[4]), g[8]);
}

Kinematics longitudinal_kinematics() {
  Kinematics k{2, 0, 1, 2.0 * std::numbers::pi};
  k.zero_on_axis = {0};
  k.displacement = {{value_of(0)}, {}, {value_of(1)}};
  k.gradient = {{d_dx(0)}, {}, {d_dz(0)}, {}, {over_x(0)}, {}, {d_dx(1)}, {}, {d_dz(1)}};
  strain_from_gradient(k);
  return k;
}

Kinematics torsion_kinematics() {
  Kinematics k{1, 0, 1, 2.0 * std::numbers::pi};
  k.zero_on_axis = {0};
  k.displacement = {{}, {value_of(0)}, {}};
  k.gradient = {{}, {over_x(0, -1.0)}, {}, {d_dx(0)}, {}, {d_dz(0)}, {}, {}, {}};
  strain_from_gradient(k);
  return k;
}

Kinematics plane_kinematics(bool is_symmetric) {
  Kinematics k{2, 0, 0, 2.0};
  k.zero_on_axis = {is_symmetric ? 0 : 1};
  k.displacement = {{value_of(0)}, {}, {value_of(1)}};
  k.gradient = {{d_dx(0)}, {}, {d_dz(0)}, {}, {}, {}, {d_dx(1)}, {}, {d_dz(1)}};
  strain_from_gradient(k);
  return k;
}

}  // namespace

std::vector<OperatorRow> Kinematics::strain_and_field() const {
  std::vector<OperatorRow> rows = strain;
  rows.insert(rows.end(), electric_field.begin(), electric_field.end());
  return rows;
}

Kinematics fourier_kinematics(int harmonic) {
  if (harmonic < 1) throw std::invalid_argument("the Fourier family starts at harmonic 1");
  const double m = harmonic;
  Kinematics k{3, harmonic, 1, std::numbers::pi};
  constexpr double h = 0.5;
  k.displacement = {
      {value_of(0, h), value_of(1, h)}, {value_of(0, h), value_of(1, -h)}, {value_of(2)}};
  // (1/r)(du_r/dt - u_t) and (1/r)(du_t/dt + u_r), amplitudes of sin(m t) and cos(m t).
  const OperatorRow r_t = {over_x(0, -h * (m + 1.0)), over_x(1, -h * (m - 1.0))};
  const OperatorRow t_t = {over_x(0, h * (1.0 + m)), over_x(1, h * (1.0 - m))};
  k.gradient = {{d_dx(0, h), d_dx(1, h)},
                r_t,
                {d_dz(0, h), d_dz(1, h)},
                {d_dx(0, h), d_dx(1, -h)},
                t_t,
                {d_dz(0, h), d_dz(1, -h)},
                {d_dx(2)},
                {over_x(2, -m)},
                {d_dz(2)}};
  strain_from_gradient(k);
  // For m = 1, field b is the sideways motion of the axis itself.
  k.zero_on_axis = harmonic == 1 ? std::vector<int>{0, 2} : std::vector<int>{0, 1, 2};
  return k;
}

Kinematics kinematics_of(Motion motion) {
  switch (motion) {
    case Motion::kLongitudinal:
      return longitudinal_kinematics();
    case Motion::kTorsion:
      return torsion_kinematics();
    case Motion::kLateral:
      return fourier_kinematics(1);
    case Motion::kOvalling:
      return fourier_kinematics(2);
    case Motion::kPlaneSymmetric:
      return plane_kinematics(true);
    case Motion::kPlaneAntisymmetric:
      return plane_kinematics(false);
  }
  throw std::invalid_argument("unknown family of motion");
}

Kinematics with_potential(Kinematics k, double scale_V) {
  const int phi = k.field_count++;
  k.potential_field = phi;
  k.electric_field = {{d_dx(phi, -scale_V)}, {}, {d_dz(phi, -scale_V)}};
  if (k.harmonic > 0) k.electric_field[1] = {over_x(phi, k.harmonic * scale_V)};
  // An antisymmetric potential vanishes on the plane of symmetry, as the axial motion does.
  const bool is_antisymmetric = k.x_power == 0 && k.zero_on_axis == std::vector<int>{1};
  if (k.harmonic > 0 || is_antisymmetric) k.zero_on_axis.push_back(phi);
  return k;
}

}  // namespace viscard
