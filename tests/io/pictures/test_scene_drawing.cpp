// Drawings of scenes: everything that is there is drawn, and nothing hides the electrodes.
#include "io/cli/scene/answer_pictures.h"
#include "io/pictures/map_picture.h"
#include "io/pictures/scene_picture.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

using namespace viscard;
using namespace viscard::test;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

const char* const kPillarFill = "fill=\"#bcd4e6\"";
const char* const kElectrodeFill = "fill=\"#d55e00\"";
const char* const kArrow = "stroke=\"#0072b2\"";

ArrayScene row_of(int count) {
  ArrayScene scene;
  scene.geometry.count = count;
  scene.film = isotropic_medium(2e9, 0.29, 1780.0);
  scene.film.permittivity_F_m = 1e-10 * Eigen::Matrix3d::Identity();
  scene.load_Pa = 1e3;
  return scene;
}

}  // namespace

TEST_CASE("a drawing of a row has its pillars, electrodes, loads and lengths", "[io][scene]") {
  ArrayScene scene = row_of(5);
  scene.loaded = {2, 3};
  const std::string svg = svg_from_scene(scene, "row.toml");
  CHECK(count_of(svg, kPillarFill) == 5);
  CHECK(count_of(svg, kElectrodeFill) == 5);
  CHECK(svg.find("1 kPa on pillars 2, 3") != std::string::npos);
  CHECK(svg.find("d 40 µm, l 120 µm, s 60 µm") != std::string::npos);
  CHECK(svg.find(">5</text>") != std::string::npos);
  const std::size_t arrows_of_two = count_of(svg, kArrow);
  scene.loaded = {2};
  CHECK(arrows_of_two == 2 * count_of(svg_from_scene(scene, ""), kArrow));
  scene.film.permittivity_F_m.setZero();
  CHECK(count_of(svg_from_scene(scene, ""), kElectrodeFill) == 0);
}

TEST_CASE("a shape above a row is drawn there and not called pressed", "[io][scene]") {
  ArrayScene scene = row_of(8);
  scene.press = ShapePress{.depth_m = -2.5e-6};
  scene.press->shape.kind = ShapeKind::kCylinder;
  scene.press->shape.radius_m = 0.02;
  const char* const rigid = "fill=\"#8a8f94\"";
  const std::string svg = svg_from_scene(scene, "row.toml");
  CHECK(svg.find("a rigid cylinder of radius 20 mm lifted to 2.5 µm above first contact") !=
        std::string::npos);
  CHECK(svg.find("pressed") == std::string::npos);
  CHECK(count_of(svg, rigid) == 1);
  scene.press->depth_m = 5e-6;
  const std::string pressed = svg_from_scene(scene, "");
  CHECK(pressed.find("of radius 20 mm pressed 5 µm deep") != std::string::npos);
  CHECK(count_of(pressed, rigid) == 1);
  scene.geometry.count = 400;  // the places of a long row are not to scale
  CHECK(count_of(svg_from_scene(scene, ""), rigid) == 0);
}

TEST_CASE("a length without room for its number has its letter only", "[io][scene]") {
  ArrayScene scene = row_of(8);
  scene.geometry.film_edge_m = 100e-6;
  CHECK(svg_from_scene(scene, "").find(">edge</text>") != std::string::npos);
  scene.geometry.film_edge_m = 200e-6;
  CHECK(svg_from_scene(scene, "").find(">edge 200 µm</text>") != std::string::npos);
}

TEST_CASE("a drawing of a long row has its first and its last pillars", "[io][scene]") {
  const std::string svg = svg_from_scene(row_of(400), "row.toml");
  CHECK(count_of(svg, kPillarFill) == 16);
  CHECK(svg.find(">8</text>") != std::string::npos);
  CHECK(svg.find(">9</text>") == std::string::npos);
  CHECK(svg.find(">393</text>") != std::string::npos);
  CHECK(svg.find(">400</text>") != std::string::npos);
}

TEST_CASE("the electrode of a pillar is drawn over what stands on it", "[io][scene]") {
  PillarScene scene;
  scene.drive = StaticDrive{.pressure_Pa = 1e4};
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  scene.film = isotropic_medium(2e9, 0.29, 1780.0);
  scene.electrodes = ElectrodeOptions{GENERATE(FilmFace::kTop, FilmFace::kBottom), 20e-6};
  const std::string svg = svg_from_scene(scene, "a & b");
  REQUIRE(count_of(svg, kElectrodeFill) == 1);
  CHECK(svg.find(kElectrodeFill) > svg.find(kPillarFill));
  CHECK(svg.find("10 kPa") != std::string::npos);
  CHECK(svg.find("a &amp; b") != std::string::npos);
  const std::size_t upright = count_of(svg, kArrow);
  scene.drive = StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = 1e4};
  CHECK(count_of(svg_from_scene(scene, ""), kArrow) < upright);  // one arrow sideways
  // Quarters: two parts in the section, and all of them from above.
  scene.electrodes->quadrants = true;
  const std::string quarters = svg_from_scene(scene, "");
  CHECK(count_of(quarters, kElectrodeFill) == 3);
  CHECK(quarters.find("electrode in quarters") != std::string::npos);
}

TEST_CASE("the sizes of a pillar that is lower than their words stand below the title",
          "[io][scene]") {
  PillarScene scene;
  scene.film = isotropic_medium(2e9, 0.29, 1780.0);
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  CHECK(svg_from_scene(scene, "").find("d 40 µm, l 120 µm") == std::string::npos);
  scene.geometry.film = FilmGeometry{50e-6, 1e-3};
  CHECK(svg_from_scene(scene, "").find(">pillar d 40 µm, l 120 µm</text>") != std::string::npos);
}

TEST_CASE("scene check draws pillars and rows into a file, and overwrites none", "[cli][scene]") {
  const std::string name =
      GENERATE(as<std::string>{}, "pillar_sweep.toml", "array_map.toml", "space_quadrants.toml");
  const SceneText folder("");
  const std::string svg = folder.path() + ".svg";
  const std::vector<std::string> words = {
      "scene", "check", std::string(VISCARD_SOURCE_DIR) + "/data/scenes/" + name, "--svg", svg};
  CHECK(run_command(words).status == 0);
  CHECK(std::filesystem::file_size(svg) > 1000);
  CHECK(run_command(words).status == 1);
}

TEST_CASE("a drawing hatches held faces and labels free ones", "[io][scene]") {
  PillarScene scene;
  if (GENERATE(false, true)) {
    scene.geometry.film = FilmGeometry{25e-6, 60e-6};
    scene.film = isotropic_medium(2e9, 0.29, 1780.0);
  }
  const char* const hatch = "stroke=\"#444\" stroke-width=\"2\"";
  CHECK(count_of(svg_from_scene(scene, ""), hatch) == 1);
  CHECK(count_of(svg_from_scene(scene, ""), ">free</text>") == 0);
  scene.fixed_bottom = false;
  CHECK(count_of(svg_from_scene(scene, ""), hatch) == 0);
  CHECK(count_of(svg_from_scene(scene, ""), ">free</text>") == 1);
}

namespace {

SpaceScene array_of(int rows, int columns) {
  SpaceScene scene;
  scene.rows = rows;
  scene.columns = columns;
  scene.pillars = lattice_places(SpaceLattice::kSquare, rows, columns, 100e-6);
  scene.pressure_Pa = 1e3;
  return scene;
}

SceneArray array_for_map(int rows, int columns) {
  SceneArray array{.rows = rows, .columns = columns, .cell_x_m = 1e-4, .cell_y_m = 1e-4};
  for (const SpacePillar& one : lattice_places(SpaceLattice::kSquare, rows, columns, 1e-4)) {
    array.pillars.push_back({one.row, one.column, one.x_m, one.y_m, 4e-5});
  }
  array.left_m = array.low_m = array.pillars.front().x_m - 1e-4;
  array.right_m = array.high_m = -array.left_m;
  return array;
}

}  // namespace

TEST_CASE("a drawing of an array in the plane has its pillars, electrodes and loads from above",
          "[io][scene]") {
  SpaceScene scene = array_of(3, 4);
  scene.loaded = {{2, 3}};
  scene.electrode = SpaceElectrode::kQuadrants;
  const std::string svg = svg_from_scene(scene, "array.toml");
  CHECK(count_of(svg, "fill=\"#bcd4e6\"") == 11);
  CHECK(count_of(svg, "fill=\"#0072b2\"") == 1);
  CHECK(count_of(svg, "fill=\"none\" stroke=\"#d55e00\"") == 12);
  CHECK(svg.find("pressure 1 kPa on 1 pillar (dark) [2, 3]") != std::string::npos);
  CHECK(svg.find(">200 µm</text>") != std::string::npos);  // the length to scale
  const std::size_t arrows = count_of(svg, kArrow);
  scene.shear_y_Pa = -50.0;
  CHECK(count_of(svg_from_scene(scene, ""), kArrow) == arrows + 3);
  CHECK(count_of(svg_from_scene(array_of(60, 60), ""), "<circle") == 0);  // no room for each
}

TEST_CASE("large lengths and moduli on a drawing have no exponent", "[io][scene]") {
  SpaceScene scene = array_of(3, 3);
  scene.backing = Backing{.young_modulus_Pa = 4e9, .poisson_ratio = 0.3};
  scene.press = ShapePress{.depth_m = 1.5e-6};
  scene.press->shape.kind = ShapeKind::kSphere;
  scene.press->shape.radius_m = 0.1;
  const std::string svg = svg_from_scene(scene, "array.toml");
  CHECK(svg.find("on a half-space of 4 GPa") != std::string::npos);
  CHECK(svg.find("a rigid sphere of radius 100 mm pressed 1.5 µm deep") != std::string::npos);
}

TEST_CASE("the voltages of a touch in time are drawn in one unit with a prefix", "[io][scene]") {
  SceneAnswer answer;
  answer.curves = {
      SceneCurve{.name = "depth", .unit = "m", .x = {0.0, 1.0}, .value = {0.0, 2e-6}},
      SceneCurve{
          .name = "electrode_voltage_1_1", .unit = "V", .x = {0.0, 1.0}, .value = {0.0, -0.045}},
      SceneCurve{.name = "reading_1_1", .unit = "V", .x = {0.0, 1.0}, .value = {0.0, 2e-4}}};
  const Pictures pictures = pictures_of(answer);
  if (pictures.empty()) return;  // gnuplot is not here
  REQUIRE(pictures.back().first == "touch");
  CHECK(pictures.back().second.find("voltage (mV)") != std::string::npos);
}

TEST_CASE("a length that is zero everywhere has an axis of micrometres", "[io][scene]") {
  SceneAnswer answer;
  answer.curves = {SceneCurve{.name = "gap_profile",
                              .unit = "m",
                              .x = {-1e-4, 1e-4},
                              .value = {0.0, 0.0},
                              .x_name = "x_m"}};
  const Pictures pictures = pictures_of(answer);
  if (pictures.empty()) return;  // gnuplot is not here
  CHECK(pictures[0].second.find("gap profile (µm)") != std::string::npos);
}

TEST_CASE("a bar of small values has the micro sign of the plots", "[io][scene]") {
  const SceneMap map{"normal_force", "N", {0, 1}, {2e-6, 4e-6}};
  CHECK(svg_from_map(array_for_map(1, 2), map, "").find(">µN</text>") != std::string::npos);
}

TEST_CASE("the modes of a row are drawn pillar by pillar and in a table", "[cli][scene][array]") {
  const SceneText scene(R"(tolerance = 1e-2
[geometry]
kind = "array"
count = 2
diameter = "40 um"
length = "120 um"
spacing = "20 um"
film = { thickness = "25 um", edge = "60 um", material = "pvdf" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "modal"
modes = 1
[effects]
crosstalk = "on"
film_compliance = "on"
)");
  const std::filesystem::path folder = scene.beside("out");
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--out", folder.string()});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto text_of = [&](const char* name) {
    std::ifstream file(folder / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  for (const char* const name : {"lateral_1.svg", "lateral_2.svg", "longitudinal_1.svg"}) {
    CAPTURE(name);
    CHECK(count_of(text_of(name), kPillarFill) == 2);
    CHECK(count_of(text_of(name), R"(stroke-dasharray="4 3")") == 2);  // at rest
    CHECK(text_of(name).find(" kHz") != std::string::npos);
    CHECK(text_of(name).find(" ± ") != std::string::npos);
    CHECK(text_of(name).find(" kHz (scene") != std::string::npos);  // the name of the file
    CHECK(text_of(name).find("the 2 modes of this cluster lie within ") != std::string::npos);
  }
  // One mode of the two has both tops move alike, the other one against each other.
  const std::string both = text_of("lateral_1.svg") + text_of("lateral_2.svg");
  CHECK(count_of(both, ">+1.00</text>") == 3);
  CHECK(count_of(both, ">−1.00</text>") == 1);
  CHECK(text_of("mode_shapes.csv").find("family,mode,frequency_Hz,pillar,motion\nlateral,1,") !=
        std::string::npos);
  CHECK(count_of(text_of("mode_shapes.csv"), "\nlongitudinal,") == 4);
}

TEST_CASE("a map has a disc for each pillar, or cells if there are many", "[io][scene]") {
  SceneArray array = array_for_map(3, 3);
  array.pillars[4].pressure_Pa = 1e3;
  SceneMap map{"mean_voltage",
               "V",
               {0, 1, 2, 3, 5, 6, 7, 8},
               {-2e-3, -1e-3, 0.0, -1e-3, -1e-3, -1e-3, -1e-3, -1e-3}};
  const std::string discs = svg_from_map(array, map, "mean & voltage");
  CHECK(count_of(discs, "<circle") == 9);
  CHECK(count_of(discs, "fill=\"none\" stroke=\"#000\" stroke-width=\"2\"") == 1);
  CHECK(discs.find("mean &amp; voltage") != std::string::npos);
  for (const char* const tick :
       {">−2</text>", ">−1.5</text>", ">−1</text>", ">−0.5</text>", ">0</text>", ">mV</text>"}) {
    CAPTURE(tick);
    CHECK(discs.find(tick) != std::string::npos);
  }
  const SceneArray large = array_for_map(30, 30);
  SceneMap even{"mean_voltage", "V", {}, {}};
  for (std::size_t i = 0; i < 900; ++i) {
    even.pillar.push_back(i);
    even.value.push_back(i < 450 ? 0.0 : 1.0);
  }
  const std::string cells = svg_from_map(large, even, "");
  CHECK(count_of(cells, "<circle") == 0);
  CHECK(count_of(cells, "<path shape-rendering") == 2);  // one for each colour
  CHECK(count_of(cells, "M") == 30);                     // a run for each row
}

TEST_CASE("a drawn phase goes on beyond half a turn", "[io]") {
  constexpr double kPi = 3.14159265358979;
  const std::vector<double> steady = unwrapped({0.0, -3.0, 3.0, 2.0, -2.5, -3.1, 3.1});
  const std::vector<double> expected{0.0,  -3.0, 3.0 - 2.0 * kPi, 2.0 - 2.0 * kPi,
                                     -2.5, -3.1, 3.1 - 2.0 * kPi};
  REQUIRE(steady.size() == expected.size());
  for (std::size_t i = 0; i < steady.size(); ++i) CHECK(steady[i] == Approx(expected[i]));
}
