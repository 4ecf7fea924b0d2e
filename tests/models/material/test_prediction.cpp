#include "models/material/prediction.h"
#include "models/material/retardation_spectrum.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

using namespace viscard;

namespace {

// E_inf 1 MPa, E_1 0.5 MPa, tau 2 s, with correlated errors.
Material fitted_material() {
  Material material;
  material.E0_Pa = 1.5e6;
  material.nu = 0.495;
  material.terms = {{1.0 / 3.0, 1.0 / 3.0, 2.0}};
  material.valid = {0.1, 100.0, 0.0};
  MaterialUncertainty uncertainty;
  uncertainty.covariance_parameters = {"E_inf_Pa", "E_1_Pa", "ln_tau_1"};
  Eigen::MatrixXd factor(3, 3);
  factor << 8e3, 0.0, 0.0, -5e3, 6e3, 0.0, -0.02, 0.01, 0.01;
  uncertainty.covariance = factor * factor.transpose();
  uncertainty.terms.resize(1);
  material.uncertainty = uncertainty;
  return material;
}

double half_width(const BandedCurve& curve, std::size_t i) {
  return 0.5 * (curve.high_95[i] - curve.low_95[i]);
}

}  // namespace

TEST_CASE("the band of E(t) is J C J' with the derivatives of the closed form", "[models]") {
  const Material material = fitted_material();
  const BandedCurve band = banded_curve(material, [](const PronySeries& series) {
    std::vector<double> out;
    for (const double t : {0.0, 0.3, 2.0, 50.0}) out.push_back(relaxation_modulus_Pa(series, t));
    return out;
  });
  const double times[] = {0.0, 0.3, 2.0, 50.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const double decay = std::exp(-times[i] / 2.0);
    const Eigen::Vector3d slope(1.0, decay, 0.5e6 * decay * times[i] / 2.0);
    const double se = std::sqrt(slope.dot(material.uncertainty->covariance * slope));
    CHECK(band.value[i] == Approx(1e6 + 0.5e6 * decay));
    CHECK(half_width(band, i) == Approx(kNormal95 * se).epsilon(1e-6));
  }
}

TEST_CASE("the systematic part scales the curve and is added in quadrature", "[models]") {
  Material material = fitted_material();
  const CurveOfSeries creep = [](const PronySeries& series) {
    return std::vector<double>{creep_compliance_1_Pa(retardation_from_relaxation(series), 1.0)};
  };
  const double scatter = half_width(banded_curve(material, creep), 0);
  material.uncertainty->systematic_relative = 0.03;
  const BandedCurve both = banded_curve(material, creep);
  CHECK(half_width(both, 0) ==
        Approx(std::hypot(scatter, kNormal95 * 0.03 * both.value[0])).epsilon(1e-6));
}

TEST_CASE("the band of a strain is the scatter of materials drawn from the covariance",
          "[models][identity]") {
  const Material material = fitted_material();
  const Course history =
      course_of_steps({{1.0, 1e4}, {20.0, 1e4}, {0.5, 0.0}, {20.0, 0.0}}, 0.1, 12);
  const BandedCurve band = banded_curve(
      material, [&](const PronySeries& series) { return response(series, history, true); });
  const Eigen::MatrixXd factor = material.uncertainty->covariance.llt().matrixL();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 4000;
  std::vector<double> squares(history.size(), 0.0);
  for (int k = 0; k < kDraws; ++k) {
    const Eigen::Vector3d z(normal(random), normal(random), normal(random));
    const Eigen::Vector3d change = factor * z;
    const PronySeries drawn{1e6 + change[0], {{0.5e6 + change[1], 2.0 * std::exp(change[2])}}};
    const std::vector<double> strain = response(drawn, history, true);
    for (std::size_t i = 0; i < strain.size(); ++i) {
      squares[i] += std::pow(strain[i] - band.value[i], 2) / kDraws;
    }
  }
  double largest = 0.0;
  for (const double value : band.value) largest = std::max(largest, value);
  for (std::size_t i = 1; i < squares.size(); ++i) {
    CAPTURE(history[i].time_s);
    // Four standard errors of 4000 draws; curvature matters where the strain almost vanishes.
    CHECK(half_width(band, i) ==
          Approx(kNormal95 * std::sqrt(squares[i])).epsilon(0.05).margin(1e-5 * largest));
  }
}

TEST_CASE("a modulus at its bound and terms that cannot be distinguished have a finite band",
          "[models][stability]") {
  Material material = fitted_material();
  material.E0_Pa = 1e6;
  material.terms = {{0.5, 0.5, 2.0}, {0.5 - 1e-12, 0.5 - 1e-12, 2.0 * (1.0 + 1e-9)}};
  material.uncertainty->terms.resize(2);
  material.uncertainty->covariance_parameters = {"E_inf_Pa", "E_1_Pa", "E_2_Pa", "ln_tau_1",
                                                 "ln_tau_2"};
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(5, 5);
  covariance(0, 0) = 1e6;
  covariance(1, 1) = covariance(2, 2) = 1e20;  // only their sum is known
  covariance(1, 2) = covariance(2, 1) = -1e20 + 1e8;
  material.uncertainty->covariance = covariance;
  PredictionRequest request;
  request.test = PredictedTest::kCreep;
  const TestPrediction creep = predict_test(material, request);
  for (std::size_t i = 0; i < creep.at.size(); ++i) {
    REQUIRE(std::isfinite(creep.curves[0].curve.low_95[i]));
    REQUIRE(creep.curves[0].curve.high_95[i] >= creep.curves[0].curve.value[i]);
  }
}

TEST_CASE("relaxation predicts its closed form and marks what the fit has not seen", "[models]") {
  const Material material = fitted_material();
  const PronySeries series = young_series(material);
  PredictionRequest request;
  SECTION("after an ideal step") {
    request.from = 0.01;
    const TestPrediction found = predict_test(material, request);
    CHECK(found.at.front() == 0.01);
    CHECK(found.at.back() == 100.0);
    CHECK(found.curves[0].name == "modulus_Pa");
    for (std::size_t i = 0; i < found.at.size(); ++i) {
      CHECK(found.curves[0].curve.value[i] == relaxation_modulus_Pa(series, found.at[i]));
      CHECK(found.is_inside[i] == (found.at[i] >= 0.1 - 1e-9));
    }
  }
  SECTION("after a ramp") {
    request.strain = 0.02;
    request.ramp_s = 1.0;
    request.hold_s = 60.0;
    request.also_at = {3.0};
    const TestPrediction found = predict_test(material, request);
    CHECK(found.input_name == "strain");
    CHECK(found.curves[0].name == "stress_Pa");
    const auto at = std::find(found.at.begin(), found.at.end(), 3.0) - found.at.begin();
    // E_inf + E_1 (tau/t_R)(1 - exp(-t_R/tau)) exp(-(t - t_R)/tau)
    const double effective = 1e6 + 0.5e6 * 2.0 * -std::expm1(-0.5) * std::exp(-1.0);
    CHECK(found.curves[0].curve.value[static_cast<std::size_t>(at)] ==
          Approx(0.02 * effective).epsilon(1e-12));
  }
}

TEST_CASE("creep and recovery predict their closed forms", "[models]") {
  const Material material = fitted_material();
  const RetardationSpectrum spectrum = retardation_from_relaxation(young_series(material));
  PredictionRequest request;
  SECTION("creep") {
    request.test = PredictedTest::kCreep;
    const TestPrediction found = predict_test(material, request);
    CHECK(found.curves[0].name == "compliance_1_Pa");
    CHECK(found.curves[0].curve.value[7] == creep_compliance_1_Pa(spectrum, found.at[7]));
  }
  SECTION("recovery") {
    request.test = PredictedTest::kRecovery;
    request.stress_Pa = 1e4;
    request.hold_s = 30.0;
    const TestPrediction found = predict_test(material, request);
    CHECK(found.at.back() == 60.0);
    CHECK(found.curves[0].curve.value.back() ==
          Approx(1e4 *
                 (creep_compliance_1_Pa(spectrum, 60.0) - creep_compliance_1_Pa(spectrum, 30.0)))
              .epsilon(1e-9));
  }
}

TEST_CASE("cycles and oscillation predict their closed forms", "[models]") {
  const Material material = fitted_material();
  const PronySeries series = young_series(material);
  PredictionRequest request;
  SECTION("cycles") {
    request.test = PredictedTest::kCycles;
    request.n_cycles = 3;
    request.period_s = 4.0;
    const TestPrediction found = predict_test(material, request);
    CHECK(found.at.back() == Approx(12.0));
    CHECK(found.at.size() >= 6U * static_cast<std::size_t>(request.points - 1));
    CHECK(*std::max_element(found.input.begin(), found.input.end()) == Approx(0.01));
    CHECK(found.curves[0].curve.value.back() < 0.0);  // it cannot relax back in time
  }
  SECTION("oscillation") {
    request.test = PredictedTest::kOscillation;
    const TestPrediction found = predict_test(material, request);
    CHECK(found.argument == "frequency_Hz");
    CHECK(found.at.front() == Approx(1.0 / (2.0 * std::numbers::pi * 100.0)));
    CHECK(found.at.back() == Approx(1.0 / (2.0 * std::numbers::pi * 0.1)));
    const ComplexModulus exact = complex_modulus_Pa(series, 2.0 * std::numbers::pi * found.at[9]);
    CHECK(found.curves[0].curve.value[9] == exact.storage_Pa);
    CHECK(found.curves[1].curve.value[9] == exact.loss_Pa);
    CHECK(found.curves[2].curve.value[9] == exact.loss_Pa / exact.storage_Pa);
    CHECK(std::count(found.is_inside.begin(), found.is_inside.end(), false) == 0);
  }
}

TEST_CASE("requests that contradict the test are refused", "[models]") {
  const Material material = fitted_material();
  const auto refused = [&](const PredictionRequest& request) {
    CHECK_THROWS_AS(predict_test(material, request), std::invalid_argument);
  };
  refused({.test = PredictedTest::kRelaxation, .stress_Pa = 1.0});
  refused({.test = PredictedTest::kCreep, .strain = 0.1});
  refused({.test = PredictedTest::kHistory});
  refused({.test = PredictedTest::kRecovery, .hold_s = -1.0});
  refused({.from = 10.0, .to = 1.0});
  refused({.test = PredictedTest::kCycles, .n_cycles = 10000, .points = 1000});
  refused({.also_at = {-1.0}});
  CHECK_THROWS_WITH(material_at_temperature(material, 40.0),
                    Catch::Contains("no temperature shift"));
}

TEST_CASE("at another temperature the times and the window shift together", "[models]") {
  Material material = fitted_material();
  material.T_ref_C = 20.0;
  material.shift =
      TemperatureShift{.law = ShiftLaw::kWlf, .T_ref_C = 20.0, .C1 = 10.0, .C2_K = 80.0};
  const Material warm = material_at_temperature(material, 40.0);
  const double a_T = std::pow(10.0, -10.0 * 20.0 / 100.0);
  CHECK(warm.terms[0].tau_s == Approx(2.0 * a_T).epsilon(1e-12));
  CHECK(warm.valid.t_min_s == Approx(0.1 * a_T).epsilon(1e-12));
  CHECK(warm.valid.t_max_s == Approx(100.0 * a_T).epsilon(1e-12));
}
