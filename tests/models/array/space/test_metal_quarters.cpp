#include "models/answer/scene_mistake.h"
#include "models/array/film/disc_charge.h"
#include "models/array/film/metal_quarters.h"
#include "models/array/space/space_array.h"
#include "models/maths/dense.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace viscard {
namespace {

constexpr double kElectrode_m = 20e-6;

LayeredFilm film_as_thick_as(double thickness_m) {
  LayeredFilm film = test::film_of_the_thesis();
  film.layers.front().thickness_m = thickness_m;
  return film;
}

MetalQuarters quarters_on(const LayeredFilm& film, double gap_m, int cells) {
  return {film, kElectrode_m, gap_m, {.cells = cells, .polynomials = 10, .film_degree = 10}};
}

// What quarter 1 reads of a potential x/a.
double slope_read(const MetalQuarters& quarters) {
  const QuarterRule rule = quarters.rule(10);
  double sum = 0.0;
  for (std::size_t p = 0; p < rule.points_m.size(); ++p)
    sum += rule.weights(0, static_cast<Eigen::Index>(p)) * rule.points_m[p].x() / kElectrode_m;
  return sum;
}

SpaceArray pillars_in_quarters(double gap_m) {
  SpaceArray array;
  array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
  array.film = test::film_of_the_thesis();
  array.electrode = gap_m > 0.0 ? SpaceElectrode::kMetalQuadrants : SpaceElectrode::kQuadrants;
  array.electrode_radius_m = kElectrode_m;
  array.electrode_gap_m = gap_m;
  array.pillars = {{0.0, 0.0, 0}};
  return array;
}

TEST_CASE("quarters of metal with narrow gaps, joined, are the equipotential disc", "[models]") {
  const LayeredFilm film = test::film_of_the_thesis();
  const DiscCharge disc(film, kElectrode_m, 1, 12, 10);
  const MetalQuarters quarters = quarters_on(film, 0.005 * kElectrode_m, 18);
  const double joined_F = 4.0 / quarters.potentials_V_C().row(0).sum();
  CHECK(joined_F == Approx(disc.capacitance_F()).epsilon(3e-4));
  for (const double ka : {0.0, 1.0, 2.0}) {
    CAPTURE(ka);
    CHECK(quarters.weight(ka / kElectrode_m) ==
          Approx(disc.weight(ka / kElectrode_m)).epsilon(3e-4));
  }
  // A wide gap takes away metal.
  const MetalQuarters apart = quarters_on(film, 0.1 * kElectrode_m, 18);
  CHECK(4.0 / apart.potentials_V_C().row(0).sum() < 0.995 * disc.capacitance_F());
}

TEST_CASE("voltages per charge of quarters are symmetric and positive", "[models]") {
  const Eigen::Matrix4d V = quarters_on(test::film_of_the_thesis(), 2e-6, 12).potentials_V_C();
  CHECK((V - V.transpose()).norm() < 1e-12 * V.norm());
  CHECK(symmetric_eigen(V).values.minCoeff() > 0.0);
  CHECK(V(0, 1) == Approx(V(0, 3)).epsilon(1e-9));  // beside it, along x and along y
  CHECK(V(0, 0) > V(0, 1));
  CHECK(V(0, 1) > V(0, 2));
  CHECK(V(0, 2) > 0.0);
  for (int q = 1; q < 4; ++q) CHECK(V(q, q) == Approx(V(0, 0)).epsilon(1e-12));
}

TEST_CASE("quarters of metal read a uniform potential as itself", "[models]") {
  const MetalQuarters quarters = quarters_on(test::film_of_the_thesis(), 2e-6, 9);
  for (const int degree : {4, 10}) {
    const QuarterRule rule = quarters.rule(degree);
    for (int q = 0; q < 4; ++q) CHECK(rule.weights.row(q).sum() == Approx(1.0).epsilon(1e-10));
    Eigen::Vector4d along = Eigen::Vector4d::Zero();
    for (std::size_t p = 0; p < rule.points_m.size(); ++p)
      along += rule.weights.col(static_cast<Eigen::Index>(p)) * rule.points_m[p].x() / kElectrode_m;
    CHECK(along[0] == Approx(slope_read(quarters)).epsilon(1e-10));
    CHECK(along[1] == Approx(-along[0]).epsilon(1e-10));
    CHECK(along[2] == Approx(-along[0]).epsilon(1e-10));
    CHECK(along[3] == Approx(along[0]).epsilon(1e-10));
  }
}

TEST_CASE("charges that a potential induces on quarters are symmetric and lower the energy",
          "[models]") {
  const MetalQuarters quarters = quarters_on(test::film_of_the_thesis(), 2e-6, 9);
  const Eigen::MatrixXd& C = quarters.induced();
  CHECK((C - C.transpose()).norm() < 1e-10 * C.norm());
  CHECK(symmetric_eigen(C).values.maxCoeff() < 1e-3 * C.norm());
  CHECK(C.row(0).norm() < 1e-10 * C.norm());  // a uniform potential moves no charge
}

TEST_CASE("readings of quarters of metal converge with their cells", "[models][convergence]") {
  const LayeredFilm film = test::film_of_the_thesis();
  const double coarse = slope_read(quarters_on(film, 2e-6, 6));
  const double fine = slope_read(quarters_on(film, 2e-6, 12));
  const double finest = slope_read(quarters_on(film, 2e-6, 24));
  CHECK(fine == Approx(finest).epsilon(3e-4));
  CHECK(std::abs(coarse - finest) > 3.0 * std::abs(fine - finest));
  CHECK(finest == Approx(0.33856).epsilon(1e-4));  // the mean over the area is 0.4244
}

TEST_CASE("on a film much thinner than they are wide, quarters of metal read the mean over them",
          "[models][reduction]") {
  // Of x/a over x, y > g, r < 1, g half of the gap.
  const double g = 0.05, end = std::sqrt(1.0 - g * g);
  const double area = 0.5 * (std::asin(end) + end * g - std::asin(g) - g * end) - g * (end - g);
  const double mean =
      ((std::pow(end, 3.0) - std::pow(g, 3.0)) / 3.0 - 0.5 * g * (end * end - g * g)) / area;
  const auto lacking = [&](double thickness_m) {
    return 1.0 - slope_read(quarters_on(film_as_thick_as(thickness_m), 2e-6, 24)) / mean;
  };
  const double thick = lacking(5e-6), thin = lacking(2.5e-6);
  CHECK(thin > 0.0);
  CHECK(thin < 0.035);
  CHECK(thin < 0.5 * thick);
}

TEST_CASE("the charge on a pillar's own quarters is felt around it as point charges are",
          "[models]") {
  const SpaceArray metal = pillars_in_quarters(2e-6), bare = pillars_in_quarters(0.0);
  const SpaceAccuracy accuracy =
      space_accuracies(metal)[5];  // at [3] the largest difference is four times as large
  const SpaceResponse with(metal, accuracy), without(bare, accuracy);
  const MetalQuarters& quarters = *with.quarters();
  const QuarterRule rule = quarters.rule(accuracy.quarters.polynomials);
  Eigen::MatrixXd own(static_cast<Eigen::Index>(rule.points_m.size()), kTopLoads);
  for (std::size_t p = 0; p < rule.points_m.size(); ++p) {
    own.row(static_cast<Eigen::Index>(p)) =
        without.potential(0, rule.points_m[p].x(), rule.points_m[p].y()).transpose();
  }
  const Eigen::MatrixXd from_points = quarters.amplitudes_from_points();
  const Eigen::MatrixXd charges =
      from_points.transpose() * (quarters.induced() * (from_points * own));
  CHECK(charges.colwise().sum().cwiseAbs().maxCoeff() < 1e-9 * charges.cwiseAbs().sum());
  const PointCharge point(metal.film, 150e-6, 12);
  for (const auto& [x_m, y_m] : {std::pair{60e-6, 0.0}, {50e-6, 50e-6}, {0.0, 80e-6}}) {
    Eigen::RowVectorXd direct = Eigen::RowVectorXd::Zero(kTopLoads);
    for (std::size_t p = 0; p < rule.points_m.size(); ++p) {
      direct += charges.row(static_cast<Eigen::Index>(p)) *
                point.at(std::hypot(x_m - rule.points_m[p].x(), y_m - rule.points_m[p].y()));
    }
    const PotentialByLoad added = with.potential(0, x_m, y_m) - without.potential(0, x_m, y_m);
    CAPTURE(x_m, y_m);
    const double size_V = std::abs(without.kernel(0, 0.0, 0.0)(2, 1));
    CHECK((added.transpose() - direct).cwiseAbs().maxCoeff() < 5e-5 * size_V);
    CHECK(direct.cwiseAbs().maxCoeff() > 2e-4 * size_V);
  }
  // What a quarter reads under its own pillar does not contain it.
  const auto read = with.kernel(0, 0.0, 0.0);
  const Eigen::MatrixXd by_points = rule.weights * own;
  CHECK((read.bottomRows<4>() - by_points).cwiseAbs().maxCoeff() <
        1e-4 * by_points.cwiseAbs().maxCoeff());
  CHECK(read.row(0).isApprox(read.bottomRows<4>().colwise().mean()));
}

TEST_CASE("a narrow gap takes from the shear that quarters read, not from the pressure",
          "[models]") {
  const auto own = [](double gap_m) {
    const SpaceArray array = pillars_in_quarters(gap_m);
    const auto kernel = SpaceResponse(array, space_accuracies(array)[2]).kernel(0, 0.0, 0.0);
    return kernel.bottomRows<4>().eval();
  };
  const auto area = own(0.0), wide = own(4e-6), narrow = own(1e-6);
  CHECK(std::abs(narrow(0, 1)) < std::abs(wide(0, 1)));
  CHECK(std::abs(narrow(0, 1)) < 0.95 * std::abs(area(0, 1)));
  CHECK(narrow(0, 0) == Approx(wide(0, 0)).epsilon(0.02));
  for (const auto& kernel : {wide, narrow}) {  // mirror images
    CHECK(kernel(1, 1) == Approx(-kernel(0, 1)).epsilon(1e-9));
    CHECK(kernel(3, 2) == Approx(-kernel(0, 2)).epsilon(1e-9));
    CHECK(kernel(2, 0) == Approx(kernel(0, 0)).epsilon(1e-9));
  }
}

TEST_CASE("quarters of metal read what an independent program finds", "[models]") {
  // Its own foot forces, film and cells in numpy; mV/kPa, extrapolated from 9 and 12 cells.
  const SpaceArray array = pillars_in_quarters(2e-6);
  const SpaceResponse response(array, space_accuracies(array)[3]);
  const auto own = response.kernel(0, 0.0, 0.0);
  CHECK(own(1, 0) == Approx(-1.7823e-6).epsilon(5e-4));
  CHECK(own(1, 1) == Approx(-5.9295e-6).epsilon(1e-3));
  CHECK(own(1, 2) == Approx(-5.5485e-6).epsilon(1e-3));
  CHECK(own(1, 3) == Approx(0.2474e-6).epsilon(2e-3));
  // Beside a loaded pillar, per cent of its own, with 9 cells: the charge on its quarters adds to 0.8005, 3.597 and to
  // -0.7997, -1.1328.
  const auto near = response.kernel(0, 60e-6, 0.0), along = response.kernel(0, 100e-6, 0.0);
  CHECK(100.0 * near(1, 0) / own(1, 0) == Approx(0.9029).margin(0.02));
  CHECK(100.0 * near(2, 0) / own(1, 0) == Approx(3.8414).margin(0.02));
  CHECK(100.0 * along(1, 1) / own(1, 1) == Approx(-0.8925).margin(0.01));
  CHECK(100.0 * along(2, 1) / own(1, 1) == Approx(-1.3455).margin(0.01));
}

TEST_CASE("gaps between quarters that are not resolved are refused", "[models]") {
  for (const double gap_m : {0.1e-6, 11e-6}) {
    SpaceArray array = pillars_in_quarters(gap_m);
    CHECK_THROWS_AS(validate(array), SceneMistake);
  }
  SpaceArray array = pillars_in_quarters(2e-6);
  CHECK_NOTHROW(validate(array));
  array.film.layers.front().thickness_m = 2e-6;
  CHECK_THROWS_AS(validate(array), SceneMistake);
  array = pillars_in_quarters(0.0);
  array.electrode_gap_m = 2e-6;  // of faces without metal
  CHECK_THROWS_AS(validate(array), SceneMistake);
}

}  // namespace
}  // namespace viscard
