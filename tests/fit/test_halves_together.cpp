// One record in two parts, fitted as two tests.
#include "fit/fit_relaxation.h"
#include "fit/fit_together.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;

namespace {

// The odd and the even rows of a record as two tests.
std::vector<MaterialTest> halves_of(const RelaxationData& all) {
  FitOptions keep;
  keep.keep_rows = true;
  RelaxationData odd, even;
  for (std::size_t i = 0; i < all.time_s.size(); ++i) {
    RelaxationData& half = i % 2 == 0 ? even : odd;
    half.time_s.push_back(all.time_s[i]);
    half.value.push_back(all.value[i]);
  }
  return {{"relaxation 1", fit_relaxation(even, keep)},
          {"relaxation 2", fit_relaxation(odd, keep)}};
}

}  // namespace

TEST_CASE("one test twice weighs as its data together", "[fit][together]") {
  const RelaxationData all = relaxation_of(s2(), 1200, 1000.0, 0.01, 7);
  const FitResult whole = fit_relaxation(all, {});
  const FitResult halves = fit_together(halves_of(all), {});
  REQUIRE(halves.terms.size() == whole.terms.size());
  CHECK(halves.E_inf_Pa == Approx(whole.E_inf_Pa).epsilon(2e-4));
  CHECK(std::abs(halves.E0_Pa - whole.E0_Pa) < 0.2 * whole.E0_se_Pa);
  CHECK(halves.E_inf_se_Pa == Approx(whole.E_inf_se_Pa).epsilon(0.1));
  CHECK_FALSE(has_flag(halves, "tests-disagree"));
  CHECK_FALSE(has_flag(halves, "few-rows"));
}

TEST_CASE("tests of few rows are flagged, because their noise is hardly known", "[fit][together]") {
  const FitResult few = fit_together(halves_of(relaxation_of(s2(), 40, 1000.0, 0.01, 7)), {});
  CHECK(has_flag(few, "few-rows"));
  const FitResult enough = fit_together(halves_of(relaxation_of(s2(), 80, 1000.0, 0.01, 7)), {});
  CHECK_FALSE(has_flag(enough, "few-rows"));
}
