// Files that are large for what they hold: reading them ends, and what has no use is refused with its limit.
#include "io/tables/csv_table.h"
#include "io/tables/known_names.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard {
namespace {

using test::contains;
using test::error_text;

TEST_CASE("thousands of tables below each other are read", "[io][csv]") {
  constexpr int kTables = 3000;
  const std::string end = GENERATE(as<std::string>{}, "\n", "\r", "\r\n");
  std::string text;
  for (int i = 0; i < kTables; ++i) {
    text += "time_s,modulus_Pa" + end + "1,3e6" + end + "2," + std::to_string(i + 1) + end + end;
  }
  const CsvTable last = csv_from_text(text, "t.csv", {.sheet = "", .table = kTables, .skip = 0});
  REQUIRE(last.columns.size() == 2);
  CHECK(last.columns[1].values == std::vector<double>{3e6, kTables});
  CHECK(last.lines.all() == std::vector<std::uint32_t>{4 * kTables - 2, 4 * kTables - 1});
  CHECK(contains(error_text([&] {
                   csv_from_text(text, "t.csv", {.sheet = "", .table = kTables + 1, .skip = 0});
                 }),
                 "there are 3000"));
}

TEST_CASE("a table that is not the first has its rows at their lines, however long its lines are",
          "[io][csv]") {
  const std::string note(10000, 'n');
  const std::string end = GENERATE(as<std::string>{}, "\n", "\r", "\r\n");
  const std::string text = "time_s,force_N" + end + "1,2" + end + note + end + "time_s,force_N" +
                           end + "3,4" + end + "5,6" + end + note;
  const CsvTable table = csv_from_text(text, "t.csv");
  REQUIRE(table.columns.size() == 2);
  CHECK(table.columns[0].values == std::vector<double>{3.0, 5.0});
  CHECK(table.lines.all() == std::vector<std::uint32_t>{5, 6});
}

TEST_CASE("words are looked up once, and no more of them than the limit", "[io][csv]") {
  KnownNames names;
  for (int i = 0; i < 1000; ++i) {
    CHECK(names.has("Force [mN]"));
    CHECK_FALSE(names.has("nothing of the kind"));
  }
  CHECK(names.n_looked_up() == 2);
  for (std::size_t i = 0; i < KnownNames::kMost + 10; ++i) names.has(std::to_string(i));
  CHECK(names.n_looked_up() == KnownNames::kMost);
  CHECK(names.has("Force [mN]"));
}

TEST_CASE("many lines of text below the numbers are left out", "[io][csv]") {
  std::string text = "time_s,modulus_Pa\n1,3e6\n2,2e6\n";
  for (int i = 0; i < 200000; ++i) text += "x,y\n";
  const CsvTable table = csv_from_text(text, "t.csv");
  CHECK(table.columns[0].values == std::vector<double>{1.0, 2.0});
}

}  // namespace
}  // namespace viscard
