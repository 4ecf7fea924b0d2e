// Headers and orders of rows in tables of tests at large strain.
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using namespace viscard::test;
using Catch::Contains;

TEST_CASE("headers of the nominal strain are known at large strain, with each unit", "[cli]") {
  const TableFolder folder;
  for (const std::string header : {"nominal strain", "engineering strain", "Nominal Strain [mm/mm]",
                                   "engineering strain [%]", "Nenndehnung [-]"}) {
    CAPTURE(header);
    const double unit = header.find('%') == std::string::npos ? 1.0 : 100.0;
    std::ostringstream table;
    table << "time_s," << header << ",nominal stress [MPa]\n";
    for (int i = 1; i <= 20; ++i) {
      const double s = 1.0 + 0.05 * i;
      table << i << "," << unit * (s - 1.0) << "," << 0.4 * (s - 1.0 / (s * s)) << "\n";
    }
    const auto run = run_command({"fit", "uniaxial=" + folder.write("strain.csv", table.str()),
                                  "--model", "neo-hooke", "--json"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    const auto json = nlohmann::json::parse(run.out);
    CHECK(json["laws"][0]["E0_Pa"].get<double>() == Approx(1.2e6).epsilon(1e-4));
    CHECK(json["tests"][0]["stretch"][1].get<double>() == Approx(2.0));
  }
}

TEST_CASE("a sorted table from compression to tension keeps all of its rows", "[cli]") {
  const TableFolder folder;
  std::vector<double> stretches;
  for (int i = 0; i < 20; ++i) stretches.push_back(0.6 + 0.1 * i);
  for (const bool is_descending : {false, true}) {
    if (is_descending) std::reverse(stretches.begin(), stretches.end());
    std::ostringstream table;
    table << "stretch,nominal_stress_Pa\n";
    for (const double s : stretches) table << s << "," << 4e5 * (s - 1.0 / (s * s)) << "\n";
    const std::string word = "uniaxial=" + folder.write("sorted.csv", table.str());
    const auto run = run_command({"fit", word, "--model", "neo-hooke"});
    CHECK(run.status == 0);
    CHECK_THAT(run.out, Contains("1 test at large strain, 20 readings") && Contains("0.6 to 2.5") &&
                            !Contains("left out"));
  }
}

TEST_CASE("cycles whose rows are not in the order of time are refused with their times", "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  table << "time_s,stretch,nominal_stress_Pa\n";
  std::vector<int> order(61);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(1);
  std::shuffle(order.begin(), order.end(), random);
  for (const int at : order) {
    const double s = 1.0 + 0.02 * at;
    table << at << "," << s << "," << 4e5 * (s - 1.0 / (s * s)) << "\n";
  }
  const std::string word = "uniaxial=" + folder.write("shuffled.csv", table.str());
  const auto run = run_command({"fit", word});
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("shuffled.csv: the times do not ascend") &&
                          Contains("sort the rows by time"));
  CHECK(run_command({"fit", word, "--model", "neo-hooke", "--cycle", "all"}).status == 0);
}

TEST_CASE("an unsorted table of one curve without times is sorted, not taken for cycles", "[cli]") {
  const TableFolder folder;
  std::vector<double> stretches;
  for (int i = 0; i < 20; ++i) stretches.push_back(1.0 + 0.05 * i);
  const auto printed = [&](double softening, const std::vector<std::string>& more) {
    std::ostringstream table;
    table << "stretch,nominal_stress_Pa\n";
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const double s = stretches[i];
      table << s << "," << (i % 2 == 0 ? 1.0 : 1.0 - softening) * 4e5 * (s - 1.0 / (s * s)) << "\n";
    }
    std::vector<std::string> words{"fit", "uniaxial=" + folder.write("rows.csv", table.str()),
                                   "--model", "neo-hooke"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  };
  const std::string sorted = printed(0.0, {}).out;
  std::mt19937_64 random(3);
  std::shuffle(stretches.begin(), stretches.end(), random);
  const auto shuffled = printed(0.0, {});
  CHECK(shuffled.status == 0);
  CHECK(shuffled.out == sorted);
  CHECK_THAT(shuffled.out, Contains("20 readings") && !Contains("left out"));
  // Rows that are neither a curve nor cycles.
  const auto neither = printed(0.3, {});
  CHECK(neither.status == 1);
  CHECK_THAT(neither.err, Contains("rows.csv: the stretch turns back in") &&
                              Contains("sort the rows by stretch"));
  CHECK_THAT(printed(0.3, {"--cycle", "all"}).out, Contains("20 readings"));
}

TEST_CASE("a damaged file of a rubber whose schema is its last key is not called a material",
          "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  table << "stretch,nominal_stress_Pa\n";
  for (int i = 0; i < 20; ++i) {
    const double s = 1.0 + 0.05 * i;
    table << s << "," << 4e5 * (s - 1.0 / (s * s)) << "\n";
  }
  const std::string out = folder.file("whole.json");
  REQUIRE(run_command({"fit", "uniaxial=" + folder.write("rows.csv", table.str()), "--model",
                       "neo-hooke", "--out", out})
              .status == 0);
  std::ifstream file(out);
  auto json = nlohmann::ordered_json::parse(file);
  const auto schema = json["schema"];
  json.erase("schema");
  json["schema"] = schema;
  json["laws"][0]["parameters"][0]["name"] = "mu";
  const auto run = run_command({"card", folder.write("bad.json", json.dump()), "--for", "abaqus"});
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("parameter 1 must be C10_Pa") && !Contains("is a material"));
}

TEST_CASE("a table of a damaged capture gives a law of rubber only with a flag", "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  table << "# load-cell samples of a capture, written by viscard 0.1.0\n"
           "# damage: unverified: its moves are damaged\nstretch,nominal_stress_Pa\n";
  for (int i = 1; i <= 20; ++i) {
    const double s = 1.0 + 0.05 * i;
    table << s << "," << 4e5 * (s - 1.0 / (s * s)) << "\n";
  }
  const std::string word = "uniaxial=" + folder.write("damaged.csv", table.str());
  const auto refused = run_command({"fit", word, "--model", "neo-hooke"});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Contains("was exported from a damaged capture"));
  const auto run = run_command({"fit", word, "--model", "neo-hooke", "--unverified", "--json"});
  INFO(run.err);
  CHECK(run.status == 1);  // as of a capture
  const auto json = nlohmann::json::parse(run.out);
  CHECK_FALSE(json["trustworthy"].get<bool>());
  CHECK_THAT(json["laws"][0]["flags"].dump(), Contains("unverified"));
}
