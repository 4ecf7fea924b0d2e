#include "fit/curves/master_model.h"
#include "fit/fit_master_curve.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

const PronySeries kTruth{2e6, {{4e6, 1e-3}, {3e6, 0.1}, {2e6, 3.0}, {1e6, 100.0}}};
const TemperatureShift kWlf{.law = ShiftLaw::kWlf, .T_ref_C = 20.0, .C1 = 8.86, .C2_K = 101.6};
const TemperatureShift kArrhenius{
    .law = ShiftLaw::kArrhenius, .T_ref_C = 20.0, .activation_J_mol = 9e4};

// Steps of 1 to 100 s at each temperature; the noise is relative to the value.
MasterData relaxation_data(const TemperatureShift& shift, double noise, std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  MasterData data;
  for (const double T_C : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0}) {
    const double a = std::exp(ln_shift_factor(shift, T_C));
    for (int i = 0; i < 40; ++i) {
      const double t_s = std::pow(10.0, -1.0 + 3.0 * i / 39.0);
      data.temperature_C.push_back(T_C + 0.1 * normal(dice) * (noise > 0.0 ? 1.0 : 0.0));
      data.argument.push_back(t_s);
      data.modulus_Pa.push_back(relaxation_modulus_Pa(kTruth, t_s / a) *
                                (1.0 + noise * normal(dice)));
    }
  }
  data.T_ref_C = 20.0;
  return data;
}

}  // namespace

TEST_CASE("WLF and Arrhenius factors are those of their formulas", "[models]") {
  // Ferry's universal constants at T_g + 50 K: log10 a = -8.86 x 50/151.6.
  CHECK(ln_shift_factor(kWlf, 70.0) ==
        Approx(-std::numbers::ln10 * 8.86 * 50.0 / 151.6).epsilon(1e-14));
  CHECK(ln_shift_factor(kWlf, 20.0) == 0.0);
  CHECK(ln_shift_factor(kArrhenius, 60.0) ==
        Approx(9e4 / 8.314462618 * (1.0 / 333.15 - 1.0 / 293.15)).epsilon(1e-14));
  CHECK(error_text([] { ln_shift_factor(kWlf, -90.0); }).find("pole") != std::string::npos);
}

TEST_CASE("the slopes of the master model equal finite differences", "[fit][gradient]") {
  MasterSegment cold{0.0, {0.1, 1.0, 10.0}, {3e6, 2e6, 1e6}, {}};
  MasterSegment sweep{30.0, {0.1, 1.0, 10.0}, {1e6, 2e6, 3e6}, {2e5, 3e5, 2e5}};
  const MasterModel model({cold, sweep}, 0, {0.0, -1.0}, {});
  Eigen::VectorXd ln_tau(2), nuisance(1);
  ln_tau << -1.0, 1.5;
  nuisance << -1.2;
  const ModelColumns at = model.columns(ln_tau, nuisance, true);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2; ++i) {
    Eigen::VectorXd up = ln_tau, down = ln_tau;
    up[i] += kStep;
    down[i] -= kStep;
    const Eigen::VectorXd slope = (model.columns(up, nuisance, false).values.col(1 + i) -
                                   model.columns(down, nuisance, false).values.col(1 + i)) /
                                  (2.0 * kStep);
    // Central differences have errors of step^2 and rounding/step, for columns of size 1e-6.
    CHECK((slope - at.term_slopes.col(i)).norm() <= 1e-8 * slope.norm());
  }
  Eigen::VectorXd up = nuisance, down = nuisance;
  up[0] += kStep;
  down[0] -= kStep;
  const Eigen::MatrixXd slope =
      (model.columns(ln_tau, up, false).values - model.columns(ln_tau, down, false).values) /
      (2.0 * kStep);
  CHECK((slope - at.nuisance_slopes[0]).norm() <= 1e-8 * slope.norm());
}

TEST_CASE("noise-free segments shift onto the truth behind them", "[fit][master]") {
  const MasterCurve curve = fit_master_curve(relaxation_data(kWlf, 0.0, 1), {.n_terms = 4});
  REQUIRE(curve.laws.wlf);
  CHECK(curve.laws.wlf_is_better);
  // The search for the best times stops at 1e-12 of the residual sum.
  CHECK(curve.laws.wlf->C1 == Approx(8.86).epsilon(1e-4));
  CHECK(curve.laws.wlf->C2_K == Approx(101.6).epsilon(1e-4));
  CHECK(curve.fit.E_inf_Pa == Approx(2e6).epsilon(1e-4));
  CHECK(curve.fit.terms.back().tau_s == Approx(100.0).epsilon(1e-3));
  CHECK(curve.T_ref_C == 20.0);
  CHECK(curve.factors[2].ln_a == 0.0);
}

TEST_CASE("noisy segments give WLF constants within their intervals, and WLF is selected",
          "[fit][master]") {
  const MasterCurve curve = fit_master_curve(relaxation_data(kWlf, 0.005, 7));
  REQUIRE(curve.laws.wlf);
  CHECK(curve.laws.wlf_is_better);
  CHECK(curve.laws.wlf_bic < curve.laws.arrhenius_bic);
  CHECK(holds(curve.laws.wlf->C1_95, 8.86));
  CHECK(holds(curve.laws.wlf->C2_K_95, 101.6));
  for (const ShiftFactor& factor : curve.factors) {
    if (factor.ln_a == 0.0) continue;
    CAPTURE(factor.temperature_C);
    CHECK(factor.ln_a == Approx(ln_shift_factor(kWlf, factor.temperature_C))
                             .margin(4.0 * factor.ln_a_se + 0.03));  // 0.1 K of scatter gives 0.02
  }
}

TEST_CASE("Arrhenius segments select the Arrhenius law, with the activation energy in its interval",
          "[fit][master]") {
  const MasterCurve curve = fit_master_curve(relaxation_data(kArrhenius, 0.005, 3));
  REQUIRE(curve.laws.arrhenius);
  CHECK_FALSE(curve.laws.wlf_is_better);
  CHECK(holds(curve.laws.arrhenius->activation_J_mol_95, 9e4));
}

TEST_CASE("frequency sweeps at several temperatures give a master curve", "[fit][master]") {
  MasterData data;
  for (const double T_C : {0.0, 15.0, 30.0, 45.0}) {
    const double a = std::exp(ln_shift_factor(kArrhenius, T_C));
    for (int i = 0; i < 25; ++i) {
      const double f_Hz = std::pow(10.0, -2.0 + 3.0 * i / 24.0);
      const double w = 2.0 * std::numbers::pi * f_Hz * a;
      double storage = kTruth.equilibrium_modulus_Pa, loss = 0.0;
      for (const MaxwellTerm& term : kTruth.terms) {
        const double x = w * term.relaxation_time_s;
        storage += term.modulus_Pa * x * x / (1.0 + x * x);
        loss += term.modulus_Pa * x / (1.0 + x * x);
      }
      data.temperature_C.push_back(T_C);
      data.argument.push_back(f_Hz);
      data.modulus_Pa.push_back(storage);
      data.loss_Pa.push_back(loss);
    }
  }
  data.T_ref_C = 15.0;
  const MasterCurve curve = fit_master_curve(data, {.n_terms = 4});
  CHECK(curve.fit.kind == FitKind::kDma);
  REQUIRE(curve.laws.arrhenius);
  CHECK(curve.laws.arrhenius->activation_J_mol == Approx(9e4).epsilon(1e-4));  // no noise
}

TEST_CASE("segments without a common modulus are refused with their temperatures",
          "[fit][master]") {
  MasterData data;
  for (int i = 0; i < 10; ++i) {
    for (const double T_C : {0.0, 50.0}) {
      data.temperature_C.push_back(T_C);
      data.argument.push_back(1.0 + i);
      data.modulus_Pa.push_back((T_C > 0.0 ? 1e6 : 3e6) - 1e4 * i);
    }
  }
  CHECK(error_text([&] { fit_master_curve(data); }).find("0 C and 50 C have no value in common") !=
        std::string::npos);
  data.T_ref_C = 25.0;
  CHECK(error_text([&] { fit_master_curve(data); }).find("there are 0 C, 50 C") !=
        std::string::npos);
}

TEST_CASE("a zero modulus and moduli of the wrong sign are refused with their place",
          "[fit][master]") {
  MasterData data = relaxation_data(kWlf, 0.0, 1);
  const double kept = data.modulus_Pa[50];
  data.modulus_Pa[50] = 0.0;
  CHECK(error_text([&] { fit_master_curve(data); }).find("at 10 C and 0.587802 s") !=
        std::string::npos);
  data.modulus_Pa[50] = kept;
  for (double& modulus : data.modulus_Pa) modulus = -modulus;
  CHECK(error_text([&] { fit_master_curve(data); }).find("--column modulus_Pa=-NAME") !=
        std::string::npos);
}

namespace {

// A glassy polymer swept from 0.1 to 10 Hz every 5 K: a spectrum of two terms a decade over 24
// decades with few moduli in the glass, a WLF shift, and isotherms whose moduli are off by a factor
// each, as by the clamps. Far below the transition E' changes by 1 to 2 % a decade.
MasterData glassy_sweeps(double noise, double isotherm_scatter, std::uint64_t seed) {
  PronySeries truth{1e6, {}};
  for (int i = -36; i <= 12; ++i) {
    const double decade = 0.5 * i;
    const double peak = decade > -4.0 ? std::exp(-std::pow((decade + 1.0) / 1.5, 2)) : 0.0;
    truth.terms.push_back({2e7 + 3e8 * peak, std::pow(10.0, decade)});
  }
  const TemperatureShift wlf{.law = ShiftLaw::kWlf, .T_ref_C = 110.0, .C1 = 12.0, .C2_K = 55.0};
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  MasterData data;
  for (double T_C = 80.0; T_C < 141.0; T_C += 5.0) {
    const double a = std::exp(ln_shift_factor(wlf, T_C));
    const double b = 1.0 + isotherm_scatter * normal(dice);
    for (int i = 0; i <= 12; ++i) {
      const double f_Hz = std::pow(10.0, -1.0 + i / 6.0);
      const ComplexModulus modulus = complex_modulus_Pa(truth, 2.0 * std::numbers::pi * f_Hz * a);
      data.temperature_C.push_back(T_C);
      data.argument.push_back(f_Hz);
      data.modulus_Pa.push_back(b * modulus.storage_Pa * (1.0 + noise * normal(dice)));
      data.loss_Pa.push_back(b * modulus.loss_Pa * (1.0 + noise * normal(dice)));
    }
  }
  data.T_ref_C = 110.0;
  return data;
}

}  // namespace

TEST_CASE("a glass whose isotherms scatter by 2 % does not climb in a staircase", "[fit][master]") {
  const MasterCurve curve = fit_master_curve(glassy_sweeps(0.005, 0.02, 4));
  const TemperatureShift wlf{.law = ShiftLaw::kWlf, .T_ref_C = 110.0, .C1 = 12.0, .C2_K = 55.0};
  CAPTURE(curve.form, curve.residual, curve.free_residual);
  CHECK(curve.form != "free");
  REQUIRE(curve.free_factors.size() == curve.factors.size());
  double last = 100.0;
  for (std::size_t k = 0; k < curve.factors.size(); ++k) {
    const ShiftFactor& factor = curve.factors[k];
    CAPTURE(factor.temperature_C, factor.ln_a, curve.free_factors[k].ln_a);
    CHECK(factor.ln_a == Approx(ln_shift_factor(wlf, factor.temperature_C)).margin(1.2));
    CHECK(factor.ln_a < last - 0.5);  // no steps
    last = factor.ln_a;
  }
}

TEST_CASE("isotherms with a vertical shift need one, and the horizontal shifts stay right",
          "[fit][master]") {
  const MasterData plain = relaxation_data(kWlf, 0.003, 11);
  MasterData data = plain;
  for (std::size_t i = 0; i < data.modulus_Pa.size(); ++i) {
    data.modulus_Pa[i] *= (data.temperature_C[i] + 273.15) / 293.15;  // an entropic network
  }
  CHECK_FALSE(fit_master_curve(plain).has_vertical_shift);
  const MasterCurve curve = fit_master_curve(data);
  REQUIRE(curve.has_vertical_shift);
  CHECK(has_flag(curve.fit, "vertical-shift"));
  for (const ShiftFactor& factor : curve.factors) {
    CAPTURE(factor.temperature_C);
    const double T_K = factor.temperature_C + 273.15;
    CHECK(factor.ln_b == Approx(std::log(T_K / 293.15)).margin(4.0 * factor.ln_b_se + 0.003));
    CHECK(factor.ln_a ==
          Approx(ln_shift_factor(kWlf, factor.temperature_C)).margin(4.0 * factor.ln_a_se + 0.05));
  }
  FitOptions off;
  off.vertical_shift = VerticalShift::kOff;
  CHECK_FALSE(fit_master_curve(data, off).has_vertical_shift);
}

TEST_CASE("isotherms that slip vertically widen the errors of their shift factors",
          "[fit][master]") {
  // One term a decade: a vertical slip of an isotherm looks like a shift of its time.
  PronySeries broad{1e6, {}};
  for (int k = -6; k <= 6; ++k) broad.terms.push_back({1e8 * std::pow(3.0, -k), std::pow(10.0, k)});
  const auto isotherms = [&](double slip, std::uint64_t seed) {
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    MasterData data;
    for (double T_C = 0.0; T_C <= 60.0; T_C += 10.0) {
      const double a = std::exp(ln_shift_factor(kWlf, T_C)), b = 1.0 + slip * normal(dice);
      for (int i = 0; i < 25; ++i) {
        const double t_s = std::pow(10.0, 3.0 * i / 24.0);
        data.temperature_C.push_back(T_C);
        data.argument.push_back(t_s);
        data.modulus_Pa.push_back(b * relaxation_modulus_Pa(broad, t_s / a) *
                                  (1.0 + 1e-3 * normal(dice)));
      }
    }
    data.T_ref_C = 20.0;
    return data;
  };
  CHECK_FALSE(has_flag(fit_master_curve(isotherms(0.0, 1)).fit, "shifts-scatter"));
  int n_flagged = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const MasterCurve curve = fit_master_curve(isotherms(0.01, seed));
    n_flagged += has_flag(curve.fit, "shifts-scatter") || curve.has_vertical_shift ? 1 : 0;
    for (const ShiftFactor& factor : curve.factors) {
      CAPTURE(seed, factor.temperature_C);
      CHECK(std::abs(factor.ln_a - ln_shift_factor(kWlf, factor.temperature_C)) <=
            4.0 * factor.ln_a_se + 1e-9);
    }
  }
  CHECK(n_flagged == 3);
}

TEST_CASE("shifts that follow no smooth curve are taken free, and the difference is flagged",
          "[fit][master]") {
  MasterData data = relaxation_data(kWlf, 0.003, 5);
  for (std::size_t i = 0; i < data.argument.size(); ++i) {
    if (std::abs(data.temperature_C[i] - 30.0) < 2.0) data.argument[i] *= 2.0;  // a wrong clock
  }
  const MasterCurve curve = fit_master_curve(data);
  CHECK(curve.form == "free");
  CHECK(has_flag(curve.fit, "shifts-not-smooth"));
  CHECK(has_flag(curve.fit, "shift-law-misfit"));
  CHECK(curve.factors[3].ln_a ==
        Approx(ln_shift_factor(kWlf, curve.factors[3].temperature_C) + std::log(2.0)).margin(0.06));
}

TEST_CASE("isotherms that are left out are named", "[fit][master]") {
  MasterData data = relaxation_data(kWlf, 0.003, 6);
  for (int i = 0; i < 2; ++i) {
    data.temperature_C.push_back(80.0);
    data.argument.push_back(1.0 + i);
    data.modulus_Pa.push_back(2.1e6);
  }
  for (int i = 0; i < 5; ++i) {
    data.temperature_C.push_back(-60.0);
    data.argument.push_back(1.0 + i);
    data.modulus_Pa.push_back(9e7 - 1e5 * i);  // no modulus in common with 0 C
  }
  const MasterCurve curve = fit_master_curve(data);
  CHECK(curve.factors.size() == 6);
  REQUIRE(curve.left_out.size() == 2);
  CHECK(curve.fit.n_left_out == 7);
  REQUIRE(curve.fit.left_out.size() == 1);  // by the right reason
  CHECK(curve.fit.left_out[0].reason == "isotherm");
  REQUIRE(has_flag(curve.fit, "isotherms-left-out"));
  for (const MaterialFlag& flag : curve.fit.flags) {
    if (flag.name != "isotherms-left-out") continue;
    CHECK(flag.text.find("80 C (only 2 rows") != std::string::npos);
    CHECK(flag.text.find("-60 C (no modulus in common") != std::string::npos);
  }
}

TEST_CASE("start shifts that are far off lead to the same master curve as none", "[fit][master]") {
  MasterData data = relaxation_data(kWlf, 0.005, 7);
  const MasterCurve plain = fit_master_curve(data, {.n_terms = 4});
  CHECK(plain.start_given.empty());
  double off = 2.0;  // decades, to alternating sides
  for (const double T_C : {0.0, 10.0, 30.0, 45.0, 60.0}) {
    data.start_shifts.push_back({T_C, ln_shift_factor(kWlf, T_C) / std::numbers::ln10 + off});
    off = -off;
  }
  const MasterCurve curve = fit_master_curve(data, {.n_terms = 4});
  CHECK(curve.start_given.size() == 5);
  CHECK_FALSE(curve.is_start_as_given);
  CHECK(curve.form == plain.form);
  REQUIRE(curve.factors.size() == plain.factors.size());
  for (std::size_t k = 0; k < curve.factors.size(); ++k) {
    CAPTURE(curve.factors[k].temperature_C);
    // The same start: the same numbers.
    CHECK(curve.factors[k].ln_a == Approx(plain.factors[k].ln_a).margin(1e-9));
  }
  CHECK(curve.fit.E0_Pa == Approx(plain.fit.E0_Pa).epsilon(1e-9));
}

TEST_CASE("start shifts near the truth are taken, and lead to the same master curve as none",
          "[fit][master]") {
  MasterData data = relaxation_data(kWlf, 0.005, 7);
  const MasterCurve plain = fit_master_curve(data, {.n_terms = 4});
  for (const ShiftFactor& factor : plain.free_factors) {  // to 0.01 decade, as a person drags
    data.start_shifts.push_back({factor.temperature_C, 0.01 * std::round(factor.ln_a / 0.023026)});
  }
  const MasterCurve curve = fit_master_curve(data, {.n_terms = 4});
  CHECK(curve.is_start_as_given);
  REQUIRE(curve.factors.size() == plain.factors.size());
  for (std::size_t k = 0; k < curve.factors.size(); ++k) {
    CAPTURE(curve.factors[k].temperature_C);
    // Searches stop when the sum of squares is known to 1e-9 of itself.
    CHECK(curve.factors[k].ln_a ==
          Approx(plain.factors[k].ln_a).margin(0.1 * plain.factors[k].ln_a_se + 1e-6));
  }
  CHECK(curve.fit.E_inf_Pa == Approx(plain.fit.E_inf_Pa).epsilon(1e-3));
}

namespace {

// Steps of 0.3 to 30 s, with a decade of reduced time between 0 and 30 C that no isotherm shows.
MasterData relaxation_with_gap() {
  std::mt19937_64 dice(3);
  std::normal_distribution<double> normal;
  MasterData data;
  for (const double T_C : {-10.0, 0.0, 30.0, 40.0, 50.0}) {
    const double a = std::exp(ln_shift_factor(kWlf, T_C));
    for (int i = 0; i < 40; ++i) {
      const double t_s = 0.3 * std::pow(10.0, 2.0 * i / 39.0);
      data.temperature_C.push_back(T_C);
      data.argument.push_back(t_s);
      data.modulus_Pa.push_back(relaxation_modulus_Pa(kTruth, t_s / a) *
                                (1.0 + 0.002 * normal(dice)));
    }
  }
  data.T_ref_C = 40.0;
  return data;
}

}  // namespace

TEST_CASE("a start shift keeps isotherms without a modulus in common, and the law places them",
          "[fit][master]") {
  MasterData data = relaxation_with_gap();
  const MasterCurve without = fit_master_curve(data);
  CHECK(without.factors.size() == 3);
  CHECK(has_flag(without.fit, "isotherms-left-out"));
  const auto from_reference = [](double T_C) {
    return ln_shift_factor(kWlf, T_C) - ln_shift_factor(kWlf, 40.0);
  };
  // -10 C follows its neighbour.
  data.start_shifts = {{0.0, from_reference(0.0) / std::numbers::ln10}};
  const MasterCurve curve = fit_master_curve(data);
  CAPTURE(curve.form, curve.is_start_as_given);
  CHECK(curve.left_out.empty());
  CHECK_FALSE(has_flag(curve.fit, "isotherms-left-out"));
  CHECK(has_flag(curve.fit, "isotherms-apart"));
  CHECK_FALSE(has_flag(curve.fit, "shifts-not-determined"));
  REQUIRE(curve.factors.size() == 5);
  for (const ShiftFactor& factor : curve.factors) {
    CAPTURE(factor.temperature_C, factor.ln_a, factor.ln_a_se);
    // Across the gap the law extrapolates: within half a decade.
    CHECK(factor.ln_a ==
          Approx(from_reference(factor.temperature_C)).margin(0.5 * std::numbers::ln10));
  }
}

TEST_CASE("two isotherms without a modulus in common are joined by a start shift, and not trusted",
          "[fit][master]") {
  const MasterData all = relaxation_with_gap();
  MasterData data;
  for (std::size_t i = 0; i < all.argument.size(); ++i) {
    if (all.temperature_C[i] != 0.0 && all.temperature_C[i] != 30.0) continue;
    data.temperature_C.push_back(all.temperature_C[i]);
    data.argument.push_back(all.argument[i]);
    data.modulus_Pa.push_back(all.modulus_Pa[i]);
  }
  data.T_ref_C = 30.0;
  CHECK(error_text([&] { fit_master_curve(data); }).find("have no value in common") !=
        std::string::npos);
  data.start_shifts = {{0.0, 3.0}};
  const MasterCurve curve = fit_master_curve(data);
  CHECK(curve.factors.size() == 2);
  CHECK(has_flag(curve.fit, "shifts-not-determined"));
  CHECK_FALSE(curve.fit.is_trustworthy);
}

TEST_CASE("start shifts of a frequency sweep have the sign of the factors of the result",
          "[fit][master]") {
  MasterData data = glassy_sweeps(0.005, 0.0, 4);
  const TemperatureShift wlf{.law = ShiftLaw::kWlf, .T_ref_C = 110.0, .C1 = 12.0, .C2_K = 55.0};
  for (double T_C = 80.0; T_C < 141.0; T_C += 5.0) {
    data.start_shifts.push_back({T_C, ln_shift_factor(wlf, T_C) / std::numbers::ln10});
  }
  const MasterCurve curve = fit_master_curve(data);
  CHECK(curve.is_start_as_given);
  REQUIRE(curve.factors.size() == 13);
  for (const ShiftFactor& factor : curve.factors) {
    CAPTURE(factor.temperature_C);
    CHECK(factor.ln_a == Approx(ln_shift_factor(wlf, factor.temperature_C)).margin(0.5));
  }
}

TEST_CASE("bad start shifts are refused with how to write them", "[fit][master]") {
  const MasterData data = relaxation_data(kWlf, 0.0, 1);
  const auto refused = [&](const std::vector<StartShift>& shifts) {
    MasterData with = data;
    with.start_shifts = shifts;
    return error_text([&] { fit_master_curve(with); });
  };
  const auto has = [](const std::string& text, const std::string& part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  has(refused({{25.0, 1.0}}),
      "--start-shift 25=1: no isotherm was measured at 25 C; there are 0 C");
  has(refused({{30.0, -1.0}, {30.4, -2.0}}),
      "--start-shift 30.4=-2: the isotherm at 30 C has a start value already, -1; give one");
  has(refused({{20.0, 0.5}}), "--start-shift 20=0.5: 20 C is the reference temperature");
  has(refused({{30.0, 41.0}}), "--start-shift 30=41: log10 a_T lies between -40 and 40 decades");
  has(refused({{30.0, std::nan("")}}), "--start-shift 30=nan: log10 a_T lies between");
  has(refused({{std::nan(""), 1.0}}), "the temperature is no number");
  CHECK(refused({{20.0, 0.0}}).empty());  // the reference itself
}
