// Numbers of the thesis' arrays: 2-D plane stress, PVDF of the MATLAB example, 1 kPa on the
// pillars, top of the film grounded, bottom clamped and charge-free. Reference: an independent
// p-element code.
#include "tests/models/array/plane/seed_array.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <utility>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kFar_m = 600e-6;  // no neighbour is felt
constexpr double kVoltage = 1e-3;  // relative, the last digits of the reference
constexpr double kPoints = 0.01;   // per cent points

double deviation_percent(double spacing_m, double far_mV, double diameter_m = 40e-6,
                         const Discretisation& mesh = kSeedMesh) {
  const ArrayGeometry row = endless_row(spacing_m, 25e-6, diameter_m);
  return 100.0 * (centre_mV(row, PlaneState::kStress, mesh) / far_mV - 1.0);
}

// Per cent coupling: half the voltage midway between two loaded pillars, over that under one.
double coupling_percent(double thickness_m) {
  const ArrayResponse r = seed_response(endless_row(60e-6, thickness_m));
  return 50.0 * r.midway_V(0, 0) / r.centre_V(0, 0);
}

}  // namespace

TEST_CASE("one pillar on a wide film gives the thesis' 4.12 mV", "[array]") {
  CHECK(centre_mV(endless_row(kFar_m)) == Approx(4.1231).epsilon(5e-5));  // digits printed
  CHECK(centre_mV(endless_row(kFar_m), PlaneState::kStrain) == Approx(3.6453).epsilon(5e-5));
}

TEST_CASE("voltage against spacing", "[array]") {
  const std::map<double, double> expected_mV = {{5, 5.0072},  {10, 4.6929}, {20, 4.3632},
                                                {30, 4.2243}, {40, 4.1626}, {50, 4.1346},
                                                {60, 4.1225}, {80, 4.1170}, {100, 4.1186}};
  for (const auto& [spacing_um, mV] : expected_mV) {
    CAPTURE(spacing_um);
    CHECK(centre_mV(endless_row(spacing_um * 1e-6)) == Approx(mV).epsilon(kVoltage));
  }
}

TEST_CASE("voltage and percentage of coupling against the film's thickness", "[array]") {
  const std::map<double, std::pair<double, double>> expected = {
      {5, {1.0792, -0.06}}, {10, {2.1095, -0.28}}, {25, {4.1225, 6.92}}, {40, {5.1417, 20.45}},
      {50, {5.6846, 29.2}}, {75, {7.2263, 43.2}},  {100, {9.1451, 48.1}}};
  for (const auto& [thickness_um, numbers] : expected) {
    CAPTURE(thickness_um);
    CHECK(centre_mV(endless_row(60e-6, thickness_um * 1e-6)) ==
          Approx(numbers.first).epsilon(kVoltage));
    const bool three_digits = thickness_um >= 50;
    CHECK(coupling_percent(thickness_um * 1e-6) ==
          Approx(numbers.second).margin(three_digits ? 0.05 : kPoints));
  }
}

TEST_CASE("the deviation of an endless row changes sign near 60 um", "[array]") {
  const double far_mV = centre_mV(endless_row(kFar_m));
  const std::map<double, double> expected = {{50, 0.280},  {55, 0.101},  {60, -0.015}, {65, -0.085},
                                             {70, -0.124}, {80, -0.148}, {100, -0.110}};
  for (const auto& [spacing_um, percent] : expected) {
    CAPTURE(spacing_um);
    CHECK(deviation_percent(spacing_um * 1e-6, far_mV) == Approx(percent).margin(kPoints));
  }
  const double strain_mV = centre_mV(endless_row(60e-6), PlaneState::kStrain);
  const double far_strain_mV = centre_mV(endless_row(kFar_m), PlaneState::kStrain);
  CHECK(100.0 * (strain_mV / far_strain_mV - 1.0) == Approx(-1.42).margin(kPoints));
}

TEST_CASE("the spacing at 0.1 % against diameter crosses where the thesis' map does", "[array]") {
  struct Row {
    double diameter_um, far_mV;
    int first_below_um;  // 0: none between 30 and 80 um
  };
  const Row row = GENERATE(Row{20, 2.6281, 80}, Row{30, 3.5143, 70}, Row{40, 4.1231, 60},
                           Row{50, 4.5298, 45}, Row{60, 4.8022, 40}, Row{80, 5.1174, 0});
  CAPTURE(row.diameter_um);
  const double d = row.diameter_um * 1e-6;
  // A fine mesh: at 40 um 0.1005 % remain at a spacing of 55 um, at 50 um 0.0995 % at 45 um.
  const ArrayGeometry far = endless_row(kFar_m, 25e-6, d);
  const double far_mV = centre_mV(far, PlaneState::kStress, kFineMesh);
  CHECK(far_mV == Approx(row.far_mV).epsilon(kVoltage));
  int first = 0;
  for (int spacing_um = 30; spacing_um <= 80 && first == 0; spacing_um += 5) {
    if (std::abs(deviation_percent(spacing_um * 1e-6, far_mV, d, kFineMesh)) < 0.1)
      first = spacing_um;
  }
  CHECK(first == row.first_below_um);
}

TEST_CASE("a film as wide as the pillar: error of g33 p t against its thickness", "[array]") {
  const double g33 = 30e-12 / (12.0 * kVacuumPermittivity_F_m);
  const std::map<double, std::pair<double, double>> expected = {
      {5, {-21.0, 0.1}},      {10, {-11.8, 0.1}},     {15, {-7.1, 0.05}},
      {25, {-2.85, kPoints}}, {40, {-0.76, kPoints}}, {50, {-0.39, kPoints}},
      {100, {-0.15, kPoints}}};  // digits given
  for (const auto& [thickness_um, percent] : expected) {
    CAPTURE(thickness_um);
    const ArrayGeometry lone{
        .count = 1, .film_thickness_m = thickness_um * 1e-6, .film_edge_m = 0.0};
    const ArrayResponse r = seed_response(lone);
    const double flat_V = g33 * thickness_um * 1e-6;  // per Pa
    CHECK(100.0 * (-r.centre_V(0, 0) / flat_V - 1.0) ==
          Approx(percent.first).margin(percent.second));
    if (thickness_um != 25) continue;
    // The thesis prints 1.9 %. Meshes refined toward both corners of the film converge to 1.852 %;
    // averaging nodal values of a coarse one instead of integrating gives 1.91 %.
    CHECK(100.0 * (-r.mean_V(0, 0) / flat_V - 1.0) == Approx(1.852).margin(kPoints + 0.002));
  }
}

TEST_CASE("eight pillars: all loaded, and the neighbours of a single loaded one", "[array]") {
  const ArrayResponse r = seed_response({.count = 8});
  const Eigen::VectorXd all_mV = -1e3 * kSeedPressure_Pa * r.centre_V.rowwise().sum();
  const std::vector<double> expected_mV = {4.1229, 4.1228, 4.1225, 4.1225};
  for (int i = 0; i < 4; ++i) {
    CHECK(all_mV[i] == Approx(expected_mV[static_cast<std::size_t>(i)]).epsilon(5e-5));
    CHECK(all_mV[7 - i] == Approx(all_mV[i]).epsilon(1e-8));
  }
  const Eigen::VectorXd mean_mV = -1e3 * kSeedPressure_Pa * r.mean_V.rowwise().sum();
  CHECK(mean_mV.minCoeff() > 3.655 * (1.0 - kVoltage));
  CHECK(mean_mV.maxCoeff() < 3.658 * (1.0 + 2.0 * kVoltage));
  const auto percent = [](const Eigen::MatrixXd& V, int i) { return 100.0 * V(i, 3) / V(3, 3); };
  CHECK(percent(r.centre_V, 4) == Approx(0.0005).margin(0.0005));
  CHECK(percent(r.mean_V, 4) == Approx(0.079).margin(0.002));
  CHECK(percent(r.mean_V, 5) == Approx(-0.010).margin(0.002));
}
