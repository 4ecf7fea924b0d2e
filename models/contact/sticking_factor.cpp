// The factor of a sticking punch. Both displacements are prescribed under the punch, so pressure
// and radial shear are unknown and solved for together.
#include "models/contact/punch_contact.h"
#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Index = Eigen::Index;

// j_0 .. j_(count-1) at z >= 0 by Miller's downward recursion (Abramowitz & Stegun, 10.5).
Eigen::VectorXd spherical_bessel(double z, Index count) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
  if (z < 1e-8) {
    values[0] = 1.0;
    return values;
  }
  const Index start = std::max(count, static_cast<Index>(z)) + 30;
  double above = 0.0, here = 1e-250;
  for (Index n = start; n-- > 0;) {
    const double below = (2.0 * static_cast<double>(n) + 3.0) / z * here - above;
    above = here;
    here = below;
    if (n < count) values[n] = here;
    if (std::abs(here) < 1e200) continue;
    above *= 1e-250;
    here *= 1e-250;
    values *= 1e-250;
  }
  // Normalised by j_0 or j_1, whichever is larger, because that one has no cancellation.
  const double j0 = std::sin(z) / z;
  const double j1 = (j0 - std::cos(z)) / z;
  const bool use_first = count < 2 || std::abs(values[0]) > std::abs(values[1]);
  return values * (use_first ? j0 / values[0] : j1 / values[1]);
}

// Surface compliance of the bonded layer in Hankel space times G xi, minus its value for the
// half-space, at x = xi H   (eq. 30). Numerators and denominator are divided by exp(2x).
struct Compliance {
  double normal = 0.0, shear = 0.0, coupling = 0.0;
};
Compliance layer_less_half_space(double x, double nu) {
  const double q = 3.0 - 4.0 * nu;
  const double e = std::exp(-2.0 * x);
  const double sinh = 0.5 * (1.0 - e * e), cosh = 0.5 * (1.0 + e * e);
  const double bottom = q * cosh + e * (2.0 * x * x + 5.0 - 12.0 * nu + 8.0 * nu * nu);
  return {(1.0 - nu) * ((q * sinh - 2.0 * x * e) / bottom - 1.0),
          (1.0 - nu) * ((q * sinh + 2.0 * x * e) / bottom - 1.0),
          (0.5 * (1.0 - 2.0 * nu) * q * (cosh - e) - x * x * e) / bottom - 0.5 * (1.0 - 2.0 * nu)};
}

// The half-space's part of the system: int_0^inf j_m j_n d xi in closed form.
Eigen::MatrixXd half_space_system(Index count, double nu) {
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  for (Index m = 0; m < count; ++m) {
    const auto a = static_cast<double>(m);
    system(m, m) = (1.0 - nu) * std::numbers::pi / (2.0 * (2.0 * a + 1.0));
    for (Index n = (m + 1) % 2; n < count; n += 2) {  // n of the other parity: coupling
      const auto b = static_cast<double>(n);
      const double sine = (m - n - 1) % 4 == 0 ? 1.0 : -1.0;  // sin((m - n) pi/2)
      system(m, n) = 0.5 * (1.0 - 2.0 * nu) * sine / (a * (a + 1.0) - b * (b + 1.0));
    }
  }
  return system;
}

// Galerkin solution with `pairs` functions for the pressure and as many for the shear; their Hankel
// transforms are j_0, j_2, ... and j_1, j_3, ...
double galerkin_factor(double r, double nu, Index pairs) {
  const Index count = 2 * pairs;
  Eigen::MatrixXd system = half_space_system(count, nu);
  if (r > 0.0) {
    static const QuadratureRule panel = gauss_legendre(24);
    constexpr Index kPanels = 30;
    const auto points = static_cast<Index>(panel.points.size());
    Eigen::MatrixXd bessel(count, kPanels * points);
    Eigen::VectorXd normal(kPanels * points), shear(normal.size()), coupling(normal.size());
    for (Index k = 0; k < normal.size(); ++k) {
      const auto i = static_cast<std::size_t>(k % points);
      const Index whole = k / points;
      const double x = static_cast<double>(whole) + panel.points[i];
      const Compliance compliance = layer_less_half_space(x, nu);
      bessel.col(k) = spherical_bessel(r * x, count);
      normal[k] = r * panel.weights[i] * compliance.normal;
      shear[k] = r * panel.weights[i] * compliance.shear;
      coupling[k] = r * panel.weights[i] * compliance.coupling;
    }
    const auto even = Eigen::seq(0, count - 2, 2), odd = Eigen::seq(1, count - 1, 2);
    const Eigen::MatrixXd pressure = bessel(even, Eigen::all), friction = bessel(odd, Eigen::all);
    system(even, even) += pressure * normal.asDiagonal() * pressure.transpose();
    system(odd, odd) += friction * shear.asDiagonal() * friction.transpose();
    const Eigen::MatrixXd mixed = pressure * coupling.asDiagonal() * friction.transpose();
    system(even, odd) += mixed;
    system(odd, even) += mixed.transpose();
  }
  const Eigen::VectorXd stresses =
      LuFactor(system).solve(Eigen::VectorXd(Eigen::VectorXd::Unit(count, 0)));
  return 0.5 * std::numbers::pi * (1.0 - nu) * stresses[0];
}

}  // namespace

double sticking_layer_factor(double radius_over_thickness, double poisson_ratio) {
  require_layer(radius_over_thickness, poisson_ratio);
  // Unless nu = 0.5 the stress oscillates at the edge, so the error falls as pairs^-2. Richardson
  // extrapolation removes that term.
  const double coarse = galerkin_factor(radius_over_thickness, poisson_ratio, 12);
  const double fine = galerkin_factor(radius_over_thickness, poisson_ratio, 24);
  return fine + (fine - coarse) / 3.0;
}

}  // namespace viscard
