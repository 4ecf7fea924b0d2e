#include "models/array/quadrants/decoupling.h"

#include "models/maths/dense.h"
#include "models/maths/require.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Jacobi>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

constexpr Eigen::Index kMostSteps = 80;  // each keeps a vector of all loads

}  // namespace

Decoupled decouple(const SeemingLoads& seeming, const Eigen::MatrixXd& seen_Pa, double residual) {
  Decoupled found;
  found.loads_Pa = Eigen::MatrixXd::Zero(seen_Pa.rows(), seen_Pa.cols());
  const double size_Pa = seen_Pa.norm();
  require(std::isfinite(size_Pa), "voltages must be finite");
  if (size_Pa == 0.0) return found;
  // Krylov vectors, the Hessenberg matrix turned to a triangle by rotations, and the turned right side.
  std::vector<Eigen::MatrixXd> basis = {seen_Pa / size_Pa};
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(kMostSteps + 1, kMostSteps);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kMostSteps + 1);
  right[0] = size_Pa;
  std::vector<Eigen::JacobiRotation<double>> rotations;
  Eigen::Index steps = 0;
  while (steps < kMostSteps && std::abs(right[steps]) > residual * size_Pa) {
    Eigen::MatrixXd next = seeming(basis.back());
    for (Eigen::Index i = 0; i <= steps; ++i) {
      const Eigen::MatrixXd& one = basis[static_cast<std::size_t>(i)];
      triangle(i, steps) = one.cwiseProduct(next).sum();
      next -= triangle(i, steps) * one;
    }
    const double left = next.norm();
    triangle(steps + 1, steps) = left;
    for (Eigen::Index i = 0; i < steps; ++i) {
      triangle.col(steps).applyOnTheLeft(i, i + 1,
                                         rotations[static_cast<std::size_t>(i)].adjoint());
    }
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(triangle(steps, steps), triangle(steps + 1, steps));
    triangle.col(steps).applyOnTheLeft(steps, steps + 1, rotation.adjoint());
    right.applyOnTheLeft(steps, steps + 1, rotation.adjoint());
    rotations.push_back(rotation);
    ++steps;
    if (left <= residual * residual) break;
    basis.push_back(next / left);
  }
  const Eigen::VectorXd share =
      triangle.topLeftCorner(steps, steps).triangularView<Eigen::Upper>().solve(right.head(steps));
  for (Eigen::Index i = 0; i < steps; ++i) {
    found.loads_Pa += share[i] * basis[static_cast<std::size_t>(i)];
  }
  found.iterations = static_cast<int>(steps);
  const Eigen::MatrixXd left_Pa = seen_Pa - seeming(found.loads_Pa);
  found.residual = left_Pa.cwiseAbs().maxCoeff() / seen_Pa.cwiseAbs().maxCoeff();
  if (!(found.residual <= std::max(1e3 * residual, 1e-6))) {
    throw std::runtime_error(
        "the quarters read their neighbours so much that the loads of the pillars are not found: " +
        text_of(found.residual, 2) +
        " of the voltages stays unexplained. Take wider gaps or a thinner film");
  }
  return found;
}

NoiseGrowth noise_growth(const Eigen::MatrixXd& seeming, const Eigen::MatrixXd& gains,
                         Eigen::Index index) {
  const Eigen::Index loads = gains.rows(), pillars = seeming.rows() / loads;
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(seeming.rows(), seeming.cols());
  const Eigen::MatrixXd inverse = LuFactor(seeming).solve(unit);
  NoiseGrowth growth;
  growth.factor = Eigen::VectorXd::Zero(loads);
  for (Eigen::Index l = 0; l < loads; ++l) {
    double variance = 0.0;
    for (Eigen::Index j = 0; j < pillars; ++j) {
      variance += (inverse.block(index * loads + l, j * loads, 1, loads) * gains).squaredNorm();
    }
    growth.factor[l] = std::sqrt(variance) / gains.row(l).norm();
  }
  const Eigen::VectorXd singular = singular_values(seeming);
  growth.condition = singular[0] / singular[singular.size() - 1];
  return growth;
}

}  // namespace viscard
