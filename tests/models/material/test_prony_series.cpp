#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace viscard;

namespace {

// The seed's 1:10 PDMS in MPa and s: E0 = 1.88, a = (0.008206, 0.01386), tau = (0.1945, 2.403).
PronySeries pdms_1to10() {
  const double E0 = 1.88;
  return {E0 * (1.0 - 0.008206 - 0.01386), {{E0 * 0.008206, 0.1945}, {E0 * 0.01386, 2.403}}};
}

// int_0^t E(t - x) J(x) dx by composite Simpson on each e-fold of both kernels' fastest times.
double convolution(const PronySeries& series, const RetardationSpectrum& creep, double time_s) {
  const int steps = 20000;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double x = time_s * i / steps;
    const double weight = (i == 0 || i == steps) ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * relaxation_modulus_Pa(series, time_s - x) * creep_compliance_1_Pa(creep, x);
  }
  return sum * time_s / (3.0 * steps);
}

}  // namespace

TEST_CASE("a Prony series starts at E_0 and ends at E_inf", "[models]") {
  const PronySeries series = pdms_1to10();
  CHECK(relaxation_modulus_Pa(series, 0.0) == Approx(1.88).epsilon(1e-15));
  CHECK(instantaneous_modulus_Pa(series) == Approx(1.88).epsilon(1e-15));
  CHECK(relaxation_modulus_Pa(series, 1e9) == Approx(1.83851592).epsilon(1e-12));
}

TEST_CASE("storage and loss moduli keep their digits at both ends of frequency",
          "[models][stability]") {
  const PronySeries series = pdms_1to10();
  CHECK(complex_modulus_Pa(series, 1e300).storage_Pa == Approx(1.88).epsilon(1e-15));
  CHECK(complex_modulus_Pa(series, 1e-300).storage_Pa == Approx(1.83851592).epsilon(1e-12));
  // High frequency: E'' -> sum E_i/(w tau_i). tan delta of 8.5e-8 at 90 kHz for this material.
  const ComplexModulus modulus = complex_modulus_Pa(series, 2.0 * M_PI * 90e3);
  CHECK(modulus.loss_Pa / modulus.storage_Pa == Approx(8.5e-8).epsilon(0.01));
  CHECK(std::isfinite(complex_modulus_Pa(series, 1e300).loss_Pa));
}

TEST_CASE("the retardation spectrum of the 1:10 material has the published times and compliances",
          "[models]") {
  const RetardationSpectrum creep = retardation_from_relaxation(pdms_1to10());
  REQUIRE(creep.terms.size() == 2);
  CHECK(creep.terms[0].retardation_time_s == test::printed("0.19610728"));
  CHECK(creep.terms[1].retardation_time_s == test::printed("2.43708189"));
  CHECK(creep.terms[0].compliance_1_Pa == test::printed("0.00439009"));
  CHECK(creep.terms[1].compliance_1_Pa == test::printed("0.00761198"));
  CHECK(creep_compliance_1_Pa(creep, 1e9) == test::printed("0.5439169654"));
}

TEST_CASE("creep compliance and relaxation modulus convolve to time", "[models]") {
  const double time_s = GENERATE(0.01, 0.3, 1.0, 5.0, 30.0);
  const PronySeries series = pdms_1to10();
  CHECK(convolution(series, retardation_from_relaxation(series), time_s) ==
        Approx(time_s).epsilon(1e-9));
}

TEST_CASE("the standard linear solid creeps with eta (E1 + E2)/(E1 E2)", "[models][reduction]") {
  // E1 = 2, E2 = 1, eta = 3: tau_r = 3, tau_c = 4.5, J(0) = 1/3, J(inf) = 1/2.
  const RetardationSpectrum creep = retardation_from_relaxation({2.0, {{1.0, 3.0}}});
  REQUIRE(creep.terms.size() == 1);
  CHECK(creep.terms[0].retardation_time_s == Approx(4.5).epsilon(1e-14));
  CHECK(creep_compliance_1_Pa(creep, 0.0) == Approx(1.0 / 3.0).epsilon(1e-15));
  CHECK(creep_compliance_1_Pa(creep, 1e6) == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("a Maxwell liquid flows with its viscosity", "[models][reduction]") {
  const RetardationSpectrum creep = retardation_from_relaxation({0.0, {{2.0, 5.0}}});
  CHECK(creep.terms.empty());
  CHECK(creep_compliance_1_Pa(creep, 7.0) == Approx(0.5 + 7.0 / 10.0).epsilon(1e-14));
  const PronySeries back = relaxation_from_retardation(creep);
  REQUIRE(back.terms.size() == 1);
  CHECK(back.equilibrium_modulus_Pa == 0.0);
  CHECK(back.terms[0].relaxation_time_s == Approx(5.0).epsilon(1e-14));
}

TEST_CASE("relaxation to retardation and back returns thirty terms over twenty decades",
          "[models][stability]") {
  const bool is_liquid = GENERATE(false, true);
  PronySeries series{is_liquid ? 0.0 : 1.0, {}};
  for (int i = 0; i < 30; ++i) {
    // Strengths over six decades, so that some zeros lie within rounding of their poles.
    series.terms.push_back({std::pow(10.0, -(i % 7)), std::pow(10.0, -10.0 + 20.0 * i / 29.0)});
  }
  const PronySeries back = relaxation_from_retardation(retardation_from_relaxation(series));
  REQUIRE(back.terms.size() == 30);
  for (std::size_t i = 0; i < 30; ++i) {
    CAPTURE(i);
    CHECK(back.terms[i].relaxation_time_s ==
          Approx(series.terms[i].relaxation_time_s).epsilon(1e-9));
    CHECK(back.terms[i].modulus_Pa == Approx(series.terms[i].modulus_Pa).epsilon(1e-7));
  }
  CHECK(back.equilibrium_modulus_Pa ==
        Approx(series.equilibrium_modulus_Pa).margin(0).epsilon(1e-12));
}

TEST_CASE("an unphysical series is refused by name", "[models]") {
  CHECK_THROWS_WITH(validate(PronySeries{1.0, {{1.0, 0.0}}}), Catch::Contains("term 1"));
  CHECK_THROWS_WITH(validate(PronySeries{1.0, {{1.0, 1.0}, {-1.0, 2.0}}}),
                    Catch::Contains("term 2"));
  CHECK_THROWS_AS(validate(PronySeries{std::numeric_limits<double>::quiet_NaN(), {}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(validate(PronySeries{0.0, {}}), std::invalid_argument);
}
