// The reduction to a band against sums over it, and against its limits in closed form.
#include "models/material/frequency_band.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>

using namespace viscard;

namespace {

constexpr double kPi = std::numbers::pi;

// Nine terms from 1 ms to 0.5 s, constant nu = 0.4.
Material wide_material() {
  Material material;
  material.E0_Pa = 3.7e6;
  material.nu = 0.4;
  for (int i = 0; i < 9; ++i) {
    const double share = 0.04 + 0.03 * std::sin(1.3 * i + 0.4);
    material.terms.push_back({share, share, 1.2e-3 * std::pow(10.0, i / 3.0)});
  }
  return material;
}

// G* by the textbook's sum of Maxwell elements, in Pa.
std::complex<double> shear_Pa(const Material& material, double f_Hz) {
  std::complex<double> sum = 1.0;
  for (const MaterialTerm& term : material.terms) {
    sum -= term.g / (1.0 + std::complex<double>(0.0, 2.0 * kPi * f_Hz * term.tau_s));
  }
  return material.E0_Pa / (2.0 * (1.0 + material.nu)) * sum;
}

}  // namespace

TEST_CASE("Rayleigh coefficients are the least squares of the loss factor over the band",
          "[material]") {
  const Material material = wide_material();
  const FrequencyBand band{5.0, 500.0};
  const BandReduction reduced = reduce_to_band(material, band);
  REQUIRE(reduced.alpha_1_s > 0.0);
  REQUIRE(reduced.beta_s > 0.0);
  const auto eta_of = [&](double f) {
    const auto exact = shear_Pa(material, f);  // constant nu: that of E too
    return exact.imag() / exact.real();
  };
  const auto squares = [&](double alpha, double beta, double* worst = nullptr) {
    double sum = 0.0;
    for (int i = 0; i <= 2000; ++i) {
      const double f = 5.0 * std::pow(100.0, i / 2000.0), w = 2.0 * kPi * f;
      const double off = alpha / (2.0 * w) + 0.5 * beta * w - 0.5 * eta_of(f);  // damping ratios
      sum += off * off;
      if (worst != nullptr) *worst = std::max(*worst, 2.0 * std::abs(off));
    }
    return sum;
  };
  double worst = 0.0;
  const double least = squares(reduced.alpha_1_s, reduced.beta_s, &worst);
  for (const double change : {0.98, 1.02}) {
    CHECK(squares(change * reduced.alpha_1_s, reduced.beta_s) > least);
    CHECK(squares(reduced.alpha_1_s, change * reduced.beta_s) > least);
  }
  CHECK(reduced.of_rayleigh.value == Approx(worst).epsilon(1e-3));  // 401 against 2001 samples
  CHECK(reduced.of_rayleigh.loss_factor == Approx(eta_of(reduced.of_rayleigh.at_Hz)).epsilon(1e-9));
  // E is as far from E' at one end as at the other.
  const double low = 2.8 * shear_Pa(material, 5.0).real(),
               high = 2.8 * shear_Pa(material, 500.0).real();
  CHECK(reduced.young_Pa / low - 1.0 == Approx(reduced.storage_change).epsilon(1e-9));
  CHECK(1.0 - reduced.young_Pa / high == Approx(reduced.storage_change).epsilon(1e-9));
  CHECK(reduced.poisson == Approx(0.4).epsilon(1e-12));
}

TEST_CASE("Rayleigh coefficients are those of the integral over the logarithm of the frequency",
          "[material]") {
  // Midpoint rule with 1e5 points: (1/x^2, 1; 1, x^2) (a, b) = (eta/x, eta x).
  const Material material = wide_material();
  const double middle_Hz = 50.0;
  double inverse = 0.0, square = 0.0, over = 0.0, times = 0.0, plain = 0.0;
  constexpr int kPoints = 100000;
  for (int i = 0; i < kPoints; ++i) {
    const double f = 5.0 * std::pow(100.0, (i + 0.5) / kPoints), x = f / middle_Hz;
    const auto exact = shear_Pa(material, f);
    const double eta = exact.imag() / exact.real();
    inverse += 1.0 / (x * x) / kPoints;
    square += x * x / kPoints;
    over += eta / x / kPoints;
    times += eta * x / kPoints;
    plain += eta / kPoints;
  }
  const double w = 2.0 * kPi * middle_Hz, determinant = inverse * square - 1.0;
  const BandReduction reduced = reduce_to_band(material, {5.0, 500.0});
  CHECK(reduced.alpha_1_s == Approx(w * (over * square - times) / determinant).epsilon(1e-7));
  CHECK(reduced.beta_s == Approx((times * inverse - over) / determinant / w).epsilon(1e-7));
  CHECK(reduced.beta_alone_s == Approx(times / square / w).epsilon(1e-7));
  CHECK(reduced.loss_factor == Approx(plain).epsilon(1e-7));
}

TEST_CASE("far below and above the relaxation a reduction has its closed limit", "[material]") {
  Material material;
  material.E0_Pa = 1.88e6;
  material.nu = 0.495;
  material.terms = {{0.2, 0.2, 1e-6}};  // omega tau << 1: loss factor omega g tau/(1 - g)
  BandReduction reduced = reduce_to_band(material, {1.0, 100.0});
  CHECK(reduced.beta_s == Approx(0.2e-6 / 0.8).epsilon(1e-5));
  CHECK(reduced.beta_alone_s == Approx(0.2e-6 / 0.8).epsilon(1e-5));
  CHECK(reduced.of_beta_alone.value < 1e-5 * reduced.of_beta_alone.loss_factor);
  CHECK(reduced.young_Pa == Approx(0.8 * 1.88e6).epsilon(1e-6));
  material.terms = {{0.2, 0.2, 1e3}};  // omega tau >> 1: g/(omega tau), of the mass alone
  reduced = reduce_to_band(material, {1.0, 100.0});
  CHECK(reduced.alpha_1_s == Approx(0.2e-3).epsilon(1e-5));
  CHECK(reduced.of_rayleigh.value < 1e-4 * reduced.of_rayleigh.loss_factor);
  CHECK(reduced.young_Pa == Approx(1.88e6).epsilon(1e-6));
  // Damping that falls with frequency is beyond a code with beta alone, and its card says so.
  CHECK(reduced.of_beta_alone.value > 0.9 * reduced.of_beta_alone.loss_factor);
}

TEST_CASE("the complex Young's modulus is 9 K G over 3 K + G, and 3 G at nu = 0.5", "[material]") {
  Material material = wide_material();
  for (MaterialTerm& term : material.terms) term.k = 0.2 * term.g;
  // young_series() takes the same way in the Laplace domain, by poles and residues.
  const PronySeries series = young_series(material);
  for (const double f_Hz : {0.01, 1.0, 30.0, 1e4}) {
    const DynamicModuli found = dynamic_moduli(material, f_Hz);
    const ComplexModulus exact = complex_modulus_Pa(series, 2.0 * kPi * f_Hz);
    CHECK(found.young_Pa.real() == Approx(exact.storage_Pa).epsilon(1e-9));
    CHECK(found.young_Pa.imag() == Approx(exact.loss_Pa).epsilon(1e-7));
  }
  material.nu = 0.5;
  CHECK(dynamic_moduli(material, 3.0).young_Pa.imag() ==
        Approx(3.0 * shear_Pa(material, 3.0).imag()).epsilon(1e-12));
}

TEST_CASE("the band that a material supports", "[material]") {
  Material material = wide_material();
  CHECK(supported_band(material).from_Hz ==
        Approx(0.1 / (2.0 * kPi * material.terms.back().tau_s)).epsilon(1e-12));
  material.valid = {0.0125, 60.0, 0.05};
  CHECK(supported_band(material).to_Hz == Approx(12.7324).epsilon(1e-5));
  CHECK(supported_band(material).from_Hz == Approx(2.65258e-3).epsilon(1e-5));
  CHECK_THROWS_WITH(reduce_to_band(material, {10.0, 10.0}), Catch::Contains("the lower one first"));
}
