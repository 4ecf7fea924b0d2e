// Headers and orders of rows in tables of tests at large strain.
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
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
