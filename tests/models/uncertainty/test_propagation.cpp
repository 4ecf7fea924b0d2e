#include "models/uncertainty/curved_propagation.h"
#include "models/uncertainty/linear_propagation.h"
#include "models/uncertainty/sampled_propagation.h"
#include "models/uncertainty/sobol_points.h"
#include "models/uncertainty/uncertain_number.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

using namespace viscard;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Formula = std::function<double(const VectorXd& deviates)>;

BatchFunction batch_of(const std::vector<Formula>& formulas) {
  return [formulas](const MatrixXd& points) {
    MatrixXd answers(points.rows(), static_cast<Eigen::Index>(formulas.size()));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      for (std::size_t k = 0; k < formulas.size(); ++k) {
        answers(i, static_cast<Eigen::Index>(k)) = formulas[k](points.row(i));
      }
    }
    return answers;
  };
}

const std::vector<UncertainInput> kThree{{"a"}, {"b"}, {"c", 1, true}};

// Ishigami & Homma (1990): sin x1 + a sin^2 x2 + b x3^4 sin x1 on (-pi, pi)^3.
double ishigami(const VectorXd& deviates) {
  const VectorXd x = deviates * (std::numbers::pi / std::numbers::sqrt3);
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) +
         0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

}  // namespace

TEST_CASE("an uncertain number has its 95 % between the ends that are written",
          "[models][uncertainty]") {
  const double z = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  const UncertainNumber normal{40.0, 1.0, Spread::kNormal};
  CHECK(value_at(normal, z) == Approx(41.0).epsilon(1e-14));
  CHECK(value_at(normal, -z) == Approx(39.0).epsilon(1e-14));
  const UncertainNumber lognormal{2.0, 1.0, Spread::kLognormal};  // a factor of 1.5
  CHECK(value_at(lognormal, z) == Approx(3.0).epsilon(1e-14));
  CHECK(value_at(lognormal, -z) == Approx(2.0 / 1.5).epsilon(1e-14));
  const UncertainNumber uniform{10.0, 3.0, Spread::kUniform};
  CHECK(value_at(uniform, std::sqrt(3.0)) == Approx(13.0).epsilon(1e-14));
  CHECK(standard_uncertainty(uniform) == Approx(std::sqrt(3.0)).epsilon(1e-14));
  CHECK_THROWS_WITH(validate(UncertainNumber{1.0, 0.0}), Catch::Contains("positive"));
  CHECK_THROWS_WITH(validate(UncertainNumber{-1.0, 0.1, Spread::kLognormal}),
                    Catch::Contains("lognormal"));
}

TEST_CASE("derivatives are extrapolated to the rounding of the function",
          "[models][uncertainty][gradient]") {
  const auto found = linear_answer(
      batch_of({[](const VectorXd& s) { return std::exp(0.1 * s[0]) * std::cos(0.2 + 0.3 * s[1]); },
                [](const VectorXd& s) { return 5.0 + 2.0 * s[2]; }}),
      kThree);
  CHECK(found.slope(0, 0) == Approx(0.1 * std::cos(0.2)).epsilon(1e-9));
  CHECK(found.slope(0, 1) == Approx(-0.3 * std::sin(0.2)).epsilon(1e-9));
  CHECK(std::abs(found.slope(0, 2)) < 1e-14);
  CHECK(found.slope(1, 2) == Approx(2.0).epsilon(1e-12));
  CHECK((found.slope_error.array() <= 1e-6).all());
  // exp(+-0.196) cos(0.2) is 0.019 from its tangent; 5 + 2 s is its own.
  CHECK(found.disagreement[0] > 0.01);
  CHECK(found.disagreement[1] < 1e-12);
}

TEST_CASE("derivatives come from a function to first order where it has answers that settle",
          "[models][uncertainty][gradient]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Formula own = [](const VectorXd& s) {
    return 2.0 + std::sin(0.1 * s[0]) + 0.3 * s[1] + 0.2 * s[2];
  };
  const auto with = [&](const Formula& first_order) {
    return linear_answer(batch_of({own}), kThree, 1e-6, batch_of({first_order}));
  };
  // The tangent of its sine, no answers off the values by "b", and a jump beside the value by "c".
  const LinearAnswer found = with([&](const VectorXd& s) {
    return s[1] != 0.0 ? nan : 2.0 + 0.1 * s[0] + 0.2 * s[2] + (s[2] > 1e-3 ? 0.5 : 0.0);
  });
  CHECK(found.by_solver == std::vector<bool>{true, false, false});
  CHECK(found.slope(0, 0) == Approx(0.1).epsilon(1e-10));
  CHECK(found.slope(0, 1) == Approx(0.3).epsilon(1e-10));
  CHECK(found.slope(0, 2) == Approx(0.2).epsilon(1e-10));
  CHECK(found.n_first_order > 6);
  CHECK(found.n_first_order < found.n_answers);
  // A function of another value is not the answer's.
  const LinearAnswer other = with([](const VectorXd& s) { return 2.001 + s[0] + s[1] + s[2]; });
  CHECK(other.by_solver == std::vector<bool>{false, false, false});
  CHECK(other.slope(0, 0) == Approx(0.1).epsilon(1e-9));
  CHECK(other.n_first_order == 1);
}

TEST_CASE("the linear interval of a sum is that of its distribution", "[models][uncertainty]") {
  const std::vector<UncertainInput> normal{{"a"}, {"b", 2}};
  const auto sum = [](const VectorXd& s) { return 1.0 + 3.0 * s[0] + 4.0 * s[2]; };
  const LinearAnswer found = linear_answer(batch_of({sum}), normal);
  const Interval interval = intervals_95(found, normal).front();
  CHECK(interval.low == Approx(1.0 - 1.959963984540054 * 5.0).epsilon(1e-9));
  const MatrixXd shares = variance_shares(found, normal);
  CHECK(shares(0, 0) == Approx(0.36).epsilon(1e-9));
  CHECK(shares(0, 1) == Approx(0.64).epsilon(1e-9));
  const std::vector<UncertainInput> uniform{{"a", 1, true}};
  const LinearAnswer flat =
      linear_answer(batch_of({[](const VectorXd& s) { return s[0]; }}), uniform);
  // 95 % of a uniform distribution are 95 % of its range; 2^14 points resolve 1e-4 of it.
  CHECK(intervals_95(flat, uniform).front().high == Approx(0.95 * std::sqrt(3.0)).epsilon(3e-4));
}

TEST_CASE("samples without an answer count as beyond either end of an interval",
          "[models][uncertainty]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto below = [&](double limit) {
    return sampled_answer(batch_of({[=](const VectorXd& s) { return s[0] < limit ? s[0] : nan; },
                                    [](const VectorXd& s) { return s[0]; }}),
                          {{"a"}}, {.n_answers = 20000});
  };
  // 1.39 % of a normal number lie above 2.2, and 1.11 % below -2.287.
  const SampledAnswer few = below(2.2);
  const SampledResult& cut = few.results[0];
  CHECK(cut.failed_share == Approx(0.0139).margin(1e-3));
  CHECK(few.n_failed > 0);
  CHECK(cut.interval_95.high == Approx(1.960).margin(4.0 * cut.end_error));
  CHECK(cut.interval_95.low == Approx(-2.287).margin(4.0 * cut.end_error));
  CHECK(cut.end_error < 0.05);
  CHECK(few.results[1].failed_share == 0.0);
  CHECK(few.results[1].interval_95.low == Approx(-1.960).margin(0.02));
  const SampledResult many = below(1.9).results[0];  // 2.87 %
  CHECK(many.failed_share > 0.025);
  CHECK(many.interval_95.low == -std::numeric_limits<double>::infinity());
  CHECK(many.interval_95.high == std::numeric_limits<double>::infinity());
}

TEST_CASE("sampled shares are the Sobol' indices of Ishigami's function",
          "[models][uncertainty][reduction]") {
  const std::vector<UncertainInput> inputs{{"x1", 1, true}, {"x2", 1, true}, {"x3", 1, true}};
  const SampledAnswer found = sampled_answer(batch_of({ishigami}), inputs, {.n_answers = 40000});
  const SampledResult& result = found.results.front();
  // Closed form, Saltelli et al., Global Sensitivity Analysis (2008), p. 179.
  const double pi4 = std::pow(std::numbers::pi, 4);
  const double first_1 = 0.5 * std::pow(1.0 + 0.1 * pi4 / 5.0, 2), first_2 = 49.0 / 8.0;
  const double joint = 0.01 * pi4 * pi4 * (1.0 / 18.0 - 1.0 / 50.0);
  const double whole = first_1 + first_2 + joint;
  CHECK(found.n_failed == 0);
  CHECK(result.deviation == Approx(std::sqrt(whole)).epsilon(0.01));
  const double alone[] = {first_1 / whole, first_2 / whole, 0.0};
  const double with_others[] = {(first_1 + joint) / whole, first_2 / whole, joint / whole};
  for (std::size_t g = 0; g < 3; ++g) {
    CAPTURE(g, result.shares[g].standard_error);
    CHECK(result.shares[g].alone == Approx(alone[g]).margin(0.01));
    CHECK(result.shares[g].with_others == Approx(with_others[g]).margin(0.01));
    CHECK(std::abs(result.shares[g].alone - alone[g]) < 4.0 * result.shares[g].standard_error);
  }
}

TEST_CASE("shares of a polynomial of degree 2 need no more samples than its terms",
          "[models][uncertainty]") {
  const auto formula = [](const VectorXd& s) {
    return 1.0 + 2.0 * s[0] + s[1] * s[1] + 0.5 * s[0] * s[2];
  };
  const SampledAnswer found = sampled_answer(batch_of({formula}), kThree, {.n_answers = 400});
  const SampledResult& result = found.results.front();
  const double whole = 4.0 + 2.0 + 0.25;  // variances of s, s^2 and of a product
  CHECK(result.deviation == Approx(std::sqrt(whole)).epsilon(1e-9));
  CHECK(result.shares[0].alone == Approx(4.0 / whole).epsilon(1e-9));
  CHECK(result.shares[1].alone == Approx(2.0 / whole).epsilon(1e-9));
  CHECK(result.shares[2].alone == Approx(0.0).margin(1e-9));
  CHECK(result.shares[2].with_others == Approx(0.25 / whole).epsilon(1e-9));
}

TEST_CASE("points without an answer are counted, and moments leave them out",
          "[models][uncertainty]") {
  const auto half_plane = [](const VectorXd& s) {
    return s[0] > 1.0 ? std::numeric_limits<double>::quiet_NaN() : s[0] + s[1];
  };
  const SampledAnswer found =
      sampled_answer(batch_of({half_plane}), {{"a"}, {"b"}}, {.n_answers = 4000});
  const double share = static_cast<double>(found.n_failed) / static_cast<double>(found.n_answers);
  CHECK(share == Approx(0.1587).margin(0.01));  // of the normal distribution beyond 1
  CHECK(std::isfinite(found.results.front().deviation));
  CHECK(std::isinf(found.results.front().interval_95.high));
  const auto none = [](const VectorXd& s) {
    return s.norm() > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  };
  CHECK_THROWS_WITH(sampled_answer(batch_of({none}), {{"a"}, {"b"}}, {.n_answers = 400}),
                    Catch::Contains("half"));
}

// F = a^-1 b^2 with lognormal a and b is lognormal: ln F is normal with s^2 = 0.3^2 + (2 0.1)^2.
TEST_CASE("a product of powers of lognormal inputs has the interval of a lognormal number",
          "[models][uncertainty]") {
  const std::vector<UncertainInput> inputs{{"a"}, {"b"}};
  const BatchFunction function = batch_of(
      {[](const VectorXd& z) { return -5.0 * std::exp(-0.3 * z[0] + 2.0 * 0.1 * z[1]); },
       [](const VectorXd& z) { return 1.0 + z[0] + 0.05 * z[0] * z[0] - 0.02 * z[1] * z[1]; }});
  const CurvedAnswer curved = curved_answer(function, inputs, linear_answer(function, inputs));
  CHECK(curved.is_logarithm == std::vector<bool>{true, false});
  const double s = std::hypot(0.3, 0.2);
  CHECK(curved.intervals_95[0].low == Approx(-5.0 * std::exp(1.959964 * s)).epsilon(4e-3));
  CHECK(curved.intervals_95[0].high == Approx(-5.0 * std::exp(-1.959964 * s)).epsilon(4e-3));
  CHECK(curved.deviation[0] ==
        Approx(5.0 * std::sqrt(std::expm1(s * s) * std::exp(s * s))).epsilon(5e-3));
  CHECK(curved.shares(0, 0) == Approx(0.09 / 0.13).epsilon(1e-6));
  CHECK(curved.disagreement[0] < 1e-6);
  CHECK(curved.disagreement[1] < 1e-6);
  // Inputs that act only together are in neither form, and are found out.
  const BatchFunction mixed = batch_of({[](const VectorXd& z) { return 1.0 + z[0] * z[1]; }});
  CHECK(curved_answer(mixed, inputs, linear_answer(mixed, inputs)).disagreement[0] > 0.3);
}
