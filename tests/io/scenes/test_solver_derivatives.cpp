// Derivatives of scenes by their uncertain inputs that come from the solver (models/pillar/README.md, eq. 26).
#include "io/basics/atomic_file.h"
#include "io/flow/scenes/uncertain_scene.h"
#include "models/scene/simulate.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Eigen::VectorXd;

namespace {

// A pillar on a film of PVDF that creeps under a pressure.
const char* const kCreep = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um +- 2 um"
film = { thickness = "25 um +- 0.5 um", radius = "60 um", material = "pvdf" }
electrode = { face = "top", kind = "equipotential", radius = "18 um" }
[materials]
pillar = { file = "soft.json" }
pvdf = { file = "PVDF" }
[analysis]
kind = "creep"
history = [["0 s", "0 Pa"], ["0 s", "3 kPa"], ["10 s", "3 kPa"]]
)";

// Frequencies of a fixed pillar.
const char* const kOneMode = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um +- 1 um"
[materials]
pillar = { E = "1.8 MPa +- 2 %", nu = 0.33, rho = "965 kg/m3 +- 2 %" }
[analysis]
kind = "modal"
modes = 1
)";

// The sensor of data/scenes/pillar_sensor.toml with every quantity uncertain. The edge of its electrode
// is the rim of the pillar.
std::string uncertain_sensor() {
  std::string text = read_file(VISCARD_SOURCE_DIR "/data/scenes/pillar_sensor.toml");
  const std::vector<std::pair<std::string, std::string>> spreads = {
      {"\"40 um\"", "\"40 um +- 0.4 um\""},
      {"\"120 um\"", "\"120 um +- 2 um\""},
      {"\"25 um\"", "\"25 um +- 0.5 um\""},
      {"\"60 um\"", "\"60 um +- 1 um\""},
      {"\"20 um\"", "\"20 um +- 0.2 um\""},
      {"\"1.8 MPa\"", "\"1.8 MPa +- 3 %\""},
      {"nu = 0.33", "nu = \"0.33 +- 0.01\""},
      {"\"965 kg/m3\"", "\"965 kg/m3 +- 2 %\""},
      {"\"10 kPa\"", "\"10 kPa +- 2 %\""},
      {"../materials", VISCARD_SOURCE_DIR "/data/materials"}};
  for (const auto& [exact, spread] : spreads) text = replaced(text, exact, spread);
  return text;
}

}  // namespace

TEST_CASE("all inputs of the sensor have derivatives from the solver that agree with differences",
          "[io][scenes][uncertainty][gradient]") {
  // 18 um: the edge of the electrode lies away from the rim, so that every quantity moves the mesh alone.
  const bool edge_is_rim = GENERATE(true, false);
  const std::string sensor = uncertain_sensor();
  const SceneText text(edge_is_rim ? sensor
                                   : replaced(sensor, "20 um +- 0.2 um", "18 um +- 0.2 um"));
  const SceneFile file = read_scene(text.path());
  const UncertainScene scene(file, read_file(text.path()), text.path());
  const Discretisation mesh{.degree = 5, .layers = 2};
  const auto n = static_cast<Eigen::Index>(scene.inputs().size());
  REQUIRE(n == 9);
  const auto batch = [&](const auto& answer_of) {
    return [&scene, answer_of](const Eigen::MatrixXd& points) {
      Eigen::MatrixXd rows(points.rows(), 5);
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const std::optional<SceneAnswer> answer = answer_of(scene.reduced_at(points.row(i)));
        for (std::size_t r = 0; r < 5; ++r) {
          rows(i, static_cast<Eigen::Index>(r)) =
              answer ? answer->results.at(r).value : std::numeric_limits<double>::quiet_NaN();
        }
      }
      return rows;
    };
  };
  const auto own = batch([&](const Scene& one) { return std::optional(answer_on(one, mesh)); });
  const auto answers = first_order_answers(scene.reduced_at(VectorXd::Zero(n)), mesh);
  REQUIRE(answers);
  const LinearAnswer by_differences = linear_answer(own, scene.inputs());
  const LinearAnswer by_solver = linear_answer(own, scene.inputs(), 1e-6, batch(answers));
  CHECK(by_solver.n_answers - by_solver.n_first_order < by_differences.n_answers);
  for (Eigen::Index d = 0; d < n; ++d) {
    const std::string& name = scene.inputs()[static_cast<std::size_t>(d)].name;
    CAPTURE(name);
    const bool moves_edge_from_rim =
        name == "geometry.diameter" || name == "geometry.electrode.radius";
    CHECK(by_solver.by_solver[static_cast<std::size_t>(d)] != (edge_is_rim && moves_edge_from_rim));
    for (Eigen::Index r = 0; r < 5; ++r) {
      CAPTURE(r);
      const double size =
          std::max(std::abs(by_differences.slope(r, d)), 1e-3 * by_differences.slope.row(r).norm());
      CHECK(std::abs(by_solver.slope(r, d) - by_differences.slope(r, d)) <= 1e-5 * size);
    }
  }
}

TEST_CASE("the output states which way each derivative was taken",
          "[io][scenes][uncertainty][cli]") {
  const SceneText text(replaced(uncertain_sensor(), "tolerance = 1e-3", "tolerance = 3e-2"));
  const CommandOutcome json = run_command({"simulate", text.path(), "--uncertainty", "--json"});
  REQUIRE(json.status == 0);
  const auto object = nlohmann::json::parse(json.out)["uncertainty"];
  for (const auto& input : object["inputs"]) {
    CAPTURE(input["name"]);
    const bool moves_edge_from_rim =
        input["name"] == "geometry.diameter" || input["name"] == "geometry.electrode.radius";
    CHECK(input["derivatives"] == (moves_edge_from_rim ? "differences" : "solver"));
  }
  CHECK(object["first_order_answers"] > 30);
  const SceneText modes(kOneMode);
  const CommandOutcome solver = run_command({"simulate", modes.path(), "--uncertainty"});
  CHECK_THAT(solver.out, Catch::Contains("derivatives: from one solution of the solver\n"));
  const SceneText buckling(replaced(kOneMode, "\"modal\"\nmodes = 1", "\"buckling\""));
  const CommandOutcome loads = run_command({"simulate", buckling.path(), "--uncertainty"});
  CHECK_THAT(loads.out, Catch::Contains("derivatives: from one solution of the solver\n"));
  // Rows of pillars have no first-order answers.
  std::string row = read_file(VISCARD_SOURCE_DIR "/data/scenes/array_modes.toml");
  row = replaced(replaced(row, "1.8 MPa", "1.8 MPa +- 2 %"), "1e-3", "3e-2");
  const SceneText array(replaced(row, "../materials", VISCARD_SOURCE_DIR "/data/materials"));
  const CommandOutcome differences = run_command({"simulate", array.path(), "--uncertainty"});
  CHECK_THAT(differences.out, Catch::Contains("derivatives: differences of whole answers\n"));
}

TEST_CASE(
    "a pillar that creeps on a film has its derivatives from one basis, by its fitted material too",
    "[io][scenes][uncertainty][cli]") {
  const SceneText text(
      replaced(kCreep, "PVDF", VISCARD_SOURCE_DIR "/data/materials/pvdf_film_manual.json"));
  write_file(text.beside("soft.json"),
             R"({"schema": "viscard-material/1", "E0_Pa": 2e6, "nu": 0.4,
    "rho_kg_m3": 965, "terms": [{"g": 0.2, "tau_s": 1.0}],
    "uncertainty": {"E0_interval_95": [1.9e6, 2.1e6], "E_inf_interval_95": [1.5e6, 1.7e6],
      "systematic_relative": 0.02, "covariance_parameters": ["E_inf_Pa", "E_1_Pa", "ln_tau_1"],
      "covariance": [[4e8, -1e8, 0], [-1e8, 1e8, 0], [0, 0, 0.01]]}})",
             false);
  const CommandOutcome outcome = run_command({"simulate", text.path(), "--uncertainty", "--json"});
  REQUIRE(outcome.status == 0);
  const auto object = nlohmann::json::parse(outcome.out)["uncertainty"];
  REQUIRE(object["inputs"].size() == 4);
  for (const auto& input : object["inputs"]) {
    CAPTURE(input["name"]);
    CHECK(input["derivatives"] == "solver");
  }
  CHECK(object["derivative_error"] < 1e-4);
}
