// A bulk layer on the film under a rigid shape, against closed forms, integral equations and an
// independent program. Rigid bases stand for films of 2e13 Pa, which yield 1e-7 of the layer.
#include "models/array/layer/layer_contact.h"
#include "models/array/layer/simulate_layer.h"
#include "models/maths/grid_convolution.h"
#include "models/pillar/mesh/scene_mistake.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kE_Pa = 1.8e6;
constexpr double kH_m = 120e-6;
constexpr double kR_m = 3650e-6;

// 120 um of PDMS on the thesis' film under the thesis' profile.
LayerScene layer_of_the_thesis(LayerModel model, double depth_m) {
  LayerScene scene;
  scene.model = model;
  scene.pillar.E0_Pa = kE_Pa;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.press.shape.kind =
      model == LayerModel::kSpace ? ShapeKind::kParaboloid : ShapeKind::kCylinder;
  scene.press.shape.radius_m = kR_m;
  scene.press.depth_m = depth_m;
  return scene;
}

LayeredFilm layer_on_rigid_base(double nu, double thickness_m) {
  Medium base = isotropic_medium(2e13, 0.29, 1000.0);
  base.permittivity_F_m = 1e-10 * Eigen::Matrix3d::Identity();
  LayeredFilm stack;
  stack.layers = {{base, 25e-6}, {isotropic_medium(kE_Pa, nu, 965.0), thickness_m}};
  return stack;
}

const SceneResult& result_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                  [&](const SceneResult& one) { return one.name == name; });
  if (found == answer.results.end()) throw std::runtime_error("no result " + name);
  return *found;
}

}  // namespace

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
    double a_H, depth_R_a2, force;
  };
  const double nu = 0.33;
  const LayerWaves waves(layer_on_rigid_base(nu, kH_m), false);
  for (const Row& row : {Row{0.1, 0.940713, 1.000551}, Row{0.5, 0.753481, 1.054096},
                         Row{1.0, 0.640892, 1.271405}, Row{5.0, 0.522115, 4.177367}}) {
    CAPTURE(row.a_H);
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
  for (int i = 0; i <= 5; ++i) scene.electrodes_m.emplace_back(50e-6 * i, 0.0);
  const SceneAnswer answer = simulate_layer(scene);
  const SceneResult& force = result_of(answer, "contact_force");
  CHECK(std::abs(force.value - 40.471) <= 1.1 * force.error_estimate);
  CHECK(force.value == Approx(40.471).epsilon(2e-3));
  const double mV[] = {-904.513, -872.768, -777.457, -618.086, -393.629, -108.193};
  for (std::size_t i = 0; i < 6; ++i) {
    const SceneResult& voltage = result_of(answer, "centre_voltage_" + std::to_string(i + 1));
    CHECK(1e3 * voltage.value == Approx(mV[i]).margin(0.05));
  }
}

TEST_CASE("a layer's error estimates cover the error of every result", "[layer]") {
  struct Case {
    const char* name;
    ShapeKind kind;
    double width_m, tilt;
  };
  for (const Case& one : {Case{"sphere", ShapeKind::kSphere, 0.0, 0.0},
                          Case{"tilted sphere", ShapeKind::kSphere, 0.0, 0.01},
                          Case{"wedge", ShapeKind::kWedge, 200e-6, 0.0},
                          Case{"plane", ShapeKind::kPlane, 300e-6, 0.003}}) {
    CAPTURE(one.name);
    LayerScene scene = layer_of_the_thesis(LayerModel::kSpace, 3e-6);
    scene.press.shape.kind = one.kind;
    scene.press.shape.slope = 0.05;
    scene.press.shape.tilt_x = one.tilt;
    scene.width_m = one.width_m;
    scene.tolerance = 1e-2;
    scene.wanted = {"contact_force", "contact_area", "centre_voltage", "mean_voltage"};
    scene.electrodes_m = {{0.0, 0.0}, {100e-6, 50e-6}, {400e-6, 0.0}};
    const SceneAnswer answer = simulate_layer(scene);
    LayerScene finer = scene;
    finer.tolerance = 1e-3;
    Discretisation mesh = answer.discretisation;
    mesh.degree = std::min(mesh.degree + 1, 7);
    const SceneAnswer fine = layer_answer_on(finer, mesh);
    CHECK(answer.largest_relative_error <= scene.tolerance);
    for (const SceneResult& r : answer.results) {
      CAPTURE(r.name, r.value, r.error_estimate);
      CHECK(std::abs(r.value - result_of(fine, r.name).value) <= r.error_estimate);
    }
  }
}

TEST_CASE("a depth and the force that it takes give one answer", "[layer]") {
  for (const LayerModel model : {LayerModel::kSpace, LayerModel::kPlaneStrain}) {
    const LayerScene by_depth = layer_of_the_thesis(model, 4e-6);
    const Discretisation mesh = layer_meshes(by_depth)[0];
    const SceneAnswer first = layer_answer_on(by_depth, mesh);
    LayerScene by_force = by_depth;
    by_force.press.depth_m = 0.0;
    by_force.press.force_N = result_of(first, "contact_force").value;
    // The windows of the coarse searches differ a little, and so do the grids.
    const SceneAnswer second = layer_answer_on(by_force, mesh);
    CHECK(result_of(second, "contact_force").value ==
          Approx(by_force.press.force_N).epsilon(1e-10));
    CHECK(result_of(second, "depth").value == Approx(4e-6).epsilon(1e-3));
  }
  // On one grid they agree to rounding.
  const LayerWaves waves(layer_on_rigid_base(0.33, kH_m), false);
  const LayerKernel kernel(waves, false, 1e-3, {});
  LayerPress press;
  press.shape.kind = ShapeKind::kSphere;
  press.shape.radius_m = kR_m;
  const LayerContact contact(kernel, press, {0.0, 0.0, 500e-6, 64});
  const LayerPressure down = contact.to_depth(5e-6);
  const LayerPressure pressed = contact.with_force(down.force_N, 7e-6, 1e-8);
  CHECK(pressed.depth_m == Approx(5e-6).epsilon(1e-10));
  CHECK((pressed.pressure_Pa - down.pressure_Pa).cwiseAbs().maxCoeff() <=
        1e-8 * down.pressure_Pa.maxCoeff());
}

TEST_CASE("a layer scales with its modulus and turns with the film", "[layer]") {
  const LayerScene scene = [] {
    LayerScene one = layer_of_the_thesis(LayerModel::kSpace, 5e-6);
    one.electrodes_m = {{100e-6, 0.0}, {0.0, 100e-6}, {-100e-6, 0.0}};
    one.electrode = SpaceElectrode::kQuadrants;
    return one;
  }();
  const Discretisation mesh = layer_meshes(scene)[1];
  const SceneAnswer answer = layer_answer_on(scene, mesh);
  const auto volts = [&](const std::string& name) { return result_of(answer, name).value; };
  // The film is stretched along x: it reads differently beside the contact and across it.
  CHECK(volts("centre_voltage_1") == Approx(volts("centre_voltage_3")).epsilon(1e-9));
  CHECK(std::abs(volts("centre_voltage_1") - volts("centre_voltage_2")) >
        1e-3 * std::abs(volts("centre_voltage_1")));
  CHECK(volts("quadrant_1_voltage_1") == Approx(volts("quadrant_2_voltage_3")).epsilon(1e-9));
  CHECK(volts("quadrant_1_voltage_1") == Approx(volts("quadrant_4_voltage_1")).epsilon(1e-9));
  const double quarters = volts("quadrant_1_voltage_1") + volts("quadrant_2_voltage_1") +
                          volts("quadrant_3_voltage_1") + volts("quadrant_4_voltage_1");
  CHECK(0.25 * quarters == Approx(volts("mean_voltage_1")).epsilon(1e-5));

  LayerScene isotropic = scene;
  isotropic.film = pvdf_of_the_thesis(12.5e-12, 12.5e-12);
  const SceneAnswer round = layer_answer_on(isotropic, mesh);
  CHECK(result_of(round, "centre_voltage_1").value ==
        Approx(result_of(round, "centre_voltage_2").value).epsilon(1e-7));

  LayerScene soft = scene;
  soft.pillar.E0_Pa *= 1e-3;
  LayerScene softer = scene;
  softer.pillar.E0_Pa *= 1e-4;
  CHECK(
      result_of(layer_answer_on(soft, mesh), "contact_force").value ==
      Approx(10.0 * result_of(layer_answer_on(softer, mesh), "contact_force").value).epsilon(1e-5));
}

// An open electrode over which the potential hardly varies reads that potential.
TEST_CASE("an equipotential electrode under a wide contact reads the mean", "[layer]") {
  LayerScene scene = layer_of_the_thesis(LayerModel::kSpace, 10e-6);
  const Discretisation mesh = layer_meshes(scene)[1];
  const double mean_V = result_of(layer_answer_on(scene, mesh), "mean_voltage_1").value;
  const double centre_V = result_of(layer_answer_on(scene, mesh), "centre_voltage_1").value;
  scene.electrode = SpaceElectrode::kEquipotential;
  const double electrode_V = result_of(layer_answer_on(scene, mesh), "electrode_voltage_1").value;
  CHECK(std::abs(electrode_V - mean_V) < std::abs(centre_V - mean_V));
  CHECK(electrode_V == Approx(mean_V).epsilon(2e-3));
}

TEST_CASE("a shape beside or above the layer's covered part touches nothing", "[layer]") {
  LayerScene scene = layer_of_the_thesis(LayerModel::kSpace, 1e-6);
  scene.width_m = 300e-6;
  scene.press.shape.x_m = 2e-3;
  const SceneAnswer answer = simulate_layer(scene);
  CHECK(result_of(answer, "contact_force").value == 0.0);
  CHECK(result_of(answer, "centre_voltage_1").value == 0.0);
  REQUIRE(answer.notes.size() == 1);
  CHECK(answer.notes[0].find("does not touch the layer") != std::string::npos);
  scene.press.depth_m = 0.0;
  scene.press.force_N = 1e-3;
  CHECK_THROWS_AS(simulate_layer(scene), SceneMistake);
}

TEST_CASE("layers that cannot be answered are refused with their key", "[layer]") {
  const auto key_of = [](const LayerScene& scene) -> std::string {
    try {
      simulate_layer(scene);
    } catch (const SceneMistake& mistake) {
      return mistake.key();
    }
    return "";
  };
  const LayerScene good = layer_of_the_thesis(LayerModel::kSpace, 1e-6);
  LayerScene bad = good;
  bad.pillar.nu = 0.5;
  CHECK(key_of(bad) == "materials.layer.nu");
  bad = good;
  bad.thickness_m = 5e-6;
  CHECK(key_of(bad) == "geometry.thickness");
  bad = good;
  bad.press.shape.kind = ShapeKind::kPlane;
  CHECK(key_of(bad) == "geometry");
  bad = good;
  bad.press.depth_m = 130e-6;
  CHECK(key_of(bad) == "shape.depth");
  bad = good;
  bad.press.depth_m = 0.0;
  CHECK(key_of(bad) == "shape");
  bad.press.force_N = 1e6;
  CHECK(key_of(bad) == "shape.force");
  bad = good;
  bad.press.shape.radius_m = 100.0;  // touches 30 mm of a layer of 120 um
  CHECK(key_of(bad) == "geometry.thickness");
  bad = good;
  bad.electrode = SpaceElectrode::kEquipotential;
  bad.electrodes_m = {{0.0, 0.0}, {30e-6, 0.0}};
  CHECK(key_of(bad) == "geometry.electrode.at");
  bad = good;
  bad.pillar.E0_Pa = 2e9;  // as stiff as the film, which is not the same in all directions
  bad.tolerance = 1e-4;
  CHECK(key_of(bad) == "tolerance");
  bad = layer_of_the_thesis(LayerModel::kPlaneStrain, 1e-6);
  bad.electrode = SpaceElectrode::kQuadrants;
  CHECK(key_of(bad) == "geometry.electrode");
}
