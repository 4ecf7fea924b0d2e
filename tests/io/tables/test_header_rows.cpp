// Rows above the numbers: titles, headers, units, and columns that separators leave.
#include "io/tables/column_map.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard {
namespace {

CsvTable read_header_rows(const std::string& text) {
  return csv_from_text(text, "t.csv");
}

}  // namespace

TEST_CASE(
    "titles as wide as the table, empty lines and separators behind the numbers keep the header",
    "[io][csv]") {
  // An empty line is no row of units: the title above it is no header.
  const CsvTable titles = read_header_rows(
      "Pr\u00fcfbericht;;\nProbe;PDMS 1:10;\n;;\nPr\u00fcfzeit;Standardkraft;Standardweg\n"
      "s;N;mm\n0,5;1,5;0,2\n0,6;1,6;0,3\n");
  CHECK(column_SI(titles, "force_N")[1] == Approx(1.6).epsilon(1e-15));
  CHECK(column_SI(titles, "depth_m")[0] == Approx(0.2e-3).epsilon(1e-15));
  const CsvTable between =
      read_header_rows("Temps;Force normale;D\u00e9placement\n;;\n(s);(mN);(mm)\n0;1;2\n1;2;3\n");
  CHECK(column_SI(between, "force_N")[1] == Approx(2e-3).epsilon(1e-15));
  CHECK(between.columns[0].values.size() == 2);
  // Only the lines of numbers end with a separator; the row of units begins with a blank cell.
  const CsvTable behind =
      read_header_rows("Zeit;Spannung;Dehnung\n;MPa;%\n0,5;1,5;5,0;\n0,6;1,6;5,0;\n");
  REQUIRE(behind.columns.size() == 3);
  CHECK(column_SI(behind, "stress_Pa")[1] == Approx(1.6e6).epsilon(1e-15));
  CHECK(column_SI(behind, "strain")[0] == Approx(0.05).epsilon(1e-15));
}

TEST_CASE("Chinese units and the columns of a compression test are understood", "[io][csv]") {
  const CsvTable chinese = read_header_rows(
      "\u65f6\u95f4(\u79d2),\u5e94\u529b(\u5343\u5e15),\u5e94\u53d8(%)\n0,1,5\n1,2,5\n");
  CHECK(column_SI(chinese, "stress_Pa")[1] == Approx(2e3).epsilon(1e-15));
  CHECK(column_SI(chinese, "strain")[1] == Approx(0.05).epsilon(1e-15));
  const CsvTable compression = read_header_rows(
      "\"Time\",\"Compressive extension\",\"Compressive "
      "load\"\n\"(s)\",\"(mm)\",\"(N)\"\n0,1,2\n1,2,3\n");
  CHECK(column_SI(compression, "depth_m")[1] == Approx(2e-3).epsilon(1e-15));
  CHECK(column_SI(compression, "force_N")[1] == Approx(3.0).epsilon(1e-15));
}

}  // namespace viscard
