// Open electrodes that influence each other (eq. S17), against discs cut into cells of charge in real space.
#include "models/array/film/coupled_discs.h"
#include "models/array/space/space_array.h"
#include "models/maths/dense.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace viscard {
namespace {

constexpr double kPermittivity_F_m = 1e-10;
constexpr double kThickness_m = 25e-6;
constexpr double kRadius_m = 20e-6;
using Places = std::vector<std::pair<double, double>>;

// A film whose charges do not deform it, and whose potential under the pillars is therefore that of a dielectric.
LayeredFilm weakly_piezoelectric(double thickness_m = kThickness_m) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 2e-14;
  d(2, 2) = -3e-14;
  LayeredFilm film;
  film.layers = {{piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                               kPermittivity_F_m * Eigen::Matrix3d::Identity(), 0.0),
                  thickness_m}};
  return film;
}

SpaceArray array_at(const LayeredFilm& film, const Places& places) {
  SpaceArray array;
  array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
  array.film = film;
  array.electrode = SpaceElectrode::kEquipotential;
  array.electrode_radius_m = kRadius_m;
  for (const auto& [x_m, y_m] : places) array.pillars.push_back({x_m, y_m, 0});
  return array;
}

// Voltages of all pillars by each load on the first one.
Eigen::MatrixXd voltages_of_loads(const SpaceArray& array, const SpaceAccuracy& accuracy) {
  const SpaceResponse response(array, accuracy);
  const auto count = static_cast<Eigen::Index>(array.pillars.size());
  Eigen::MatrixXd voltages(count, kTopLoads);
  for (int load = 0; load < kTopLoads; ++load) {
    TopLoads loads = TopLoads::Zero(count, kTopLoads);
    loads(0, load) = 1.0;
    voltages.col(load) = response.voltages_V(loads);
  }
  return voltages;
}

struct Cell {
  double x_m, y_m, r_m, angle, dr_m, dangle;
  Eigen::Index disc;
};

// Rings that shrink toward the edge, where the charge is singular.
std::vector<Cell> cells_of(const Places& places, int rings, int sectors) {
  std::vector<Cell> cells;
  for (std::size_t d = 0; d < places.size(); ++d) {
    for (int i = 0; i < rings; ++i) {
      const double from_m = kRadius_m * std::sin(0.5 * std::numbers::pi * i / rings);
      const double to_m = kRadius_m * std::sin(0.5 * std::numbers::pi * (i + 1) / rings);
      for (int j = 0; j < sectors; ++j) {
        const double width = 2.0 * std::numbers::pi / sectors, angle = (j + 0.5) * width;
        const double r_m = 0.5 * (from_m + to_m);
        cells.push_back({places[d].first + r_m * std::cos(angle),
                         places[d].second + r_m * std::sin(angle), r_m, angle, to_m - from_m, width,
                         static_cast<Eigen::Index>(d)});
      }
    }
  }
  return cells;
}

// Images of a unit charge on a face without outer field, the other one grounded: an alternating series, summed by
// repeated means of its partial sums (Euler). Without the charge itself and the factor 1/(2 pi eps).
double images(double distance_m) {
  constexpr int kTerms = 33, kMeans = 6;
  std::array<double, kMeans> sums{};
  double sum = 0.0;
  for (int n = 1; n <= kTerms; ++n) {
    sum += (n % 2 == 0 ? 2.0 : -2.0) / std::hypot(distance_m, 2.0 * n * kThickness_m);
    sums[static_cast<std::size_t>(std::max(0, n - kTerms + kMeans - 1))] = sum;
  }
  for (std::size_t left = kMeans - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) sums[i] = 0.5 * (sums[i] + sums[i + 1]);
  }
  return sums[0];
}

// Mean of 1/distance over a cell: at its own middle that of a rectangle, elsewhere from its parts.
double mean_inverse(const Cell& of, const Cell& at, const std::pair<double, double>& axis) {
  const double wide_m = of.dr_m, long_m = of.r_m * of.dangle;
  const double distance_m = std::hypot(at.x_m - of.x_m, at.y_m - of.y_m);
  if (distance_m == 0.0) {
    return 2.0 / (wide_m * long_m) *
           (wide_m * std::asinh(long_m / wide_m) + long_m * std::asinh(wide_m / long_m));
  }
  const auto parts = [&](double m) {
    return std::clamp(static_cast<int>(std::ceil(2.0 * m / distance_m)), 1, 12);
  };
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < parts(wide_m); ++i) {
    for (int j = 0; j < parts(long_m); ++j) {
      const double r_m = of.r_m + wide_m * ((i + 0.5) / parts(wide_m) - 0.5);
      const double angle = of.angle + of.dangle * ((j + 0.5) / parts(long_m) - 0.5);
      sum += r_m / std::hypot(at.x_m - axis.first - r_m * std::cos(angle),
                              at.y_m - axis.second - r_m * std::sin(angle));
      weight += r_m;
    }
  }
  return sum / weight;
}

// Voltages of equipotential discs without net charge in the potential of a pillar under its loads.
Eigen::MatrixXd voltages_of_cells(const Places& places, const SpaceResponse& sampled) {
  constexpr int kRings = 9, kSectors = 27;
  constexpr double kUnit_V = 1e12;  // scales the voltages as the charges are
  const std::vector<Cell> cells = cells_of(places, kRings, kSectors);
  const auto count = static_cast<Eigen::Index>(cells.size());
  const auto discs = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count + discs, count + discs);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(count + discs, kTopLoads);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Cell& at = cells[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < count; ++j) {
      const Cell& of = cells[static_cast<std::size_t>(j)];
      A(i, j) = (mean_inverse(of, at, places[static_cast<std::size_t>(of.disc)]) +
                 images(std::hypot(at.x_m - of.x_m, at.y_m - of.y_m))) /
                (2.0 * std::numbers::pi * kPermittivity_F_m);
    }
    A(i, count + at.disc) = -kUnit_V;
    A(count + at.disc, i) = kUnit_V;
    b.row(i) = -sampled.potential(0, at.x_m, at.y_m).transpose();
  }
  return kUnit_V * LuFactor(A).solve(b).bottomRows(discs);
}

TEST_CASE("electrodes that nearly touch read what discs of charged cells read",
          "[models][array][space]") {
  const Places places = {{0.0, 0.0}, {46e-6, 0.0}, {15e-6, 48e-6}};
  SpaceArray array = array_at(weakly_piezoelectric(), places);
  const SpaceAccuracy accuracy = space_accuracies(array)[3];
  const Eigen::MatrixXd coupled_V = voltages_of_loads(array, accuracy);
  const Eigen::MatrixXd alone_V = voltages_of_loads(array, without_coupling(accuracy));
  array.electrode = SpaceElectrode::kSampled;
  const SpaceResponse sampled(array, accuracy);
  const Eigen::MatrixXd cells_V = voltages_of_cells(places, sampled);
  const Eigen::MatrixXd one_V = voltages_of_cells({places.front()}, sampled);
  // What the others add to the pressed pillar's own voltage, 3 % of it, where the cells' own error cancels.
  const double added_V = coupled_V(0, 0) - alone_V(0, 0);
  CHECK(std::abs(added_V) > 0.02 * std::abs(alone_V(0, 0)));
  CHECK(cells_V(0, 0) - one_V(0, 0) == Approx(added_V).epsilon(2e-2));
  // Alone, a sheared pillar reads nothing, and electrode 2 nothing of a shear across the line to it.
  for (const TopLoad load : {TopLoad::kShearX, TopLoad::kShearY, TopLoad::kTiltX}) {
    const auto column = static_cast<Eigen::Index>(load);
    INFO("load " << column);
    CHECK(alone_V(0, column) == Approx(0.0).margin(1e-20));
    CHECK(coupled_V(0, column) == Approx(cells_V(0, column)).epsilon(1.5e-2));
  }
  const auto across = static_cast<Eigen::Index>(TopLoad::kShearY);
  CHECK(coupled_V(1, across) == Approx(cells_V(1, across)).epsilon(1.5e-2));
  for (Eigen::Index i = 1; i < 3; ++i) {
    for (Eigen::Index load = 0; load < 3; ++load) {
      INFO("electrode " << i << ", load " << load);
      CHECK(coupled_V(i, load) == Approx(cells_V(i, load)).epsilon(2e-2));
    }
  }
}

// Unit charge at d: field 1/(2 pi eps d^2) (nothing above the film). A thin disc has the moment 16 eps a^3/3 per
// field in its plane: Jackson, Classical Electrodynamics (1999), 4.4; half of it with fields on one side only.
TEST_CASE("a distant electrode acts back as the dipole of a thin disc", "[models][array][space]") {
  const double distance_m = 12.0 * kRadius_m;
  const LayeredFilm film = weakly_piezoelectric(100.0 * kRadius_m);
  const DiscCharge charge(film, kRadius_m, 4, 4, 8);
  const CoupledDiscs discs(film, charge, {{0.0, 0.0, 0}, {distance_m, 0.0, 0}},
                           {.harmonics = 3, .modes = 3, .settled = 1e-9});
  const double field_V_m_C =
      1.0 / (2.0 * std::numbers::pi * kPermittivity_F_m * distance_m * distance_m);
  const double moment = 8.0 / 3.0 * kPermittivity_F_m * std::pow(kRadius_m, 3);
  const Eigen::VectorXd voltages_V_C = discs.voltages_V_C(0);
  CHECK(voltages_V_C[0] == Approx(-moment * field_V_m_C * field_V_m_C).epsilon(3e-2));
  // That of a point charge and of its images in the grounded face, -2 + 2 - ... over 2 n t: to (a/d)^2 and (d/t)^3.
  const double images = 1.0 - distance_m / (100.0 * kRadius_m) * std::numbers::ln2;
  CHECK(voltages_V_C[1] == Approx(images * field_V_m_C * distance_m).epsilon(5e-3));
}

TEST_CASE("charges on two electrodes read each other alike with others between them",
          "[models][array][space]") {
  const LayeredFilm film = test::film_of_the_thesis();
  const DiscCharge charge(film, kRadius_m, 6, 4, 8);
  const std::vector<SourcePoint> points = {
      {0.0, 0.0, 0}, {45e-6, 5e-6, 0}, {80e-6, -25e-6, 0}, {20e-6, 50e-6, 0}};
  const CouplingAccuracy accuracy{
      .harmonics = 4, .modes = 3, .beyond_nearest_m = 200e-6, .settled = 1e-12};
  const CoupledDiscs discs(film, charge, points, accuracy);
  const Eigen::VectorXd from_first = discs.voltages_V_C(0);
  const Eigen::VectorXd from_third = discs.voltages_V_C(2);
  CHECK(from_first[2] == Approx(from_third[0]).epsilon(1e-9));
  // The one between them raises it much more than the tolerance of this comparison.
  const CoupledDiscs two(film, charge, {points[0], points[2]}, accuracy);
  CHECK(std::abs(two.voltages_V_C(0)[1] / from_first[2] - 1.0) > 1e-2);
}

TEST_CASE("readings converge with the harmonics and modes of the charges",
          "[models][convergence]") {
  const LayeredFilm film = test::film_of_the_thesis();
  const DiscCharge charge(film, kRadius_m, 8, 5, 8);
  const std::vector<SourcePoint> points = {{0.0, 0.0, 0}, {46e-6, 0.0, 0}, {15e-6, 48e-6, 0}};
  // What the charges induced on the others take from the voltage of a charged one.
  const auto read_V = [&](int harmonics, int modes) {
    const CouplingAccuracy accuracy{
        .harmonics = harmonics, .modes = modes, .beyond_nearest_m = 100e-6, .settled = 1e-12};
    return CoupledDiscs(film, charge, points, accuracy).voltages_V_C(0)[0];
  };
  const double finest_V = read_V(7, 5);
  double last = 1.0;
  for (const auto& [harmonics, modes] : {std::pair{1, 1}, {2, 2}, {4, 3}, {6, 4}}) {
    const double error = std::abs(read_V(harmonics, modes) / finest_V - 1.0);
    INFO(harmonics << " harmonics, error " << error);
    CHECK(error < 0.5 * last);
    last = error;
  }
  CHECK(last < 1e-3);
}

TEST_CASE("a quarter turn of four electrodes turns their voltages", "[models][array][space]") {
  // A film without a direction of its own.
  const SpaceArray array = array_at(test::film_of_the_thesis(12.5e-12, 12.5e-12),
                                    {{0.0, 0.0}, {47e-6, 0.0}, {0.0, 47e-6}, {47e-6, 47e-6}});
  const Eigen::MatrixXd V = voltages_of_loads(array, space_accuracies(array)[2]);
  const auto x = static_cast<Eigen::Index>(TopLoad::kShearX);
  const auto y = static_cast<Eigen::Index>(TopLoad::kShearY);
  CHECK(V(1, 0) == Approx(V(2, 0)).epsilon(1e-9));
  CHECK(V(1, x) == Approx(V(2, y)).epsilon(1e-9));
  CHECK(V(0, x) == Approx(V(0, y)).epsilon(1e-9));
  CHECK(V(3, x) == Approx(V(3, y)).epsilon(1e-9));
}

TEST_CASE("electrodes far apart read what each reads alone", "[models][array][space]") {
  const SpaceArray array = array_at(test::film_of_the_thesis(), {{0.0, 0.0}, {200e-6, 0.0}});
  const SpaceAccuracy accuracy = space_accuracies(array)[4];
  const Eigen::MatrixXd coupled_V = voltages_of_loads(array, accuracy);
  const Eigen::MatrixXd alone_V = voltages_of_loads(array, without_coupling(accuracy));
  CHECK((coupled_V - alone_V).cwiseAbs().maxCoeff() < 1e-6 * std::abs(alone_V(0, 0)));
}

TEST_CASE("one electrode's voltage is the same from the charges and by reciprocity",
          "[models][array][space]") {
  SpaceArray array =
      array_at(test::film_of_the_thesis(), {{0.0, 0.0}, {46e-6, 0.0}, {15e-6, 48e-6}});
  array.classes.push_back({PillarGeometry{.diameter_m = 36e-6}, array.classes.front().medium});
  array.pillars[1].of_class = 1;
  SpaceAccuracy accuracy = space_accuracies(array)[2];
  accuracy.coupling.settled = 1e-12;
  const SpaceResponse response(array, accuracy);
  TopLoads loads(3, kTopLoads);
  loads << 1.0, 0.2, -0.3, 0.1, 0.0, 0.5, 0.4, 0.1, 0.0, 0.2, -0.7, 0.3, 0.6, 0.2, 0.1;
  const Eigen::MatrixXd V = response.voltages_V(loads);
  for (std::size_t i = 0; i < 3; ++i) {
    Eigen::MatrixXd row = response.added_by_electrodes(i);
    for (std::size_t j = 0; j < 3; ++j) {
      const PlacedPillar &here = array.pillars[i], &from = array.pillars[j];
      row.row(static_cast<Eigen::Index>(j)) +=
          response.kernel(from.of_class, here.x_m - from.x_m, here.y_m - from.y_m).row(0);
    }
    CHECK(row.cwiseProduct(loads).sum() ==
          Approx(V(static_cast<Eigen::Index>(i), 0)).epsilon(1e-7));
  }
}

}  // namespace
}  // namespace viscard
