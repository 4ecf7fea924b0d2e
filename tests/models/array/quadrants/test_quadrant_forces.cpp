// From the voltages of quarters back to the forces of the pillars. Reference values of Python programs with their own
// foot forces (p 8), film and integrals; a node-wise mean of the thesis' appendix A.1 from the same.
#include "models/array/quadrants/sensed_array.h"
#include "models/array/space/space_array.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace viscard {
namespace {

using test::film_of_the_thesis;

// Pillars of 40 x 120 um, rows from the lowest y.
SpaceArray quartered(int rows, int columns, double pitch_m, bool is_uniaxial = true) {
  SpaceArray array;
  array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
  array.film = is_uniaxial ? film_of_the_thesis() : film_of_the_thesis(12.5e-12, 12.5e-12);
  array.electrode = SpaceElectrode::kQuadrants;
  array.electrode_radius_m = 20e-6;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      array.pillars.push_back({column * pitch_m, row * pitch_m, 0});
    }
  }
  return array;
}

QuadrantArray sensed_by(const SpaceArray& array, const SpaceResponse& response) {
  QuadrantArray quadrants;
  quadrants.pillars = sources_of(array);
  quadrants.reach_m = response.reach_m();
  quadrants.kernel = [&](int of_class, double x_m, double y_m) -> Eigen::MatrixXd {
    return response.kernel(of_class, x_m, y_m).bottomLeftCorner<4, 3>();
  };
  quadrants.voltages_V = [&](const Eigen::MatrixXd& loads_Pa) -> Eigen::MatrixXd {
    TopLoads all = TopLoads::Zero(loads_Pa.rows(), kTopLoads);
    all.leftCols<3>() = loads_Pa;
    return response.voltages_V(all).rightCols<4>();
  };
  return quadrants;
}

// What the loads of a lone pillar, each 1, seem to be at an offset: loads x loads.
Eigen::MatrixXd seeming_at(const QuadrantArray& quadrants, double x_m, double y_m) {
  return gains_by_class(quadrants).front() * quadrants.kernel(0, x_m, y_m);
}

TEST_CASE("gains of quarters are those of an independent program", "[models]") {
  const SpaceArray array = quartered(1, 1, 100e-6);
  const SpaceResponse response(array, space_accuracies(array)[3]);
  const auto B = response.kernel(0, 0.0, 0.0);  // V/Pa; rows 2 to 5 are the quarters
  CHECK(B(2, 0) == Approx(-1.92665e-6).epsilon(2e-4));
  CHECK(B(2, 1) == Approx(-7.78507e-6).epsilon(2e-4));
  CHECK(B(2, 2) == Approx(-7.32744e-6).epsilon(2e-4));
  CHECK(B(2, 3) == Approx(0.32483e-6).epsilon(1e-3));
  CHECK(B(2, 4) == Approx(0.29691e-6).epsilon(1e-3));
  const QuadrantGains gains = gains_by_class(sensed_by(array, response)).front();
  const std::array<std::array<double, 4>, 3> signs = {
      {{1, 1, 1, 1}, {1, -1, -1, 1}, {1, 1, -1, -1}}};
  const std::array<double, 3> expected = {-129759.0, -32113.0, -34118.0};  // Pa/V
  for (std::size_t load = 0; load < 3; ++load) {
    for (std::size_t q = 0; q < 4; ++q) {
      const double gain = gains(static_cast<Eigen::Index>(load), static_cast<Eigen::Index>(q));
      CHECK(gain == Approx(signs.at(load).at(q) * expected.at(load)).epsilon(2e-4));
    }
  }
  const SpaceArray isotropic = quartered(1, 1, 100e-6, false);
  const auto same = SpaceResponse(isotropic, space_accuracies(isotropic)[3]).kernel(0, 0.0, 0.0);
  CHECK(same(2, 0) == Approx(-1.92397e-6).epsilon(2e-4));
  CHECK(same(2, 1) == Approx(-7.55006e-6).epsilon(2e-4));
  CHECK(same(2, 3) == Approx(0.31063e-6).epsilon(1e-3));
}

TEST_CASE("quarters take a moment on the top for a shear, by its lever over the length",
          "[models]") {
  const SpaceArray array = quartered(1, 1, 100e-6);
  const SpaceResponse response(array, space_accuracies(array)[2]);
  const auto B = response.kernel(0, 0.0, 0.0);
  // t_z = p x/R has the moment p pi R^3/4 about y, a shear at the top the moment tau pi R^2 l at the foot.
  CHECK(B(2, 3) / B(2, 1) == Approx(-20e-6 / (4.0 * 120e-6)).epsilon(3e-3));
}

TEST_CASE("neighbours seem to bear what an independent program finds", "[models]") {
  const SpaceArray array = quartered(1, 1, 100e-6);
  const SpaceResponse response(array, space_accuracies(array)[3]);
  const QuadrantArray quadrants = sensed_by(array, response);
  const auto near = [](double value) {
    return Approx(value).margin(1.1e-4);
  };  // two units of the last digit printed
  const Eigen::MatrixXd along = seeming_at(quadrants, 100e-6, 0.0);
  const Eigen::MatrixXd across = seeming_at(quadrants, 0.0, 100e-6);
  const Eigen::MatrixXd both = seeming_at(quadrants, 100e-6, 100e-6);
  CHECK(along(0, 0) == near(-0.00263));
  CHECK(along(1, 0) == near(0.00010));
  CHECK(across(0, 0) == near(0.00193));
  CHECK(across(2, 0) == near(-0.00030));
  CHECK(both(0, 0) == near(-0.00042));
  CHECK(along(0, 1) == near(-0.0302));
  CHECK(along(1, 1) == near(0.0016));
  CHECK(across(1, 1) == near(0.0005));
  CHECK(both(0, 1) == near(-0.0023));
  CHECK(across(0, 2) == near(0.0142));
  CHECK(across(2, 2) == near(-0.0023));
  CHECK(along(2, 2) == near(-0.0009));
}

TEST_CASE("means over nodes count axes to one side and misread pressure and shear", "[models]") {
  const SpaceArray array = quartered(1, 1, 100e-6);
  const SpaceResponse response(array, space_accuracies(array)[3]);
  const QuadrantGains gains = gains_by_class(sensed_by(array, response)).front();
  const std::vector<QuadrantNode> nodes = nodes_of({8, 29}, 20e-6);
  std::array<int, 4> counts{};
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(4, kTopLoads);
  for (const QuadrantNode& node : nodes) {
    ++counts.at(static_cast<std::size_t>(node.quarter));
    means.row(node.quarter) += node.weight * response.potential(0, node.x_m, node.y_m).transpose();
  }
  CHECK(counts == std::array<int, 4>{65, 56, 56, 56});
  const Eigen::MatrixXd seen = gains * means.leftCols<3>();
  const auto near = [](double value) { return Approx(value).margin(1e-3); };
  CHECK(seen(0, 0) == near(1.0517));
  CHECK(seen(0, 1) == near(-0.140));
  CHECK(seen(1, 1) == near(0.870));
  CHECK(seen(2, 1) == near(0.015));
  CHECK(seen(0, 2) == near(-0.125));
  CHECK(seen(1, 2) == near(-0.031));
  CHECK(seen(2, 2) == near(0.871));
  // A mesh of 7 circles of 32 nodes: with the last on the rim, and with the circles at i/7.25 of the radius.
  for (const auto& [share, pressure] : {std::pair{1.0, 1.0471}, {7.0 / 7.25, 1.0599}}) {
    counts = {};
    Eigen::MatrixXd other = Eigen::MatrixXd::Zero(4, kTopLoads);
    for (const QuadrantNode& node : nodes_of({7, 32}, share * 20e-6)) {
      ++counts.at(static_cast<std::size_t>(node.quarter));
      other.row(node.quarter) +=
          node.weight * response.potential(0, node.x_m, node.y_m).transpose();
    }
    CHECK(counts == std::array<int, 4>{64, 56, 49, 56});
    CHECK((gains * other.leftCols<3>())(0, 0) == Approx(pressure).margin(3e-4));
  }
  CHECK_THROWS_AS(nodes_of({8, 3}, 20e-6), std::invalid_argument);
}

TEST_CASE("voltages of an array lead back to the forces of all pillars", "[models]") {
  struct Case {
    double pitch_m;
    bool is_shifted, is_metal;
  };
  const Case one = GENERATE(Case{100e-6, false, false}, Case{100e-6, true, false},
                            Case{60e-6, false, false}, Case{100e-6, false, true});
  CAPTURE(one.pitch_m, one.is_shifted, one.is_metal);
  SpaceArray array = quartered(6, 7, one.pitch_m);
  if (one.is_metal) {
    array.electrode = SpaceElectrode::kMetalQuadrants;
    array.electrode_gap_m = 2e-6;
  }
  for (std::size_t i = 0; i < array.pillars.size() && one.is_shifted; ++i) {
    array.pillars[i].x_m += (i / 7) % 2 == 0 ? 0.0 : 50e-6;
  }
  array.pillars.erase(array.pillars.begin() + 17);  // a dead one
  const SpaceResponse response(array, space_accuracies(array)[1]);
  const QuadrantArray quadrants = sensed_by(array, response);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> load_Pa(-1e3, 1e3);
  const Eigen::MatrixXd loads_Pa = Eigen::MatrixXd::NullaryExpr(
      static_cast<Eigen::Index>(array.pillars.size()), 3, [&] { return load_Pa(random); });
  const SensedArray sensed =
      sensed_array(quadrants, gains_by_class(quadrants), quadrants.voltages_V(loads_Pa));
  CHECK((sensed.loads_Pa - loads_Pa).cwiseAbs().maxCoeff() < 1e-6);
  CHECK(sensed.left_V.cwiseAbs().maxCoeff() < 1e-12);
  // Each by itself is wrong by what it reads of its neighbours' shear: 3 % of each at a pitch of 100 um.
  const double alone_Pa = (sensed.alone_Pa - loads_Pa).cwiseAbs().maxCoeff();
  CHECK(alone_Pa > 20.0);
  CHECK(alone_Pa < (one.pitch_m < 80e-6 ? 1500.0 : 200.0));
}

TEST_CASE("noise of the voltages grows as the scatter of many trials", "[models]") {
  const SpaceArray array = quartered(5, 5, 60e-6);  // near feet: neighbours matter
  const SpaceResponse response(array, space_accuracies(array)[0]);
  const QuadrantArray quadrants = sensed_by(array, response);
  const std::vector<QuadrantGains> gains = gains_by_class(quadrants);
  const NoiseGrowth growth = growth_in_middle(quadrants, gains);
  CHECK(growth.condition > 1.1);
  CHECK(growth.condition < 10.0);
  const auto all = response.sums_of({TopLoad::kPressure, TopLoad::kShearX, TopLoad::kShearY},
                                    std::vector<bool>(25, true));
  QuadrantArray fast = quadrants;
  fast.voltages_V = [&](const Eigen::MatrixXd& loads_Pa) -> Eigen::MatrixXd {
    return all(loads_Pa).middleCols<4>(2);
  };
  std::mt19937 random(3);
  std::normal_distribution<double> noise_V(0.0, 1e-4);
  constexpr int kTrials = 1000;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::MatrixXd read_V =
        Eigen::MatrixXd::NullaryExpr(25, 4, [&] { return noise_V(random); });
    squares += sensed_array(fast, gains, read_V).loads_Pa.row(12).transpose().cwiseAbs2();
  }
  const Eigen::Vector3d alone_Pa = sensed_noise_Pa(gains.front(), 1e-4);
  for (int load = 0; load < 3; ++load) {
    CHECK(std::sqrt(squares[load] / kTrials) ==
          Approx(growth.factor[load] * alone_Pa[load]).epsilon(0.08));
  }
}

TEST_CASE("quarters that cannot tell loads apart are refused", "[models]") {
  QuadrantResponse same = QuadrantResponse::Ones();
  CHECK_THROWS_AS(quadrant_gains(same), std::invalid_argument);
  same.col(1).setZero();
  CHECK_THROWS_AS(quadrant_gains(same), std::invalid_argument);
}

TEST_CASE("neighbours that read more than the pillar itself are solved or refused",
          "[models][stability]") {
  // Each pillar reads its left neighbour g times as strongly as itself: a triangular, badly conditioned array.
  for (const double g : {0.5, 0.99, 3.0}) {
    const SeemingLoads seeming = [&](const Eigen::MatrixXd& loads) {
      Eigen::MatrixXd seen = loads;
      seen.bottomRows(loads.rows() - 1) += g * loads.topRows(loads.rows() - 1);
      return seen;
    };
    const Eigen::MatrixXd loads = Eigen::MatrixXd::Ones(200, 3);
    try {
      const Eigen::MatrixXd found = decouple(seeming, seeming(loads)).loads_Pa;
      CHECK((found - loads).cwiseAbs().maxCoeff() < 1e-3);
    } catch (const std::runtime_error&) {
      CHECK(g >= 0.99);
    }
  }
  CHECK(decouple([](const Eigen::MatrixXd& loads) { return loads; }, Eigen::MatrixXd::Zero(3, 3))
            .iterations == 0);
}

}  // namespace
}  // namespace viscard
