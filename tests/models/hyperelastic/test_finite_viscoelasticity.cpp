#include "models/hyperelastic/finite_viscoelasticity.h"
#include "tests/support/convergence.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

HyperelasticLaw mooney() {
  Eigen::VectorXd moduli_Pa(2);
  moduli_Pa << 2e5, 5e4;
  return {HyperelasticForm::kMooneyRivlin, moduli_Pa, {}};
}

// S_1 and S_3 of Mooney-Rivlin in uniaxial tension by its own formula: the Kirchhoff stress is
// 2 C10 s_i^2 - 2 C01/s_i^2 up to the pressure.
std::array<double, 2> piola_uniaxial(double s) {
  const double first = 4e5 * s * s - 1e5 / (s * s), side = 4e5 / s - 1e5 * s;
  const double mean = (first + 2.0 * side) / 3.0;
  return {(first - mean) / (s * s), (side - mean) * s};
}

// The nominal stress of a ramp to `top` in `ramp_s` followed by a hold, by Simpson's rule on the
// hereditary integral of dS/dt by central differences: no recursion.
double by_quadrature(double g, double tau_s, double top, double ramp_s, double at_s) {
  const auto stretch = [&](double t) { return 1.0 + (top - 1.0) * std::min(t, ramp_s) / ramp_s; };
  constexpr int n = 4000;
  const double end = std::min(at_s, ramp_s), h = end / n;
  std::array<double, 2> sum{};
  for (int i = 0; i <= n; ++i) {
    const double t = h * i, small = 1e-5 * ramp_s;
    const double s_up = 1.0 + (top - 1.0) * (t + small) / ramp_s;
    const double s_down = 1.0 + (top - 1.0) * (t - small) / ramp_s;
    const double simpson = i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    for (std::size_t j = 0; j < 2; ++j) {
      const double rate = (piola_uniaxial(s_up)[j] - piola_uniaxial(s_down)[j]) / (2.0 * small);
      sum[j] += simpson * h / 3.0 * std::exp(-(at_s - t) / tau_s) * rate;
    }
  }
  const double s = stretch(at_s);
  std::array<double, 2> total = piola_uniaxial(s);
  for (std::size_t j = 0; j < 2; ++j) total[j] = (1.0 - g) * total[j] + g * sum[j];
  return (s * s * total[0] - total[1] / s) / s;
}

Course ramp_and_hold(double top, double ramp_s, int n_ramp, double hold_s, int n_hold) {
  Course history;
  for (int i = 0; i <= n_ramp; ++i) {
    history.push_back({ramp_s * i / n_ramp, 1.0 + (top - 1.0) * i / n_ramp});
  }
  for (int i = 1; i <= n_hold; ++i) history.push_back({ramp_s + hold_s * i / n_hold, top});
  return history;
}

}  // namespace

TEST_CASE("finite viscoelasticity: after a jump each term relaxes by exp(-t/tau)", "[models]") {
  const HyperelasticLaw law = mooney();
  const std::vector<RubberTerm> terms{{0.3, 0.5}, {0.2, 40.0}};
  for (const auto deformation :
       {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
    for (const double stretch : {0.6, 1.7, 3.0}) {
      const Course history{
          {0.0, 1.0}, {0.0, stretch}, {0.4, stretch}, {7.0, stretch}, {200.0, stretch}};
      const std::vector<double> stress_Pa = nominal_stress_Pa(law, terms, deformation, history);
      const double at_once_Pa = nominal_stress_Pa(law, deformation, stretch);
      CHECK(stress_Pa[0] == Approx(0.0).margin(1e-9));
      for (std::size_t i = 1; i < stress_Pa.size(); ++i) {
        const double t = history[i].time_s;
        const double left = 0.5 + 0.3 * std::exp(-t / 0.5) + 0.2 * std::exp(-t / 40.0);
        CHECK(stress_Pa[i] == Approx(at_once_Pa * left).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("finite viscoelasticity: a ramp and a hold as the hereditary integral by quadrature",
          "[models][identity]") {
  const Course history = ramp_and_hold(2.2, 3.0, 60, 10.0, 5);
  const std::vector<double> stress_Pa =
      nominal_stress_Pa(mooney(), {{0.4, 1.3}}, Deformation::kUniaxial, history);
  for (const std::size_t i : {20u, 45u, 60u, 62u, 65u}) {
    CAPTURE(history[i].time_s);
    // The stress is taken as linear within steps of at most 2 %.
    CHECK(stress_Pa[i] ==
          Approx(by_quadrature(0.4, 1.3, 2.2, 3.0, history[i].time_s)).epsilon(5e-5));
  }
}

TEST_CASE("finite viscoelasticity: the step is of second order, and coarse records are divided",
          "[models][convergence]") {
  const double exact_Pa = by_quadrature(0.4, 1.3, 1.3, 3.0, 3.0);
  const auto error = [&](double step) {
    const int n = static_cast<int>(std::lround(0.3 / step));
    return std::abs(
        nominal_stress_Pa(mooney(), {{0.4, 1.3}}, Deformation::kUniaxial,
                          ramp_and_hold(1.3, 3.0, n, 1.0, 1))[static_cast<std::size_t>(n)] -
        exact_Pa);
  };
  const std::vector<double> orders = test::observed_orders(error, 0.02, 3);
  CAPTURE(orders);
  CHECK(orders.back() == Approx(2.0).margin(0.05));
  CHECK(error(0.3) < 2.0 * error(0.02));  // one step of 30 %
}

TEST_CASE("finite viscoelasticity: slow and quick times give the two elastic limits",
          "[models][reduction]") {
  const Course history = ramp_and_hold(1.8, 1.0, 30, 5.0, 4);
  const auto slow_Pa = nominal_stress_Pa(mooney(), {{0.6, 1e9}}, Deformation::kPlanar, history);
  const auto quick_Pa = nominal_stress_Pa(mooney(), {{0.6, 1e-9}}, Deformation::kPlanar, history);
  for (std::size_t i = 1; i < history.size(); ++i) {
    const double law_Pa = nominal_stress_Pa(mooney(), Deformation::kPlanar, history[i].value);
    CHECK(slow_Pa[i] == Approx(law_Pa).epsilon(1e-8));
    CHECK(quick_Pa[i] == Approx(0.4 * law_Pa).epsilon(1e-6));
  }
}

TEST_CASE("finite viscoelasticity: derivative by ln tau as finite differences",
          "[models][gradient]") {
  const StretchCourse course(Deformation::kEquibiaxial, ramp_and_hold(1.9, 2.0, 25, 30.0, 40));
  const HyperelasticLaw law = mooney();
  const auto stress = course.unit_stress(law.form, law.shapes, false).values.times(law.moduli_Pa);
  for (const double tau_s : {1e-3, 0.3, 8.0, 1e6}) {
    const double h = 1e-4;
    const Eigen::VectorXd up = course.relaxed(stress, tau_s * std::exp(h), false).values.col(0);
    const Eigen::VectorXd down = course.relaxed(stress, tau_s * std::exp(-h), false).values.col(0);
    const Eigen::VectorXd slope = course.relaxed(stress, tau_s, true).by_ln_tau.col(0);
    CHECK((slope - (up - down) / (2.0 * h)).norm() < 1e-6 * slope.norm() + 1e-3);
  }
}

TEST_CASE("finite viscoelasticity: bad terms and histories are refused", "[models]") {
  const auto stress_of = [](const std::vector<RubberTerm>& terms, const Course& history) {
    return nominal_stress_Pa(mooney(), terms, Deformation::kUniaxial, history);
  };
  CHECK_THROWS_WITH(stress_of({{0.7, 1.0}, {0.6, 2.0}}, {{0.0, 1.0}}),
                    Contains("the sum of all g is 1.3; it must be at most 1"));
  CHECK_THROWS_WITH(stress_of({{0.1, 0.0}}, {{0.0, 1.0}}), Contains("tau_1 is 0 s"));
  CHECK_THROWS_WITH(stress_of({}, {{0.0, 1.0}, {-1.0, 1.1}}),
                    Contains("the time of point 2 of a history is before"));
  CHECK_THROWS_WITH(stress_of({}, {{0.0, 1.0}, {1.0, -1.1}}), Contains("the stretch of point 2"));
}
