// One wrong time stamp in a record must not look like fast sampling.
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/clean_data.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kStep_s = 0.02;

void check_same_terms(const FitResult& fit, const FitResult& without) {
  CHECK(fit.is_trustworthy);
  REQUIRE(fit.terms.size() == without.terms.size());
  for (std::size_t i = 0; i < fit.terms.size(); ++i) {
    CHECK(fit.terms[i].tau_s > kStep_s / 3.0);
    CHECK(fit.terms[i].tau_s == Approx(without.terms[i].tau_s).epsilon(0.02));
    CHECK(fit.terms[i].modulus_Pa == Approx(without.terms[i].modulus_Pa).epsilon(0.02));
  }
}

}  // namespace

TEST_CASE("the shortest step ignores a wrong stamp but no real change of the sampling", "[fit]") {
  std::vector<double> even = even_times(10.0, kStep_s);
  CHECK(shortest_step_s(even) == Approx(kStep_s));
  const std::size_t at = GENERATE(std::size_t{2}, std::size_t{250}, std::size_t{498});
  std::vector<double> odd = even;
  odd[at] = odd[at - 1] + 1e-3;  // 1 ms, then 39 ms
  CHECK(shortest_step_s(odd) == Approx(kStep_s));
  odd = even;
  odd.insert(odd.begin() + static_cast<std::ptrdiff_t>(at), odd[at - 1] + 1e-3);  // 1 ms, 19 ms
  CHECK(shortest_step_s(odd) == Approx(19e-3));
  odd[at] = odd[at - 1];  // a repeated stamp
  CHECK(shortest_step_s(odd) == Approx(kStep_s));
}

TEST_CASE("the shortest step of sampling in log time and of two rates is the real one", "[fit]") {
  std::vector<double> decades = {0.0, 1.0, 10.0, 100.0, 1e3};
  CHECK(shortest_step_s(decades) == 1.0);
  std::vector<double> log_times;
  for (int i = 0; i < 60; ++i) log_times.push_back(1e-3 * std::pow(10.0, 0.1 * i));
  CHECK(shortest_step_s(log_times) == Approx(1e-3 * (std::pow(10.0, 0.1) - 1.0)));
  std::vector<double> two_rates = even_times(1.0, 1e-3);
  for (int i = 1; i < 100; ++i) two_rates.push_back(1.0 + 0.5 * i);
  CHECK(shortest_step_s(two_rates) == Approx(1e-3));
}

TEST_CASE("one wrong time stamp makes no fast term", "[fit]") {
  RelaxationData data = relaxation_of(s2(), 5001, 100.0, 1e-3, 3);
  const FitResult without = fit_relaxation(data);
  const std::size_t at = GENERATE(std::size_t{3}, std::size_t{40}, std::size_t{2500});
  CAPTURE(at);
  const auto here = static_cast<std::ptrdiff_t>(at);
  data.time_s.insert(data.time_s.begin() + here, data.time_s[at - 1] + 1e-3);
  data.value.insert(data.value.begin() + here, data.value[at - 1] + 5e-3);
  check_same_terms(fit_relaxation(data), without);
}

TEST_CASE("one wrong time stamp makes no fast term of an indentation", "[fit]") {
  std::vector<double> time_s = even_times(60.0, kStep_s);
  const FitResult without =
      fit_indentation(indentation_of(s2(), time_s, ramp_and_hold(1.0), 1e-3, 4));
  const std::size_t at = GENERATE(std::size_t{40}, std::size_t{1500});
  CAPTURE(at);
  time_s.insert(time_s.begin() + static_cast<std::ptrdiff_t>(at), time_s[at - 1] + 1e-3);
  check_same_terms(fit_indentation(indentation_of(s2(), time_s, ramp_and_hold(1.0), 1e-3, 4)),
                   without);
}
