#include "models/pillar/large/finite_law.h"

#include "models/maths/require.h"

#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Strain4 = Eigen::Vector4d;  // rr, zz, 2 rz, tt
using Strain4ByGradient = Eigen::Matrix<double, 4, 5>;

// Entries of F = I + gradient, in the order of the gradient.
struct Deformed {
  double rr, rz, tt, zr, zz;
  explicit Deformed(const Gradient5& g)
      : rr(1.0 + g[0]), rz(g[1]), tt(1.0 + g[2]), zr(g[3]), zz(1.0 + g[4]) {}
};

// Green's strain E = (H + H^t + H^t H)/2, from the gradient so that no digits are lost near rest.
Strain4 green_strain(const Gradient5& g) {
  return {g[0] + 0.5 * (g[0] * g[0] + g[3] * g[3]), g[4] + 0.5 * (g[1] * g[1] + g[4] * g[4]),
          g[1] + g[3] + g[0] * g[1] + g[3] * g[4], g[2] + 0.5 * g[2] * g[2]};
}

Strain4ByGradient strain_by_gradient(const Deformed& F) {
  Strain4ByGradient T = Strain4ByGradient::Zero();
  T(0, 0) = F.rr;
  T(0, 3) = F.zr;
  T(1, 1) = F.rz;
  T(1, 4) = F.zz;
  T(2, 0) = F.rz;
  T(2, 1) = F.rr;
  T(2, 3) = F.zz;
  T(2, 4) = F.zr;
  T(3, 2) = F.tt;
  return T;
}

// Principal values of Green's strain, and the rows that take them from its four entries.
struct Principal {
  Eigen::Vector3d strain;           // two in the meridian plane, one around the axis
  Eigen::Matrix<double, 3, 4> row;  // of each
  Eigen::RowVector4d shear;         // of the entry off the diagonal in principal axes
};

Principal principal_of(const Strain4& E) {
  const double mean = 0.5 * (E[0] + E[1]);
  const double half = 0.5 * (E[0] - E[1]);
  const double off = 0.5 * E[2];
  const double radius = std::hypot(half, off);
  const double angle = 0.5 * std::atan2(off, half);
  const double c = std::cos(angle), s = std::sin(angle);
  Principal p;
  p.strain = {mean + radius, mean - radius, E[3]};
  p.row << c * c, s * s, c * s, 0.0, s * s, c * c, -c * s, 0.0, 0.0, 0.0, 0.0, 1.0;
  p.shear << -c * s, c * s, 0.5 * (c * c - s * s), 0.0;
  return p;
}

// Of the energy without its volumetric part, by the logarithms of the principal stretches.
LogDerivatives by_log_strain(const FiniteLaw& law, const Eigen::Vector3d& e) {
  LogDerivatives w;
  if (law.rubber) {
    const Eigen::Vector3d isochoric = e.array() - e.mean();
    if (!is_within_limit(*law.rubber, isochoric)) {
      w.gradient.setConstant(std::numeric_limits<double>::quiet_NaN());
      return w;
    }
    w = log_derivatives(*law.rubber, isochoric);
    const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - Eigen::Matrix3d::Constant(1.0 / 3.0);
    w.gradient = P * w.gradient;
    w.hessian = P * w.hessian * P;
    return w;
  }
  const Eigen::Vector3d green = e.unaryExpr([](double x) { return 0.5 * std::expm1(2.0 * x); });
  const Eigen::Vector3d squares = 2.0 * green.array() + 1.0;
  const double lame_Pa = law.bulk_Pa - 2.0 / 3.0 * law.shear_Pa;
  const Eigen::Vector3d second =
      lame_Pa * Eigen::Vector3d::Constant(green.sum()) + 2.0 * law.shear_Pa * green;
  w.gradient = second.cwiseProduct(squares);
  w.hessian = lame_Pa * squares * squares.transpose();
  w.hessian.diagonal().array() +=
      squares.array() * (2.0 * law.shear_Pa * squares.array() + 2.0 * second.array());
  return w;
}

// (S_1 - S_2)/(2 (E_1 - E_2)), and its limit, half the difference of the derivatives, where both
// strains are so close that the quotient has fewer digits than the limit.
double shear_stiffness(const Eigen::Vector3d& stress, const Eigen::Vector3d& strain,
                       const Eigen::Matrix3d& D) {
  const double difference = strain[0] - strain[1];
  if (difference > 1e-5 * (1.0 + std::abs(strain[0] + strain[1]))) {
    return 0.5 * (stress[0] - stress[1]) / difference;
  }
  return 0.25 * (D(0, 0) + D(1, 1) - 2.0 * D(0, 1));
}

bool is_inside_out(const Deformed& F) {
  return !(F.tt > 0.0) || !(F.rr * F.zz - F.rz * F.zr > 0.0);
}

}  // namespace

FiniteLaw finite_law(const HyperelasticLaw& rubber, double nu) {
  validate(rubber);
  require_value(nu >= 0.0 && nu <= 0.5, "the Poisson ratio of rubber at large strain", nu, "",
                "from 0 to 0.5");
  FiniteLaw law{rubber, 0.0, 0.0, nu};
  law.rubber->moduli_Pa *= 1.5 / (1.0 + nu);
  law.shear_Pa = youngs_modulus_Pa(*law.rubber) / 3.0;
  law.bulk_Pa = nu < 0.5 ? law.shear_Pa * 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu))
                         : std::numeric_limits<double>::infinity();
  return law;
}

FiniteLaw st_venant_kirchhoff(double E_Pa, double nu) {
  require_positive("Young's modulus", E_Pa, "Pa");
  require_value(nu > -1.0 && nu < 0.5, "the Poisson ratio of St Venant-Kirchhoff", nu, "",
                "between -1 and 0.5");
  return {std::nullopt, E_Pa / (2.0 * (1.0 + nu)), E_Pa / (3.0 * (1.0 - 2.0 * nu)), nu};
}

// Bonet & Wood, eq. 6.37 and 6.40: S_a = (dW/de_a)/s_a^2 along the principal axes at rest, and its
// derivatives by Green's strain.
GradientDerivatives shape_energy(const FiniteLaw& law, const Gradient5& gradient) {
  GradientDerivatives out;
  const Deformed F(gradient);
  const Principal p = principal_of(green_strain(gradient));
  const Eigen::Vector3d log_strain =
      p.strain.unaryExpr([](double E) { return 0.5 * std::log1p(2.0 * E); });
  const LogDerivatives w = by_log_strain(law, log_strain);
  if (is_inside_out(F) || !w.gradient.allFinite()) {
    out.stress.setConstant(std::numeric_limits<double>::quiet_NaN());
    out.tangent.setConstant(std::numeric_limits<double>::quiet_NaN());
    return out;
  }
  const Eigen::Vector3d per_square = (1.0 + 2.0 * p.strain.array()).inverse();
  const Eigen::Vector3d stress = w.gradient.cwiseProduct(per_square);
  Eigen::Matrix3d D = w.hessian;
  D.diagonal() -= 2.0 * w.gradient;
  D = per_square.asDiagonal() * D * per_square.asDiagonal();
  const Eigen::Vector4d S = p.row.transpose() * stress;
  const Eigen::Matrix4d material =
      p.row.transpose() * D * p.row +
      4.0 * shear_stiffness(stress, p.strain, D) * p.shear.transpose() * p.shear;
  const Strain4ByGradient T = strain_by_gradient(F);
  out.stress = T.transpose() * S;
  out.tangent = T.transpose() * material * T;
  const auto add = [&](int i, int j, double value) {
    out.tangent(i, j) += value;
    if (i != j) out.tangent(j, i) += value;
  };
  add(0, 0, S[0]);
  add(3, 3, S[0]);
  add(1, 1, S[1]);
  add(4, 4, S[1]);
  add(0, 1, S[2]);
  add(3, 4, S[2]);
  add(2, 2, S[3]);
  return out;
}

double volume_change(const Gradient5& g) {
  const double plane = g[0] + g[4] + g[0] * g[4] - g[1] * g[3];
  return plane + g[2] + plane * g[2];
}

GradientDerivatives volume_derivatives(const Gradient5& gradient) {
  const Deformed F(gradient);
  const double plane = F.rr * F.zz - F.rz * F.zr;
  GradientDerivatives out;
  out.stress << F.zz * F.tt, -F.zr * F.tt, plane, -F.rz * F.tt, F.rr * F.tt;
  out.tangent(0, 4) = F.tt;
  out.tangent(1, 3) = -F.tt;
  out.tangent.row(2) << F.zz, -F.zr, 0.0, -F.rz, F.rr;
  const Tangent5 upper = out.tangent;
  out.tangent += upper.transpose();
  return out;
}

Eigen::Vector4d true_stress_Pa(const Gradient5& P, const Gradient5& gradient) {
  const Deformed F(gradient);
  const double J = 1.0 + volume_change(gradient);
  return Eigen::Vector4d(P[0] * F.rr + P[1] * F.rz, P[2] * F.tt, P[3] * F.zr + P[4] * F.zz,
                         P[0] * F.zr + P[1] * F.zz) /
         J;
}

}  // namespace viscard
