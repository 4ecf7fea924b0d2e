// Scenes against requirements: values against closed forms and the thesis' sensor, remedies against the solver.
#include "io/basics/atomic_file.h"
#include "io/flow/design/judge_scene.h"
#include "io/flow/design/judgement_output.h"
#include "io/flow/scenes/named_values.h"
#include "io/scenes/scene_file.h"
#include "models/maths/usable_machine.h"
#include "models/scene/simulate.h"
#include "tests/io/scenes/scene_text.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <new>
#include <numbers>
#include <system_error>

using namespace viscard;
using namespace viscard::test;

namespace {

const std::string kData = VISCARD_SOURCE_DIR "/data/";
const std::string kHand = kData + "requirements/human_hand.toml";

Requirements required(const std::string& lines) {
  return requirements_from_toml("[require]\n" + lines, "require.toml");
}

Judgement judged_file(const std::string& scene, const Requirements& requirements,
                      double search_s = 0.0) {
  const std::string path = kData + scene;
  JudgeOptions options;
  options.search_s = search_s;
  return judge_scene(read_file(path), path, requirements, options);
}

const JudgedLine& line_of(const Judgement& judgement, const std::string& key) {
  for (const JudgedLine& line : judgement.lines) {
    if (key == line.kind->key) return line;
  }
  FAIL("no line " << key);
  return judgement.lines.front();
}

}  // namespace

TEST_CASE("every requirement is described in the README of its room", "[io][design]") {
  const std::string readme = read_file(VISCARD_SOURCE_DIR "/io/flow/design/README.md");
  for (const RequirementKind& kind : requirement_kinds()) {
    CAPTURE(kind.key);
    CHECK(readme.find("`" + std::string(kind.key) + "`") != std::string::npos);
  }
}

TEST_CASE("a lack of memory, of threads or of disk is no property of a scene", "[io][design]") {
  const Scene scene = read_scene(kData + "scenes/pillar_modal.toml").scene;
  const Requirements requirements = required("bandwidth = \"1 kHz\"\n");
  const auto& kinds = requirement_kinds();
  const auto bandwidth = std::find_if(kinds.begin(), kinds.end(), [](const RequirementKind& kind) {
    return std::string(kind.key) == "bandwidth";
  });
  REQUIRE(bandwidth != kinds.end());
  const auto with = [&](const auto& error) {
    return computed(*bandwidth, scene, requirements,
                    [&](const Scene&) -> SceneAnswer { throw error; });
  };
  CHECK_THROWS_AS(with(std::bad_alloc()), std::bad_alloc);
  CHECK_THROWS_AS(with(NotEnoughMemory("the next mesh is too large")), NotEnoughMemory);
  CHECK_THROWS_AS(with(std::system_error(EAGAIN, std::generic_category())), std::system_error);
  CHECK(with(std::runtime_error("it buckles")).how == "it buckles");
}

TEST_CASE("one pillar: buckling, bandwidth and what it cannot answer", "[io][design]") {
  const Judgement judgement = judged_file(
      "scenes/pillar_modal.toml",
      required("largest_pressure = \"20 kPa\"\nbandwidth = \"1 kHz\"\ncrosstalk = \"1 %\"\n"
               "largest_force = \"1 N\"\ntactel_area = \"2 mm2\"\nhysteresis = \"5 %\"\n"));
  // 29.37 kPa and 16.03 kHz on a rigid base; the film takes less than half a per cent.
  CHECK(line_of(judgement, "largest_pressure").found.value == Approx(29.37e3).epsilon(5e-3));
  CHECK(line_of(judgement, "largest_pressure").verdict == Verdict::kPass);
  const double share = std::sqrt(0.05 / 1.05);
  CHECK(line_of(judgement, "bandwidth").found.value == Approx(16030.0 * share).epsilon(5e-3));
  CHECK(line_of(judgement, "crosstalk").verdict == Verdict::kNotAnswered);
  CHECK(line_of(judgement, "largest_force").verdict == Verdict::kNotAnswered);
  CHECK(line_of(judgement, "hysteresis").found.how.find("elastic") != std::string::npos);
  CHECK_FALSE(judgement.passes());
}

TEST_CASE("the hysteresis of a pillar is pi times the loss tangent of its material",
          "[io][design]") {
  // One term, g = 0.2, tau = 0.1 s, constant Poisson ratio: tan d = g w/((1 - g) + w^2), w = 2 pi f tau.
  const SceneText scene(R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { file = "one.json" }
[analysis]
kind = "modal"
)");
  std::ofstream(scene.beside("one.json"))
      << R"({"schema": "viscard-material/1", "name": "one", "E0_Pa": 1.8e6, "nu": 0.33,
             "rho_kg_m3": 965, "terms": [{"g": 0.2, "k": 0.2, "tau_s": 0.1}]})";
  const Judgement judgement =
      judge_scene(read_file(scene.path()), scene.path(),
                  required("hysteresis = \"90 %\"\nlowest_frequency = \"0.01 Hz\"\n"
                           "bandwidth = \"1 kHz\"\n"),
                  {});
  const double largest = 0.2 / (2.0 * std::sqrt(0.8));  // at w = sqrt(1 - g)
  const JudgedLine& line = line_of(judgement, "hysteresis");
  CAPTURE(line.found.how);
  REQUIRE(line.found.is_answered);
  CHECK(std::abs(line.found.value - std::numbers::pi * largest) <= line.found.error_estimate);
  CHECK(line.found.value == Approx(std::numbers::pi * largest).epsilon(0.03));
}

TEST_CASE("a row: cross-talk and pitch, and a nonlinearity that its material decides",
          "[io][design]") {
  const Judgement judgement = judged_file(
      "scenes/array_voltages.toml",
      required("crosstalk = \"0.1 %\"\nresolved_wavelength = \"300 um\"\n"
               "nonlinearity = \"1 %\"\nlinear_to = \"4 kPa\"\nlargest_pressure = \"5 kPa\"\n"));
  // 0.0781 % by a Green's function, to 10 % of the tolerance.
  CHECK(line_of(judgement, "crosstalk").found.value == Approx(7.81e-4).margin(2e-4));
  CHECK(line_of(judgement, "crosstalk").verdict == Verdict::kPass);
  CHECK(line_of(judgement, "resolved_wavelength").found.value == Approx(200e-6));
  // 4 kPa x 2.5 over 1.8 MPa are 0.56 % of strain, 1 to 2.3 times that is undecided at 1 %.
  CHECK(line_of(judgement, "nonlinearity").verdict == Verdict::kUndecided);
  CHECK_FALSE(judgement.passes());
}

TEST_CASE("a dimension that would pass does, and the solver confirms that a larger one does not",
          "[io][design]") {
  const SceneText file(R"(tolerance = 2e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
[analysis]
kind = "buckling"
)");
  const Judgement judgement = judge_scene(read_file(file.path()), file.path(),
                                          required("largest_pressure = \"60 kPa\"\n"), {});
  const JudgedLine& line = line_of(judgement, "largest_pressure");
  REQUIRE(line.verdict == Verdict::kFail);
  REQUIRE(line.remedies.size() == 2);  // thicker or shorter
  for (const Remedy& remedy : line.remedies) {
    CAPTURE(remedy.key, remedy.to_m);
    const auto buckles_Pa = [&](double value_m) {
      PillarScene scene = std::get<PillarScene>(read_scene(file.path()).scene);
      (remedy.key == "geometry.length" ? scene.geometry.length_m : scene.geometry.diameter_m) =
          value_m;
      return simulate(scene).results.at(0).value;
    };
    const bool is_shorter = remedy.key == "geometry.length";
    CHECK((remedy.to_m < remedy.from_m) == is_shorter);
    CHECK(buckles_Pa(remedy.to_m) >= 60e3);
    CHECK(buckles_Pa(remedy.to_m * (is_shorter ? 1.05 : 1.0 / 1.05)) < 60e3);
  }
}

TEST_CASE("requirements that are wrong are refused with what there is", "[io][design]") {
  CHECK_THROWS_WITH(required(""), Catch::Contains("nothing is required"));
  CHECK_THROWS_WITH(required("top = \"fre\"\ncrosstalk = 0.1\n"), Catch::Contains("free"));
  CHECK_THROWS_WITH(required("crosstalc = 0.1\n"), Catch::Contains("crosstalk"));
  CHECK_THROWS_WITH(required("crosstalk = \"1 kPa\"\n"), Catch::Contains("crosstalk"));
  CHECK_THROWS_WITH(required("crosstalk = -1\n"), Catch::Contains("crosstalk"));
}

TEST_CASE("the thesis' sensor against the human hand: the verdicts of its chapter 9",
          "[io][design][slow]") {
  const Judgement judgement = judged_file("scenes/space_heat_noise.toml", read_requirements(kHand));
  const auto value = [&](const char* key) { return line_of(judgement, key).found.value; };
  const auto verdict = [&](const char* key) { return line_of(judgement, key).verdict; };
  CHECK(value("pillars_per_tactel") == Approx(200.0));
  CHECK(value("resolved_wavelength") == Approx(200e-6));
  CHECK(verdict("resolved_wavelength") == Verdict::kFail);
  CHECK(value("largest_force") == Approx(2e-6 * 29369.0 / 7.9577).epsilon(5e-3));
  CHECK(verdict("largest_force") == Verdict::kFail);
  CHECK(verdict("bandwidth") == Verdict::kPass);
  CHECK(value("lowest_frequency") == Approx(0.142).epsilon(0.02));
  CHECK(verdict("lowest_frequency") == Verdict::kFail);
  CHECK(value("pressure_resolution") == Approx(340.7).epsilon(0.01));  // as simulate gives it
  CHECK(verdict("pressure_resolution") == Verdict::kPass);
  CHECK(value("crosstalk") == Approx(0.00416).epsilon(0.15));
  CHECK(verdict("crosstalk") == Verdict::kFail);
  CHECK(verdict("pressure_per_kelvin") == Verdict::kFail);
  CHECK(verdict("hysteresis") == Verdict::kNotAnswered);  // its material is elastic
}
