// A bulk layer on the film under a rigid shape, against closed forms, integral equations and an
// independent program.
#include "models/answer/scene_mistake.h"
#include "models/array/layer/layer_contact.h"
#include "models/array/layer/simulate_layer.h"
#include "models/maths/grid_convolution.h"
#include "tests/models/array/layer/layer_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("a convolution on a grid is the sum over its points", "[maths]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Eigen::Index columns : {Eigen::Index{1}, Eigen::Index{6}}) {
    const Eigen::Index rows = columns == 1 ? 9 : 6;
    Eigen::MatrixXd kernel(rows, columns), values(rows, columns);
    for (Eigen::Index i = 0; i < kernel.size(); ++i) {
      kernel.data()[i] = uniform(random);
      values.data()[i] = uniform(random);
    }
    const Eigen::MatrixXd sums = GridConvolution(kernel).apply(values);
    for (Eigen::Index c = 0; c < columns; ++c) {
      for (Eigen::Index r = 0; r < rows; ++r) {
        double sum = 0.0;
        for (Eigen::Index j = 0; j < columns; ++j) {
          for (Eigen::Index i = 0; i < rows; ++i) {
            sum += kernel(std::abs(r - i), std::abs(c - j)) * values(i, j);
          }
        }
        CHECK(sums(r, c) == Approx(sum).margin(1e-13));
      }
    }
  }
}

// A Fredholm equation for the bonded layer, solved with 40 and 80 points to 1e-14: a/H, depth R/a^2 and
// the force over Hertz' at the same radius of contact a.
TEST_CASE("a sphere on a layer bonded to a rigid base bears what the integral equation says",
          "[layer]") {
  struct Row {
    double nu, a_H, depth_R_a2, force;
  };
  // 0.499999 stands for 0.5: 5 times as wide as thick, such a layer yields by its volume 1e-5 of what it does.
  for (const Row& row :
       {Row{0.33, 0.1, 0.940713, 1.000551}, Row{0.33, 0.5, 0.753481, 1.054096},
        Row{0.33, 1.0, 0.640892, 1.271405}, Row{0.33, 5.0, 0.522115, 4.177367},
        Row{0.499999, 0.1, 0.925775, 1.000802}, Row{0.499999, 0.5, 0.696246, 1.078906},
        Row{0.499999, 1.0, 0.559415, 1.410500}, Row{0.499999, 5.0, 0.359125, 9.946303}}) {
    const double nu = row.nu;
    const LayerWaves waves(layer_on_rigid_base(nu, kH_m), false);
    CAPTURE(nu, row.a_H);
    const double a_m = row.a_H * kH_m;
    const double hertz_N = 4.0 / 3.0 * kE_Pa / (1.0 - nu * nu) * a_m * a_m * a_m / kR_m;
    const LayerKernel kernel(waves, false, 3.5 * a_m, {});
    LayerPress press;
    press.shape.kind = ShapeKind::kParaboloid;
    press.shape.radius_m = kR_m;
    const LayerContact contact(kernel, press, {0.0, 0.0, 2.2 * a_m, 128});
    const LayerPressure found = contact.to_depth(row.depth_R_a2 * a_m * a_m / kR_m);
    CHECK(found.force_N == Approx(row.force * hertz_N).epsilon(1e-4));
    CHECK(std::sqrt(found.contact_m2 / std::numbers::pi) == Approx(a_m).epsilon(4e-3));
    CHECK(found.pressure_Pa.minCoeff() >= 0.0);
    const Eigen::MatrixXd mirrored = found.pressure_Pa.colwise().reverse();
    const double largest_Pa = found.pressure_Pa.maxCoeff();
    CHECK((found.pressure_Pa - mirrored).cwiseAbs().maxCoeff() < 1e-8 * largest_Pa);
    CHECK((found.pressure_Pa - found.pressure_Pa.transpose()).cwiseAbs().maxCoeff() <
          1e-8 * largest_Pa);
  }
}

// The same equation, for the thesis' profile at 10 um: radius of contact and force.
TEST_CASE("the thesis' profile on a bonded layer in space is that of the integral equation",
          "[layer]") {
  struct Row {
    double nu, a_m, force_N;
  };
  for (const Row& row :
       {Row{0.33, 254.900e-6, 2.461489e-2}, Row{0.499999, 290.891e-6, 7.061755e-2}}) {
    CAPTURE(row.nu);
    const LayerWaves waves(layer_on_rigid_base(row.nu, kH_m), false);
    LayerPress press;
    press.shape.kind = ShapeKind::kParaboloid;
    press.shape.radius_m = kR_m;
    const LayerContact contact(LayerKernel(waves, false, 3.5 * row.a_m, {}), press,
                               {0.0, 0.0, 2.2 * row.a_m, 128});
    const LayerPressure found = contact.to_depth(10e-6);
    CHECK(found.force_N == Approx(row.force_N).epsilon(1e-4));
    CHECK(std::sqrt(found.contact_m2 / std::numbers::pi) == Approx(row.a_m).epsilon(4e-3));
  }
}

// Hertz: F = 4/3 E* sqrt(R) delta^(3/2) on a half-space; a layer of 1000 radii of contact.
TEST_CASE("a thick layer answers as a half-space", "[layer]") {
  LayerScene scene = layer_of_the_thesis(LayerModel::kSpace, 1e-8);
  scene.thickness_m = 6e-3;
  scene.wanted = {"contact_force", "largest_pressure"};
  const double E_Pa = contact_modulus_Pa(scene);
  const double hertz_N = 4.0 / 3.0 * E_Pa * std::sqrt(kR_m) * 1e-12;
  const double a_m = std::sqrt(kR_m * 1e-8);
  const SceneAnswer answer = simulate_layer(scene);
  const SceneResult& force = result_of(answer, "contact_force");
  // The integral equation adds 0.0966 at a/H = 0.1, in proportion to a/H.
  CHECK(force.value / hertz_N - 1.0 == Approx(0.97 * a_m / scene.thickness_m).margin(5e-4));
  CHECK(result_of(answer, "largest_pressure").value ==
        Approx(2.0 / std::numbers::pi * E_Pa * a_m / kR_m).epsilon(2e-3));
}

// Winkler: a layer much thinner than its contact is compressed as if it could not widen, F = pi R delta^2
// M/H under a paraboloid. Edges add a share of H/a.
TEST_CASE("a thin layer is a foundation of springs", "[layer]") {
  constexpr double kThin_m = 10e-6, kWide_m = 10e-3;
  LayerScene scene = layer_of_the_thesis(LayerModel::kSpace, 0.1 * kThin_m);
  scene.thickness_m = kThin_m;
  scene.film_thickness_m = 10e-6;
  scene.press.shape.radius_m = kWide_m;
  scene.wanted = {"contact_force"};
  const double a_m = std::sqrt(2.0 * kWide_m * scene.press.depth_m);
  const double springs_N = std::numbers::pi * kWide_m * std::pow(scene.press.depth_m, 2.0) *
                           bonded_modulus_Pa(scene) / kThin_m;
  const double force_N = result_of(simulate_layer(scene), "contact_force").value;
  CHECK(force_N == Approx(springs_N).epsilon(kThin_m / a_m));
  CHECK(force_N != Approx(springs_N).epsilon(1e-3));  // the edge is felt at a/H = 14
}

// Fourier series on a grid of 2 um with elimination on the touched cells, which agrees with 4 um to 5e-5.
TEST_CASE("the thesis' profile on a bulk layer in the plane is that of an independent program",
          "[layer]") {
  struct Row {
    LayerModel model;
    double depth_m, force_N_m, largest_Pa, half_m;
    std::vector<double> mV;  // at x = 0, 50, ... um
  };
  const std::vector<Row> rows = {
      {LayerModel::kPlaneStress,
       10e-6,
       60.872,
       168.90e3,
       250e-6,
       {-906.17, -874.27, -778.37, -619.40, -410.25, -200.97, -63.88, -10.64, 0.50}},
      {LayerModel::kPlaneStrain,
       10e-6,
       78.372,
       214.81e3,
       256e-6,
       {-973.95, -940.57, -840.07, -672.50, -448.43, -218.03, -64.36, -7.39, 1.26}},
      {LayerModel::kPlaneStress, 1e-6, 2.0926, 19.93e3, 68e-6, {}},
      {LayerModel::kPlaneStrain, 1e-6, 2.5507, 23.66e3, 69e-6, {}}};
  for (const Row& row : rows) {
    LayerScene scene = layer_of_the_thesis(row.model, row.depth_m);
    scene.electrodes_m.clear();
    for (int i = 0; i <= 8; ++i) scene.electrodes_m.emplace_back(50e-6 * i, 0.0);
    const SceneAnswer answer = simulate_layer(scene);
    const SceneResult& force = result_of(answer, "contact_force");
    CHECK(force.unit == "N/m");
    CHECK(force.value == Approx(row.force_N_m).epsilon(2e-4));
    CHECK(result_of(answer, "largest_pressure").value == Approx(row.largest_Pa).epsilon(2e-4));
    CHECK(result_of(answer, "contact_width").value == Approx(2.0 * row.half_m).margin(3e-6));
    for (std::size_t i = 0; i < row.mV.size(); ++i) {
      const SceneResult& voltage = result_of(answer, "centre_voltage_" + std::to_string(i + 1));
      CHECK(1e3 * voltage.value == Approx(row.mV[i]).margin(0.05));
    }
  }
}

// FreeFEM, quadratic elements, 95 000 unknowns: the face follows the profile over 740 um, pulled at its
// ends, where the pressure is singular.
TEST_CASE("a face that follows the thesis' profile is that of finite elements", "[layer]") {
  LayerScene scene = layer_of_the_thesis(LayerModel::kPlaneStress, 10e-6);
  scene.feels_contact = false;
  scene.width_m = 740e-6;
  scene.tolerance = 1e-2;
  scene.wanted = {"contact_force", "centre_voltage"};
  scene.electrodes_m.clear();
  for (int i = 0; i <= 8; ++i) scene.electrodes_m.emplace_back(50e-6 * i, 0.0);
  const SceneAnswer answer = simulate_layer(scene);
  const SceneResult& force = result_of(answer, "contact_force");
  CHECK(std::abs(force.value - 40.471) <= 1.1 * force.error_estimate);
  CHECK(force.value == Approx(40.471).epsilon(2e-3));
  const double mV[] = {-904.513, -872.768, -777.457, -618.086, -393.629,
                       -108.193, 193.784,  361.446,  274.487};
  for (std::size_t i = 0; i < 9; ++i) {
    const SceneResult& voltage = result_of(answer, "centre_voltage_" + std::to_string(i + 1));
    // Near the end at 370 um, where the pressure is singular, two programs differ by 0.6 %.
    CHECK(1e3 * voltage.value == Approx(mV[i]).margin(i < 6 ? 0.05 : 0.01 * std::abs(mV[i])));
  }
}
