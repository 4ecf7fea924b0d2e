#include "models/array/contact/top_contact.h"
#include "models/pillar/system/medium.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kRadius_m = 20e-6;

TopContact contact_of(const TopFineness& fineness, double nu = 0.33) {
  return TopContact(top_compliance(PillarGeometry{.diameter_m = 40e-6, .length_m = 120e-6},
                                   isotropic_medium(1.8e6, nu, 965.0), fineness));
}

// Sphere on a layer that is bonded to a rigid base: a Nystrom solution of the layer's integral
// equation (40 and 80 points agree to 1e-14). a: radius of contact; force over Hertz's at this radius.
struct OnLayer {
  double nu = 0.0, a_over_H = 0.0, force_over_hertz = 0.0, depth_R_over_a2 = 0.0;
  double free_over_H = 0.0;  // beside the contact; what lies beyond does not matter
};

TEST_CASE("a sphere on a wide flat pillar is one on a bonded layer", "[models][convergence]") {
  const OnLayer cases[] = {{0.33, 1.0, 1.271405, 0.640892, 3.0},
                           {0.33, 5.0, 4.177367, 0.522115, 3.0},
                           {0.5, 1.0, 1.410500, 0.559415, 7.0}};
  for (const OnLayer& one : cases) {
    INFO("nu " << one.nu << ", a/H " << one.a_over_H);
    const double H_m = 10e-6, R_m = 1e-3, E_Pa = 1e6;
    const double a_m = one.a_over_H * H_m;
    const double rim_m = a_m + one.free_over_H * H_m;
    const int elements = static_cast<int>(std::lround(8.0 * rim_m / H_m));
    const TopContact top(top_compliance(PillarGeometry{.diameter_m = 2.0 * rim_m, .length_m = H_m},
                                        isotropic_medium(E_Pa, one.nu, 965.0),
                                        {.elements = elements, .angles = 4}));
    const double depth_m = one.depth_R_over_a2 * a_m * a_m / R_m;
    const TopPressure pressure =
        top.press([&](double x, double y) { return depth_m - (x * x + y * y) / (2.0 * R_m); });
    const double hertz_N = 4.0 / 3.0 * E_Pa / (1.0 - one.nu * one.nu) * a_m * a_m * a_m / R_m;
    CHECK(pressure.force_N == Approx(one.force_over_hertz * hertz_N).epsilon(1e-3));
    CHECK(std::sqrt(pressure.share) * rim_m == Approx(a_m).epsilon(0.03));
  }
}

TEST_CASE("a top that is touched everywhere bears the mean overlap", "[models]") {
  const TopContact top = contact_of({.elements = 8, .angles = 24});
  const double k_N_m = 1.0 / top.compliance().sinking_m_N();
  const double turning_Nm = 1.0 / top.compliance().turning_rad_Nm();
  const double R_m = 3650e-6, depth_m = 10e-6, x0_m = -40e-6, y0_m = 30e-6;
  const TopPressure pressure = top.press([&](double x, double y) {
    return depth_m - (std::pow(x - x0_m, 2) + std::pow(y - y0_m, 2)) / (2.0 * R_m);
  });
  const double mean_m =
      depth_m - (x0_m * x0_m + y0_m * y0_m + 0.5 * kRadius_m * kRadius_m) / (2.0 * R_m);
  CHECK(pressure.share == 1.0);
  CHECK_FALSE(pressure.is_partial);
  CHECK(pressure.force_N == Approx(k_N_m * mean_m).epsilon(1e-12));
  CHECK(pressure.moment_x_Nm == Approx(turning_Nm * x0_m / R_m).epsilon(1e-10));
  CHECK(pressure.moment_y_Nm == Approx(turning_Nm * y0_m / R_m).epsilon(1e-10));
  // The pressures at the points have the same sums: reciprocity on the grid.
  const Eigen::MatrixXd even = Eigen::MatrixXd::Constant(16, 24, 1e-6);
  CHECK(top.forces(even).sum() == Approx(k_N_m * 1e-6).epsilon(2e-4));
}

TEST_CASE("motion and forces of a top are inverse to each other", "[models]") {
  const TopContact top = contact_of({.elements = 6, .angles = 16});
  const Eigen::MatrixXd forces_N = 1e-6 * Eigen::MatrixXd::Random(12, 16);
  const Eigen::MatrixXd back_N = top.forces(top.motion(forces_N));
  CHECK((back_N - forces_N).cwiseAbs().maxCoeff() < 1e-9 * forces_N.cwiseAbs().maxCoeff());
}

TEST_CASE("partial contact of a round top converges", "[models][convergence]") {
  const TopContact coarse = contact_of({.elements = 6, .angles = 16});
  const TopContact fine = contact_of({.elements = 12, .angles = 32});
  const Overlap inclined = [](double x, double) { return 1e-6 + 0.1 * x; };
  const Overlap sphere = [](double x, double y) { return 1e-6 - (x * x + y * y) / 2e-4; };
  // 32 elements and 96 angles of the same method, base as on these grids.
  const TopPressure a = coarse.press(inclined), b = fine.press(inclined);
  CHECK(b.is_partial);
  CHECK(b.force_N == Approx(1.95237e-5).epsilon(5e-4));
  CHECK(b.moment_x_Nm == Approx(1.83437e-10).epsilon(5e-4));
  CHECK(std::abs(a.force_N - b.force_N) < 2e-3 * b.force_N);
  CHECK(fine.press(sphere).force_N == Approx(1.16932e-5).epsilon(1e-3));
}

TEST_CASE("what a shape on a top must hold holds", "[models][stability]") {
  const TopContact top = contact_of({.elements = 6, .angles = 16});
  const Overlap inclined = [](double x, double y) { return 4e-7 + 0.07 * x + 0.03 * y; };
  const TopPressure pressure = top.press(inclined);
  SECTION("a mirrored shape gives mirrored moments") {
    const TopPressure mirror = top.press([&](double x, double y) { return inclined(-x, y); });
    CHECK(mirror.force_N == Approx(pressure.force_N).epsilon(1e-9));
    CHECK(mirror.moment_x_Nm == Approx(-pressure.moment_x_Nm).epsilon(1e-9));
    CHECK(mirror.moment_y_Nm == Approx(pressure.moment_y_Nm).epsilon(1e-9));
  }
  SECTION("forces scale with the overlap") {
    for (const double scale : {1e-9, 1e-3, 10.0}) {
      const TopPressure scaled =
          top.press([&](double x, double y) { return scale * inclined(x, y); });
      CHECK(scaled.force_N == Approx(scale * pressure.force_N).epsilon(1e-9));
    }
  }
  SECTION("no point pulls, and no point overlaps") {
    Eigen::MatrixXd overlap_m(12, 16);
    for (int ring = 0; ring < 12; ++ring) {
      for (int a = 0; a < 16; ++a) {
        const double r_m = top.compliance().radius_m[static_cast<std::size_t>(ring)];
        const double angle = 2.0 * std::numbers::pi * a / 16;
        overlap_m(ring, a) = inclined(r_m * std::cos(angle), r_m * std::sin(angle));
      }
    }
    const Eigen::MatrixXd f = top.unilateral_forces(overlap_m, overlap_m);
    CHECK(f.minCoeff() >= 0.0);
    CHECK((overlap_m - top.motion(f)).maxCoeff() < 1e-8 * overlap_m.maxCoeff());
  }
  SECTION("deeper means more force") {
    double last_N = 0.0;
    for (double depth_m = -1.2e-6; depth_m < 3e-6; depth_m += 2e-7) {
      const double force_N =
          top.press([&](double x, double y) { return depth_m + 0.06 * x + 0.0 * y; }).force_N;
      CHECK(force_N >= last_N);
      last_N = force_N;
    }
  }
  SECTION("a surface that stays above, or at the top, bears nothing") {
    CHECK(top.press([](double, double) { return -1e-9; }).share == 0.0);
    CHECK(top.press([](double, double) { return 0.0; }).force_N == 0.0);
    CHECK(top.press([](double, double) { return -HUGE_VAL; }).share == 0.0);
  }
}

TEST_CASE("loads that change around a top do not reach down to where the mesh ends", "[models]") {
  // Harmonic 3 is solved on the upper two diameters of the long pillar, and on all of the short one.
  const auto top_of = [](double length_m) {
    return top_compliance(PillarGeometry{.diameter_m = 40e-6, .length_m = length_m},
                          isotropic_medium(1.8e6, 0.33, 965.0), {.elements = 12, .angles = 32});
  };
  const TopCompliance long_top = top_of(240e-6), short_top = top_of(79e-6);
  for (const std::size_t m : {3U, 4U, 8U, 16U}) {
    INFO("harmonic " << m);
    const double change = (long_top.harmonic_m_N[m] - short_top.harmonic_m_N[m]).norm();
    CHECK(change < 1e-8 * long_top.harmonic_m_N[m].norm());
  }
}

// 1.503e-5 N is the limit of 8, 16 and 32 elements over which the points of the grid lie on the edge.
TEST_CASE("an edge over the middle of a top converges, and does not turn the top along itself",
          "[models][convergence]") {
  const Overlap edge = [](double x, double) { return x >= -1e-12 ? 1e-6 : -HUGE_VAL; };
  const TopPressure coarse = contact_of({.elements = 6, .angles = 16}).press(edge);
  const TopPressure middle = contact_of({.elements = 12, .angles = 32}).press(edge);
  const TopPressure fine = contact_of({.elements = 24, .angles = 64}).press(edge);
  CHECK((coarse.force_N - middle.force_N) / (middle.force_N - fine.force_N) ==
        Approx(2.0).epsilon(0.15));
  CHECK(fine.force_N == Approx(1.503e-5).epsilon(3e-3));
  CHECK(std::abs(fine.moment_y_Nm) < 1e-9 * fine.moment_x_Nm);
  CHECK(fine.is_cut);
  CHECK(fine.is_partial);
  CHECK(fine.share < 0.5);  // its far side lifts
}

struct Cut {
  const char* name;
  Overlap overlap;
  bool is_edge = true;
};

Overlap edge_of(double direction, double at_m) {
  return [=](double x, double y) {
    return x * std::cos(direction) + y * std::sin(direction) >= at_m ? 1e-6 : -HUGE_VAL;
  };
}

// Changes of the force over a force, and of the moments over that force at half a radius, where a top begins to lift.
double change_of(const TopPressure& a, const TopPressure& b, double force_N) {
  const double moment_Nm = std::hypot(a.moment_x_Nm - b.moment_x_Nm, a.moment_y_Nm - b.moment_y_Nm);
  return std::max(std::abs(a.force_N - b.force_N), moment_Nm / (0.5 * kRadius_m)) / force_N;
}

// The finest grid of scenes, 48 elements and 128 angles, between those of half and of twice its fineness. An edge's
// error falls as the size of the elements: twice the change to the finer grid is left.
TEST_CASE("tops touched in part converge to two thousandths", "[models][convergence][slow]") {
  const TopContact coarse = contact_of({.elements = 24, .angles = 64});
  const TopContact fine = contact_of({.elements = 48, .angles = 128});
  const TopContact finest = contact_of({.elements = 96, .angles = 256});
  for (const Cut& one :
       {Cut{"edge over the middle", edge_of(0.0, 0.0)}, Cut{"turned by 0.05", edge_of(0.05, 0.0)},
        Cut{"by 0.3, at 0.3 um", edge_of(0.3, 0.3e-6)}, Cut{"by 0.7", edge_of(0.7, -2e-6)},
        Cut{"by 0.2, at 7 um", edge_of(0.2, 7e-6)},
        Cut{"plane", [](double x, double) { return 1e-6 + 0.1 * x; }, false},
        Cut{"sphere", [](double x, double y) { return 1e-6 - (x * x + y * y) / 2e-4; }, false}}) {
    CAPTURE(one.name);
    const TopPressure a = coarse.press(one.overlap), b = fine.press(one.overlap),
                      c = finest.press(one.overlap);
    CHECK(b.is_partial);
    CHECK(change_of(a, b, c.force_N) < (one.is_edge ? 2.7e-3 : 1e-4));
    CHECK(2.0 * change_of(b, c, c.force_N) < (one.is_edge ? 1.5e-3 : 6e-5));
  }
}

// The same surface, turned by any angle and moved by any part of the distance of points.
TEST_CASE("the force under an edge changes evenly as the edge moves", "[models][stability]") {
  const TopContact top = contact_of({.elements = 12, .angles = 32});
  double last_N = 0.0;
  for (double at_m = 12e-6; at_m > -12e-6; at_m -= 0.25e-6) {
    const double force_N =
        top.press([&](double x, double) { return x >= at_m ? 1e-6 : -HUGE_VAL; }).force_N;
    CAPTURE(at_m);
    CHECK(force_N > last_N);
    if (last_N > 0.0) CHECK(force_N - last_N < 0.04e-5);
    last_N = force_N;
  }
}

}  // namespace
}  // namespace viscard
