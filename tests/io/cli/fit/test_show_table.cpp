// How a table is read, without its fit; and the curves of a fit.
#include "io/basics/atomic_file.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace viscard {
namespace {

using nlohmann::json;
using test::contains;
using test::run_command;
using test::ScratchFolder;

json shown(const std::string& file, std::vector<std::string> words = {}) {
  words.insert(words.begin(), {"fit", file, "--show-table", "--json"});
  const auto outcome = run_command(words);
  INFO(outcome.err);
  REQUIRE(outcome.status == kDone);
  return json::parse(outcome.out);
}

TEST_CASE("a table is shown as it is read: columns, quantities, units, guesses, gaps",
          "[cli][fit]") {
  ScratchFolder scratch;
  const std::string file = (scratch / "a.csv").string();
  write_file(file, "t (ms);E;Note\n1;2000;a\n2;1500;b\n3;;c\n4;1200;d\n", false);
  const json table = shown(file);
  INFO(table.dump(1));
  CHECK(table.at("schema") == "viscard-table/1");
  CHECK(table.at("separator") == "semicolon");
  CHECK(table.at("n_rows") == 4);
  CHECK(table.at("kind") == "relaxation");
  CHECK(table.at("kind_trouble") == "");
  CHECK(table.at("lines") == json({2, 3, 4, 5}));
  const json& time = table.at("columns").at(0);
  CHECK(time.at("quantity") == "time_s");
  CHECK(time.at("used") == true);
  CHECK(time.at("factor") == 1e-3);
  CHECK(time.at("guessed") == "");
  const json& modulus = table.at("columns").at(1);
  CHECK(modulus.at("quantity") == "modulus_Pa");
  CHECK(contains(modulus.at("guessed"), "no unit is stated; it was taken as in SI, Pa"));
  CHECK(modulus.at("n_gaps") == 1);
  CHECK(contains(modulus.at("first_gap"), "line 4"));
  CHECK(modulus.at("cells") == json({"2000", "1500", "", "1200"}));
  const json& note = table.at("columns").at(2);
  CHECK(note.at("quantity") == "");
  CHECK(note.at("used") == false);
  CHECK(note.at("cells").at(0) == "a");
  const json stated = shown(file, {"--column", "modulus_Pa=E [kPa]"});
  CHECK(stated.at("columns").at(1).at("factor") == 1e3);
  CHECK(stated.at("columns").at(1).at("guessed") == "");
}

TEST_CASE("a table of no known test is shown with the reason, and not refused", "[cli][fit]") {
  ScratchFolder scratch;
  const std::string file = (scratch / "a.csv").string();
  write_file(file, "alpha,beta\n1,2\n2,3\n3,4\n", false);
  const json table = shown(file);
  CHECK(table.at("kind") == "");
  CHECK(contains(table.at("kind_trouble"), "no known column to fit"));
  CHECK(table.at("columns").size() == 2);
  const auto text = run_command({"fit", file, "--show-table"});
  CHECK(text.status == kDone);
  CHECK(contains(text.out, "column 2 'beta': not known"));
  CHECK(run_command({"fit", file, "--show-table", "--out", "m.json"}).status == kBadWords);
  CHECK(run_command({"fit", "relaxation=" + file, "--show-table"}).status == kBadWords);
  CHECK(run_command({"fit", (scratch / "none.csv").string(), "--show-table"}).status == kFailed);
}

TEST_CASE("fit --curves adds data and fit to the object, as --csv writes them", "[cli][fit]") {
  const std::string file = VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv";
  const json plain = json::parse(run_command({"fit", file, "--json"}).out);
  const json with = json::parse(run_command({"fit", file, "--json", "--curves"}).out);
  CHECK_FALSE(plain.contains("curves"));
  const json& curves = with.at("curves");
  CHECK(curves.at("argument") == "time_s");
  const json& column = curves.at("columns").at(0);
  CHECK(column.at("name") == "modulus_Pa");
  const std::size_t n = curves.at("values").size();
  REQUIRE(n > 10);
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double sigma = column.at("sigma").at(i);
    const double residual =
        column.at("measured").at(i).get<double>() - column.at("fitted").at(i).get<double>();
    squares += residual * residual / (sigma * sigma);
  }
  // White noise of the stated size: 1 on average, within five of its standard deviations.
  CHECK(squares / static_cast<double>(n) ==
        Approx(1.0).margin(5.0 * std::sqrt(2.0 / static_cast<double>(n))));
  CHECK(run_command({"fit", file, "--curves"}).status == kBadWords);
  CHECK(run_command({"fit", file, file, "--json", "--curves"}).status == kBadWords);
}

}  // namespace
}  // namespace viscard
