#include "models/material/viscoelastic_models.h"
#include "models/maths/mittag_leffler.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace viscard;

namespace {

const std::vector<ViscoelasticModel>& catalogue() {
  static const std::vector<ViscoelasticModel> kModels{
      ElasticModel{2.0},
      MaxwellModel{2.0, 3.0},
      KelvinVoigtModel{2.0, 3.0},
      StandardLinearSolid{2.0, 1.0, 3.0},
      GeneralizedMaxwellModel{{1.0, {{0.5, 0.1}, {0.7, 2.0}, {0.3, 50.0}}}},
      GeneralizedMaxwellModel{{0.0, {{0.5, 0.1}, {0.7, 2.0}}}},
      FractionalZenerModel{1.0, 2.0, 3.0, 0.5},
      FractionalZenerModel{1.0, 2.0, 3.0, 0.85},
      FractionalZenerModel{0.0, 2.0, 3.0, 0.4}};
  return kModels;
}

// int_0^t f(s) ds by tanh-sinh quadrature, which converges with infinite slopes at the ends too.
template <typename Function>
double integral(double t, const Function& f) {
  double sum = 0.0;
  constexpr double kStep = 1.0 / 64.0;
  for (int k = -250; k <= 250; ++k) {
    const double sinh = 0.5 * std::numbers::pi * std::sinh(kStep * k);
    const double weight =
        0.5 * std::numbers::pi * std::cosh(kStep * k) / std::pow(std::cosh(sinh), 2);
    const double at = t / (1.0 + std::exp(-2.0 * sinh));
    if (!(at > 0.0 && at < t) || !(weight > 0.0)) continue;
    sum += 0.5 * t * weight * kStep * f(at);
  }
  return sum;
}

}  // namespace

TEST_CASE("every model relaxes monotonically between its limits and dissipates",
          "[models][identity]") {
  for (const ViscoelasticModel& model : catalogue()) {
    CAPTURE(model.index());
    CHECK_NOTHROW(validate(model));
    double before = relaxation_modulus_Pa(model, 1e-9);
    double storage_before = 0.0, creep_before = 0.0;
    for (double ln = -8.0; ln <= 8.0; ln += 0.5) {
      const double x = std::pow(10.0, ln);
      const double modulus = relaxation_modulus_Pa(model, x);
      const std::complex<double> dynamic = complex_modulus_Pa(model, x);
      const double creep = creep_compliance_1_Pa(model, x);
      CHECK(modulus <= before * (1.0 + 1e-12));  // rounding of the spectral integral
      CHECK(modulus >= 0.0);
      CHECK(dynamic.imag() >= 0.0);
      CHECK(dynamic.real() >= storage_before * (1.0 - 1e-12));
      CHECK(creep >= creep_before * (1.0 - 1e-12));
      before = modulus;
      storage_before = dynamic.real();
      creep_before = creep;
    }
  }
}

TEST_CASE("relaxation and creep of every model convolve to time", "[models][identity]") {
  // int_0^t E(t - s) J(s) ds = t, with the delta of Kelvin-Voigt as viscosity times J(t).
  for (const ViscoelasticModel& model : catalogue()) {
    const auto* solid = std::get_if<KelvinVoigtModel>(&model);
    for (const double t : {0.05, 1.0, 20.0}) {
      CAPTURE(model.index(), t);
      double sum = integral(t, [&](double s) {
        return relaxation_modulus_Pa(model, t - s) * creep_compliance_1_Pa(model, s);
      });
      if (solid != nullptr) sum += solid->viscosity_Pa_s * creep_compliance_1_Pa(model, t);
      CHECK(sum == Approx(t).epsilon(1e-9));  // quadrature
    }
  }
}

TEST_CASE("storage and loss of every model are the transform of its relaxation",
          "[models][identity]") {
  // E''(w)/w at w -> 0 is the viscosity int (E - E_inf) dt for discrete spectra; for all models
  // E'(w -> infinity) is the instantaneous modulus and E'(0) the equilibrium one.
  for (const ViscoelasticModel& model : catalogue()) {
    if (std::holds_alternative<KelvinVoigtModel>(model)) continue;  // infinite at once
    CAPTURE(model.index());
    CHECK(complex_modulus_Pa(model, 1e15).real() ==
          Approx(relaxation_modulus_Pa(model, 0.0)).epsilon(1e-5));  // fractional: w^-alpha
    CHECK(complex_modulus_Pa(model, 1e-15).real() ==
          Approx(relaxation_modulus_Pa(model, 1e15)).margin(1e-5));
  }
}

TEST_CASE("the standard linear solid has the closed forms of its two times", "[models]") {
  const StandardLinearSolid solid{2.0, 1.0, 3.0};  // tau_r = 3 s, tau_c = 4.5 s
  CHECK(relaxation_modulus_Pa(solid, 3.0) == Approx(2.0 + std::exp(-1.0)).epsilon(1e-14));
  CHECK(creep_compliance_1_Pa(solid, 0.0) == Approx(1.0 / 3.0).epsilon(1e-14));
  CHECK(creep_compliance_1_Pa(solid, 4.5) == Approx(0.5 - std::exp(-1.0) / 6.0).epsilon(1e-13));
  CHECK(creep_compliance_1_Pa(solid, 1e6) == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("models reduce to simpler ones", "[models][reduction]") {
  const StandardLinearSolid solid{2.0, 1.0, 3.0};
  for (const double t : {0.01, 1.0, 30.0}) {
    CHECK(relaxation_modulus_Pa(FractionalZenerModel{2.0, 1.0, 3.0, 1.0}, t) ==
          Approx(relaxation_modulus_Pa(solid, t)).epsilon(1e-13));
    CHECK(creep_compliance_1_Pa(FractionalZenerModel{2.0, 1.0, 3.0, 1.0}, t) ==
          Approx(creep_compliance_1_Pa(solid, t)).epsilon(1e-13));
    // Near alpha = 1 continuously: the derivative by alpha is of order 1.
    CHECK(relaxation_modulus_Pa(FractionalZenerModel{2.0, 1.0, 3.0, 0.999}, t) ==
          Approx(relaxation_modulus_Pa(solid, t)).epsilon(2e-3));
    CHECK(relaxation_modulus_Pa(StandardLinearSolid{2.0, 1e-12, 3.0}, t) ==
          Approx(relaxation_modulus_Pa(ElasticModel{2.0}, t)).epsilon(1e-11));
  }
  // A stiff branch makes the standard linear solid a Kelvin-Voigt solid.
  CHECK(creep_compliance_1_Pa(StandardLinearSolid{2.0, 1e9, 3.0}, 1.0) ==
        Approx(creep_compliance_1_Pa(KelvinVoigtModel{2.0, 3.0}, 1.0)).epsilon(1e-8));
}

TEST_CASE("the Mittag-Leffler decay of order one half is exp(x^2) erfc(x)", "[models]") {
  for (const double x : {1e-6, 0.1, 1.0, 3.0, 5.0}) {
    CHECK(mittag_leffler_decay(0.5, x) ==
          Approx(std::exp(x * x) * std::erfc(x)).epsilon(1e-12));  // rounding of the product
  }
  for (const double alpha : {0.05, 0.3, 0.7, 0.95, 0.999, 0.99995}) {
    CAPTURE(alpha);
    // Two terms of the series at small x, the leading asymptote at large x.
    CHECK(mittag_leffler_decay(alpha, 1e-5) ==
          Approx(1.0 - 1e-5 / std::tgamma(1.0 + alpha)).epsilon(1e-9));
    if (alpha < 0.99) {
      CHECK(mittag_leffler_decay(alpha, 1e6) ==
            Approx(1e-6 / std::tgamma(1.0 - alpha)).epsilon(3e-5));
    }
  }
  CHECK(mittag_leffler_decay(0.3, 0.0) == 1.0);
  CHECK(mittag_leffler_decay(0.3, 1e300) >= 0.0);
  CHECK_THROWS_AS(mittag_leffler_decay(1.1, 1.0), std::invalid_argument);
}

TEST_CASE("models refuse unphysical parameters", "[models]") {
  CHECK_THROWS_AS(validate(ViscoelasticModel(ElasticModel{-1.0})), std::invalid_argument);
  CHECK_THROWS_AS(validate(ViscoelasticModel(MaxwellModel{1.0, std::nan("")})),
                  std::invalid_argument);
  CHECK_THROWS_AS(validate(ViscoelasticModel(FractionalZenerModel{1.0, 1.0, 1.0, 1.5})),
                  std::invalid_argument);
}
