#include "io/report/report.h"
#include "io/report/report_rubber.h"
#include "tests/io/plots/markup.h"
#include "tests/io/report/synthetic_report.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string page_of(const ReportInput& input) {
  return render_report(input).html;
}

bool is_shown(const std::string& html, double value_SI) {
  const std::vector<ShownNumber> numbers = numbers_of(html);
  return std::any_of(numbers.begin(), numbers.end(), [&](const ShownNumber& number) {
    return std::abs(number.value_SI - value_SI) <= 1e-14 * std::abs(value_SI);
  });
}

// A law of rubber with one term; half-widths of its intervals are 2 %.
RubberReport rubber_of(double E0_Pa, double g) {
  RubberReport rubber{"rubber.json", "yeoh", E0_Pa, (1.0 - g) * E0_Pa};
  rubber.E0_Pa_95 = {0.98 * rubber.E0_Pa, 1.02 * rubber.E0_Pa};
  rubber.E_inf_Pa_95 = {0.98 * rubber.E_inf_Pa, 1.02 * rubber.E_inf_Pa};
  if (g > 0.0) rubber.terms = {{g, 0.0, 1.5}};
  rubber.stretches = "uniaxial 1 to 3";
  return rubber;
}

}  // namespace

TEST_CASE("linear and large-strain tests stand side by side, and disagreements are named",
          "[io][report]") {
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  CHECK_FALSE(contains(page_of(input), "Linear and large-strain tests"));
  const double E0_Pa = input.specimens[0].fit->E0_Pa, E_inf_Pa = input.specimens[0].fit->E_inf_Pa;

  input.rubbers = {rubber_of(E0_Pa, 1.0 - E_inf_Pa / E0_Pa)};
  CHECK(rubber_disagreements(input).empty());
  CHECK(contains(page_of(input), "the tests agree within their intervals"));
  CHECK(is_shown(page_of(input), input.rubbers[0].E_inf_Pa));

  // Softer by 40 % after all relaxation, not at once.
  input.rubbers = {rubber_of(E0_Pa, 0.4)};
  const std::vector<std::string> apart = rubber_disagreements(input);
  REQUIRE(apart.size() == 1);
  CHECK(contains(apart[0], "rubber.json disagree on E_inf at rest"));
  CHECK(contains(page_of(input), "1 of 2 comparisons disagree"));
  CHECK(contains(page_of(input), "do not overlap: the tests disagree"));

  // The rate of an elastic law is not known: it may lie anywhere between E_inf and E0.
  input.rubbers = {rubber_of(0.5 * (E0_Pa + E_inf_Pa), 0.0)};
  CHECK(rubber_disagreements(input).empty());
  input.rubbers = {rubber_of(2.0 * E0_Pa, 0.0)};
  CHECK(rubber_disagreements(input).size() == 1);
}

TEST_CASE("the systematic part of a linear test counts before a disagreement is reported",
          "[io][report]") {
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  FitResult& fit = *input.specimens[0].fit;
  input.rubbers = {rubber_of(1.2 * fit.E0_Pa, 0.0)};
  fit.systematic_relative = 0.0;
  CHECK(rubber_disagreements(input).size() == 1);
  fit.systematic_relative = 0.15;
  CHECK(rubber_disagreements(input).empty());
}
