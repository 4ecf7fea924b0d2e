// What an answer by a law says, beside the law itself.
#include "fit/fit_relaxation.h"
#include "fit/intervals/flags.h"
#include "fit/laws/law_fit.h"
#include "tests/fit/laws/law_records.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("a law does not keep answers and flags of the series", "[fit]") {
  FitResult fit = relaxation_fit(
      [](double t) { return 1e6 + 2e6 * std::exp(-std::pow(t / 3.0, 0.5)); }, 0.01, 4);
  REQUIRE(fit.first);
  const double time_s = fit.first->time_s;
  for (const char* name :
       {"E0-extrapolated", "E0-unknown", "liquid", "solid-or-liquid", "tau-beyond-window"}) {
    const int term = std::string(name) == "tau-beyond-window" ? 1 : 0;
    fit.flags.push_back({name, term, "of the series"});
  }
  fit.flags.push_back({"rows-left-out", 0, "of the record"});
  fit.first->modulus_Pa = 9e6;
  fit.bic_liquid_minus_solid = 1.0;
  fit.is_trustworthy = false;
  take_law("kww", fit);
  const PronySeries series = young_series(material_from_fit(fit, 0.495, 0.0));
  CHECK(fit.first->modulus_Pa == Approx(relaxation_modulus_Pa(series, time_s)).epsilon(1e-9));
  CHECK(fit.first->modulus_Pa <= fit.E0_Pa);
  CHECK_FALSE(fit.bic_liquid_minus_solid);
  CHECK(fit.is_trustworthy);
  CHECK(std::none_of(fit.flags.begin(), fit.flags.end(),
                     [](const MaterialFlag& flag) { return flag.text == "of the series"; }));
  CHECK(std::any_of(fit.flags.begin(), fit.flags.end(),
                    [](const MaterialFlag& flag) { return flag.name == "rows-left-out"; }));
}

TEST_CASE("without being asked for, no law is fitted", "[fit]") {
  CHECK(fit_relaxation(relaxation_of(s2(), 400, 1000.0, 0.002, 5)).laws.empty());
}

TEST_CASE("a law with an unknown E0 does not advise fewer terms", "[fit]") {
  FitResult fit = relaxation_fit(
      [](double t) { return 1e6 + 2e6 * std::exp(-std::pow(t / 3.0, 0.5)); }, 0.01, 4);
  for (FittedLaw& one : fit.laws) one.series_covariance *= 1e8;  // as of a record of few rows
  take_law("kww", fit);
  const auto flag = std::find_if(fit.flags.begin(), fit.flags.end(),
                                 [](const MaterialFlag& one) { return one.name == "E0-unknown"; });
  REQUIRE(flag != fit.flags.end());
  CHECK(flag->text.find("fewer terms") == std::string::npos);
  CHECK(flag->text.find("another law") != std::string::npos);
  CHECK_FALSE(fit.is_trustworthy);
}
