// What `viscard simulate --out` leaves beside results.json.
#include "io/basics/atomic_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <filesystem>

using namespace viscard;
using namespace viscard::test;

namespace {

const std::string kRow = R"(tolerance = 1e-2
[geometry]
kind = "array"
count = 4
diameter = "40 um"
length = "120 um"
spacing = "60 um"
film = { thickness = "25 um", material = "pvdf" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
)";
const std::string kStatic = R"(kind = "static"
load = { pressure = "1 kPa", on = "top" }
)";

std::filesystem::path answered(const SceneText& scene) {
  std::filesystem::path folder = scene.beside("out");
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--out", folder.string()});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return folder;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("what every pillar of a row answers is a table and a picture", "[cli][scene][array]") {
  const SceneText scene(kRow + kStatic);
  const auto folder = answered(scene);
  const std::string table = read_file(folder / "results.csv");
  CHECK(table.find("\nresult,value,unit,error\n") != std::string::npos);
  CHECK(count_of(table, "\ncentre_voltage_") == 4);
  const std::string picture = read_file(folder / "centre_voltage.svg");
  CHECK(picture.find("centre voltage") != std::string::npos);
  CHECK(picture.find("pillar") != std::string::npos);
}

TEST_CASE("modes are a table with one line each", "[cli][scene][array]") {
  const SceneText scene(kRow + "kind = \"modal\"\nmodes = 1\n");
  const auto folder = answered(scene);
  const std::string table = read_file(folder / "modes.csv");
  CHECK(table.find("\nfamily,harmonic,frequency_Hz,error_Hz\n") != std::string::npos);
  CHECK(count_of(table, "\nlateral,") == 4);
}

TEST_CASE("a sweep draws one line for each combination of its other parameters",
          "[cli][scene][array]") {
  const SceneText scene(kRow + kStatic + R"([sweep]
diameter = ["20 um", "40 um"]
spacing = ["40 um", "60 um", "80 um"]
limit_percent = 0.1
[want]
quantities = ["deviation_percent"]
)");
  const auto folder = answered(scene);
  const std::string picture = read_file(folder / "deviation_percent_2.svg");
  CHECK(picture.find("spacing (µm)") != std::string::npos);
  CHECK(count_of(picture, "diameter 20 µm") == 1);
  CHECK(count_of(picture, "diameter 40 µm") == 1);
  CHECK(picture.find("limit") != std::string::npos);
  CHECK(read_file(folder / "results.csv").find("\"deviation_percent_1 at diameter 20 um, ") !=
        std::string::npos);
}
