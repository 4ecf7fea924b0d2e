#include "io/cli/scene/answer_output.h"
#include "io/results/result_json.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sstream>

using namespace viscard;

namespace {

SceneAnswer answer() {
  SceneAnswer out;
  out.results.push_back({"potential_at_centre", -4.1231e-3, "V", 1e-7});
  out.modes.push_back({"lateral", 1, 16026.87, 0.1});
  out.modes.push_back({"torsion", 0, 55165.77, 0.1});
  out.modes.push_back({"lateral", 1, 77403.97, 0.1});
  return out;
}

}  // namespace

TEST_CASE("values printed elsewhere stand beside ours with the difference of their sizes",
          "[cli]") {
  const std::vector<PrintedComparison> rows = compare_printed(
      {{"lateral 2", "77.76 kHz", "coarse mesh"}, {"potential_at_centre", "4.12 mV", ""}},
      answer());
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].ours == 77403.97);
  CHECK(rows[0].printed == Approx(77760.0).epsilon(1e-12));
  CHECK(rows[0].difference_percent == Approx(0.460).epsilon(2e-3));  // printed digits
  // Signs are conventions of poling: sizes are compared.
  CHECK(rows[1].difference_percent == Approx(100.0 * (4.12 / 4.1231 - 1.0)).epsilon(1e-9));
  std::ostringstream text;
  print_comparison(rows, text);
  CHECK_THAT(text.str(), Catch::Contains("lateral 2") && Catch::Contains("coarse mesh"));
  CHECK(json_from_result(ShownAnswer{.printed = rows})["printed"][1]["unit"] == "V");
}

TEST_CASE("a printed value that the answer does not have is refused with the nearest name",
          "[cli]") {
  CHECK_THROWS_WITH(compare_printed({{"laterl 1", "1 Hz", ""}}, answer()),
                    Catch::Contains("laterl 1") && Catch::Contains("lateral 1"));
  CHECK_THROWS(compare_printed({{"lateral 1", "4 mV", ""}}, answer()));  // not a frequency
}

TEST_CASE("percentages are compared in points, with their sign", "[cli]") {
  SceneAnswer row;
  row.results = {{"coupling_percent_1", -0.0587, "%", 1e-3}};
  const auto rows = compare_printed({{"coupling_percent_1", "-0.06 %", ""}}, row);
  CHECK(*rows.at(0).difference_points == Approx(-0.0013).epsilon(1e-9));
  std::ostringstream text;
  print_comparison(rows, text);
  CHECK_THAT(text.str(), Catch::Contains("-0.0013 points"));
  CHECK(json_from_result(ShownAnswer{.printed = rows})["printed"][0]["difference_points"] ==
        *rows[0].difference_points);
  CHECK_FALSE(compare_printed({{"lateral 1", "1 Hz", ""}}, answer()).at(0).difference_points);
}

TEST_CASE("a scene without printed values prints no table", "[cli]") {
  std::ostringstream text;
  print_comparison(compare_printed({}, answer()), text);
  CHECK(text.str().empty());
}
