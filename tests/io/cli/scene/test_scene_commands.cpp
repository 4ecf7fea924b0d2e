#include "io/basics/atomic_file.h"
#include "io/cost/study_cost.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/flow/scenes/compared_answers.h"
#include "io/scenes/scene_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

namespace {

const char* const kSensor = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
film = { thickness = "25 um", radius = "60 um", material = "pvdf" }
electrode = { face = "top", radius = "20 um" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_film_manual.json" }
[analysis]
kind = "static"
load = { pressure = "10 kPa", on = "top" }
)";

}  // namespace

TEST_CASE("a scene that contradicts itself is reported in one line with the line of the file",
          "[cli][scene]") {
  struct Case {
    const char *from, *to, *where, *what;
  };
  const Case c = GENERATE(
      Case{"tolerance = 1e-3", "tolerance = 0", "scene.toml:1:", "tolerance"},
      Case{", on = \"top\"", "", "scene.toml:12:", "no place"},
      Case{"radius = \"20 um\"", "radius = \"90 um\"", "scene.toml:6:", "electrode"},
      Case{"radius = \"60 um\"", "radius = \"10 um\"", "scene.toml:", "film"},
      Case{"pressure = \"10 kPa\"", "pressure = \"40 kPa\"", "scene.toml:12:", "buckling"},
      Case{"length =", "lenght =", "scene.toml:", "lenght"},
      Case{"kind = \"static\"", "kind = \"statik\"", "scene.toml:11:", "did you mean 'static'"},
      Case{"nu = 0.33", "nu = 0.7", "scene.toml:8:", "Poisson"},
      Case{"E = \"1.8 MPa\"", "E = \"1.8 um\"", "scene.toml:8:", "MPa"},
      Case{"[analysis]", "[effects]\ninertai = \"on\"\n[analysis]",
           "scene.toml:11:", "did you mean 'inertia'"},
      Case{"[analysis]", "[effects]\nfilm_compliance = \"off\"\n[analysis]",
           "scene.toml:11:", "cannot be off"},
      Case{"[analysis]", "[effects]\ninertia = \"maybe\"\n[analysis]",
           "scene.toml:11:", "There are: auto, off, on"});
  CAPTURE(c.to);
  const SceneText scene(replaced(kSensor, c.from, c.to));
  const CommandOutcome outcome = run_command({"scene", "check", scene.path()});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find(c.where) != std::string::npos);
  CHECK(outcome.err.find(c.what) != std::string::npos);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

TEST_CASE("a scene is drawn with its sizes", "[cli][scene]") {
  const SceneText scene(kSensor);
  const std::string svg = scene.beside("scene.svg");
  REQUIRE(run_command({"scene", "check", scene.path(), "--svg", svg}).status == 0);
  std::stringstream text;
  text << std::ifstream(svg).rdbuf();
  for (const char* part : {"<svg", "d 40 µm", "l 120 µm", "t 25 µm", "film radius 60 µm",
                           "electrode, radius 20 µm", "10 kPa", "</svg>"}) {
    CAPTURE(part);
    CHECK(text.str().find(part) != std::string::npos);
  }
  CHECK(run_command({"scene", "check", scene.path(), "--svg", svg}).status == 1);  // is there
  CHECK(run_command({"scene", "check", scene.path(), "--svg", svg, "--force"}).status == 0);
  const auto as_png =
      run_command({"scene", "check", scene.path(), "--svg", scene.beside("scene.png")});
  CHECK(as_png.status == 2);
  CHECK_THAT(as_png.err, Catch::Contains("end its name with .svg"));
}

TEST_CASE("an effect that is not computed and exceeds the tolerance stands in the first line",
          "[cli][scene]") {
  // Sideways, for small strains the top moves by 0.28 and by 5.5 lengths at 10 and 200 kPa.
  struct Case {
    const char* shear;
    bool is_within;
    int status;
  };
  const Case c =
      GENERATE(Case{"1 Pa", true, 0}, Case{"10 kPa", false, 0}, Case{"200 kPa", false, 1});
  CAPTURE(c.shear);
  const SceneText scene(std::string(R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
[analysis]
kind = "static"
load = { shear = ")") + c.shear +
                        "\", on = \"top\", direction = \"lateral\" }\n");
  const CommandOutcome json = run_command({"simulate", scene.path(), "--json"});
  CHECK(json.status == c.status);
  CHECK(nlohmann::json::parse(json.out)["effects_within_tolerance"] == c.is_within);
  CHECK(nlohmann::json::parse(json.out)["within_tolerance"] == true);
  const CommandOutcome text = run_command({"simulate", scene.path()});
  CHECK(text.status == c.status);
  const std::string first = text.out.substr(0, text.out.find('\n'));
  CHECK((first.find("finite_strain is not computed") != std::string::npos) == !c.is_within);
  // Other interfaces show the same text.
  const auto doubt = nlohmann::json::parse(json.out)["tolerance_doubt"].get<std::string>();
  CHECK(first == scene.path() + (c.is_within ? "" : ": " + doubt));
}

TEST_CASE("the plan is one object with every effect, estimate and reason", "[cli][scene]") {
  const SceneText scene(kSensor);
  const CommandOutcome outcome = run_command({"plan", scene.path(), "--json"});
  REQUIRE(outcome.status == 0);
  const auto object = nlohmann::json::parse(outcome.out);
  CHECK(object["effects"].size() == 19);
  for (const auto& effect : object["effects"]) {
    CHECK(effect["name"].is_string());
    CHECK(effect["on"].is_boolean());
    CHECK((effect["estimate"].is_number() || effect["estimate"].is_null()));
    CHECK_FALSE(effect["reason"].get<std::string>().empty());
  }
  CHECK(object["left_out"].get<double>() <= 0.5 * object["tolerance"].get<double>());
  // Without [want] the film's coupling is a need, so that there is nothing to save.
  CHECK(object["savings"].is_array());
  CHECK(run_command({"plan"}).status == 2);
  CHECK(run_command({"plan", scene.path(), "--tol", "2"}).status == 2);
}

TEST_CASE("the plan shows choices with their savings, and the reasons for all other effects",
          "[cli][scene]") {
  const SceneText scene(std::string(kSensor) + "[want]\nquantities = [\"electrode_voltage\"]\n");
  const CommandOutcome printed = run_command({"plan", scene.path()});
  REQUIRE(printed.status == 0);
  CAPTURE(printed.out);
  CHECK(printed.out.find("1.0e+00") == std::string::npos);
  CHECK(printed.out.find("\n  piezo_coupling ") != std::string::npos);  // a choice
  CHECK(printed.out.find("\n  crosstalk ") == std::string::npos);       // none
  CHECK(printed.out.find("  off, not needed\n") < printed.out.find("    crosstalk: "));
  CHECK(printed.out.find("  on, needed\n") < printed.out.find("    film_compliance: "));
  CHECK(printed.out.find("  without piezo_coupling: ") != std::string::npos);
  const auto object = nlohmann::json::parse(run_command({"plan", scene.path(), "--json"}).out);
  REQUIRE(object["savings"].size() == 1);
  const auto& saving = object["savings"][0];
  CHECK(saving["effect"] == "piezo_coupling");
  CHECK(saving["cpu_s"].get<double>() > 0.0);
  // One way solves displacements and potentials one after the other.
  CHECK(saving["unknowns_without"].get<int>() < saving["unknowns"].get<int>());
  for (const auto& effect : object["effects"]) {
    CAPTURE(effect["name"].get<std::string>());
    CHECK(effect["choice"].get<bool>() == (effect["name"] == "piezo_coupling"));
  }
}

TEST_CASE("the cost of accuracy: rows, a front, and advice that meets its tolerance",
          "[cli][scene]") {
  const SceneText scene(
      replaced(kSensor, "electrode = { face = \"top\", radius = \"20 um\" }\n", "") +
      "[want]\nquantities = [\"top_displacement\"]\n");
  const std::string out = scene.beside("cost");
  const CommandOutcome outcome =
      run_command({"cost", scene.path(), "--budget", "2s", "--json", "--out", out});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto study = nlohmann::json::parse(outcome.out);
  REQUIRE(study["rows"].size() >= 1);
  for (const auto& row : study["rows"]) {
    CHECK(row["unknowns"].get<int>() > 0);
    CHECK(row["wall_s"].get<double>() > 0.0);
    CHECK(row["cpu_s"].get<double>() > 0.0);
    CHECK_FALSE(row["predicted"].get<bool>());
    CHECK(row["error"].get<double>() >= 0.0);
  }
  for (const auto& advice : study["recommendations"]) {
    if (advice["row"].is_null()) continue;
    const auto& row = study["rows"][advice["row"].get<std::size_t>()];
    CHECK(row["error"].get<double>() <= 0.5 * advice["tolerance"].get<double>());
  }
  for (const char* name : {"cost.csv", "cost.json", "cost.svg"}) {
    CHECK(std::ifstream(out + "/" + name).good());
  }
  CHECK(study["machine"]["cores"].get<int>() >= 1);
  CHECK(study["machine"]["processor_share"].get<double>() > 0.0);
  CHECK(study["rows"].size() + study["predicted_rows"].size() ==
        study["rows"].size() + study["rows_left_out"].get<std::size_t>());
  std::stringstream picture;
  picture << std::ifstream(out + "/cost.svg").rdbuf();
  for (const char* part : {"processor time (s)", "the scene's tolerance, 10⁻³", ">p2/1<"}) {
    if (study["rows"].size() < 2) break;  // a busy machine times one mesh at most
    CAPTURE(part);
    CHECK(picture.str().find(part) != std::string::npos);
  }
  CHECK(picture.str().find(" um<") == std::string::npos);  // as in all pictures, µm
  CHECK(run_command({"cost", scene.path(), "--budget", "soon"}).status == 2);
}

TEST_CASE("the factor over linear elements is read off the line through their errors",
          "[io][scene]") {
  CostStudy study;
  study.rows = {
      {.discretisation = "h1 10 um", .effects = "all on", .cpu_s = 1e-3, .error = 4e-2},
      {.discretisation = "h1 5 um", .effects = "all on", .cpu_s = 1e-2, .error = 4e-3},
      {.discretisation = "graded p4, 2 layers", .effects = "all on", .cpu_s = 2e-3, .error = 9e-4}};
  const auto beyond = factor_over_linear(study, 1e-3);  // error falls as 1/time here
  REQUIRE(beyond);
  CHECK(beyond->factor == Approx(4e-2 / 2e-3).epsilon(1e-12));
  CHECK(beyond->is_extrapolated);
  const auto between = factor_over_linear(study, 1e-2);
  REQUIRE(between);
  CHECK(between->factor == Approx(4e-3 / 2e-3).epsilon(1e-12));
  CHECK_FALSE(between->is_extrapolated);
  CHECK_FALSE(factor_over_linear(study, 1e-5));  // no row is that accurate
}

TEST_CASE("two scenes stand beside each other with ratios, pictures and a contrast at the pitch",
          "[cli][scene]") {
  const ScratchFolder folder;
  // Half the modulus gives twice the displacement, in every number of the answer but the voltages.
  const SceneText stiff(kSensor);
  const SceneText soft(replaced(kSensor, "1.8 MPa", "0.9 MPa"));
  const CommandOutcome both =
      run_command({"simulate", stiff.path(), "--compare", soft.path(), "--json"});
  CAPTURE(both.err);
  REQUIRE(both.status == 0);
  const nlohmann::json compared = nlohmann::json::parse(both.out)["compared"];
  CHECK(compared["scene"] == soft.path());
  bool has_stiffness = false;
  for (const auto& row : compared["values"]) {
    if (row["name"] != "top_displacement") continue;
    has_stiffness = true;
    // The film deforms too, so that the ratio lies between the pillar's 1/2 and 1.
    CHECK(row["ratio"].get<double>() > 0.5);
    CHECK(row["ratio"].get<double>() < 0.52);
    CHECK(row["ratio_error"].get<double>() < 4e-3);
  }
  CHECK(has_stiffness);
  CHECK(compared["profiles"].empty());

  const std::string seed = std::string(VISCARD_SOURCE_DIR) + "/data/seed/";
  const std::string out = (folder / "out").string();
  const CommandOutcome bulk = run_command({"simulate", seed + "array_cylinder.toml", "--compare",
                                           seed + "layer_cylinder.toml", "--out", out});
  CAPTURE(bulk.err);
  CHECK(bulk.out.find("times as sharp") != std::string::npos);
  CHECK(std::filesystem::exists(folder / "out/compared.csv"));
  CHECK(std::filesystem::exists(folder / "out/compared_centre_voltage.svg"));

  const CommandOutcome other =
      run_command({"simulate", stiff.path(), "--compare", seed + "table_7_1_modes.toml"});
  CHECK(other.status == 1);
  CHECK(other.err.find("have no value, curve or profile") != std::string::npos);
}

TEST_CASE("patterned and bulk of chapter 8 are answered by one command each", "[cli][scene]") {
  const std::string seed = std::string(VISCARD_SOURCE_DIR) + "/data/seed/";
  struct Pair {
    const char* name;
    double force, voltage, sharper;  // of the strips over the layer; the voltage at x = 50 um
  };
  // At the same displacement finite elements give -599.1 mV of -872.8 mV (data/seed/layer_cylinder_prescribed.toml).
  const auto [name, force, voltage, sharper] =
      GENERATE(Pair{"chapter_8_1", 0.3306, 0.6863, 1.46}, Pair{"chapter_8_2", 1.0, 1.580, 0.703},
               Pair{"chapter_8_3", 0.3675, 0.6602, 1.05});
  CAPTURE(name);
  const CommandOutcome outcome = run_command({"simulate", seed + name + ".toml", "--json"});
  INFO(outcome.err);
  const nlohmann::json compared = nlohmann::json::parse(outcome.out).at("compared");
  const auto ratio = [&](const std::string& value) {
    for (const auto& row : compared.at("values")) {
      if (row.at("name") == value) return row.at("ratio").get<double>();
    }
    return 0.0;
  };
  CHECK(ratio("contact_force") == Approx(force).epsilon(1e-3));
  const bool has_same_places = std::string(name) != "chapter_8_3";
  CHECK(ratio(has_same_places ? "centre_voltage_5" : "centre_voltage at 50 um") ==
        Approx(voltage).epsilon(2e-3));
  const nlohmann::json profile = compared.at("profiles").at(0);
  CHECK(profile.at("contrast").get<double>() / profile.at("other_contrast").get<double>() ==
        Approx(sharper).epsilon(1e-2));
}

TEST_CASE("a row that is called an array is read as before, with a note", "[cli][scene]") {
  const std::string path = std::string(VISCARD_SOURCE_DIR) + "/data/seed/array_strips.toml";
  const std::string row = read_file(path);
  const std::string old = std::string(row).replace(row.find("\"row\""), 5, "\"array\"");
  const SceneFile now = scene_from_toml(row, path), before = scene_from_toml(old, path);
  CHECK(std::holds_alternative<ArrayScene>(now.scene));
  CHECK(std::holds_alternative<ArrayScene>(before.scene));
  SceneAnswer answer;
  add_notes_of_file(now, answer);
  CHECK(answer.notes.empty());
  add_notes_of_file(before, answer);
  CHECK(answer.notes.size() == 1);
  CHECK(toml_of(now).find("kind = \"row\"") != std::string::npos);
  const std::string none =
      "[geometry]\nkind = \"array\"\ndiameter = \"40 um\"\nlength = \"120 um\"\n";
  CHECK_THROWS_WITH(scene_from_toml(none, path), Catch::Contains("kind = \"row\" with a count"));
  // An array in the plane is one by its rows; its model need not be stated.
  CHECK_THROWS_WITH(scene_from_toml(none + "rows = 2\nmodel = \"plane-stress\"\n", path),
                    Catch::Contains("space"));
}

TEST_CASE("the contrast of a profile is the largest step of one pitch over the largest voltage",
          "[cli][scene]") {
  Scene row = ArrayScene{};
  std::get<ArrayScene>(row).geometry.count = 3;
  Scene layer = LayerScene{};
  const double pitch_m = 100e-6;  // of the default row
  std::get<LayerScene>(layer).electrodes_m = {{0.0, 0.0}, {pitch_m, 0.0}, {3.0 * pitch_m, 0.0}};
  const auto answer = [](double one, double two, double three) {
    SceneAnswer out;
    for (const auto& [name, value] : {std::pair("centre_voltage_1", one),
                                      {"centre_voltage_2", two},
                                      {"centre_voltage_3", three}})
      out.results.push_back({.name = name, .value = value, .unit = "V", .error_estimate = 1e-6});
    return out;
  };
  const SceneAnswer here = answer(-1.0, -4.0, -2.0), there = answer(-8.0, 0.0, -6.0);
  const ComparedAnswers found = compare_answers({row, here}, {layer, there}, "layer.toml");
  REQUIRE(found.profiles.size() == 1);
  CHECK(found.profiles[0].pitch_m == Approx(pitch_m));
  CHECK(*found.profiles[0].contrast == Approx(3.0 / 4.0));
  CHECK(*found.profiles[0].other_contrast == Approx(8.0 / 8.0));  // the third is two pitches away
  // Electrodes of the same number lie elsewhere: those at the same places are compared.
  REQUIRE(found.values.size() == 2);
  CHECK(found.values[0].name == "centre_voltage at 0 um");
  CHECK(*found.values[0].ratio == Approx(4.0 / 8.0));
  CHECK(found.values[0].ratio_error == Approx(1e-6 / 8.0 * (1.0 + 4.0 / 8.0)));
  CHECK(found.values[1].name == "centre_voltage at 100 um");
  CHECK_FALSE(found.values[1].ratio);  // 0 V
}
