#include "models/array/contact/sticking_top.h"
#include "models/array/contact/top_contact.h"
#include "models/contact/punch_contact.h"
#include "models/pillar/system/medium.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kModulus_Pa = 1.8e6;

StickingCompliance sticking(double diameter_m, double length_m, double nu,
                            const TopFineness& fineness) {
  return sticking_compliance(PillarGeometry{.diameter_m = diameter_m, .length_m = length_m},
                             isotropic_medium(kModulus_Pa, nu, 965.0), fineness);
}

// Numbers between -1 and 1 that look like noise.
PointVectors some_vectors(Eigen::Index rows, Eigen::Index columns, double seed) {
  return PointVectors::NullaryExpr(rows, columns, [&](Eigen::Index i, Eigen::Index j) {
    return std::sin(seed + 12.9898 * static_cast<double>(i) + 78.233 * static_cast<double>(j * j));
  });
}

}  // namespace

TEST_CASE("a flat shape that sticks to a pillar without lateral contraction presses a column E A/l",
          "[models][reduction]") {
  const double d_m = 40e-6, l_m = 90e-6, depth_m = 2e-6;
  const StickingTop top(sticking(d_m, l_m, 0.0, {.elements = 4, .angles = 8}));
  const TopPressure pressure = top.press([&](double, double) { return depth_m; });
  const double area_m2 = 0.25 * std::numbers::pi * d_m * d_m;
  CHECK(pressure.force_N == Approx(kModulus_Pa * area_m2 / l_m * depth_m).epsilon(1e-10));
  CHECK(pressure.share == 1.0);
  CHECK(std::abs(pressure.shear_x_N) < 1e-12 * pressure.force_N);
}

// By symmetry, the middle of a cylinder that is bonded at both ends moves as under a plate that slides.
TEST_CASE("a pillar between two planes that stick is two halves under a plate that slides",
          "[models][identity]") {
  for (const double nu : {0.33, 0.49, 0.5}) {
    for (const double half_m : {10e-6, 60e-6}) {
      CAPTURE(nu, half_m);
      const TopFineness fineness{.elements = 12, .angles = 8};
      const StickingTop whole(sticking(40e-6, 2.0 * half_m, nu, fineness));
      const TopContact half(top_compliance(PillarGeometry{.diameter_m = 40e-6, .length_m = half_m},
                                           isotropic_medium(kModulus_Pa, nu, 965.0), fineness));
      const auto rings = static_cast<Eigen::Index>(half.compliance().radius_m.size());
      const double half_N = half.forces(Eigen::MatrixXd::Constant(rings, 8, 1e-6)).sum();
      const double whole_N = whole.press([](double, double) { return 2e-6; }).force_N;
      // The singular rim of the end that sticks is less fine than that of the foot.
      CHECK(whole_N == Approx(half_N).epsilon(1.5e-3));
    }
  }
}

// Both see the same edge of the punch, whose size on the grid is known to 2 % only; the ratio of their forces is known
// much better.
TEST_CASE("a flat punch that sticks bears more than one that slides as on a bonded layer",
          "[models][identity]") {
  const double H_m = 20e-6, rim_m = 50e-6, depth_m = 1e-6;
  for (const double nu : {0.2, 0.33}) {
    const PillarGeometry layer{.diameter_m = 2.0 * rim_m, .length_m = H_m};
    const Medium medium = isotropic_medium(kModulus_Pa, nu, 965.0);
    const TopFineness fineness{.elements = 24, .angles = 4};
    const StickingTop sticks(sticking_compliance(layer, medium, fineness));
    const TopContact slides(top_compliance(layer, medium, fineness));
    for (const double radius_m : {19.5e-6, 22.3e-6}) {
      CAPTURE(nu, radius_m);
      const Overlap punch = [&](double x, double y) {
        return std::hypot(x, y) <= radius_m ? depth_m : -HUGE_VAL;
      };
      const auto factor = [&](bool is_sticking) {
        return layer_factor({.punch_radius_m = radius_m,
                             .layer_thickness_m = H_m,
                             .poisson_ratio = nu,
                             .is_sticking = is_sticking});
      };
      const double ratio = sticks.press(punch).force_N / slides.press(punch).force_N;
      CHECK(ratio == Approx(factor(true) / factor(false)).epsilon(2.5e-3));
    }
  }
}

// Of a clamped beam whose other end turns by an angle and does not move, M = (4 + phi)/(1 + phi) E I/l
// per angle and F = 6/(1 + phi) E I/l^2, phi = 12 E I/(kappa G A l^2): Przemieniecki, Theory of Matrix
// Structural Analysis (1968), 5.6; kappa = 6/7 at nu = 0: Cowper, J. Appl. Mech. 33 (1966) 335.
TEST_CASE("a slender pillar whose top turns and does not slide is a clamped beam",
          "[models][reduction]") {
  const double d_m = 40e-6, l_m = 200e-6, slope = 0.01, R_m = 0.5 * d_m;
  const StickingTop top(sticking(d_m, l_m, 0.0, {.elements = 6, .angles = 8}));
  const TopPressure pressure = top.follow([&](double x, double) { return slope * x; });
  const double I_m4 = 0.25 * std::numbers::pi * std::pow(R_m, 4);
  const double phi = 12.0 * I_m4 * 2.0 / (6.0 / 7.0 * std::numbers::pi * R_m * R_m * l_m * l_m);
  const double moment_Nm = (4.0 + phi) / (1.0 + phi) * kModulus_Pa * I_m4 / l_m * slope;
  const double shear_N = 6.0 / (1.0 + phi) * kModulus_Pa * I_m4 / (l_m * l_m) * slope;
  CHECK(pressure.moment_x_Nm == Approx(moment_Nm).epsilon(1e-3));
  // Pressed on its side toward +x the top would move there; the shape holds it back.
  CHECK(pressure.shear_x_N == Approx(-shear_N).epsilon(1e-3));
  CHECK(std::abs(pressure.moment_y_Nm) < 1e-9 * moment_Nm);
}

TEST_CASE("forces and motions of a top that sticks are reciprocal and inverse",
          "[models][identity]") {
  const StickingTop top(sticking(40e-6, 50e-6, 0.4, {.elements = 5, .angles = 12}));
  const PointVectors a_N = 1e-6 * some_vectors(30, 12, 0.3), b_N = 1e-6 * some_vectors(30, 12, 1.7);
  const double ab_J = a_N.cwiseProduct(top.motion(b_N)).sum();
  CHECK(ab_J == Approx(b_N.cwiseProduct(top.motion(a_N)).sum()).epsilon(1e-9));
  CHECK((top.forces(top.motion(a_N)) - a_N).cwiseAbs().maxCoeff() < 1e-8 * a_N.maxCoeff());
}

TEST_CASE("points of a sticking top push where they touch, and do not slide there", "[models]") {
  const StickingTop top(sticking(40e-6, 120e-6, 0.33, {.elements = 8, .angles = 24}));
  const auto rings = static_cast<Eigen::Index>(top.compliance().radius_m.size());
  Eigen::MatrixXd overlap_m(rings, 24);
  for (Eigen::Index ring = 0; ring < rings; ++ring) {
    for (int a = 0; a < 24; ++a) {
      const double x_m = top.compliance().radius_m[static_cast<std::size_t>(ring)] *
                         std::cos(2.0 * std::numbers::pi * a / 24);
      overlap_m(ring, a) = 1e-6 + 0.1 * x_m;
    }
  }
  const PointVectors f_N = top.pushing_forces(overlap_m);
  const PointVectors moved_m = top.motion(f_N);
  const auto down = f_N.bottomRows(rings).array();
  CHECK(down.minCoeff() >= 0.0);
  CHECK((down > 0.0).count() < down.size());
  const double size_m = overlap_m.maxCoeff();
  for (int direction = 0; direction < 2; ++direction) {
    const auto slides = moved_m.middleRows(direction * rings, rings).array();
    CHECK((down > 0.0).select(slides, 0.0).abs().maxCoeff() < 1e-8 * size_m);
  }
  const auto left_m = overlap_m.array() - moved_m.bottomRows(rings).array();
  CHECK((down > 0.0).select(left_m, 0.0).abs().maxCoeff() < 1e-8 * size_m);
  CHECK(left_m.maxCoeff() < 1e-3 * size_m);  // a point at the edge that was let go three times
}

TEST_CASE("a top that sticks answers a turned shape with turned forces, and converges",
          "[models][convergence]") {
  const TopFineness grids[] = {{6, 16}, {12, 32}, {24, 64}};
  std::vector<TopPressure> answers;
  for (const TopFineness& fineness : grids) {
    const StickingTop top(sticking(40e-6, 120e-6, 0.33, fineness));
    answers.push_back(top.press([](double x, double) { return 1e-6 + 0.1 * x; }));
    const TopPressure turned = top.press([](double, double y) { return 1e-6 - 0.1 * y; });
    const TopPressure& last = answers.back();
    CHECK(turned.force_N == Approx(last.force_N).epsilon(1e-8));
    CHECK(turned.moment_y_Nm == Approx(-last.moment_x_Nm).epsilon(1e-8));
    CHECK(turned.shear_y_N == Approx(-last.shear_x_N).epsilon(1e-8));
    CHECK(std::abs(turned.torque_Nm) < 1e-8 * last.moment_x_Nm);
  }
  const double first = std::abs(answers[1].force_N - answers[0].force_N);
  const double second = std::abs(answers[2].force_N - answers[1].force_N);
  CHECK(second < 0.5 * first);
  CHECK(second < 1e-3 * answers[2].force_N);
  // Held tops bear more than tops that slide.
  const TopContact slides(top_compliance(PillarGeometry{.diameter_m = 40e-6, .length_m = 120e-6},
                                         isotropic_medium(kModulus_Pa, 0.33, 965.0), grids[1]));
  CHECK(answers[1].force_N > slides.press([](double x, double) { return 1e-6 + 0.1 * x; }).force_N);
}

TEST_CASE("a sticking top is given the stiffness of a finer mesh", "[models]") {
  StickingCompliance top = sticking(40e-6, 120e-6, 0.33, {.elements = 4, .angles = 8});
  const StickingCompliance::Means before = top.means();
  const StickingCompliance::Means wanted{.sinking_m_N = 1.01 * before.sinking_m_N,
                                         .sideways_m_N = 1.02 * before.sideways_m_N,
                                         .turning_rad_N = 1.03 * before.turning_rad_N,
                                         .turning_rad_Nm = 1.04 * before.turning_rad_Nm};
  top.adjust(wanted);
  CHECK(top.means().sinking_m_N == Approx(wanted.sinking_m_N).epsilon(1e-12));
  CHECK(top.means().sideways_m_N == Approx(wanted.sideways_m_N).epsilon(1e-12));
  CHECK(top.means().turning_rad_N == Approx(wanted.turning_rad_N).epsilon(1e-12));
  CHECK(top.means().turning_rad_Nm == Approx(wanted.turning_rad_Nm).epsilon(1e-12));
}

}  // namespace viscard
