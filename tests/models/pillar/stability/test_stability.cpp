#include "tests/models/pillar/stability/stability_cases.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

using namespace viscard::test;

namespace {

const std::string kTable = VISCARD_SOURCE_DIR "/tests/golden/pillar_stability.csv";
const std::string kHead = "case;relative error;bound;true error over claimed\n";

std::vector<StabilityCase> all_cases() {
  std::vector<StabilityCase> all = elastic_stability_cases();
  for (auto part : {viscoelastic_stability_cases(), electric_and_unit_stability_cases(),
                    answer_stability_cases(), touch_stability_cases()}) {
    std::move(part.begin(), part.end(), std::back_inserter(all));
  }
  return all;
}

std::string read(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Row {
  std::string name;
  double error = 0.0;
  double bound = 0.0;
  std::optional<double> of_claim;  // what the answer's own estimate covers: 1 and less is honest
};

std::string table_of(const std::vector<Row>& rows) {
  std::string text = kHead;
  for (const Row& row : rows) {
    const std::string share = row.of_claim ? fmt::format("{:.2f}", *row.of_claim) : "";
    // Below 1e-13 is rounding, which differs from machine to machine.
    const std::string error = row.error < 1e-13 ? "< 1e-13" : fmt::format("{:.1e}", row.error);
    text += fmt::format("{};{};{:.1e};{}\n", row.name, error, row.bound, share);
  }
  return text;
}

std::vector<Row> rows_of(const std::string& table) {
  std::vector<Row> rows;
  std::istringstream lines(table.substr(kHead.size()));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string name, error, bound, share;
    std::getline(cells, name, ';');
    std::getline(cells, error, ';');
    std::getline(cells, bound, ';');
    std::getline(cells, share, ';');
    Row row{name, error[0] == '<' ? 0.0 : std::stod(error), std::stod(bound), std::nullopt};
    if (!share.empty()) row.of_claim = std::stod(share);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_CASE("the stability suite stays within its bounds and the kept table of errors",
          "[pillar][stability][golden]") {
  std::vector<Row> rows;
  for (const StabilityCase& c : all_cases()) {
    const Seen seen = c.error();
    rows.push_back({c.name, seen.error, c.bound, seen.of_claim});
    CAPTURE(c.name, seen.error, seen.of_claim.value_or(0.0));
    CHECK(seen.error <= c.bound);  // false for a NaN
    CHECK(seen.of_claim.value_or(0.0) <= 1.0);
  }
  if (std::getenv("VISCARD_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(kTable) << table_of(rows);
    return;
  }
  const std::string kept = read(kTable);
  REQUIRE(kept.rfind(kHead, 0) == 0);
  const std::vector<Row> written = rows_of(kept);
  REQUIRE(written.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(rows[i].name, rows[i].error);
    CHECK(written[i].name == rows[i].name);
    CHECK(written[i].bound == Approx(rows[i].bound).epsilon(1e-12));
    // Errors that are rounding or near it may differ by a machine's arithmetic.
    const double allowed = rows[i].error < 1e-8 ? 100.0 : 1.3;
    CHECK(rows[i].error <= allowed * written[i].error + 1e-12);
    CHECK(written[i].error <= allowed * rows[i].error + 1e-12);
    REQUIRE(written[i].of_claim.has_value() == rows[i].of_claim.has_value());
    // A share of 0.00 is printed for less than half a hundredth.
    CHECK(written[i].of_claim.value_or(0.0) ==
          Approx(rows[i].of_claim.value_or(0.0)).epsilon(0.3).margin(0.01));
  }
}
