#include "models/pillar/time/reduced_body.h"

namespace viscard {

Eigen::VectorXd ReducedBody::output(
    const std::function<double(const Eigen::VectorXd&)>& linear) const {
  Eigen::VectorXd values(basis.cols());
  for (Eigen::Index i = 0; i < basis.cols(); ++i) values[i] = linear(basis.col(i));
  return values;
}

}  // namespace viscard
