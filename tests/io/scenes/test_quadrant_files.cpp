// Voltages of quarters in files, and the forces that `viscard simulate` finds from them.
#include "io/basics/atomic_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>

#include <filesystem>

using namespace viscard;
using namespace viscard::test;

namespace {

const std::string kQuarters = R"(tolerance = 1e-2
[geometry]
kind = "array"
model = "space"
rows = 2
columns = 3
diameter = "40 um"
length = "120 um"
spacing = "60 um"
dead = [[1, 3]]
film = { thickness = "25 um", edge = "200 um", material = "pvdf" }
electrode = { face = "bottom", kind = "sampled", quadrants = true }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "static"
)";
const std::string kLoads =
    "load = { pressure = \"1 kPa\", shear_x = \"100 Pa\", pillars = [[2, 2], [1, 1]] }\n";

// The scene with other electrodes.
std::string with_electrodes(const std::string& keys) {
  const std::string old = "kind = \"sampled\", quadrants = true";
  std::string text = kQuarters;
  return text.replace(text.find(old), old.size(), keys);
}
const char* const kMetal = "kind = \"equipotential\", quadrants = true, gap = \"2 um\"";

CommandOutcome simulated(const SceneText& scene, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"simulate", scene.path(), "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return run_command(words);
}

nlohmann::json forces_in(const std::string& out) {
  nlohmann::json forces;
  const nlohmann::json answer = nlohmann::json::parse(out);
  for (const nlohmann::json& map : answer.at("maps")) {
    if (map.at("name").get<std::string>().starts_with("sensed_"))
      forces[map.at("name").get<std::string>()] = map.at("values");
  }
  return forces;
}

std::string refused_file(const std::string& table) {
  const SceneText scene(kQuarters + "[quadrants]\nvoltages = \"readings.csv\"\n");
  write_file(scene.beside("readings.csv"), table, true);
  const CommandOutcome outcome = simulated(scene);
  CHECK(outcome.status == 1);
  return outcome.out + outcome.err;
}

const std::string kHeader =
    "row,column,quadrant_1_voltage [mV],quadrant_2_voltage [mV],quadrant_3_voltage "
    "[mV],quadrant_4_voltage [mV]\n";

}  // namespace

TEST_CASE("the voltages that simulate writes lead back to the loads", "[cli][scene][array]") {
  const bool is_metal = GENERATE(false, true);
  CAPTURE(is_metal);
  const std::string quarters = is_metal ? with_electrodes(kMetal) : kQuarters;
  const SceneText made(quarters + kLoads +
                       "[want]\nquantities = [\"sensed_normal_force\", \"sensed_shear_x_force\", " +
                       "\"sensed_shear_y_force\"]\n");
  const CommandOutcome first = simulated(made, {"--out", made.beside("out")});
  CAPTURE(first.err);
  REQUIRE(first.status == 0);
  CHECK(read_file(made.beside("out/sensed_forces.svg")).find("arrows: shear, the longest") !=
        std::string::npos);
  const SceneText scene(quarters + "[quadrants]\nvoltages = \"readings.csv\"\n");
  write_file(scene.beside("readings.csv"), read_file(made.beside("out/pillars.csv")), true);
  const CommandOutcome second = simulated(scene);
  CAPTURE(second.err);
  REQUIRE(second.status == 0);
  const nlohmann::json before = forces_in(first.out), after = forces_in(second.out);
  REQUIRE(before.size() == 3);
  REQUIRE(after.size() == 3);
  for (const auto& [name, values] : before.items()) {
    CAPTURE(name);
    REQUIRE(values.size() == 5);
    for (std::size_t i = 0; i < values.size(); ++i) {
      CHECK(after.at(name)[i].get<double>() == Approx(values[i].get<double>()).margin(3e-9));
    }
  }
}

TEST_CASE("tables of voltages that cannot be read are refused with the file",
          "[cli][scene][array]") {
  const std::string rows = "1,1,1,1,1,1\n1,2,1,1,1,1\n2,1,1,1,1,1\n2,2,1,1,1,1\n";
  CHECK(refused_file(kHeader + rows).find("has no voltages of pillar [2, 3]") != std::string::npos);
  CHECK(refused_file(kHeader + rows + "2,2,1,1,1,1\n").find("pillar [2, 2] twice") !=
        std::string::npos);
  CHECK(refused_file(kHeader + rows + "1,3,1,1,1,1\n").find("no pillar [1, 3]") !=
        std::string::npos);
  CHECK(refused_file(kHeader + rows + "0,3,1,1,1,1\n").find("from 1") != std::string::npos);
  CHECK(refused_file("row,column,quadrant_1_voltage [mV]\n1,1,1\n")
            .find("needs the columns row, column") != std::string::npos);
  CHECK(
      refused_file("row,column,quadrant_1_voltage [um]\n1,1,1\n").find("needs a unit of voltage") !=
      std::string::npos);
}

TEST_CASE("words of quarters that contradict each other are refused with the line",
          "[cli][scene][array]") {
  const auto text_of = [](const std::string& more) {
    const CommandOutcome outcome = simulated(SceneText(kQuarters + kLoads + more));
    CHECK(outcome.status != 0);
    return outcome.out + outcome.err;
  };
  CHECK(text_of("[quadrants]\nneighbours = \"some\"\n").find("quadrants.neighbours") !=
        std::string::npos);
  CHECK(text_of("[quadrants]\naverages = \"mean\"\n").find("quadrants.averages") !=
        std::string::npos);
  CHECK(text_of("[quadrants]\nnoise = \"-1 V\"\n").find("quadrants.noise") != std::string::npos);
  CHECK(text_of("[quadrants]\nvoltages = \"none.csv\"\n").find("none.csv") != std::string::npos);
}

TEST_CASE("quarters of metal read their own names, and gaps that mean nothing are refused",
          "[cli][scene][array]") {
  const CommandOutcome outcome = simulated(SceneText(with_electrodes(kMetal) + kLoads));
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const nlohmann::json results = nlohmann::json::parse(outcome.out).at("results");
  CHECK(results.contains("electrode_voltage_largest"));
  CHECK(results.contains("quadrant_4_voltage_largest"));
  CHECK_FALSE(results.contains("centre_voltage_largest"));
  const auto text_of = [](const std::string& keys, const std::string& more = "") {
    const CommandOutcome refused = simulated(SceneText(with_electrodes(keys) + kLoads + more));
    CHECK(refused.status != 0);
    return refused.out + refused.err;
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  CHECK(has(text_of("kind = \"equipotential\", quadrants = true"), "geometry.electrode.gap"));
  CHECK(has(text_of("kind = \"sampled\", quadrants = true, gap = \"2 um\""), "quarters of metal"));
  CHECK(has(text_of("kind = \"equipotential\", quadrants = true, gap = \"12 um\""), "10 um"));
  CHECK(has(text_of(kMetal, "[quadrants]\naverages = \"nodes\"\n"), "quadrants.averages"));
}
