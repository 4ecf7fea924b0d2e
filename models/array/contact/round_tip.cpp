#include "models/array/contact/round_tip.h"

#include "models/array/contact/point_waves.h"
#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kLargestContact = 0.25;  // over the way from tip to rim
constexpr double kNearestRim = 0.3;       // of the top's radius
constexpr double kSteepest = 0.05;        // tilt of a sphere, above which its curvature changes

// <p, u> on a half-space for a pressure (1 - r^2/b^2)^mu of unit force, times E* b: its transform is
// 2^(mu+1) Gamma(mu + 2) J_(mu+1)(x)/x^(mu+1), and int J_n^2 x^(-2 n) dx is known (Watson, Theory of Bessel Functions
// (1944), 13.41). mu = 1/2, Hertz's pressure, gives 3/5.
double half_space_energy(double mu) {
  const double n = mu + 1.0;
  const double integral =
      std::tgamma(2.0 * n) * std::sqrt(std::numbers::pi) /
      (std::pow(2.0, 2.0 * n) * std::pow(std::tgamma(n + 0.5), 2) * std::tgamma(2.0 * n + 0.5));
  return std::pow(std::pow(2.0, n) * std::tgamma(n + 1.0), 2) * integral / std::numbers::pi;
}

// Coefficients of rho over <r^2>: three widths of a pressure with mu = 3/2, whose <r^2> is 2/7 of b^2.
Eigen::Vector3d rest_of_top(const RoundTip& tip, const TopCompliance& top, double to_rim_m,
                            const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& motion) {
  constexpr double kMu = 1.5;
  constexpr std::array<double, 3> kWidths = {0.45, 0.65, 0.85};  // of the way to the rim
  Eigen::Matrix3d powers;
  Eigen::Vector3d rest;
  for (std::size_t i = 0; i < kWidths.size(); ++i) {
    const double b_m = kWidths[i] * to_rim_m;
    Eigen::MatrixXd forces_N = Eigen::MatrixXd::Zero(top.ring_area_m2.size(), top.angles);
    double second_m2 = 0.0;
    for (Eigen::Index ring = 0; ring < forces_N.rows(); ++ring) {
      const double r_m = top.radius_m[static_cast<std::size_t>(ring)];
      for (int a = 0; a < top.angles; ++a) {
        const double angle = point_angle(a, top.angles);
        const double dx_m = r_m * std::cos(angle) - tip.x_m, dy_m = r_m * std::sin(angle) - tip.y_m;
        const double s2 = (dx_m * dx_m + dy_m * dy_m) / (b_m * b_m);
        if (s2 >= 1.0) continue;
        forces_N(ring, a) = top.ring_area_m2[ring] * std::pow(1.0 - s2, kMu);
        second_m2 += forces_N(ring, a) * s2 * b_m * b_m;
      }
    }
    const double sum_N = forces_N.sum();
    forces_N /= sum_N;
    second_m2 /= sum_N;
    const auto row = static_cast<Eigen::Index>(i);
    powers.row(row) << 1.0, second_m2, second_m2 * second_m2;
    rest[row] = forces_N.cwiseProduct(motion(forces_N)).sum() -
                half_space_energy(kMu) / (top.plane_modulus_Pa * b_m);
  }
  return powers.colPivHouseholderQr().solve(rest);
}

// Mean of the tip's height under Hertz's pressure of radius a, and its derivative.
struct MeanHeight {
  double height_m, slope;
};
MeanHeight mean_height(const RoundTip& tip, double a_m) {
  const double R_m = tip.radius_m;
  if (!tip.is_sphere) return {a_m * a_m / (5.0 * R_m), 0.4 * a_m / R_m};
  static const QuadratureRule kRule = gauss_legendre(16);
  MeanHeight mean{0.0, 0.0};
  for (std::size_t i = 0; i < kRule.points.size(); ++i) {
    // s = sqrt(1 - r^2/a^2) makes the weight 3 s^2 ds smooth.
    const double s = kRule.points[i], weight = 3.0 * s * s * kRule.weights[i];
    const double r2_m2 = a_m * a_m * (1.0 - s * s);
    const double left_m = std::sqrt(std::max(R_m * R_m - r2_m2, 0.0));
    mean.height_m += weight * r2_m2 / (R_m + left_m);
    mean.slope += weight * (1.0 - s * s) * a_m / std::max(left_m, 1e-3 * R_m);
  }
  return mean;
}

}  // namespace

std::optional<RoundTip> round_tip(const RigidShape& shape, double x_m, double y_m, double R_m,
                                  double depth_m) {
  const bool is_sphere = shape.kind == ShapeKind::kSphere;
  if (!is_sphere && shape.kind != ShapeKind::kParaboloid) return {};
  const double tilt = std::hypot(shape.tilt_x, shape.tilt_y);
  if (is_sphere && tilt > kSteepest) return {};
  // Where the surface is level: of a sphere at R s/sqrt(1 + s^2) from `at`.
  const double way_m = -shape.radius_m / (is_sphere ? std::sqrt(1.0 + tilt * tilt) : 1.0);
  RoundTip tip{.x_m = shape.x_m + way_m * shape.tilt_x - x_m,
               .y_m = shape.y_m + way_m * shape.tilt_y - y_m,
               .radius_m = shape.radius_m,
               .is_sphere = is_sphere};
  if (std::hypot(tip.x_m, tip.y_m) >= R_m) return {};
  tip.overlap_m = depth_m - height_m(shape, x_m + tip.x_m, y_m + tip.y_m);
  if (!(tip.overlap_m > 0.0)) return {};
  return tip;
}

std::optional<TopPressure> press_round_tip(
    const RoundTip& tip, const TopCompliance& top,
    const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces_N)>& motion) {
  const double R_m = top.radius_m.back();
  const double to_rim_m = R_m - std::hypot(tip.x_m, tip.y_m);
  const double most_m =
      std::min(kLargestContact * to_rim_m, tip.is_sphere ? 0.7 * tip.radius_m : HUGE_VAL);
  if (to_rim_m < kNearestRim * R_m) return {};
  const double Es_Pa = top.plane_modulus_Pa;
  // Saves the search where the contact is large for certain: the top yields less than on its half-space and under a
  // uniform pressure together.
  const double hertz_m = most_m * most_m / tip.radius_m;
  const double hertz_N = 4.0 / 3.0 * Es_Pa * most_m * hertz_m;
  if (tip.overlap_m > 2.0 * (hertz_m + hertz_N * top.sinking_m_N())) return {};
  const Eigen::Vector3d rho = rest_of_top(tip, top, to_rim_m, motion);
  const auto force_N = [&](double a_m) {
    const double m_m2 = 0.4 * a_m * a_m;
    const double falls = 0.6 / (Es_Pa * a_m * a_m) - (rho[1] + 2.0 * rho[2] * m_m2) * 0.8 * a_m;
    return 2.0 * mean_height(tip, a_m).slope / falls;
  };
  const auto overlap_m = [&](double a_m) {
    const double m_m2 = 0.4 * a_m * a_m;
    const double yields_m_N = 0.6 / (Es_Pa * a_m) + rho[0] + (rho[1] + rho[2] * m_m2) * m_m2;
    return mean_height(tip, a_m).height_m + force_N(a_m) * yields_m_N;
  };
  if (!(overlap_m(most_m) > tip.overlap_m)) return {};
  double low_m = 0.0, high_m = most_m;
  for (int i = 0; i < 200 && high_m - low_m > 1e-15 * most_m; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    (overlap_m(middle_m) < tip.overlap_m ? low_m : high_m) = middle_m;
  }
  const double a_m = 0.5 * (low_m + high_m);
  TopPressure pressure;
  pressure.force_N = force_N(a_m);
  pressure.moment_x_Nm = pressure.force_N * tip.x_m;
  pressure.moment_y_Nm = pressure.force_N * tip.y_m;
  pressure.share = a_m * a_m / (R_m * R_m);
  pressure.share_error = pressure.share * std::pow(a_m / to_rim_m, 2);
  pressure.largest_Pa = 1.5 * pressure.force_N / (std::numbers::pi * a_m * a_m);
  pressure.is_partial = true;
  return pressure;
}

}  // namespace viscard
