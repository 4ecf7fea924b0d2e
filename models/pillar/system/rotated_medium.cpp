#include "models/pillar/system/rotated_medium.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Rotates Voigt stresses about z (Auld, Acoustic Fields and Waves in Solids (1973), ch. 3); strains
// rotate with the inverse transpose.
Matrix6d stress_rotation(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Matrix6d M = Matrix6d::Zero();
  M << c * c, s * s, 0, 0, 0, 2 * c * s, s * s, c * c, 0, 0, 0, -2 * c * s, 0, 0, 1, 0, 0, 0, 0, 0,
      0, c, -s, 0, 0, 0, 0, s, c, 0, -c * s, c * s, 0, 0, 0, c * c - s * s;
  return M;
}

}  // namespace

Medium rotated_about_z(const Medium& medium, double angle) {
  const Matrix6d M = stress_rotation(angle);
  Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
  a.topLeftCorner<2, 2>() << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  Medium turned = medium;
  turned.stiffness_Pa = M * medium.stiffness_Pa * M.transpose();
  turned.piezo_C_m2 = a * medium.piezo_C_m2 * M.transpose();
  turned.permittivity_F_m = a * medium.permittivity_F_m * a.transpose();
  return turned;
}

bool is_isotropic_about_z(const Medium& medium) {
  constexpr double kRounding = 1e-9;
  const Medium mean = averaged_about_z(medium);
  const auto same = [](const auto& a, const auto& b) {
    return (a - b).norm() <= kRounding * b.norm();
  };
  return same(medium.stiffness_Pa, mean.stiffness_Pa) && same(medium.piezo_C_m2, mean.piezo_C_m2) &&
         same(medium.permittivity_F_m, mean.permittivity_F_m);
}

Medium averaged_about_z(const Medium& medium) {
  Medium mean = medium;
  mean.stiffness_Pa.setZero();
  mean.piezo_C_m2.setZero();
  mean.permittivity_F_m.setZero();
  constexpr int kAngles = 8;  // fourth-order harmonics and lower cancel exactly
  for (int i = 0; i < kAngles; ++i) {
    const Medium turned = rotated_about_z(medium, 2.0 * std::numbers::pi * i / kAngles);
    mean.stiffness_Pa += turned.stiffness_Pa / kAngles;
    mean.piezo_C_m2 += turned.piezo_C_m2 / kAngles;
    mean.permittivity_F_m += turned.permittivity_F_m / kAngles;
  }
  return mean;
}

}  // namespace viscard
