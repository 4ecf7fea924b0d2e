#include "fit/curves/step_model.h"
#include "fit/fit_relaxation.h"
#include "fit/search/order_path.h"
#include "fit/search/projection.h"
#include "fit/search/separable.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// A master curve like that of a glassy polymer: 31 decades, 481 points, a broad spectrum
// (Kohlrausch's function), and a small error of its own for each segment.
RelaxationData broad_master_curve() {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  RelaxationData data;
  double shift = 0.0;
  for (int i = 0; i < 481; ++i) {
    if (i % 30 == 0) shift = 2e-3 * normal(random);
    const double ln_t = std::log(10.0) * (-2.5 + 31.0 * i / 480.0);
    const double share = 1.0 / (1.0 + std::exp(0.17 * (ln_t - 40.0)));
    data.time_s.push_back(std::exp(ln_t));
    data.value.push_back(1e9 * (0.05 + 1.6 * share) * (1.0 + shift + 3e-4 * normal(random)));
  }
  return data;
}

SpectralState from_times(const std::vector<double>& tau_s) {
  SpectralState state;
  state.ln_tau.resize(static_cast<Eigen::Index>(tau_s.size()));
  for (std::size_t i = 0; i < tau_s.size(); ++i) {
    state.ln_tau[static_cast<Eigen::Index>(i)] = std::log(tau_s[i]);
  }
  return state;
}

}  // namespace

TEST_CASE("more terms never fit worse, and a requested order equals that of the free choice",
          "[fit]") {
  const RelaxationData data = broad_master_curve();
  const FitResult free = fit_relaxation(data);
  REQUIRE(free.orders.size() >= 15);
  for (std::size_t i = 1; i < free.orders.size(); ++i) {
    CHECK(free.orders[i].rss < free.orders[i - 1].rss);
    CHECK(free.orders[i].n_terms > free.orders[i - 1].n_terms);
  }
  FitOptions options;
  options.n_terms = 4;
  const FitResult wished = fit_relaxation(data, options);
  REQUIRE(wished.terms.size() == 4);
  // The sums of squares of one table are in proportion to the weighted ones of that fit.
  for (std::size_t i = 0; i < free.orders.size(); ++i) {
    if (free.orders[i].n_terms != 4) continue;
    CHECK(wished.orders[i].bic == Approx(free.orders[i].bic).epsilon(1e-9));
    CHECK(wished.rss <= wished.orders[i].rss * (1.0 + 1e-9));
  }
}

TEST_CASE("no random start finds a better fit of few terms than the path", "[fit]") {
  const RelaxationData data = broad_master_curve();
  const StepModel model(data.time_s, data.value, StepShape::kRelaxation, {});
  const std::vector<SpectralState> path = order_path(model, {.max_terms = 40});
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> anywhere(model.ln_tau_min(), model.ln_tau_max());
  for (const Eigen::Index n_terms : {2, 3, 4}) {
    const SpectralState& found = path[static_cast<std::size_t>(n_terms)];
    REQUIRE(found.n_terms() == n_terms);
    for (int start = 0; start < 20; ++start) {
      SpectralState state;
      state.ln_tau = Eigen::VectorXd::NullaryExpr(n_terms, [&] { return anywhere(random); });
      // The fits of the path are converged to 1e-7 per step.
      CHECK(found.rss <= quick_search(model, state, {.max_iterations = 60}).rss * (1.0 + 1e-4));
    }
  }
}

TEST_CASE("projections by normal equations and by QR agree", "[fit][identity]") {
  const RelaxationData data = relaxation_of(s2(), 400, 1000.0, 0.01, 7);
  const StepModel model(data.time_s, data.value, StepShape::kRelaxation, {});
  // The columns of the second pair are so close that only QR can separate them.
  const double gap = GENERATE(2.0, 1.0 + 1e-7);
  const SpectralState at = from_times({0.8, 40.0, 40.0 * gap});
  const Projection fast = project(model, at.ln_tau);
  const SpectralState exact = solve_coefficients(model, at.ln_tau, {});
  CHECK(fast.rss == Approx(exact.rss).epsilon(1e-10));
  // Gradient of the sum of squares by central differences of the exact solution.
  for (Eigen::Index i = 0; i < 2 && gap > 1.5; ++i) {
    constexpr double kStep = 1e-5;
    Eigen::VectorXd up = at.ln_tau, down = at.ln_tau;
    up[i] += kStep;
    down[i] -= kStep;
    const double slope =
        (solve_coefficients(model, up, {}).rss - solve_coefficients(model, down, {}).rss) /
        (2.0 * kStep);
    CHECK(2.0 * fast.gradient[i] == Approx(slope).epsilon(1e-4).margin(1e-6));
  }
}

TEST_CASE("the quick search and the thorough search find the same optimum", "[fit]") {
  const RelaxationData data = relaxation_of(s6(), 3000, 1e4, 0.01, 8);
  const StepModel model(data.time_s, data.value, StepShape::kRelaxation, {});
  const SpectralState start = from_times({5.0, 50.0, 500.0, 2000.0});
  const SpectralState quick = quick_search(model, start, {.tolerance = 1e-13});
  const SpectralState thorough = refine(model, start);
  CHECK(quick.rss == Approx(thorough.rss).epsilon(1e-9));
  CHECK((quick.ln_tau - thorough.ln_tau).cwiseAbs().maxCoeff() < 1e-3);
}

TEST_CASE("a time that is held keeps its value", "[fit]") {
  const RelaxationData data = relaxation_of(s2(), 1000, 1000.0, 0.01, 9);
  const StepModel model(data.time_s, data.value, StepShape::kRelaxation, {});
  const SpectralState start = from_times({2.0, 60.0});
  RefineOptions options;
  options.held = 1;
  const SpectralState state = quick_search(model, start, options);
  CHECK(state.ln_tau[1] == std::log(60.0));
  CHECK(std::abs(state.ln_tau[0] - std::log(2.0)) > 0.01);
  CHECK(state.rss > quick_search(model, start, {}).rss);
}
