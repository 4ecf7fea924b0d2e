// The section [shape] of a scene file.
#include "io/basics/atomic_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Json = nlohmann::json;

namespace {

std::string pressed(const std::string& shape) {
  return R"(tolerance = 1e-2
[geometry]
kind = "array"
model = "space"
rows = 3
columns = 3
diameter = "40 um"
length = "120 um"
spacing = "60 um"
film = { thickness = "25 um", edge = "200 um", material = "pvdf" }
electrode = { face = "bottom", kind = "sampled" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33 }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "static"
[shape]
)" + shape;
}

Json answer_of(const std::string& shape) {
  const SceneText scene(pressed(shape));
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return Json::parse(outcome.out);
}

std::string refusal_of(const std::string& shape) {
  const SceneText scene(pressed(shape));
  const CommandOutcome outcome = run_command({"simulate", scene.path()});
  CHECK(outcome.status == 1);
  CHECK(outcome.out.empty());
  return outcome.err;
}

double result_of(const Json& answer, const std::string& name) {
  return answer.at("results").at(name).at("value").get<double>();
}

}  // namespace

TEST_CASE("shapes of a scene file press with their depth or their force", "[cli][scene][array]") {
  const Json sphere = answer_of("kind = \"sphere\"\nradius = \"20 mm\"\ndepth = \"2 um\"\n");
  // k (depth - a^2/(4 R)) under the apex, k = 19.0468 N/m.
  CHECK(result_of(sphere, "pillar_force_2_2") ==
        Approx(19.0468 * (2e-6 - 1e-10 / 20e-3 * 1.0)).epsilon(1e-4));
  CHECK(result_of(sphere, "contacts") == 9.0);
  const std::string force = std::to_string(1e6 * result_of(sphere, "contact_force"));
  const Json by_force =
      answer_of("kind = \"sphere\"\nradius = \"20 mm\"\nforce = \"" + force + " uN\"\n");
  CHECK(result_of(by_force, "depth") == Approx(2e-6).epsilon(1e-6));
  const Json held =
      answer_of("kind = \"sphere\"\nradius = \"20 mm\"\ndepth = \"2 um\"\nfriction = \"stick\"\n");
  CHECK(result_of(held, "pillar_force_2_2") > result_of(sphere, "pillar_force_2_2"));
  CHECK(result_of(held, "shear_force_x_2_3") > 0.0);
  CHECK_FALSE(sphere.at("results").contains("shear_force_x_2_3"));
  // A cylinder along x touches the middle row alone, moved by a pitch the first one.
  const Json cylinder = answer_of(
      "kind = \"cylinder\"\nradius = \"1 mm\"\ndepth = \"2 um\"\ndirection = \"90 degree\"\n"
      "at = [\"0 um\", \"-100 um\"]\n");
  CHECK(result_of(cylinder, "pillar_force_1_2") > 0.0);
  CHECK(result_of(cylinder, "pillar_force_1_2") ==
        Approx(result_of(cylinder, "pillar_force_1_3")).epsilon(1e-9));
  CHECK(result_of(cylinder, "pillar_force_3_2") == 0.0);
  // A plane that rises along x by 0.5 degree touches the left column first.
  const Json plane =
      answer_of("kind = \"plane\"\ndepth = \"0.5 um\"\ntilt = [\"0.5 degree\", \"0 degree\"]\n");
  CHECK(result_of(plane, "pillar_force_2_1") > result_of(plane, "pillar_force_2_2"));
  CHECK(result_of(plane, "pillar_force_2_3") == 0.0);
  CHECK(result_of(answer_of("kind = \"wedge\"\nangle = \"2 degree\"\ndepth = \"1 um\"\n"),
                  "contacts") == 3.0);
}

TEST_CASE("a table of heights presses as the shape that it samples", "[cli][scene][array]") {
  const auto folder = std::filesystem::temp_directory_path() / "viscard_heights";
  std::filesystem::create_directories(folder);
  std::string csv = "x [um],y [um],z [um]\n";
  for (int i = -40; i <= 40; ++i) {
    for (int j = -40; j <= 40; ++j) {
      const double x = 5.0 * i, y = 5.0 * j;
      csv += std::to_string(x) + "," + std::to_string(y) + "," +
             std::to_string((x * x + y * y) / 2.0 / 20e3) + "\n";
    }
  }
  const auto path = folder / "heights.csv";
  write_file(path, csv, true);
  const Json table =
      answer_of("kind = \"table\"\nfile = \"" + path.string() + "\"\ndepth = \"2 um\"\n");
  const Json shape = answer_of("kind = \"paraboloid\"\nradius = \"20 mm\"\ndepth = \"2 um\"\n");
  for (const char* pillar : {"pillar_force_2_2", "pillar_force_1_1", "pillar_force_2_3"}) {
    CHECK(result_of(table, pillar) == Approx(result_of(shape, pillar)).epsilon(2e-4));
  }
  write_file(path, "x [um],y [um],z [um]\n0,0,0\n0,1,0\n1,0,0\n", true);
  CHECK_THAT(refusal_of("kind = \"table\"\nfile = \"" + path.string() + "\"\ndepth = \"2 um\"\n"),
             Catch::Contains("the grid must be full"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("mistakes in a shape name the key and the way out", "[cli][scene][array]") {
  const auto refuses = [](const std::string& shape, const std::string& words) {
    INFO(shape);
    CHECK_THAT(refusal_of(shape), Catch::Contains(words));
  };
  refuses("kind = \"ball\"\ndepth = \"1 um\"\n", "shape.kind");
  refuses("kind = \"sphere\"\ndepth = \"1 um\"\n", "needs a radius");
  refuses("kind = \"plane\"\nradius = \"1 mm\"\ndepth = \"1 um\"\n", "shape.radius");
  refuses("kind = \"plane\"\n", "either a depth");
  refuses("kind = \"plane\"\ndepth = \"1 um\"\nforce = \"1 mN\"\n", "either a depth");
  refuses("kind = \"plane\"\ndepth = \"-1 um\"\n", "positive");
  refuses(
      "kind = \"plane\"\ndepth = \"1 um\"\nfriction = \"stick\"\n"
      "work_of_adhesion = \"40 mJ/m2\"\n",
      "shape.friction");
  refuses("kind = \"plane\"\ndepth = \"1 um\"\nat = [\"1 um\"]\n", "two values");
  refuses("kind = \"plane\"\ndepth = \"1 um\"\ntilt = [\"60 degree\", \"0 degree\"]\n",
          "45 degrees");
  refuses("kind = \"wedge\"\ndepth = \"1 um\"\n", "angle");
  refuses("kind = \"wedge\"\nangle = \"60 degree\"\ndepth = \"1 um\"\n", "45 degrees");
  refuses("kind = \"plane\"\ndirection = \"5 degree\"\ndepth = \"1 um\"\n", "shape.direction");
  refuses("kind = \"table\"\ndepth = \"1 um\"\n", "file");
  refuses("kind = \"sphere\"\nradius = \"1 mm\"\nforce = \"1 N\"\n", "press the pillars flat");
  refuses("kind = \"sphere\"\nradius = \"1 mm\"\nforce = \"1 mN\"\nat = [\"5 cm\", \"0 m\"]\n",
          "no pillar under the shape");
}

TEST_CASE("a shape of a scene file moves along its path", "[cli][scene][array]") {
  const std::string sphere = "kind = \"sphere\"\nradius = \"100 mm\"\n";
  const auto along = [](const std::string& of_last) {
    return "path = [{ time = \"0 s\", x = \"-20 um\", depth = \"1 um\" }, { time = \"0.1 s\", " +
           of_last + " }]\n";
  };
  const std::string moves = along("x = \"20 um\", depth = \"1 um\"");
  const Json dragged = answer_of(sphere + "friction = 0.1\n" + moves);
  const double normal_N = result_of(dragged, "pillar_force_2_2");
  CHECK(normal_N == Approx(19.0468 * (1e-6 - 6e-10 / 200e-3)).epsilon(1e-3));
  CHECK(result_of(dragged, "shear_force_x_2_2") == Approx(0.1 * normal_N).epsilon(1e-6));
  CHECK(result_of(dragged, "largest_slip") == Approx(result_of(dragged, "slip_largest")));
  const double lean_m = 0.1 * normal_N / 0.377686;
  CHECK(result_of(dragged, "slip_2_2") == Approx(40e-6 - lean_m).epsilon(2e-2));
  const Json held = answer_of(sphere + "friction = \"stick\"\n" + moves);
  CHECK(result_of(held, "slip_2_2") == 0.0);
  CHECK(result_of(held, "shear_force_x_2_2") == Approx(0.377686 * 40e-6).epsilon(1e-3));
  const Json free = answer_of(sphere + "friction = 0\n" + moves);
  CHECK(result_of(free, "pillar_force_2_2") == Approx(normal_N).epsilon(1e-6));
  CHECK_FALSE(free.at("results").contains("shear_force_x_2_2"));

  CHECK_THAT(refusal_of(sphere + "friction = 0.1\ndepth = \"1 um\"\n"),
             Catch::Contains("shape.friction") && Catch::Contains("shape.path"));
  CHECK_THAT(refusal_of(sphere + "depth = \"1 um\"\n" + moves), Catch::Contains("shape.depth"));
  CHECK_THAT(refusal_of(sphere + "at = [\"1 um\", \"0 um\"]\n" + moves),
             Catch::Contains("shape.at"));
  CHECK_THAT(refusal_of(sphere + along("force = \"1 mN\"")), Catch::Contains("shape.path.2"));
  CHECK_THAT(refusal_of(sphere + "friction = -0.1\n" + moves), Catch::Contains("shape.friction"));
}

TEST_CASE("a rough surface is the same for the same seed", "[cli][scene][array]") {
  const auto rough = [](int seed, const std::string& rest = "") {
    return "kind = \"rough\"\nrms = \"0.25 um\"\ncorrelation_length = \"75 um\"\ndepth = \"3 um\"\n"
           "seed = " +
           std::to_string(seed) + "\n" + rest;
  };
  const double force_N = result_of(answer_of(rough(1)), "contact_force");
  // Nine pillars under a depth of 3 um with 12 heights of rms over it: k 3 um each, within 3 rms.
  CHECK(force_N == Approx(9.0 * 19.0468 * 3e-6).epsilon(0.25));
  CHECK(result_of(answer_of(rough(1)), "contact_force") == force_N);
  CHECK(result_of(answer_of(rough(2)), "contact_force") != force_N);
  CHECK_THAT(refusal_of("kind = \"rough\"\ndepth = \"1 um\"\n"), Catch::Contains("rms"));
  CHECK_THAT(refusal_of("kind = \"rough\"\nrms = \"0.25 um\"\ncorrelation_length = \"10 nm\"\n"
                        "depth = \"1 um\"\n"),
             Catch::Contains("shape.correlation_length"));
  CHECK_THAT(refusal_of("kind = \"plane\"\nrms = \"0.25 um\"\ndepth = \"1 um\"\n"),
             Catch::Contains("belongs to kind = \"rough\""));
}

TEST_CASE("pressures and gaps along the row under a shape are curves", "[cli][scene][array]") {
  const SceneText scene(
      pressed("kind = \"paraboloid\"\nradius = \"1 mm\"\ndepth = \"2 um\"\n[want]\n"
              "quantities = [\"pressure_profile\", \"gap_profile\", \"contact_force\"]\n"));
  const std::filesystem::path folder = scene.beside("out");
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--out", folder.string()});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto second_column = [&](const std::string& name) {
    std::ifstream file(folder / name);
    std::vector<double> values;
    for (std::string line; std::getline(file, line);) {
      const std::size_t comma = line.find(',');
      const bool is_number = !line.empty() && (std::isdigit(line[0]) != 0 || line[0] == '-');
      if (is_number && comma != std::string::npos)
        values.push_back(std::stod(line.substr(comma + 1)));
    }
    return values;
  };
  // k (depth - a^2/(4 R)) over the area of the top, k = 19.0468 N/m; the others are 100 um away.
  const std::vector<double> pressure_Pa = second_column("pressure_profile.csv");
  REQUIRE(pressure_Pa.size() == 3);
  CHECK(pressure_Pa[1] == Approx(19.0468 * (2e-6 - 1e-7) / 1.256637e-9).epsilon(1e-3));
  CHECK(pressure_Pa[0] == 0.0);
  const std::vector<double> gap_m = second_column("gap_profile.csv");
  REQUIRE(gap_m.size() == 3);
  CHECK(gap_m[0] == Approx(5e-6 - 2e-6).epsilon(1e-6));
  CHECK(gap_m[1] == 0.0);
}

TEST_CASE("a backing of a scene file is a half-space under the film", "[cli][scene][array]") {
  const std::string kShape = "kind = \"sphere\"\nradius = \"20 mm\"\ndepth = \"2 um\"\n";
  const auto on = [&](const std::string& backing) {
    std::string text = pressed(kShape);
    text.replace(text.find("edge = \"200 um\""), 15, "edge = \"5 mm\", backing = " + backing);
    return SceneText(text);
  };
  const auto force_on = [&](const std::string& backing) {
    const SceneText scene = on(backing);
    const CommandOutcome outcome = run_command({"simulate", scene.path(), "--json"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    return Json::parse(outcome.out);
  };
  const double rigid_N = result_of(force_on("\"rigid\""), "contact_force");
  CHECK(rigid_N == Approx(result_of(answer_of(kShape), "contact_force")).epsilon(1e-9));
  const double board_N = result_of(force_on("{ E = \"20 GPa\", nu = 0.3 }"), "contact_force");
  const Json rubber = force_on("{ E = \"10 MPa\", nu = 0.45 }");
  CHECK(board_N == Approx(rigid_N).epsilon(1e-3));
  CHECK(result_of(rubber, "contact_force") < 0.99 * rigid_N);
  const auto refuses = [&](const std::string& backing, const std::string& words) {
    const SceneText scene = on(backing);
    const CommandOutcome outcome = run_command({"simulate", scene.path()});
    CAPTURE(backing);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Catch::Contains(words));
  };
  refuses("\"soft\"", "geometry.film.backing");
  refuses("{ E = \"4 GPa\" }", "needs E and nu");
  refuses("{ E = \"4 GPa\", nu = 0.5 }", "geometry.film.backing.nu");
  refuses("{ E = \"10 kPa\", nu = 0.3 }", "geometry.film.backing.E");
  refuses("{ E = \"4 GPa\", nu = 0.3 }, bottom = \"fixed\"", "geometry.film.bottom");
}

TEST_CASE("a row of a scene file takes a shape with friction, or with adhesion and its way",
          "[cli][scene][array]") {
  const auto row = [](const std::string& shape) {
    std::string text = pressed(shape);
    text = replaced(text, "model = \"space\"\nrows = 3\ncolumns = 3", "model = \"plane-stress\"");
    text = replaced(text, "spacing", "count = 3\nspacing");
    return SceneText(text);
  };
  const auto answer_of_row = [&](const std::string& shape) {
    const SceneText scene = row(shape);
    const CommandOutcome outcome = run_command({"simulate", scene.path(), "--json"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    return Json::parse(outcome.out);
  };
  const std::string kCylinder = "kind = \"cylinder\"\nradius = \"20 mm\"\n";
  const Json sliding = answer_of_row(kCylinder + "depth = \"2 um\"\n");
  // k <depth - gap> with k = 6.0295e5 N/m2.
  CHECK(result_of(sliding, "pillar_force_2") ==
        Approx(6.0295e5 * (2e-6 - 40e-6 * 40e-6 / 12.0 / 40e-3)).epsilon(1e-3));
  CHECK(sliding.at("results").at("contact_force").at("unit") == "N/m");
  CHECK_FALSE(sliding.at("results").contains("shear_force_1"));
  const Json sticking = answer_of_row(kCylinder + "depth = \"2 um\"\nfriction = \"stick\"\n");
  CHECK(result_of(sticking, "shear_force_3") > 0.0);
  CHECK(result_of(sticking, "pillar_force_2") > result_of(sliding, "pillar_force_2"));
  CHECK(sticking.at("notes").dump().find("full stick") != std::string::npos);
  const Json held = answer_of_row(kCylinder +
                                  "depth = \"-1 um\"\nbefore = [\"2 um\"]\n"
                                  "work_of_adhesion = \"40 mJ/m2\"\n");
  CHECK(result_of(held, "pillar_force_2") < 0.0);
  // sqrt(pi E w d) over the stiffness, below the mean of the gap.
  const double stretch_m = std::sqrt(3.14159265 * 1.8e6 * 0.04 * 40e-6) / 6.0295e5;
  CHECK(result_of(held, "release_depth_2") ==
        Approx(40e-6 * 40e-6 / 12.0 / 40e-3 - stretch_m).epsilon(1e-3));
  const auto refuses = [&](const std::string& shape, const std::string& words) {
    const SceneText scene = row(shape);
    const CommandOutcome outcome = run_command({"simulate", scene.path()});
    CAPTURE(shape);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Catch::Contains(words));
  };
  refuses(kCylinder + "depth = \"1 um\"\nfriction = \"rough\"\n", "shape.friction");
  refuses(kCylinder + "depth = \"-1 um\"\n", "positive");
  refuses(kCylinder + "depth = \"1 um\"\nbefore = [\"2 um\"]\n", "shape.before");
  refuses(kCylinder + "depth = \"1 um\"\ntilt = [\"0 degree\", \"1 degree\"]\n", "section of x");
}
