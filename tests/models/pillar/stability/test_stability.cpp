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

const std::string kReadme = VISCARD_SOURCE_DIR "/models/pillar/README.md";
const std::string kStart =
    "<!-- stability table, written by the test \"the stability suite...\" -->\n";
const std::string kEnd = "<!-- end of the stability table -->\n";

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
  double worst = 0.0;
  for (const Row& row : rows) worst = std::max(worst, row.of_claim.value_or(0.0));
  std::string text =
      "\n| case | relative error | bound | true error over claimed |\n|---|---|---|---|\n";
  for (const Row& row : rows) {
    std::string share = row.of_claim ? fmt::format("{:.2f}", *row.of_claim) : "";
    if (row.of_claim == worst) share = "**" + share + "**";
    // Below 1e-13 is rounding, which differs from machine to machine.
    const std::string error = row.error < 1e-13 ? "< 1e-13" : fmt::format("{:.1e}", row.error);
    text += fmt::format("| {} | {} | {:.1e} | {} |\n", row.name, error, row.bound, share);
  }
  return text + "\n";
}

// The rows of the table, split at its lines.
std::vector<Row> rows_of(const std::string& table) {
  std::vector<Row> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0 || line.rfind("| case", 0) == 0) continue;
    const std::size_t a = line.find(" | ");
    const std::size_t b = line.find(" | ", a + 3);
    const std::string error = line.substr(a + 3, b - a - 3);
    Row row{line.substr(2, a - 2), error[0] == '<' ? 0.0 : std::stod(error),
            std::stod(line.substr(b + 3)), std::nullopt};
    std::string share = line.substr(line.find(" | ", b + 3) + 3);
    share.erase(std::remove(share.begin(), share.end(), '*'), share.end());
    if (share.find_first_of("0123456789") != std::string::npos) row.of_claim = std::stod(share);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_CASE("the stability suite stays within its bounds and the table in models/pillar/README.md",
          "[pillar][stability][golden]") {
  std::vector<Row> rows;
  for (const StabilityCase& c : all_cases()) {
    const Seen seen = c.error();
    rows.push_back({c.name, seen.error, c.bound, seen.of_claim});
    CAPTURE(c.name, seen.error, seen.of_claim.value_or(0.0));
    CHECK(seen.error <= c.bound);  // false for a NaN
    CHECK(seen.of_claim.value_or(0.0) <= 1.0);
  }
  std::string text = read(kReadme);
  const std::size_t start = text.find(kStart);
  const std::size_t end = text.find(kEnd);
  REQUIRE(start != std::string::npos);
  REQUIRE(end != std::string::npos);
  const std::size_t from = start + kStart.size();
  if (std::getenv("VISCARD_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(kReadme) << text.substr(0, from) << table_of(rows) << text.substr(end);
    return;
  }
  const std::vector<Row> written = rows_of(text.substr(from, end - from));
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
