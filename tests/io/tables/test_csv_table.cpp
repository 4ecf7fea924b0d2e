#include "io/tables/csv_table.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace viscard {
namespace {

using test::contains;
using test::error_text;

CsvTable read(const std::string& text) {
  return csv_from_text(text, "t.csv");
}

std::string error_of(const std::string& text) {
  return error_text([&] { csv_from_text(text, "t.csv"); });
}

std::string utf16(const std::string& ascii, bool is_big_endian, bool has_bom) {
  std::string out = has_bom ? (is_big_endian ? "\xfe\xff" : "\xff\xfe") : "";
  for (const char c : ascii) {
    if (is_big_endian) out += '\0';
    out += c;
    if (!is_big_endian) out += '\0';
  }
  return out;
}

TEST_CASE("the same table is read from every way of writing it", "[io][csv]") {
  const std::string comma = "time_s,force_N\n0,1.5\n0.25,-2e-3\n";
  const auto text = GENERATE_COPY(
      as<std::string>{}, comma, "time_s;force_N\n0;1,5\n0,25;-2e-3\n",
      "time_s\tforce_N\n0\t1.5\n0.25\t-2e-3\n", "time_s force_N\n0 1.5\n0.25 -2e-3\n",
      "  time_s    force_N\n  0.0     1.5  \n\t0.25 \t -2e-3\n",
      "time_s, force_N\n0, 1.5\n.25, -2E-03\n", "time_s,force_N\r\n0,1.5\r\n0.25,-2e-3\r\n",
      "time_s,force_N\r0,1.5\r0.25,-2e-3", "\xef\xbb\xbftime_s,force_N\n0,1.5\n0.25,-2e-3\n",
      "# made by hand\n\n% a note\n// another\ntime_s,force_N\n\n0,1.5\n# in between\n0.25,-2e-3\n",
      "# time_s force_N\n0 1.5\n0.25 -2e-3\n",
      "\"time_s\",\"force_N\"\n\"0\",\"+1.5\"\n0.25,-2e-3\n",
      "time_s,force_N,\n0,1.5,\n0.25,-2e-3,\n", "0 1,5\n0,25 -2e-3\n", utf16(comma, false, true),
      utf16(comma, true, true), utf16(comma, false, false), utf16(comma, true, false));
  CAPTURE(text);
  const CsvTable table = read(text);
  REQUIRE(table.columns.size() == 2);
  if (table.has_header) {
    CHECK(table.columns[0].header == "time_s");
    CHECK(table.columns[1].header == "force_N");
  }
  CHECK(table.columns[0].values == std::vector<double>{0.0, 0.25});
  CHECK(table.columns[1].values == std::vector<double>{1.5, -2e-3});
}

TEST_CASE("units are read from brackets, after a slash or from a row of units", "[io][csv]") {
  const auto unit_of = [](const std::string& header) {
    return read(header + "\n1;2\n").columns[0].unit;
  };
  const auto name_of = [](const std::string& header) {
    return read(header + "\n1;2\n").columns[0].name;
  };
  CHECK(unit_of("Force [nN];x") == "nN");
  CHECK(name_of("Force [nN];x") == "Force");
  CHECK(unit_of("Time (s);x") == "s");
  CHECK(unit_of("Kraft / mN;x") == "mN");
  CHECK(unit_of("t/s;x") == "s");
  CHECK(unit_of("Time, s;x") == "s");
  CHECK(unit_of("Weg (\xb5m);x") == "µm");  // Latin-1
  CHECK(unit_of("E(t);x").empty());         // an argument, not tonnes
  CHECK(name_of("E(t);x") == "E(t)");
  CHECK(unit_of("Channel (left);x").empty());
  CHECK(unit_of("time_s;x").empty());
  const CsvTable rows = read("t,E_relax\ns, MPa\n0.1,5\n");
  CHECK(rows.columns[0].unit == "s");
  CHECK(rows.columns[1].unit == "MPa");
  CHECK(rows.columns[1].values == std::vector<double>{5.0});
  CHECK(read("f,Set\n[Hz],[-]\n1,0\n").columns[0].unit == "Hz");
  CHECK(read("strain,E\n%, MPa\n1,2\n").columns[0].unit == "%");
  const CsvTable blanks = read("Time (s) Force (N)\n0 1\n");
  REQUIRE(blanks.columns.size() == 2);
  CHECK(blanks.columns[1].name == "Force");
  CHECK(blanks.columns[1].unit == "N");
}

TEST_CASE("lines before the header are kept as notes", "[io][csv]") {
  const CsvTable table =
      read("Sample;PDMS 1:10\nDiameter;4,4\nRelaxation\n\nt [s];F [N];h [mm]\n0,0;1,0;2,5\n");
  REQUIRE(table.columns.size() == 3);
  CHECK(table.preamble ==
        std::vector<std::string>{"Sample;PDMS 1:10", "Diameter;4,4", "Relaxation"});
  CHECK(table.columns[2].unit == "mm");
  CHECK(table.columns[2].values == std::vector<double>{2.5});
  CHECK(table.lines.all() == std::vector<std::uint32_t>{6});
}

TEST_CASE("columns of text stay text, and bad cells of numbers are remembered", "[io][csv]") {
  const CsvTable table =
      read("segment,time_s\nextend,0\npause,1\n\"a \"\"b\"\"\",oops\npause,nan\n");
  CHECK(table.columns[0].text == std::vector<std::string>{"extend", "pause", "a \"b\"", "pause"});
  CHECK(table.columns[1].first_bad_line == 4);
  CHECK(table.columns[1].first_bad_cell == "oops");
  CHECK(std::isnan(table.columns[1].values[2]));
  CHECK(std::isnan(table.columns[1].values[3]));
  CHECK(table.columns[1].text == std::vector<std::string>{"0", "1", "oops", "nan"});
  const CsvTable gap = read("a,b\n1,2\n3,\n");
  CHECK(gap.columns[1].first_bad_line == 3);
  CHECK(gap.columns[1].first_bad_cell.empty());
  CHECK(gap.columns[1].text.empty());
  CHECK(read("a,b\n1,1e999\n").columns[1].first_bad_line == 2);
  CHECK(read("a,b\n1,1e-999\n").columns[1].values == std::vector<double>{0.0});
}

TEST_CASE("a file that is not a table is refused with file and line", "[io][csv]") {
  CHECK(error_of("") == "t.csv: is empty; expected a table of numbers");
  CHECK(error_of("\n# only a comment\n") == "t.csv: is empty; expected a table of numbers");
  CHECK(contains(error_of("a,b\nc,d\n"), "t.csv: has no line with a number"));
  CHECK(error_of("time_s,force_N\n0,1\n1,2\n2\n3,4\n") ==
        "t.csv:4: 1 cells, but the table has 2 columns");
  CHECK(error_of("a,b\n0,1\n1,2,3\n2,3\n") == "t.csv:3: 3 cells, but the table has 2 columns");
  CHECK(contains(error_of(std::string("a,b\n0,\0\n", 8)), "t.csv: is not a text table"));
  CHECK(contains(error_of("a;b\n1,5;2.5\n"), "has a decimal comma and line 2 a decimal point"));
  CHECK(contains(error_of("a,b\n\"1,2\n"), "t.csv: line 2: a quote is not closed"));
  CHECK(contains(error_text([] { read_csv("/nowhere/t.csv"); }), "/nowhere/t.csv: cannot open"));
}

TEST_CASE("a bad number far down in a long table is found with its line", "[io][csv]") {
  std::string text = "time_s,force_N\n";
  for (int i = 0; i < 5000; ++i) text += std::to_string(i) + (i == 4321 ? ",abc\n" : ",1\n");
  const CsvTable table = read(text);
  CHECK(table.columns[1].first_bad_line == 4323);
  CHECK(table.columns[1].first_bad_cell == "abc");
}

}  // namespace

TEST_CASE("each row knows its line, also across comments and blank lines", "[io][csv]") {
  const CsvTable table = read("time_s,force_N\n0,1\n1,2\n\n# a note\n2,3\n3,4\n4,5\n");
  CHECK(table.lines.all() == std::vector<std::uint32_t>{2, 3, 6, 7, 8});
  CHECK(table.lines[2] == 6);
  CHECK(table.lines.size() == 5);
}

TEST_CASE("columns without end are refused with the limit", "[io][csv]") {
  std::string header = "time_s", row = "0";
  for (int i = 0; i < 20000; ++i) {
    header += ",c" + std::to_string(i);
    row += ",1";
  }
  CHECK(contains(error_of(header + "\n" + row + "\n" + row + "\n"),
                 "t.csv: line 1: has more than 16384 columns, the limit"));
}

}  // namespace viscard
