// A film on an elastic half-space: what it reads, how it moves under all pillars, contact on it.
#include "models/answer/scene_mistake.h"
#include "models/array/film/film_table.h"
#include "models/array/space/foot_motion.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_contact.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace viscard {
namespace {

using test::film_of_the_thesis;
using test::pvdf_of_the_thesis;

// A rigid base without a modulus.
LayeredFilm film_on(double E_Pa, double nu) {
  LayeredFilm film = film_of_the_thesis(12.5e-12, 12.5e-12);
  if (E_Pa > 0.0) film.backing = Backing{E_Pa, nu};
  return film;
}

constexpr double kPitch_m = 100e-6;

SpaceArray square_on(int n, const LayeredFilm& film) {
  SpaceArray array;
  array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
  array.film = film;
  array.electrode_radius_m = 20e-6;
  const int middle = n / 2;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      array.pillars.push_back({(column - middle) * kPitch_m, (row - middle) * kPitch_m, 0});
    }
  }
  return array;
}

// A uniform pressure of 1 Pa on a disc of 20 um, as forces at points.
FootForces uniform_disc() {
  FootForces foot;
  constexpr int kPoints = 400;
  constexpr double kRadius_m = 20e-6;
  foot.pressure.r = foot.pressure.z = Eigen::VectorXd::Zero(kPoints);
  foot.shear = foot.tilt = {foot.pressure.r, foot.pressure.r, foot.pressure.r};
  for (int i = 0; i < kPoints; ++i) {
    const double r_m = kRadius_m * (i + 0.5) / kPoints;
    foot.radius_m.push_back(r_m);
    foot.pressure.z[i] = -2.0 * std::numbers::pi * r_m * kRadius_m / kPoints;
  }
  return foot;
}

TEST_CASE("a pressed disc on a backed film reads as finite elements find", "[models]") {
  // FreeFEM, axisymmetric, degree 2, 108 000 unknowns in a domain of 24 mm: mV at r = 0, 50, 100, 200 um
  // per kPa. A half-space of PDMS is felt to the end of that domain (5e-3 of the smallest values).
  struct Case {
    double E_Pa, nu;
    std::array<double, 4> mV;
    double margin_mV;
  };
  const std::array<double, 4> kRadius_m = {0.0, 50e-6, 100e-6, 200e-6};
  for (const Case& one : {Case{0.0, 0.0, {-2.67199, -0.09662, -0.00017, 0.00007}, 2e-5},
                          Case{4e9, 0.38, {-2.47526, -0.07717, 0.00388, 0.00040}, 2e-5},
                          Case{1.8e6, 0.49, {-2.30205, -0.13979, 0.00425, 0.00534}, 2e-4}}) {
    const FilmTable film(film_on(one.E_Pa, one.nu), 14.0, 2, 9, 1e-3);
    const FootForces foot = uniform_disc();
    const PotentialSpectrum spectrum =
        graded_spectrum(film, potential_reading(film), foot, film.largest_k_1_m(), 2e4, false);
    const WideTable table = one.E_Pa > 0.0 ? WideTable(PotentialTable(spectrum, {}, 150e-6), film,
                                                       potential_reading(film), foot)
                                           : WideTable(PotentialTable(spectrum, {}, 250e-6));
    for (std::size_t i = 0; i < kRadius_m.size(); ++i) {
      CAPTURE(one.E_Pa, kRadius_m[i]);
      CHECK(1e6 * table.at(kRadius_m[i], 0.0)[0] == Approx(one.mV[i]).margin(one.margin_mV));
    }
  }
}

TEST_CASE("beyond the near table the waves of a half-space go on without a step", "[models]") {
  // Against one table of all waves for all distances.
  const FilmTable film(film_on(1.8e6, 0.49), 10.0, 2, 8, 3e-3);
  const FootForces foot = uniform_disc();
  const auto near = [&](double reach_m) {
    return PotentialTable(graded_spectrum(film, potential_reading(film), foot, film.largest_k_1_m(),
                                          kWavePhase / reach_m, false),
                          {}, reach_m);
  };
  const WideTable table(near(250e-6), film, potential_reading(film), foot);
  const PotentialTable all = near(2.5e-3);
  for (const double r_m : {251e-6, 300e-6, 400e-6, 600e-6, 999e-6, 1.01e-3, 2.4e-3}) {
    CAPTURE(r_m);
    CHECK(1e9 * table.at(r_m, 0.0)[0] == Approx(1e9 * all.at(r_m, 0.0)[0]).epsilon(1e-3));
  }
}

TEST_CASE("a pillar on a stiff backing reads and settles as an independent program finds",
          "[models]") {
  // Fourier p-elements of another program, per kPa on one pillar: mV at centre and mean, per cent of
  // the mean at neighbours 1, sqrt 2, 2, 3 and 5 pitches away, m/Pa that the film settles under the
  // pillar and at a neighbour: there the mean over the foot, here weighted with the traction. Without the
  // film's edge.
  struct Case {
    double E_Pa, nu, centre, mean;
    std::array<double, 5> per_cent;
    double own_m_Pa, neighbour_m_Pa;
  };
  const std::array<std::array<double, 2>, 5> kOffset = {{{1, 0}, {1, 1}, {2, 0}, {3, 0}, {5, 0}}};
  for (const Case& one : {Case{20e9,
                               0.30,
                               -2.3475,
                               -1.8790,
                               {-0.1092, -0.0616, -0.0096, -0.0007, -0.0001},
                               7.76e-15,
                               1.8e-16},
                          Case{4e9,
                               0.38,
                               -2.2552,
                               -1.8039,
                               {-0.3016, -0.1351, -0.0356, -0.0075, -0.0014},
                               1.09e-14,
                               8.7e-16},
                          Case{2e9,
                               0.29,
                               -2.1337,
                               -1.6986,
                               {-1.0227, -0.4539, -0.1633, -0.0480, -0.0103},
                               1.46e-14,
                               1.9e-15}}) {
    CAPTURE(one.E_Pa);
    const SpaceArray array = square_on(11, film_on(one.E_Pa, one.nu));
    const SpaceResponse response(array, space_accuracies(array)[2]);
    const auto own = response.kernel(0, 0.0, 0.0);
    CHECK(1e6 * own(0, 0) == Approx(one.centre).epsilon(2e-4));
    CHECK(1e6 * own(1, 0) == Approx(one.mean).epsilon(2e-4));
    for (std::size_t i = 0; i < kOffset.size(); ++i) {
      const auto there = response.kernel(0, kOffset[i][0] * kPitch_m, kOffset[i][1] * kPitch_m);
      CAPTURE(i);
      CHECK(100.0 * there(1, 0) / own(1, 0) == Approx(one.per_cent[i]).margin(0.005));
    }
    const FootMotion motion(array);
    const double area_m2 = std::numbers::pi * 400e-12;
    BaseForces force = BaseForces::Zero(2, 3);
    force(0, 0) = area_m2;  // 1 Pa
    const BaseMotions moved = motion.under({60, 61})(force);
    CHECK(1e15 * moved(0, 0) == Approx(1e15 * one.own_m_Pa).epsilon(3e-2));
    CHECK(1e15 * moved(1, 0) == Approx(1e15 * one.neighbour_m_Pa).epsilon(3e-2));
  }
}

TEST_CASE("the traction of a foot is that on its film and its soft backing", "[models]") {
  // FreeFEM, axisymmetric, degree 2, pillar, film and half-space in one mesh (165 000 unknowns, 12 mm wide
  // and deep; on rubber the film ends at 1.5 mm, because the domain's side would hold a longer one): mV per
  // kPa at the centre, mean, and at 200 um, and m/Pa by which the top sinks. With the traction on a rigid
  // base the centre would read 6e-4 more on PDMS.
  struct Case {
    double E_Pa, nu, centre, mean, at_200_um, top_m_Pa, tolerance;
  };
  for (const Case& one : {Case{4e9, 0.38, -2.25505, -1.80389, 0.000626288, 6.59799e-11, 3e-5},
                          Case{10e6, 0.49, -2.16186, -1.7555, 0.00525074, 6.6437e-11, 5e-5},
                          Case{1.8e6, 0.49, -2.17295, -1.7671, 0.00538616, 6.74456e-11, 5e-5}}) {
    CAPTURE(one.E_Pa);
    const SpaceArray array = square_on(3, film_on(one.E_Pa, one.nu));
    const SpaceResponse response(array, space_accuracies(array)[3]);
    const auto own = response.kernel(0, 0.0, 0.0);
    CHECK(1e6 * own(0, 0) == Approx(one.centre).epsilon(one.tolerance));
    CHECK(1e6 * own(1, 0) == Approx(one.mean).epsilon(one.tolerance));
    // The end of the film changes 1e-4 here and 2e-5 under the pillar.
    CHECK(1e6 * response.kernel(0, 200e-6, 0.0)(0, 0) ==
          Approx(one.at_200_um).margin(3.0 * one.tolerance));
    const double top_m_Pa = response.foot(0).sinking_m_Pa +
                            FootMotion(array).own_sinking_m_N(0) * std::numbers::pi * 400e-12;
    CHECK(1e11 * top_m_Pa == Approx(1e11 * one.top_m_Pa).epsilon(1e-3));
  }
}

TEST_CASE("an array on a backing answers by FFT as by single sums", "[models]") {
  // The middle row of the lattice stands a nanometre aside, so that it is none: summed pair by pair.
  SpaceArray lattice = square_on(5, film_on(10e6, 0.49));
  lattice.electrode = SpaceElectrode::kQuadrants;
  SpaceArray aside = lattice;
  aside.pillars[12].x_m += 1e-9;
  TopLoads loads = TopLoads::Zero(25, kTopLoads);
  for (int i = 0; i < 25; ++i) {
    loads.row(i) << 1e3 * std::cos(i), 50.0 * std::sin(2 * i), 70.0 * std::cos(3 * i),
        20.0 * std::sin(5 * i), 30.0 * std::cos(7 * i);
  }
  const SpaceAccuracy accuracy = space_accuracies(lattice)[0];
  const Eigen::MatrixXd by_fft = SpaceResponse(lattice, accuracy).voltages_V(loads);
  const Eigen::MatrixXd by_pairs = SpaceResponse(aside, accuracy).voltages_V(loads);
  CHECK((by_fft - by_pairs).cwiseAbs().maxCoeff() < 1e-3 * by_pairs.cwiseAbs().maxCoeff());
}

TEST_CASE("motions under feet on a backing are reciprocal and positive", "[models]") {
  SpaceArray array = square_on(3, film_on(1.8e6, 0.49));
  array.classes.push_back({{.diameter_m = 30e-6, .length_m = 100e-6}, array.classes[0].medium});
  for (const std::size_t i : {1U, 5U}) array.pillars[i].of_class = 1;
  const FootMotion motion(array);
  const YieldingBase base = motion.under({0, 1, 2, 3, 4, 5, 6, 7, 8});
  Eigen::MatrixXd W(27, 27);
  const double kLever_m = 10e-6;  // moments as forces
  for (int column = 0; column < 27; ++column) {
    BaseForces force = BaseForces::Zero(9, 3);
    const double scale = column % 3 == 0 ? 1.0 : kLever_m;
    force(column / 3, column % 3) = scale;
    const BaseMotions moved = base(force);
    for (int row = 0; row < 27; ++row) {
      W(row, column) = moved(row / 3, row % 3) * (row % 3 == 0 ? 1.0 : kLever_m);
    }
  }
  CHECK((W - W.transpose()).cwiseAbs().maxCoeff() < 1e-6 * W.cwiseAbs().maxCoeff());
  Eigen::VectorXd x(27);
  for (int trial = 0; trial < 20; ++trial) {
    for (int i = 0; i < 27; ++i) x[i] = std::sin(1.7 * i * (trial + 1) + trial);
    CHECK(x.dot(W * x) > 0.0);
  }
}

SpaceScene pressed(int n, std::optional<Backing> backing, double depth_m) {
  SpaceScene scene;
  scene.tolerance = 5e-3;
  scene.rows = scene.columns = n;
  scene.pillars = lattice_places(SpaceLattice::kSquare, n, n, kPitch_m);
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis(12.5e-12, 12.5e-12);
  scene.backing = backing;
  ShapePress press;
  press.shape.kind = ShapeKind::kParaboloid;
  press.shape.radius_m = 0.1;
  press.depth_m = depth_m;
  scene.press = press;
  return scene;
}

TEST_CASE("a sphere on an array on a soft half-space presses as an independent program finds",
          "[models]") {
  // 100 x 100 pillars, R 100 mm, 3 um deep: FFT and conjugate gradients with tops that are touched or
  // not as a whole, which leaves 1e-3 at the rim; and with traction of a foot on a rigid base.
  const SpaceContact soft = contact_on(pressed(100, Backing{1.8e6, 0.49}, 3e-6), 1);
  CHECK(soft.pressed.force_N == Approx(2.6141e-3).epsilon(1e-3));
  CHECK(soft.loads_Pa.col(0).maxCoeff() == Approx(26.05e3).epsilon(1.5e-3));
  // Tops at the rim are touched in part, which there count as free.
  CHECK(soft.pressed.contacts >= 148);
  CHECK(soft.pressed.contacts <= 172);
  const SpaceContact stiff = contact_on(pressed(100, Backing{4e9, 0.38}, 3e-6), 1);
  CHECK(stiff.pressed.force_N == Approx(5.3740e-3).epsilon(1e-3));
}

TEST_CASE("on a backing depth and the load it gave agree, and the answer is symmetric",
          "[models]") {
  SpaceScene scene = pressed(20, Backing{1.8e6, 0.49}, 1.5e-6);
  const SpaceContact by_depth = contact_on(scene, 0);
  scene.press->force_N = by_depth.pressed.force_N;
  scene.press->depth_m = 0.0;
  const SpaceContact by_force = contact_on(scene, 0);
  CHECK(by_force.pressed.depth_m == Approx(1.5e-6).epsilon(1e-10));
  CHECK(by_force.pressed.contacts == by_depth.pressed.contacts);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      const auto force = [&](int r, int c) {
        return by_depth.pressed.tops[static_cast<std::size_t>(20 * r + c)].force_N;
      };
      CHECK(force(row, column) ==
            Approx(force(19 - row, column)).margin(1e-9 * by_depth.largest_force_N()));
      CHECK(force(row, column) ==
            Approx(force(row, 19 - column)).margin(1e-9 * by_depth.largest_force_N()));
    }
  }
}

TEST_CASE("a very stiff backing is a rigid base", "[models]") {
  SpaceScene scene = pressed(10, Backing{1e16, 0.3}, 1e-6);
  const SpaceContact backed = contact_on(scene, 0);
  scene.backing.reset();
  const SpaceContact rigid = contact_on(scene, 0);
  CHECK(backed.pressed.force_N == Approx(rigid.pressed.force_N).epsilon(1e-5));
  const SpaceArray on_rigid = square_on(3, film_of_the_thesis());
  SpaceArray on_stiff = on_rigid;
  on_stiff.film.backing = Backing{1e16, 0.3};
  TopLoads loads = TopLoads::Zero(9, kTopLoads);
  loads.row(4) << 1e3, 200.0, 100.0, 50.0, 20.0;
  const SpaceAccuracy accuracy = space_accuracies(on_rigid)[2];
  const Eigen::MatrixXd expected = SpaceResponse(on_rigid, accuracy).voltages_V(loads);
  const Eigen::MatrixXd stiff =
      SpaceResponse(on_stiff, space_accuracies(on_stiff)[2]).voltages_V(loads);
  // The film's own compliance under the foot, which the rigid foot leaves out (eq. S7), is 3e-5.
  CHECK((stiff - expected).cwiseAbs().maxCoeff() < 1e-4 * expected.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace viscard
