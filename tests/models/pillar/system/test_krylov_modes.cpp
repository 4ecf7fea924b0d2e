// The search for modes by itself, on diagonal pencils whose eigenvalues are known.
#include "models/pillar/system/krylov_modes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;

namespace {

// op = B^-1 A with diagonal A and B: self-adjoint in x'By.
struct Diagonal {
  Eigen::VectorXd value;  // eigenvalues of op
  Eigen::VectorXd B;

  EigenPairs largest(int count, const KrylovOptions& options) const {
    const PencilMap op = [this](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
      return Eigen::VectorXd(value.cwiseProduct(x));
    };
    const LinearMap times_B = [this](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(B.cwiseProduct(x));
    };
    return largest_eigenpairs(op, times_B, static_cast<int>(value.size()), count, options);
  }
  // The largest ||op v - mu v|| over mu, in the norm of B.
  double residual(const EigenPairs& pairs) const {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
      const Eigen::VectorXd v = pairs.vectors.col(i);
      const Eigen::VectorXd left = value.cwiseProduct(v) - pairs.values[i] * v;
      largest = std::max(largest, std::sqrt(left.dot(B.cwiseProduct(left))) / pairs.values[i]);
    }
    return largest;
  }
};

// Eigenvalues 1, 1/4, 1/9 ... as those of a string, times a scale, and a B of very unequal entries.
Diagonal string_like(int size, double scale = 1.0) {
  Diagonal body{Eigen::VectorXd(size), Eigen::VectorXd(size)};
  for (int i = 0; i < size; ++i) {
    body.value[i] = scale / ((i + 1.0) * (i + 1.0));
    body.B[i] = std::pow(10.0, 4.0 * std::sin(i));
  }
  return body;
}

}  // namespace

TEST_CASE("modes are found to the requested residual, in any unit", "[pillar]") {
  const double scale = GENERATE(1.0, 1e-13, 1e9);  // of 1/omega^2 in s^2
  const Diagonal body = string_like(300, scale);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const EigenPairs pairs = body.largest(6, {.tolerance = tolerance});
    CAPTURE(scale, tolerance);
    REQUIRE(pairs.converged);
    CHECK(body.residual(pairs) <= tolerance);
    for (int i = 0; i < 6; ++i) {  // the values' own error is the square of the residual, over gaps
      CHECK(pairs.values[i] == Approx(body.value[i]).epsilon(30.0 * tolerance * tolerance + 1e-13));
    }
    const Eigen::MatrixXd gram = pairs.vectors.transpose() * body.B.asDiagonal() * pairs.vectors;
    CHECK((gram - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("modes that are nearly equal are all found", "[pillar]") {
  Diagonal body = string_like(200);
  for (int i = 1; i < 3; ++i) body.value[i] = (1.0 - 1e-6 * i) * body.value[0];
  const EigenPairs pairs = body.largest(4, {});
  REQUIRE(pairs.converged);
  for (int i = 0; i < 4; ++i) CHECK(pairs.values[i] == Approx(body.value[i]).epsilon(1e-12));
}

TEST_CASE("equal modes are found at least once, and every mode found is one of the system",
          "[pillar]") {
  const int equal = GENERATE(2, 3, 8);
  Diagonal body = string_like(200);
  for (int i = 1; i < equal; ++i) body.value[i] = body.value[0];
  const EigenPairs pairs = body.largest(3, {});
  REQUIRE(pairs.converged);
  CAPTURE(equal, pairs.values);
  CHECK(pairs.values[0] == Approx(body.value[0]).epsilon(1e-12));
  CHECK(body.residual(pairs) <= 1e-8);
  const Eigen::MatrixXd gram = pairs.vectors.transpose() * body.B.asDiagonal() * pairs.vectors;
  CHECK((gram - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a search among numbers that are not finite ends", "[pillar]") {
  Diagonal body = string_like(300);
  body.value[17] = std::nan("");
  CHECK_FALSE(body.largest(3, {}).converged);
}

TEST_CASE("a small system gives all its modes, and a small space stops with too few", "[pillar]") {
  const Diagonal small = string_like(7);
  const EigenPairs all = small.largest(7, {});
  REQUIRE(all.converged);
  for (int i = 0; i < 7; ++i) CHECK(all.values[i] == Approx(small.value[i]).epsilon(1e-10));

  Diagonal close = string_like(300);
  for (int i = 0; i < 300; ++i) close.value[i] = 1.0 - 1e-6 * i;
  const EigenPairs stopped = close.largest(5, {.tolerance = 1e-12, .largest_space = 20});
  CHECK_FALSE(stopped.converged);
  REQUIRE(stopped.values.size() == 5);
  CHECK(stopped.values[0] == Approx(1.0).epsilon(1e-3));  // rough
}

TEST_CASE("a quick search returns what has converged, from the first mode on", "[pillar]") {
  Diagonal body = string_like(300);
  for (int i = 1; i < 300; ++i) body.value[i] = 1.0 - 1e-6 * i;
  body.value[0] = 3.0;
  const EigenPairs pairs = body.largest(3, {.tolerance = 1e-8, .is_quick = true});
  CHECK_FALSE(pairs.converged);
  REQUIRE(pairs.leading == 1);
  REQUIRE(pairs.vectors.cols() == 1);
  CHECK(pairs.values[0] == Approx(3.0).epsilon(1e-13));
  CHECK(std::abs(pairs.vectors(0, 0)) * std::sqrt(body.B[0]) == Approx(1.0).epsilon(1e-12));
  CHECK(pairs.values[1] == Approx(1.0).epsilon(1e-2));  // rough
}

TEST_CASE("an operator of low rank gives its few modes", "[pillar]") {
  Diagonal body = string_like(120);
  body.value.tail(117).setZero();  // all starts lie in a space of three
  const EigenPairs pairs = body.largest(3, {});
  REQUIRE(pairs.converged);
  for (int i = 0; i < 3; ++i) CHECK(pairs.values[i] == Approx(body.value[i]).epsilon(1e-12));
}
