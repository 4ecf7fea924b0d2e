#include "fit/search/nnls.h"

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include <random>

using namespace viscard;

TEST_CASE("non-negative least squares satisfies its optimality conditions", "[fit]") {
  std::mt19937_64 random(GENERATE(1U, 2U, 3U, 4U));
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(60, 15, [&] { return normal(random); });
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(60, [&] { return normal(random); });
  std::vector<bool> is_free(15, false);
  is_free[3] = true;
  const Eigen::VectorXd x = least_squares_with_signs(a, y, is_free);
  const Eigen::VectorXd gradient = a.transpose() * (y - a * x);
  // Karush-Kuhn-Tucker: the gradient is zero for columns in use and not positive for columns held
  // at zero.
  for (Eigen::Index j = 0; j < 15; ++j) {
    if (j == 3 || x[j] > 0.0) {
      CHECK(gradient[j] == Approx(0.0).margin(1e-11));
    } else {
      CHECK(x[j] == 0.0);
      CHECK(gradient[j] <= 1e-11);
    }
  }
  CHECK((x - nonnegative_from_normal_equations(a.transpose() * a, a.transpose() * y, is_free))
            .norm() < 1e-10);
}

TEST_CASE("non-negative least squares without active bounds is plain least squares",
          "[fit][reduction]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.5, 1.5);
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(30, 4, [&] { return unit(random); });
  const Eigen::VectorXd truth = Eigen::VectorXd::Constant(4, 2.0);
  const Eigen::VectorXd x = least_squares_with_signs(a, a * truth, std::vector<bool>(4, false));
  CHECK((x - truth).norm() < 1e-12);
}

TEST_CASE("repeated and zero columns do no harm in non-negative least squares",
          "[fit][stability]") {
  Eigen::MatrixXd a(5, 3);
  a.col(0) << 1, 2, 3, 4, 5;
  a.col(1) = a.col(0);
  a.col(2).setZero();
  const Eigen::VectorXd y = 3.0 * a.col(0);
  const Eigen::VectorXd x = least_squares_with_signs(a, y, std::vector<bool>(3, false));
  CHECK(x.allFinite());
  CHECK((a * x - y).norm() < 1e-10);
}
