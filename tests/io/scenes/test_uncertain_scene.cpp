#include "io/basics/atomic_file.h"
#include "io/config/quantity_text.h"
#include "io/flow/scenes/named_values.h"
#include "io/flow/scenes/scene_uncertainty.h"
#include "models/scene/simulate.h"
#include "models/uncertainty/sobol_points.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;
using namespace viscard::test;
using Eigen::VectorXd;

namespace {

// Frequencies of a fixed pillar, which are proportional to sqrt(E/rho)/L at equal shape.
const char* const kModes = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa +- 2 %", nu = 0.33, rho = "965 kg/m3 +- 2 %" }
[analysis]
kind = "modal"
modes = 1
)";

// A pressed pillar. Its top moves by p L/E times a function of its shape and nu.
const char* const kPressed = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = PILLAR
[analysis]
kind = "static"
load = { pressure = "10 kPa +- 1 %", on = "top" }
[want]
quantities = ["top_displacement"]
)";

SceneUncertainty uncertainty_in(const std::string& path, const UncertaintyOptions& options = {}) {
  const SceneFile file = read_scene(path);
  const UncertainScene scene(file, read_file(path), path);
  SceneAnswer answer = simulate(file.scene);
  const auto is_unwanted = [&](const SceneResult& r) {
    return !asks_for(common(file.scene), r.name);
  };
  std::erase_if(answer.results, is_unwanted);
  return scene_uncertainty(scene, answer, options);
}

const ResultUncertainty& result_named(const SceneUncertainty& all, const std::string& name) {
  const auto found = std::find_if(all.results.begin(), all.results.end(),
                                  [&](const ResultUncertainty& r) { return r.name == name; });
  REQUIRE(found != all.results.end());
  return *found;
}

double value_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& r : answer.results) {
    if (r.name == name) return r.value;
  }
  FAIL("no result " + name);
  return 0.0;
}

}  // namespace

TEST_CASE("a quantity with +- is read in SI with its distribution", "[io][scenes][uncertainty]") {
  const auto check = [](const char* text, const char* unit, double value, double half,
                        Spread spread) {
    CAPTURE(text);
    const auto found = uncertain_from_text(text, unit);
    REQUIRE(found);
    CHECK(found->value == Approx(value).epsilon(1e-12));
    CHECK(found->half_width == Approx(half).epsilon(1e-12));
    CHECK(found->spread == spread);
  };
  check("40 um +- 1 um", "m", 40e-6, 1e-6, Spread::kNormal);
  check("40 +- 1 um", "m", 40e-6, 1e-6, Spread::kNormal);
  check("40 um ± 500 nm uniform", "m", 40e-6, 0.5e-6, Spread::kUniform);
  check("1.8 MPa +/- 5 % lognormal", "Pa", 1.8e6, 0.09e6, Spread::kLognormal);
  check("0.33 +- 0.02", "1", 0.33, 0.02, Spread::kNormal);
  check("-10 kPa +- 2 % normal", "Pa", -1e4, 200.0, Spread::kNormal);
  CHECK_FALSE(uncertain_from_text("40 um", "m"));
  CHECK_FALSE(uncertain_from_text("1e-3", "1"));
  for (const char* const text : {"40 um +- 1", "40 um +- 1 kg", "40 um +- -1 um", "40 um +-",
                                 "40 um +- 1 um gaussian", "-1 Pa +- 1 % lognormal"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(uncertain_from_text(text, "m"), std::invalid_argument);
  }
}

TEST_CASE("a scene with +- is answered at its values, and a tolerance has no uncertainty",
          "[io][scenes][uncertainty]") {
  const SceneText scene(kModes);
  const SceneFile file = read_scene(scene.path());
  REQUIRE(file.uncertain.size() == 2);
  CHECK(file.uncertain[0].key == "materials.pillar.E");
  CHECK(common(file.scene).pillar.E0_Pa == Approx(1.8e6).epsilon(1e-12));
  const SceneFile other =
      scene_from_toml(read_file(scene.path()), scene.path(), {{"materials.pillar.E", 2e6}});
  CHECK(common(other.scene).pillar.E0_Pa == Approx(2e6).epsilon(1e-12));
  const SceneText wrong(replaced(kModes, "tolerance = 1e-3", "tolerance = \"1e-3 +- 1e-4\""));
  CHECK_THROWS_WITH(read_scene(wrong.path()),
                    Catch::Contains("tolerance") && Catch::Contains("no uncertainty"));
}

TEST_CASE("frequencies take half of the relative uncertainty of modulus and density each",
          "[io][scenes][uncertainty]") {
  const SceneText text(kModes);
  const SceneUncertainty found = uncertainty_in(text.path());
  CHECK_FALSE(found.is_sampled);
  for (const ResultUncertainty& mode : found.results) {
    CAPTURE(mode.name);
    const double relative = 0.5 * std::sqrt(2.0) * 0.02 / 1.959963984540054;
    CHECK(mode.standard_uncertainty == Approx(relative * mode.value).epsilon(1e-6));
    CHECK(mode.interval_95.high - mode.value ==
          Approx(1.959963984540054 * relative * mode.value).epsilon(1e-6));
    CHECK(mode.causes[0].share == Approx(0.5).epsilon(1e-6));
    CHECK(mode.causes[1].share == Approx(0.5).epsilon(1e-6));
    CHECK(mode.numerical_error > 0.0);
  }
}

TEST_CASE("derivatives of the solver agree with Richardson's extrapolation",
          "[io][scenes][uncertainty][gradient]") {
  const SceneText text(
      replaced(replaced(kPressed, "PILLAR", "{ E = \"1.8 MPa +- 5 %\", nu = \"0.4 +- 0.02\" }"),
               "\"120 um\"", "\"120 um +- 2 um\""));
  const UncertainScene scene(read_scene(text.path()), read_file(text.path()), text.path());
  const auto at = [&](const VectorXd& deviates) {
    return value_of(answer_on(scene.reduced_at(deviates), {.degree = 4, .layers = 2}),
                    "top_displacement");
  };
  const auto all_at = [&](const Eigen::MatrixXd& points) {
    Eigen::MatrixXd answers(points.rows(), 1);
    for (Eigen::Index i = 0; i < points.rows(); ++i) answers(i, 0) = at(points.row(i));
    return answers;
  };
  const LinearAnswer linear = linear_answer(all_at, scene.inputs());
  const auto n = static_cast<Eigen::Index>(scene.inputs().size());
  REQUIRE(n == 4);
  for (Eigen::Index d = 0; d < n; ++d) {
    std::vector<double> row;  // of Richardson's table, from the largest step on
    for (const double step : {0.8, 0.4, 0.2, 0.1}) {
      const VectorXd moved = step * VectorXd::Unit(n, d);
      row.push_back((at(moved) - at(-moved)) / (2.0 * step));
    }
    for (double power = 4.0; row.size() > 1; power *= 4.0) {
      for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        row[i] = row[i + 1] + (row[i + 1] - row[i]) / (power - 1.0);
      }
      row.pop_back();
    }
    CAPTURE(scene.inputs()[static_cast<std::size_t>(d)].name);
    CHECK(linear.slope(0, d) == Approx(row[0]).epsilon(1e-5));
    CHECK(linear.slope_error(0, d) < 1e-5 * linear.slope.norm());
  }
  // u = p L f/E: exact derivatives by the pressure and by the modulus, at equal shape.
  const double z = 1.959963984540054;
  const auto slope_by = [&](const char* name) {
    const auto& all = scene.inputs();
    const auto it = std::find_if(all.begin(), all.end(),
                                 [&](const UncertainInput& i) { return i.name == name; });
    return linear.slope(0, it - all.begin());
  };
  CHECK(slope_by("analysis.load.pressure") == Approx(linear.value[0] * 0.01 / z).epsilon(1e-5));
  CHECK(slope_by("materials.pillar.E") == Approx(-linear.value[0] * 0.05 / z).epsilon(1e-5));
}

TEST_CASE("a material file brings its covariance and its systematic part",
          "[io][scenes][uncertainty]") {
  const SceneText text(replaced(kPressed, "PILLAR", "{ file = \"fitted.json\" }"));
  // E0 = 2 MPa with E_inf = 1.6 MPa and E_1 = 0.4 MPa, whose errors are 20 kPa and 10 kPa with a
  // correlation of -0.5.
  write_file(text.beside("fitted.json"),
             R"({"schema": "viscard-material/1", "E0_Pa": 2e6, "nu": 0.45,
    "rho_kg_m3": 965, "terms": [{"g": 0.2, "tau_s": 1.0}],
    "uncertainty": {"E0_interval_95": [1.9e6, 2.1e6], "E_inf_interval_95": [1.5e6, 1.7e6],
      "systematic_relative": 0.02, "covariance_parameters": ["E_inf_Pa", "E_1_Pa", "ln_tau_1"],
      "covariance": [[4e8, -1e8, 0], [-1e8, 1e8, 0], [0, 0, 0.01]]}})",
             false);
  const SceneUncertainty found = uncertainty_in(text.path());
  const ResultUncertainty& moved = result_named(found, "top_displacement");
  REQUIRE(found.inputs.size() == 3);
  CHECK(found.inputs[0].name == "analysis.load.pressure");
  CHECK(found.inputs[1].name == "materials.pillar: random part");
  CHECK(found.inputs[2].name == "materials.pillar: systematic part");
  const double z = 1.959963984540054;
  const double pressure = std::pow(0.01 / z, 2);
  const double random = (4e8 + 1e8 - 2e8) / 4e12;  // var(E_inf + E_1)/E0^2
  const double systematic = 4e-4;
  const double whole = pressure + random + systematic;
  // To second order in deviations of 2 %.
  CHECK(moved.standard_uncertainty ==
        Approx(std::abs(moved.value) * std::sqrt(whole)).epsilon(2e-3));
  CHECK(moved.causes[0].share == Approx(pressure / whole).margin(2e-3));
  CHECK(moved.causes[1].share == Approx(random / whole).margin(2e-3));
  CHECK(moved.causes[2].share == Approx(systematic / whole).margin(2e-3));
}

// Shares by plain differences of independent samples, with no control variate (Jansen, 1999).
TEST_CASE("variance shares agree with a brute-force study of 1e4 points",
          "[io][scenes][uncertainty][slow]") {
  const char* const uncertain =
      "{ E = \"1.8 MPa +- 20 % lognormal\", nu = \"0.4 +- 0.05 uniform\", rho = \"965 kg/m3 +- 5 "
      "%\" }";
  const std::string pressed =
      replaced(replaced(kPressed, "PILLAR", uncertain), "\"120 um\"", "\"120 um +- 8 um uniform\"");
  const std::string modal =
      replaced(replaced(kModes, "{ E = \"1.8 MPa +- 2 %\", nu = 0.33, rho = \"965 kg/m3 +- 2 %\" }",
                        uncertain),
               "\"40 um\"", "\"40 um +- 3 um\"");
  const SceneText text(GENERATE_COPY(pressed, modal));
  const SceneUncertainty found = uncertainty_in(text.path(), {.n_samples = 2000});
  REQUIRE(found.is_sampled);
  const UncertainScene scene(read_scene(text.path()), read_file(text.path()), text.path());
  const std::string name = found.results.front().name;
  const auto value = [&](const VectorXd& deviates) {
    const auto all =
        named_values(answer_on(scene.reduced_at(deviates), {.degree = 3, .layers = 1}));
    return all.front().value;
  };
  const auto n = static_cast<Eigen::Index>(scene.inputs().size());
  constexpr Eigen::Index kPoints = 10000;
  const Eigen::MatrixXd cube = sobol_points(kPoints, 2 * n);
  const Eigen::MatrixXd a = deviates_from(cube.leftCols(n), scene.inputs());
  const Eigen::MatrixXd b = deviates_from(cube.rightCols(n), scene.inputs());
  VectorXd at_b(kPoints), squares = VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < kPoints; ++i) {
    at_b[i] = value(b.row(i));
    for (Eigen::Index g = 0; g < n; ++g) {
      VectorXd mixed = a.row(i);
      mixed[g] = b(i, g);
      squares[g] += 0.5 * std::pow(at_b[i] - value(mixed), 2) / static_cast<double>(kPoints);
    }
  }
  const double variance = (at_b.array() - at_b.mean()).square().mean();
  for (Eigen::Index g = 0; g < n; ++g) {
    CAPTURE(name, scene.inputs()[static_cast<std::size_t>(g)].name);
    CHECK(found.results.front().causes[static_cast<std::size_t>(g)].share ==
          Approx(1.0 - squares[g] / variance).margin(0.02));
  }
}

TEST_CASE("a scene without anything uncertain, or with a sweep, is refused",
          "[io][scenes][uncertainty]") {
  const SceneText exact(
      replaced(replaced(kPressed, "PILLAR", "{ E = 1.8e6, nu = 0.4 }"), "10 kPa +- 1 %", "10 kPa"));
  const CommandOutcome outcome = run_command({"simulate", exact.path(), "--uncertainty"});
  CHECK(outcome.status == 1);
  CHECK_THAT(outcome.err, Catch::Contains("nothing is uncertain") && Catch::Contains("+-"));
  const CommandOutcome alone = run_command({"simulate", exact.path(), "--samples", "1000"});
  CHECK(alone.status == 2);
  CHECK_THAT(alone.err, Catch::Contains("--uncertainty"));
}

TEST_CASE("the errors of a law of rubber are left out, and the answer says so",
          "[io][scenes][uncertainty]") {
  const std::string rubber =
      "{ file = \"" VISCARD_SOURCE_DIR "/data/materials/treloar_yeoh.json\", nu = 0.49 }";
  const std::string left_out =
      "the errors of the parameters of the law of rubber are not propagated";
  const SceneText pressed(replaced(kPressed, "PILLAR", rubber));
  const CommandOutcome found = run_command({"simulate", pressed.path(), "--uncertainty"});
  CHECK(found.status == 0);
  CHECK_THAT(found.out + found.err, Catch::Contains("materials.pillar: " + left_out));
  const SceneText exact(replaced(replaced(kPressed, "PILLAR", rubber), "10 kPa +- 1 %", "10 kPa"));
  const CommandOutcome refused = run_command({"simulate", exact.path(), "--uncertainty"});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Catch::Contains("nothing is uncertain") && Catch::Contains(left_out));
}

TEST_CASE("viscard simulate --uncertainty prints, stores and draws intervals and causes",
          "[io][scenes][uncertainty][cli]") {
  const SceneText text(kModes);
  const std::string folder = text.beside("out");
  const CommandOutcome outcome =
      run_command({"simulate", text.path(), "--uncertainty", "--out", folder, "--json"});
  REQUIRE(outcome.status == 0);
  const auto object = nlohmann::json::parse(outcome.out)["uncertainty"];
  CHECK(object["method"] == "linear");
  CHECK(object["inputs"][0]["text"] == "1.8 MPa +- 2 %");
  const auto& first = object["results"][0];
  CHECK(first["interval_95"][0] < first["value"]);
  CHECK(first["causes"].size() == 2);
  CHECK_THAT(read_file(folder + "/uncertainty.csv"), Catch::Contains("materials.pillar.E"));
  CHECK_THAT(read_file(folder + "/uncertainty.svg"), Catch::Contains("<svg"));
  const CommandOutcome people = run_command({"simulate", text.path(), "--uncertainty"});
  CHECK_THAT(people.out, Catch::Contains("50.0 %") && Catch::Contains("numerical error"));
}
