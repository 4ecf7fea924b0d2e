// Misfit and Kramers-Kronig of the isotherms of a master curve.
#include "fit/fit_master_curve.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// Sweeps of 41 frequencies at each temperature, with a loss of the instrument added to that of the material.
MasterData sweeps_with_loss(double added_Pa, double noise, double slip = 0.0) {
  const PronySeries truth{1e6,
                          {{2e6, 5e-5}, {1.5e6, 5e-4}, {1e6, 5e-3}, {0.7e6, 0.05}, {0.4e6, 0.5}}};
  const TemperatureShift shift{
      .law = ShiftLaw::kArrhenius, .T_ref_C = 20.0, .activation_J_mol = 9e4};
  std::mt19937_64 dice(11);
  std::normal_distribution<double> normal;
  MasterData data;
  for (const double T_C : {0.0, 20.0, 40.0, 60.0}) {
    const double a = std::exp(ln_shift_factor(shift, T_C));
    const double b = 1.0 + slip * normal(dice);
    for (int i = 0; i <= 40; ++i) {
      const double f_Hz = std::pow(10.0, -2.0 + 0.1 * i);
      const ComplexModulus modulus = complex_modulus_Pa(truth, 2.0 * std::numbers::pi * f_Hz * a);
      data.temperature_C.push_back(T_C);
      data.argument.push_back(f_Hz);
      data.modulus_Pa.push_back(b * modulus.storage_Pa * (1.0 + noise * normal(dice)));
      data.loss_Pa.push_back(b * (modulus.loss_Pa + added_Pa) * (1.0 + noise * normal(dice)));
    }
  }
  return data;
}

}  // namespace

TEST_CASE("a loss that no material has is found on a master curve as on one isotherm",
          "[fit][master]") {
  const double added_Pa = GENERATE(1e5, 2e5);
  const double noise = GENERATE(0.0, 0.002);
  CAPTURE(added_Pa, noise);
  const MasterCurve curve = fit_master_curve(sweeps_with_loss(added_Pa, noise));
  for (const auto& flag : curve.fit.flags) UNSCOPED_INFO(flag.text);
  CHECK(has_flag(curve.fit, "storage-loss-contradict"));
  REQUIRE(curve.fit.lack_of_fit);
  CHECK(curve.fit.lack_of_fit->is_significant);
  CHECK((added_Pa < 2e5 || has_flag(curve.fit, "misfit")));
}

TEST_CASE("sweeps of one material, with noise or a slip of each isotherm, contradict nothing",
          "[fit][master]") {
  const double noise = GENERATE(0.0, 0.002, 0.01);
  const double slip = GENERATE(0.0, 0.005);
  CAPTURE(noise, slip);
  const MasterCurve curve = fit_master_curve(sweeps_with_loss(0.0, noise, slip));
  for (const auto& flag : curve.fit.flags) UNSCOPED_INFO(flag.text);
  CHECK_FALSE(has_flag(curve.fit, "storage-loss-contradict"));
  CHECK_FALSE(has_flag(curve.fit, "misfit"));
}
