#include "io/cli/report/report_commands.h"

#include <catch2/catch.hpp>

using namespace viscard;

namespace {

EmulatedTruth truth_of_two_terms() {
  EmulatedTruth truth;
  truth.material.E0_Pa = 2e6;
  truth.material.terms = {{0.01, 0.01, 0.2}, {0.02, 0.02, 3.0}};
  return truth;
}

Material estimate_of(std::size_t n_terms) {
  Material material = truth_of_two_terms().material;
  material.E0_Pa = 2.01e6;
  material.terms.resize(n_terms);
  MaterialUncertainty uncertainty;
  uncertainty.E0_Pa_95 = {1.9e6, 2.1e6};
  for (std::size_t i = 0; i < n_terms; ++i) {
    const MaterialTerm& term = material.terms[i];
    uncertainty.terms.push_back(
        {.g_95 = {0.9 * term.g, 1.1 * term.g}, .tau_s_95 = {1.5 * term.tau_s, 1.6 * term.tau_s}});
  }
  material.uncertainty = uncertainty;
  return material;
}

}  // namespace

TEST_CASE("a score states for each parameter whether its interval contains the truth", "[flow]") {
  const std::vector<ScoreRow> rows = score_rows("1:10", truth_of_two_terms(), estimate_of(2));
  REQUIRE(rows.size() == 5);
  CHECK(rows[0].quantity == "E0");
  CHECK(rows[0].estimate == Approx(2.01).epsilon(1e-12));
  CHECK(rows[0].is_inside);
  CHECK(rows[1].quantity == "g_1");
  CHECK(rows[1].is_inside);
  CHECK(rows[2].quantity == "tau_1");
  CHECK_FALSE(rows[2].is_inside);
}

TEST_CASE("a term the fit did not find counts as missed", "[flow]") {
  const std::vector<ScoreRow> rows = score_rows("1:10", truth_of_two_terms(), estimate_of(1));
  REQUIRE(rows.size() == 5);
  CHECK_FALSE(rows[3].is_inside);
  CHECK_FALSE(rows[4].is_inside);
  CHECK(table_from_scores(rows).find("NO") != std::string::npos);
}
