// Answers of a bulk layer on the film under a rigid shape: their errors, their symmetries, and what is refused.
#include "models/answer/scene_mistake.h"
#include "models/array/layer/layer_contact.h"
#include "models/array/layer/simulate_layer.h"
#include "tests/models/array/layer/layer_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;

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

TEST_CASE("profiles under a symmetric shape are symmetric up to both edges", "[layer]") {
  LayerScene scene = layer_of_the_thesis(LayerModel::kPlaneStrain, 3e-6);
  scene.press.shape = {};  // a plane, which touches all of the layer
  scene.width_m = 1e-3;
  scene.wanted = {"pressure_profile", "gap_profile"};
  const SceneAnswer answer = layer_answer_on(scene, {.degree = 4, .layers = 2});
  REQUIRE(answer.curves.size() == 2);
  const std::vector<double>& x_m = answer.curves[0].x;
  const std::vector<double>& p_Pa = answer.curves[0].value;
  const std::size_t count = x_m.size();
  REQUIRE(count == 61);
  CHECK(x_m[10] == Approx(-500e-6));
  CHECK(x_m[50] == Approx(500e-6));
  for (std::size_t i = 0; i < count; ++i) {
    CAPTURE(i, x_m[i]);
    CHECK((p_Pa[i] > 0.0) == (i >= 10 && i <= 50));
    CHECK(p_Pa[i] == Approx(p_Pa[count - 1 - i]).epsilon(1e-6));
  }
  for (const double gap_m : answer.curves[1].value) CHECK(gap_m == 0.0);
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
