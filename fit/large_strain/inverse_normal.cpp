#include "fit/large_strain/inverse_normal.h"

#include "models/maths/dense.h"

namespace viscard {

using Eigen::Index;
using Eigen::VectorXd;

Eigen::MatrixXd inverse_normal(const Eigen::MatrixXd& slopes, const std::vector<Index>& free,
                               UnseenDirections& unseen) {
  Eigen::MatrixXd used(slopes.rows(), static_cast<Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    used.col(static_cast<Index>(i)) = slopes.col(free[i]);
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  if (free.empty()) return all;
  const VectorXd length = used.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd pseudo = pseudo_inverse(used * length.cwiseInverse().asDiagonal());
  const Eigen::MatrixXd inverse = pseudo * pseudo.transpose();
  const Eigen::MatrixXd seen = pseudo * used * length.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(seen.rows(), seen.cols()) - seen;
  constexpr double kRounding = 1e-4;  // a direction that is not seen has the length 1
  if (rest.norm() > kRounding) {
    unseen.columns = Eigen::MatrixXd::Zero(slopes.cols(), rest.cols());
    unseen.step = VectorXd::Zero(slopes.cols());
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto a = static_cast<Index>(i);
      unseen.step[free[i]] = 1.0 / length[a];
      unseen.columns.row(free[i]) = rest.row(a) / length[a];
    }
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = 0; j < free.size(); ++j) {
      const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
      all(free[i], free[j]) = inverse(a, b) / (length[a] * length[b]);
    }
  }
  return all;
}

}  // namespace viscard
