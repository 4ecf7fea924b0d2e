// Designs that choose among materials and kinds besides their ranges.
#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/written_path.h"
#include "io/flow/optimise/optimised_output.h"
#include "io/results/result_json.h"
#include "tests/io/optimise/spec_files.h"

#include <cmath>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string stiffness_choice(const std::string& values) {
  return "[require]\ncollapse_margin = 2\n" + std::string(kLongest) +
         "from = \"80 um\"\nto = \"2000 um\"\n[[choice]]\nkey = \"materials.pillar.E\"\nvalues = "
         "[" +
         values + "]\n";
}

}  // namespace

TEST_CASE("of several materials the one with the best design is taken", "[io][design]") {
  const SpecFiles files(stiffness_choice(R"("1 MPa", "2 MPa", "1.5 MPa")"));
  const DesignFront front = design_front(files.read(), {});
  REQUIRE(front.designs.size() == 1);
  const OptimisedDesign& design = front.designs[0];
  REQUIRE(design.is_feasible);
  // The longest that stands grows with E^(2/3), so the stiffest wins.
  CHECK(design.values.at(0) == std::pair<std::string, std::string>{"materials.pillar.E", "2 MPa"});
  const double expected_m = longest_m(2e6, 2.0) * std::exp(-1.2 * 0.04 - 2e-3);
  CHECK(design.objectives.at(0).value * 1e-6 == Approx(expected_m).epsilon(1e-3));
  CHECK(design.scene_text.find("2 MPa") != std::string::npos);
  CHECK(csv_from_front(files.read(), front).rfind("materials.pillar.E,geometry.length,", 0) == 0);
}

TEST_CASE("if no choice has a design, the nearest is shown with its limits", "[io][design]") {
  const double from_um = 1.2e6 * longest_m(2e6, 2.0);
  const SpecFiles files(
      replaced(stiffness_choice(R"("1 MPa", "2 MPa")"), "80 um", std::to_string(from_um) + " um"));
  const DesignFront front = design_front(files.read(), {});
  REQUIRE(front.designs.size() == 1);
  CHECK_FALSE(front.designs[0].is_feasible);
  CHECK(front.designs[0].values.at(0).second == "2 MPa");
  CHECK(front.designs[0].active.at(0) == "collapse_margin");
}

TEST_CASE("choices that are wrong are refused, and a scene that cannot be names its choice",
          "[io][design]") {
  const auto refused = [](const std::string& spec, const char* why) {
    CAPTURE(spec);
    CHECK_THROWS_WITH(design_front(SpecFiles(spec).read(), {}), Catch::Contains(why));
  };
  const std::string good = stiffness_choice(R"("1 MPa", "2 MPa")");
  refused(stiffness_choice(""), "differ");
  refused(stiffness_choice(R"("1 MPa", "1 MPa")"), "differ");
  refused(replaced(good, "materials.pillar.E", "geometry.length"), "a range or another choice");
  refused(replaced(good, "materials.pillar.E", "materials.pilar.E"), "materials.pilar");
  refused(replaced(good, "\"1 MPa\"", "\"soft\""), "with materials.pillar.E = soft");
  std::string many;
  for (int i = 1; i <= 65; ++i) many += (i > 1 ? "," : "") + ("\"" + std::to_string(i) + " MPa\"");
  refused(stiffness_choice(many), "65 combinations");
}

TEST_CASE("film material and kind of electrode are chosen as the best single specification is",
          "[io][design][slow]") {
  const std::string scene =
      replaced(replaced(read_file(VISCARD_SOURCE_DIR "/data/scenes/pillar_sensor.toml"),
                        "../materials", VISCARD_SOURCE_DIR "/data/materials"),
               "1e-3", "1e-2");
  const std::string spec =
      "[require]\nlargest_pressure = \"20 kPa\"\nbandwidth = \"2 kHz\"\n"
      "[[range]]\nkey = \"geometry.length\"\nfrom = \"40 um\"\nto = \"300 um\"\n"
      "[[objective]]\nquantity = \"voltage_per_pressure\"\ngoal = \"largest\"\n";
  const std::string folder = VISCARD_SOURCE_DIR "/data/materials/";
  const std::vector<std::string> films{folder + "pvdf_film_manual.json", folder + "pzt5a.json"},
      kinds{"equipotential", "sampled"};
  const std::string choices = "[[choice]]\nkey = \"materials.pvdf.file\"\nvalues = [\"" + films[0] +
                              "\", \"" + films[1] +
                              "\"]\n[[choice]]\nkey = \"geometry.electrode.kind\"\n"
                              "values = [\"equipotential\", \"sampled\"]\n";
  const SpecFiles files(spec + choices, scene);
  const DesignFront front = design_front(files.read(), {});
  REQUIRE(front.designs.at(0).is_feasible);
  double most = 0.0;
  std::string film, kind;
  for (const std::string& one_film : films) {
    for (const std::string& one_kind : kinds) {
      const SpecFiles single(spec, replaced(replaced(scene, films[0], one_film),
                                            "\"equipotential\"", "\"" + one_kind + "\""));
      const OptimisedDesign design = optimise_design(single.read(), {});
      if (!design.is_feasible || design.objectives.at(0).value <= most) continue;
      most = design.objectives.at(0).value;
      film = one_film;
      kind = one_kind;
    }
  }
  CHECK(front.designs[0].objectives.at(0).value == Approx(most).epsilon(1e-9));
  CHECK(front.designs[0].values.at(0).second == film);
  CHECK(front.designs[0].values.at(1).second == kind);
}

TEST_CASE("with --strip-paths the files of a design state no folder", "[io][design]") {
  DesignSpec spec;
  spec.path = "spec.toml";
  spec.scene_path = "scenes/scene.toml";
  spec.choices = {{"materials.pillar.file", {"/home/anna/a.json", "../../anna/deep/b.json"}}};
  spec.objectives = {{"geometry.length", "largest"}, {"bandwidth", "largest"}};
  DesignFront front;
  for (const std::string& file : spec.choices[0].values) {
    OptimisedDesign design;
    design.values = {{"materials.pillar.file", file}};
    design.scene_text = "[materials]\npillar = { file = \"" + file + "\" }\n";
    const auto value = static_cast<double>(file.size());  // of two designs that differ
    design.objectives = {{"geometry.length", "m", value}, {"bandwidth", "Hz", 100.0 - value}};
    front.designs.push_back(design);
  }
  const auto written = [&] {
    std::string all =
        csv_from_front(spec, front) + text_from_front(spec, front) +
        svg_from_plot(picture_of_front(spec, front), "front") +
        text_from_json(json_from_keys([&](ResultVisitor& v) { show_front(v, spec, front); }), 2);
    for (const OptimisedDesign& design : front.designs)
      all += scene_for_folder(spec, design, "out");
    return all;
  };
  CHECK(written().find("Written with --strip-paths") == std::string::npos);
  CHECK(written().find("/home/anna/a.json") != std::string::npos);
  strip_written_paths(true);
  const std::string stripped = written();
  strip_written_paths(false);
  CAPTURE(stripped);
  CHECK(stripped.find("anna") == std::string::npos);
  CHECK(stripped.find("a.json") != std::string::npos);
  CHECK(stripped.find("b.json") != std::string::npos);
  CHECK(stripped.find("# Written with --strip-paths") != std::string::npos);
}

TEST_CASE("with --strip-paths designs with files of one name in two folders stay different",
          "[io][design]") {
  DesignSpec spec;
  spec.path = "spec.toml";
  spec.scene_path = "scene.toml";
  spec.choices = {{"materials.pillar.file", {"../alpha/m.json", "../beta/m.json"}}};
  spec.objectives = {{"geometry.length", "largest"}};
  DesignFront front;
  for (const std::string& file : spec.choices[0].values) {
    OptimisedDesign design;
    design.values = {{"materials.pillar.file", file}};
    design.scene_text = "[materials]\npillar = { file = \"" + file + "\" }\n";
    design.objectives = {{"geometry.length", "m", 1e-3}};
    front.designs.push_back(design);
  }
  strip_written_paths(true);
  std::vector<std::string> all{
      csv_from_front(spec, front), text_from_front(spec, front),
      text_from_json(json_from_keys([&](ResultVisitor& v) { show_front(v, spec, front); }), 2), ""};
  for (const OptimisedDesign& design : front.designs)
    all.back() += scene_for_folder(spec, design, "out");
  strip_written_paths(false);
  for (const std::string& text : all) {
    CAPTURE(text);
    CHECK(text.find("alpha/m.json") != std::string::npos);
    CHECK(text.find("beta/m.json") != std::string::npos);
    CHECK(text.find("../") == std::string::npos);
  }
}
