#include "fit/fit_relaxation.h"
#include "fit/laws/fractional_diagnosis.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

RelaxationData power_law(const FractionalZenerModel& truth) {
  std::mt19937_64 dice(3);
  std::normal_distribution<double> normal;
  RelaxationData data;
  for (int i = 0; i < 300; ++i) {
    const double t_s = std::pow(10.0, -3.0 + 6.0 * i / 299.0);
    data.time_s.push_back(t_s);
    data.value.push_back(relaxation_modulus_Pa(ViscoelasticModel(truth), t_s) +
                         2e-3 * normal(dice));
  }
  return data;
}

}  // namespace

TEST_CASE("a power law between two plateaus is found, and preferred to its series", "[fit]") {
  const FractionalZenerModel truth{1.0, 1.0, 2.0, 0.5};
  const FitResult fit = fit_relaxation(power_law(truth));
  REQUIRE(fit.terms.size() >= 3);
  const auto diagnosis = diagnose_fractional(fit);
  REQUIRE(diagnosis);
  CHECK(diagnosis->bic_difference < -6.0);
  // Noise of 0.002 over 300 samples: about 0.01 for the exponent and for ln tau.
  CHECK(diagnosis->model.alpha == Approx(0.5).margin(0.02));
  CHECK(std::log(diagnosis->model.tau_s / 2.0) == Approx(0.0).margin(0.1));
  CHECK(diagnosis->model.equilibrium_Pa == Approx(1.0).epsilon(0.01));
  CHECK(diagnosis->chi_square == Approx(300.0).epsilon(0.25));  // sqrt(2/300) = 0.08
}

TEST_CASE("two separate terms are not taken for a power law", "[fit]") {
  const FitResult fit = fit_relaxation(relaxation_of(s2(), 4000, 1000.0, 0.002, 5));
  const auto diagnosis = diagnose_fractional(fit);
  REQUIRE(diagnosis);
  CHECK(diagnosis->bic_difference > 6.0);
}

TEST_CASE("one term is the power law with exponent one", "[fit]") {
  const FitResult fit = fit_relaxation(relaxation_of({1.0, {{0.5, 3.0}}}, 1500, 100.0, 0.005, 6));
  REQUIRE(fit.terms.size() == 1);
  const auto diagnosis = diagnose_fractional(fit);
  REQUIRE(diagnosis);
  CHECK(diagnosis->model.alpha == Approx(1.0).margin(0.03));
  CHECK(diagnosis->model.tau_s == Approx(fit.terms[0].tau_s).epsilon(0.05));
  CHECK(std::abs(diagnosis->bic_difference) < 12.0);  // ln(1500) for the exponent alone
}

TEST_CASE("only relaxation after a step is diagnosed", "[fit]") {
  FitResult fit;
  fit.kind = FitKind::kDma;
  CHECK_FALSE(diagnose_fractional(fit));
}
