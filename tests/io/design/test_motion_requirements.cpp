// Requirements of surfaces that slide: slip and texture.
#include "io/flow/design/judge_scene.h"
#include "io/scenes/scene_file.h"
#include "tests/io/scenes/scene_text.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

// Two pillars under a flat face that is pressed on them and then moves by 20 um.
std::string scan(const std::string& friction, const std::string& amplifier) {
  return R"(
tolerance = 5e-2
[geometry]
kind = "array"
model = "space"
rows = 1
columns = 2
lattice = "square"
diameter = "40 um"
length = "120 um"
spacing = "60 um"
film = { thickness = "25 um", edge = "200 um", material = "pvdf" }
electrode = { face = "bottom", kind = "equipotential", radius = "20 um" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.49, rho = "965 kg/m3" }
pvdf = { file = ")" VISCARD_SOURCE_DIR R"(/data/materials/pvdf_film_manual.json" }
[shape]
kind = "sphere"
radius = "10 mm"
friction = )" +
         friction + R"(
path = [
  { time = "0 s", x = "0 um", y = "0 um", depth = "0 um" },
  { time = "20 ms", x = "0 um", y = "0 um", depth = "0.5 um" },
  { time = "60 ms", x = "20 um", y = "0 um", depth = "0.5 um" },
]
[readout]
kind = "voltage"
resistance = "1e13 ohm"
capacitance = "0.1 pF"
[noise]
from = "100 Hz"
to = "1 kHz"
amplifier = ")" +
         amplifier + R"("
)";
}

RequiredValue found(const std::string& scene, const std::string& line) {
  const Requirements required = requirements_from_toml("[require]\n" + line, "require.toml");
  JudgeOptions options;
  options.search_s = 0.0;
  return judge_scene(scene, "scan.toml", required, options).lines.front().found;
}

}  // namespace

TEST_CASE("slip is seen the earlier the less an amplifier adds to it", "[io][design]") {
  const std::string line = "slip_latency = \"20 ms\"\n";
  const RequiredValue quiet = found(scan("0.1", "1 nV"), line);
  INFO(quiet.how);
  REQUIRE(quiet.is_answered);
  CHECK(quiet.value > 0.0);
  CHECK(quiet.value < 40e-3);
  CHECK_THAT(quiet.how, Contains("first in reading_1_"));
  const RequiredValue loud = found(scan("0.1", "1 mV"), line);
  CHECK_FALSE(loud.is_answered);
  CHECK_THAT(loud.how, Contains("5 are seen"));
  const RequiredValue glued = found(scan("20", "1 nV"), line);
  CHECK_FALSE(glued.is_answered);
  CHECK_THAT(glued.how, Contains("no top slides"));
}

TEST_CASE("a texture is averaged over a top as a Bessel function", "[io][design]") {
  const std::string scene = scan("\"none\"", "20 nV");
  const auto amplitude = [&](const std::string& wavelength, const std::string& speed) {
    return found(scene, "texture_amplitude = \"1 um\"\ntexture_wavelength = \"" + wavelength +
                            "\"\ntexture_speed = \"" + speed + "\"\n");
  };
  const RequiredValue fine = amplitude("100 um", "20 mm/s"), coarse = amplitude("100 mm", "20 m/s");
  REQUIRE(fine.is_answered);
  REQUIRE(coarse.is_answered);
  const double q = 2.0 * std::numbers::pi * 20.0 / 100.0;
  CHECK(coarse.value / fine.value == Approx(2.0 * std::cyl_bessel_j(1.0, q) / q).epsilon(1e-4));
  CHECK(fine.error_estimate < 0.1 * fine.value);
  CHECK_THAT(amplitude("100 um", "1 m/s").how, Contains("outside the band"));
  CHECK_THAT(amplitude("0.02 um", "4 um/s").how, Contains("too short for the diameter"));
  CHECK_THAT(found(scene, "texture_amplitude = \"1 um\"\n").how, Contains("texture_speed"));
}
