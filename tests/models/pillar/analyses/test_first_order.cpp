// Answers to first order that reuse one solution (eq. 26), against answers of their own.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/system/stiffness_factor.h"
#include "models/uncertainty/linear_propagation.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace viscard;

namespace {

const Discretisation kMesh{.degree = 5, .layers = 2};

// A film of given constants: E, nu, d31, d33, relative permittivity.
struct FilmConstants {
  double E_Pa = 2e9, nu = 0.29, d31 = 23e-12, d33 = -33e-12, permittivity = 12.0;
};

void set_film(const FilmConstants& c, PillarScene& scene) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << c.d31, c.d31, c.d33, 0, 0, 0;
  scene.film_charge_C_N = d;
  scene.film =
      piezo_medium(isotropic_moduli_Pa(c.E_Pa, c.nu), d,
                   c.permittivity * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

// The sensor of data/scenes/pillar_sensor.toml with an electrode of 18 um, whose edge is not the rim.
PillarScene sensor() {
  PillarScene scene;
  scene.tolerance = 1e-3;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  set_film({}, scene);
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 18e-6};
  test::as<StaticDrive>(scene).pressure_Pa = 1e4;
  return scene;
}

PillarScene without_film() {
  PillarScene scene = sensor();
  scene.geometry.film.reset();
  scene.film.reset();
  scene.film_charge_C_N.setZero();
  scene.electrodes.reset();
  return scene;
}

// A scene whose parameters move: its film is made of the constants at the end.
struct Moved {
  PillarScene scene;
  FilmConstants film;
};

// A parameter and its standard deviation, relative to its value.
struct Parameter {
  std::string name;
  double deviation;
  std::function<double&(Moved&)> value;
  bool is_length = false;
};

std::vector<Parameter> parameters_of(const PillarScene& scene) {
  std::vector<Parameter> all = {
      {"diameter", 0.01, [](Moved& m) -> double& { return m.scene.geometry.diameter_m; }, true},
      {"length", 0.02, [](Moved& m) -> double& { return m.scene.geometry.length_m; }, true},
      {"E", 0.1, [](Moved& m) -> double& { return m.scene.pillar.E0_Pa; }},
      {"rho", 0.1, [](Moved& m) -> double& { return m.scene.pillar.rho_kg_m3; }}};
  if (scene.pillar.nu < 0.5) {
    all.push_back({"nu", 0.005, [](Moved& m) -> double& { return m.scene.pillar.nu; }});
  }
  if (pressure_Pa(scene) != 0.0) {
    all.push_back({"pressure", 0.1, [](Moved& m) -> double& {
                     return std::get<StaticDrive>(m.scene.drive).pressure_Pa;
                   }});
  }
  if (!scene.geometry.film) return all;
  const auto film_length = [&](const char* name, double FilmGeometry::*member) {
    all.push_back({name, 0.02,
                   [member](Moved& m) -> double& { return (*m.scene.geometry.film).*member; },
                   true});
  };
  film_length("film thickness", &FilmGeometry::thickness_m);
  film_length("film radius", &FilmGeometry::radius_m);
  const auto film_constant = [&](const char* name, double FilmConstants::*member) {
    all.push_back({name, 0.04, [member](Moved& m) -> double& { return m.film.*member; }});
  };
  film_constant("film E", &FilmConstants::E_Pa);
  film_constant("film nu", &FilmConstants::nu);
  if (!scene.electrodes) return all;
  film_constant("d31", &FilmConstants::d31);
  film_constant("d33", &FilmConstants::d33);
  film_constant("permittivity", &FilmConstants::permittivity);
  if (scene.electrodes->electrode_radius_m > 0.0) {
    all.push_back({"electrode radius", 0.01,
                   [](Moved& m) -> double& { return m.scene.electrodes->electrode_radius_m; },
                   true});
  }
  return all;
}

PillarScene moved(const PillarScene& scene, const std::vector<Parameter>& parameters,
                  const Eigen::VectorXd& deviates) {
  Moved at{scene, {}};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i].value(at) *=
        1.0 + parameters[i].deviation * deviates[static_cast<Eigen::Index>(i)];
  }
  if (scene.film) set_film(at.film, at.scene);
  return at.scene;
}

std::vector<std::string> names_of(const SceneAnswer& answer) {
  std::vector<std::string> names;
  for (const SceneResult& r : answer.results) names.push_back(r.name);
  for (const SceneMode& m : answer.modes) names.push_back(m.family + " frequency");
  return names;
}

BatchFunction batch_of(const PillarScene& scene, const std::vector<Parameter>& parameters,
                       std::size_t n_values, const FirstOrderAnswers& answer_of) {
  return [=](const Eigen::MatrixXd& points) {
    Eigen::MatrixXd values =
        Eigen::MatrixXd::Constant(points.rows(), static_cast<Eigen::Index>(n_values),
                                  std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const auto answer = answer_of(moved(scene, parameters, points.row(i)));
      if (!answer) continue;
      Eigen::Index k = 0;
      for (const SceneResult& r : answer->results) values(i, k++) = r.value;
      for (const SceneMode& m : answer->modes) values(i, k++) = m.frequency_Hz;
    }
    return values;
  };
}

// Every derivative comes from the solver, those by lengths only if `lengths_too`, and agrees to 1e-5 of
// itself, or to the tolerance of both, relative to the standard uncertainty.
void check_derivatives(const PillarScene& scene, bool lengths_too = true) {
  constexpr double kSlopes = 1e-6;
  // The iterated pressures of an incompressible pillar leave 1e-8 of a voltage, which differences see.
  const double allowed = scene.pillar.nu == 0.5 ? 1e-5 : kSlopes;
  const std::vector<std::string> names = names_of(pillar_answer_on(scene, kMesh));
  const std::vector<Parameter> parameters = parameters_of(scene);
  std::vector<UncertainInput> inputs;
  for (const Parameter& one : parameters) inputs.push_back({one.name});
  const FirstOrderAnswers first_order = first_order_answers(scene, kMesh);
  REQUIRE(first_order);
  const BatchFunction own = batch_of(scene, parameters, names.size(), [](const PillarScene& one) {
    return std::optional<SceneAnswer>(pillar_answer_on(one, kMesh));
  });
  const LinearAnswer expected = linear_answer(own, inputs, kSlopes);
  const LinearAnswer found =
      linear_answer(own, inputs, kSlopes, batch_of(scene, parameters, names.size(), first_order));
  for (std::size_t d = 0; d < parameters.size(); ++d) {
    CAPTURE(parameters[d].name);
    CHECK(found.by_solver[d] == (lengths_too || !parameters[d].is_length));
    for (std::size_t r = 0; r < names.size(); ++r) {
      const auto row = static_cast<Eigen::Index>(r), column = static_cast<Eigen::Index>(d);
      const double by_solver = found.slope(row, column);
      const double by_differences = expected.slope(row, column);
      const double uncertainty = expected.slope.row(row).norm();
      if (uncertainty == 0.0) {  // the voltage of a driven electrode
        CHECK(by_solver == 0.0);
        continue;
      }
      CAPTURE(names[r], by_solver / uncertainty, by_differences / uncertainty);
      CHECK(std::abs(by_solver - by_differences) / uncertainty <=
            1e-5 * std::abs(by_differences) / uncertainty + allowed);
      CHECK(found.slope_error(row, column) <= 1e-5 * uncertainty);
    }
  }
}

}  // namespace

TEST_CASE("derivatives of a sensor from one solution agree with differences of its answers",
          "[pillar][gradient]") {
  PillarScene scene = sensor();
  SECTION("with an electrode on the bottom's face or the top's, smaller or wider than the pillar") {
    scene.electrodes->grounded = GENERATE(FilmFace::kBottom, FilmFace::kTop);
    scene.electrodes->electrode_radius_m = GENERATE(18e-6, 33e-6);
  }
  SECTION("with a charge-free face") {
    scene.electrodes->electrode_radius_m = 0.0;
    scene.electrodes->grounded = FilmFace::kTop;
  }
  SECTION("driven by a voltage") {
    std::get<StaticDrive>(scene.drive).drive_V = 10.0;
  }
  SECTION("whose top is moved") {
    std::get<StaticDrive>(scene.drive) = StaticDrive{.displacement_m = -1e-6};
  }
  SECTION("with quadrants, under a shear") {
    std::get<StaticDrive>(scene.drive) =
        StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = 1e3};
    scene.electrodes->quadrants = true;
  }
  SECTION("of a nearly incompressible pillar") {
    scene.pillar.nu = GENERATE(0.47, 0.4899);
  }
  check_derivatives(scene);
}

TEST_CASE("derivatives of displacements and stresses from one solution agree with differences",
          "[pillar][gradient]") {
  PillarScene scene = without_film();
  SECTION("of a pillar on a rigid base") {}
  SECTION("of a nearly incompressible pillar with a fillet, whose elements are stretched") {
    scene.pillar.nu = 0.4899;
    scene.geometry.foot = {4e-6, 6e-6};
  }
  SECTION("of a strip") {
    scene.plane = GENERATE(PlaneState::kStrain, PlaneState::kStress);
  }
  SECTION("of a pillar on an elastic film") {
    scene = sensor();
    scene.electrodes.reset();
  }
  check_derivatives(scene);
}

TEST_CASE("derivatives of frequencies are those of the Rayleigh quotients of the modes",
          "[pillar][gradient]") {
  PillarScene scene = GENERATE(true, false) ? sensor() : without_film();
  scene.electrodes.reset();
  scene.pillar.nu = GENERATE(0.33, 0.48);
  scene.drive = ModalDrive{.modes = 2};
  scene.discretisation = kMesh;
  check_derivatives(scene);
}

TEST_CASE(
    "an incompressible pillar has derivatives by its moduli from one solution, not by lengths",
    "[pillar][gradient]") {
  PillarScene scene = sensor();
  scene.pillar.nu = 0.5;
  check_derivatives(scene, /*lengths_too=*/false);
  const FirstOrderAnswers first_order = first_order_answers(scene, kMesh);
  PillarScene other = scene;
  other.pillar.E0_Pa *= 1.001;
  CHECK(first_order(other));
  other.geometry.length_m *= 1.001;
  CHECK_FALSE(first_order(other));
}

TEST_CASE("a scene has no first-order answer where the elements change or the analysis has none",
          "[pillar][gradient]") {
  PillarScene scene = sensor();
  scene.electrodes->electrode_radius_m = 20e-6;  // the edge is the rim
  const FirstOrderAnswers first_order = first_order_answers(scene, kMesh);
  REQUIRE(first_order(scene));
  PillarScene wider = scene;
  wider.geometry.diameter_m *= 1.001;
  CHECK_FALSE(first_order(wider));
  PillarScene condensed = scene;
  condensed.pillar.nu = 0.46;  // pressures are condensed from 0.45 on
  CHECK_FALSE(first_order(condensed));
  PillarScene pressed = without_film();
  pressed.drive = ModalDrive{.modes = 1, .pressure_Pa = 1e3};
  CHECK_FALSE(first_order_answers(pressed, kMesh));
  PillarScene one_way = scene;
  one_way.one_way_potential = true;
  CHECK_FALSE(first_order_answers(one_way, kMesh));
  PillarScene buckling = without_film();
  buckling.drive = BucklingDrive{};
  CHECK_FALSE(first_order_answers(buckling, kMesh));
}

TEST_CASE("a form applied to a vector is its matrix times the vector", "[pillar]") {
  PillarScene scene = sensor();
  scene.pillar.nu = 0.48;
  scene.geometry.foot = {4e-6, 6e-6};
  const PillarModel model = electric_model_of(scene, Motion::kLongitudinal, kMesh);
  Eigen::VectorXd u(model.system().size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = std::sin(1.0 + static_cast<double>(i));
  const Eigen::VectorXd expected = times(model.stiffness(), u);
  CHECK((model.stiffness_times(u, u) - expected).norm() <= 1e-13 * expected.norm());
  const Eigen::VectorXd mass = times(model.mass(), u);
  CHECK((model.mass_times(u) - mass).norm() <= 1e-13 * mass.norm());
}
