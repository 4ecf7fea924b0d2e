// What `viscard simulate` prints and leaves of an array in the plane.
#include "io/basics/atomic_file.h"
#include "io/tables/csv_table.h"
#include "io/tables/npy_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <filesystem>

using namespace viscard;
using namespace viscard::test;
using Json = nlohmann::json;

namespace {

const std::string kSpace = R"(tolerance = 1e-2
[geometry]
kind = "array"
model = "space"
rows = 3
columns = 4
diameter = "40 um"
length = "120 um"
spacing = "60 um"
dead = [[1, 4]]
film = { thickness = "25 um", edge = "200 um", material = "pvdf" }
electrode = { face = "bottom", kind = "sampled", quadrants = true }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", shear_x = "100 Pa", pillars = [[2, 2], [3, 4]] }
)";

Json answer_of(const SceneText& scene, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"simulate", scene.path(), "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const CommandOutcome outcome = run_command(words);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return Json::parse(outcome.out);
}

const Json& map_named(const Json& answer, const std::string& name) {
  for (const Json& map : answer.at("maps")) {
    if (map.at("name") == name) return map;
  }
  throw std::runtime_error("no map " + name);
}

std::vector<double> column_of(const CsvTable& table, const std::string& header) {
  for (const CsvColumn& column : table.columns) {
    if (column.header == header) return column.values;
  }
  throw std::runtime_error("no column " + header);
}

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("only memory limits the number of pillars", "[cli][scene][array]") {
  const auto with_rows = [](const std::string& count) {
    std::string text = kSpace;
    text.replace(text.find("rows = 3"), 8, "rows = " + count);
    text.replace(text.find("columns = 4"), 11, "columns = " + count);
    return text;
  };
  const SceneText endless(with_rows("100000"));
  const CommandOutcome refused = run_command({"plan", endless.path()});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Catch::Contains("1e+10 pillars") && Catch::Contains("of memory"));
  const SceneText large(with_rows("460"));  // 211 600
  const CommandOutcome planned = run_command({"plan", large.path()});
  CAPTURE(planned.err);
  CHECK(planned.status == 0);
}

TEST_CASE("an array in the plane is maps in JSON, with the places of its pillars",
          "[cli][scene][array]") {
  const SceneText scene(kSpace);
  const Json answer = answer_of(scene);
  CHECK(answer.at("maps").size() == 7);
  const Json& pillars = answer.at("pillars");
  REQUIRE(pillars.at("row").size() == 11);
  CHECK(pillars.at("row")[3] == 2);  // [1, 4] is dead
  CHECK(pillars.at("column")[3] == 1);
  CHECK(pillars.at("x_m")[3].get<double>() == Approx(-150e-6));
  CHECK(pillars.at("y_m")[10].get<double>() == Approx(100e-6));
  const Json& mean = map_named(answer, "mean_voltage");
  CHECK(mean.at("unit") == "V");
  CHECK(mean.at("values").size() == 11);
  CHECK(mean.at("values")[4].get<double>() ==
        answer.at("results").at("mean_voltage_2_2").at("value").get<double>());
  CHECK(mean.at("smallest").get<double>() <= mean.at("values")[4].get<double>());
  CHECK(mean.at("error_estimate").get<double>() > 0.0);
  CHECK(mean.at("error_estimate").get<double>() <=
        1e-2 * std::abs(mean.at("smallest").get<double>()));
  CHECK(map_named(answer, "crosstalk_percent").at("values")[4].is_null());  // bears a load
}

TEST_CASE("the files of an array hold the numbers of its JSON", "[cli][scene][array]") {
  const SceneText scene(kSpace);
  const std::filesystem::path folder = scene.beside("out");
  const Json answer = answer_of(scene, {"--out", folder.string()});
  const CsvTable table = read_csv(folder / "pillars.csv");
  CHECK(column_of(table, "row").size() == 11);
  CHECK(column_of(table, "shear_x_Pa")[4] == 100.0);
  CHECK(column_of(table, "pressure_Pa")[3] == 0.0);
  for (const Json& map : answer.at("maps")) {
    const std::string name = map.at("name");
    const bool is_percent = map.at("unit") == "%";
    CAPTURE(name);
    const std::vector<double> column = column_of(table, is_percent ? name : name + "_V");
    const std::string bytes = read_file(folder / (name + ".npy"));
    REQUIRE(bytes.size() == 128 + 3 * 4 * sizeof(double));
    std::vector<double> matrix(12);
    std::memcpy(matrix.data(), bytes.data() + 128, 12 * sizeof(double));
    CHECK(std::isnan(matrix[3]));  // the dead one
    for (std::size_t i = 0; i < 11; ++i) {
      const std::size_t at = i < 3 ? i : i + 1;
      if (map.at("values")[i].is_null()) {
        CHECK(std::isnan(column[i]));
        CHECK(std::isnan(matrix[at]));
        continue;
      }
      CHECK(column[i] == Approx(map.at("values")[i].get<double>()).epsilon(1e-8));
      CHECK(matrix[at] == map.at("values")[i].get<double>());
    }
    CHECK(times_in(read_file(folder / (name + ".svg")), "<circle") == 11);
  }
  CHECK(std::filesystem::exists(folder / "results.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "mean_voltage_3.svg"));  // no curve over "pillar 4"
}

TEST_CASE("a .npy file is what numpy.save writes", "[io][tables]") {
  // Bytes of numpy.save(f, numpy.array([[1.5, -2.0]])) of NumPy 1.24.2.
  const std::string bytes = npy_from_matrix({1.5, -2.0}, 1, 2);
  REQUIRE(bytes.size() == 144);
  CHECK(bytes.substr(0, 10) == std::string("\x93NUMPY\x01\x00\x76\x00", 10));
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }";
  CHECK(bytes.substr(10, header.size()) == header);
  CHECK(bytes.substr(10 + header.size(), 118 - header.size()) ==
        std::string(117 - header.size(), ' ') + "\n");
  CHECK(bytes.substr(128) ==
        std::string("\x00\x00\x00\x00\x00\x00\xf8\x3f\x00\x00\x00\x00\x00\x00\x00\xc0", 16));
  CHECK_THROWS_AS(npy_from_matrix({1.0}, 1, 2), std::invalid_argument);
}

TEST_CASE("places of pillars from a file answer as the lattice that they form",
          "[cli][scene][array]") {
  const SceneText scene(replaced(
      replaced(replaced(replaced(kSpace, "rows = 3\ncolumns = 4\n", "positions = \"places.csv\"\n"),
                        "spacing = \"60 um\"\ndead = [[1, 4]]\n", ""),
               "[[2, 2], [3, 4]]", "[[5, 1], [11, 1]]"),
      "quadrants = true", "quadrants = false"));
  std::string table = "nr,Y (mm),x_um\n";
  for (int row = 1; row <= 3; ++row) {
    for (int column = 1; column <= 4; ++column) {
      if (row == 1 && column == 4) continue;
      table += "1," + std::to_string(0.1 * row) + "," + std::to_string(100 * column) + "\n";
    }
  }
  write_file(scene.beside("places.csv"), table, true);
  const Json listed = answer_of(scene);
  const Json lattice = answer_of(SceneText(kSpace));
  const Json &values = map_named(listed, "centre_voltage").at("values"),
             &expected = map_named(lattice, "centre_voltage").at("values");
  REQUIRE(values.size() == 11);
  for (std::size_t i = 0; i < 11; ++i) {
    CHECK(values[i].get<double>() == Approx(expected[i].get<double>()).epsilon(1e-6));
  }
}

TEST_CASE("places of pillars that cannot be read are refused with the file",
          "[cli][scene][array]") {
  struct Case {
    const char *table, *what;
  };
  const Case one = GENERATE(Case{"x [um],z [um]\n1,2\n3,4\n", "needs the columns x and y"},
                            Case{"x,y [um]\n1,2\n3,4\n", "needs a unit of length"},
                            Case{"x [um],y [um]\n1,2\n3,a\n", "not a finite number"},
                            Case{"x [um],y [um]\n0,0\n30,0\n", "tenth of their diameter"});
  const SceneText scene(
      replaced(replaced(replaced(kSpace, "rows = 3\ncolumns = 4\n", "positions = \"places.csv\"\n"),
                        "spacing = \"60 um\"\ndead = [[1, 4]]\n", ""),
               ", pillars = [[2, 2], [3, 4]]", ""));
  write_file(scene.beside("places.csv"), one.table, true);
  const CommandOutcome outcome = run_command({"simulate", scene.path()});
  CAPTURE(outcome.err, one.table);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find(one.what) != std::string::npos);
}

TEST_CASE("plan and cost of an array in the plane", "[cli][scene][array]") {
  const SceneText scene(kSpace);
  const CommandOutcome plan = run_command({"plan", scene.path(), "--json"});
  REQUIRE(plan.status == 0);
  bool needs_neighbours = false;
  const Json planned = Json::parse(plan.out);
  for (const Json& effect : planned.at("effects")) {
    needs_neighbours = needs_neighbours || (effect.at("name") == "crosstalk" && effect.at("on"));
  }
  CHECK(needs_neighbours);
  // A budget that a busy machine does not use up: the study takes some seconds.
  const CommandOutcome cost = run_command({"cost", scene.path(), "--json", "--budget", "300s"});
  REQUIRE(cost.status == 0);
  const Json rows = Json::parse(cost.out).at("rows");
  REQUIRE(rows.size() >= 4);
  CHECK(rows[0].at("discretisation") == "graded p3, 1 layer");
  for (std::size_t i = 1; i < 4; ++i) CHECK(rows[i].at("error") < rows[i - 1].at("error"));
  for (const Json& row : rows) {
    CHECK(row.at("discretisation").get<std::string>().starts_with("graded"));
  }
}
