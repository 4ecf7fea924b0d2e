#include "tests/benchmarks/factor_peers/answer_cases.h"

#include "models/array/plane/array_scene.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard::peers {
namespace {

Answer answer_of(const SceneAnswer& scene) {
  Answer answer;
  const auto add = [&](double value, double error) {
    answer.value.push_back(value);
    answer.error.push_back(error);
  };
  for (const SceneResult& result : scene.results) {
    if (result.is_wanted) add(result.value, result.error_estimate);
  }
  for (const SceneMode& mode : scene.modes) add(mode.frequency_Hz, mode.error_estimate);
  for (const SceneCurve& curve : scene.curves) {
    if (!curve.is_watched) continue;
    for (std::size_t i = 0; i < curve.error.size(); ++i) add(curve.value[i], curve.error[i]);
  }
  return answer;
}

// The scenes are those of data/scenes, with the same numbers.
Material soft() {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.rho_kg_m3 = 965.0;
  return material;
}

Material relaxing() {
  Material material = soft();
  material.E0_Pa = 1.88e6;
  material.nu = 0.495;
  material.terms = {{.008206, .008206, .1945}, {.01386, .01386, 2.403}};
  return material;
}

Medium elastic_film() {
  return isotropic_medium(2e9, 0.29, 1780.0);
}

PiezoMatrix film_charge(double d31_C_N, double d32_C_N, double d33_C_N) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << d31_C_N, d32_C_N, d33_C_N, 0.0, 0.0, 0.0;
  return d;
}

Medium piezo_film(const PiezoMatrix& d) {
  return piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                      12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

PillarGeometry on_film() {
  return {.film = FilmGeometry{25e-6, 60e-6}};
}

// The twelve lowest modes on one mesh: four pairs of bending, two longitudinal, two torsional. The
// error is that of the mesh, against converged values (bench_pillar_peers).
Answer twelve_modes(const PillarGeometry& geometry, const Discretisation& mesh,
                    const std::vector<double>& converged_Hz) {
  PillarMedia media{isotropic_medium(1.8e6, .33, 965.0), std::nullopt};
  if (geometry.film) media.film = elastic_film();
  Answer answer;
  for (const auto& [motion, count] :
       {std::pair{Motion::kLateral, 4}, std::pair{Motion::kLongitudinal, 2},
        std::pair{Motion::kTorsion, 2}}) {
    const PillarModel model(geometry, mesh, media, {.motion = motion});
    for (const PillarMode& mode : lowest_modes(model, count)) {
      const double converged = converged_Hz[answer.value.size()];
      answer.value.push_back(mode.frequency_Hz);
      answer.error.push_back(std::max(std::abs(mode.frequency_Hz - converged), 1e-7 * converged));
    }
  }
  return answer;
}

const std::vector<double> kFixedHz = {16029.18, 77413.28, 173664.2, 274693.5,
                                      90769.96, 268168.4, 55168.42, 165505.3};
const std::vector<double> kFilmHz = {16026.87, 77403.97, 173645.7, 274668.4,
                                     90760.26, 268141.2, 55165.77, 165497.3};

PillarScene modal_scene() {
  PillarScene scene;
  scene.geometry = on_film();
  scene.pillar = soft();
  scene.film = elastic_film();
  scene.drive = ModalDrive{};
  return scene;
}

PillarScene free_disc_scene() {
  PillarScene scene = modal_scene();
  scene.geometry.length_m = 40e-6;
  scene.geometry.film = FilmGeometry{50e-6, 1e-3};
  scene.drive = ModalDrive{.modes = 3};
  scene.fixed_bottom = false;
  return scene;
}

PillarScene buckling_scene() {
  PillarScene scene;
  scene.tolerance = 1e-4;
  scene.pillar = soft();
  scene.drive = BucklingDrive{};
  return scene;
}

PillarScene sensor_scene() {
  PillarScene scene;
  scene.geometry = on_film();
  scene.pillar = soft();
  const PiezoMatrix d = film_charge(23e-12, 23e-12, -33e-12);
  scene.film = piezo_film(d);
  scene.film_charge_C_N = d;
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  scene.drive = StaticDrive{.pressure_Pa = 1e4};
  return scene;
}

PillarScene incompressible_scene() {
  PillarScene scene = sensor_scene();
  scene.pillar.nu = 0.5;
  return scene;
}

PillarScene creep_scene() {
  PillarScene scene;
  scene.tolerance = 1e-4;
  scene.pillar = relaxing();
  scene.drive = CreepDrive{{{0.0, 0.0}, {0.0, 1e4}, {10.0, 1e4}, {10.0, 0.0}, {30.0, 0.0}}};
  return scene;
}

PillarScene touch_scene() {
  PillarScene scene = sensor_scene();
  scene.pillar = relaxing();
  scene.drive = CreepDrive{{{0.0, 0.0}, {0.01, 1e4}, {2.0, 1e4}, {2.01, 0.0}, {4.0, 0.0}}};
  scene.readout = Readout{.resistance_Ohm = 1e13, .capacitance_F = 1e-13};
  return scene;
}

PillarScene sweep_scene() {
  PillarScene scene;
  scene.pillar = relaxing();
  HarmonicDrive drive{.load_place = LoadPlace::kBase,
                      .direction = LoadDirection::kLateral,
                      .base_acceleration_m_s2 = 1.0};
  for (int i = 0; i < 1000; ++i) drive.frequencies_Hz.push_back(std::pow(1e5, i / 999.0));
  scene.drive = drive;
  return scene;
}

PillarScene pulse_scene() {
  PillarScene scene;
  scene.tolerance = 1e-2;
  scene.pillar = soft();
  scene.drive = TransientDrive{.history = {{0.0, 0.0}, {5e-6, 1e3}, {10e-6, 0.0}, {100e-6, 0.0}},
                               .end_time_s = 100e-6};
  return scene;
}

ArrayScene row_scene(int count) {
  ArrayScene scene;
  scene.geometry.count = count;
  scene.pillar = soft();
  scene.film = piezo_film(film_charge(22e-12, 3e-12, -30e-12));
  scene.load_Pa = 1e3;
  scene.wanted = {"centre_voltage", "mean_voltage"};
  return scene;
}

ArrayScene row_modes_scene() {
  ArrayScene scene = row_scene(4);
  scene.geometry.spacing_m = 20e-6;
  scene.geometry.film_edge_m = 60e-6;
  scene.drive = RowModal{.modes = 2};
  scene.load_Pa = 0.0;
  scene.wanted = {};
  return scene;
}

// Displacement of the top on a uniform mesh of quadratic elements, as a user of an ordinary
// finite-element program would choose it. The error is that of the mesh.
Answer quadratic_static(double size_m) {
  const PillarModel model(on_film(), {.degree = 2, .uniform_m = size_m},
                          {isotropic_medium(1.8e6, .33, 965.0), elastic_film()}, {});
  const Eigen::VectorXd load = model.top_traction();
  const double moved_m = load.dot(model.solve(load).unknowns);
  return {{moved_m}, {1e-4 * std::abs(moved_m)}};
}

AnswerCase scene_case(const char* name, const Scene& scene) {
  return {name, [scene] { return answer_of(simulate(scene)); }};
}

}  // namespace

std::vector<AnswerCase> answer_cases() {
  const auto modes_case = [](const char* name, bool has_film, int degree, int layers) {
    return AnswerCase{name, [=] {
                        return twelve_modes(has_film ? on_film() : PillarGeometry{},
                                            {.degree = degree, .layers = layers},
                                            has_film ? kFilmHz : kFixedHz);
                      }};
  };
  return {modes_case("fixed pillar, 12 modes, degree 4", false, 4, 2),
          modes_case("pillar on film, 12 modes, degree 4", true, 4, 2),
          modes_case("pillar on film, 12 modes, degree 8", true, 8, 3),
          scene_case("modes on film to 0.1 %", modal_scene()),
          scene_case("free disc, modes to 0.1 %", free_disc_scene()),
          scene_case("buckling to 0.01 %", buckling_scene()),
          scene_case("film voltage to 0.1 %", sensor_scene()),
          scene_case("film voltage, nu = 0.5", incompressible_scene()),
          scene_case("creep to 0.01 %", creep_scene()),
          scene_case("touch and readout", touch_scene()),
          scene_case("sweep, 1000 frequencies", sweep_scene()),
          scene_case("pulse, 1000 times", pulse_scene()),
          scene_case("row of 8, voltages", row_scene(8)),
          scene_case("row of 64, voltages", row_scene(64)),
          scene_case("row of 4, modes", row_modes_scene()),
          {"quadratic elements of 2 um", [] { return quadratic_static(2e-6); }},
          {"quadratic elements of 0.8 um", [] { return quadratic_static(0.8e-6); }}};
}

}  // namespace viscard::peers
