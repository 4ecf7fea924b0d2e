// Solutions of a matrix close to a factored one.
#include "models/pillar/system/stiffness_factor.h"

#include <cmath>
#include <utility>

namespace viscard {

void NearbySolutions::add(const Eigen::VectorXd& load) {
  Eigen::VectorXd source;
  solutions.push_back(factor.solve(load, &source));
  sources.push_back(std::move(source));
  loads.push_back(load);
}

void StiffnessFactor::approximate(const NearbySolutions& known, Product product) {
  known_ = &known;
  product_ = std::move(product);
}

// From the known solution whose load is most nearly parallel; any start is right to first order that is
// a smooth function of the load and the solution itself where nothing has moved.
Eigen::VectorXd StiffnessFactor::solve_nearby(const Eigen::VectorXd& right_side,
                                              Eigen::VectorXd* pressure_source) const {
  Eigen::VectorXd u, source;
  double largest = 0.0;
  for (std::size_t i = 0; i < known_->loads.size(); ++i) {
    const Eigen::VectorXd& load = known_->loads[i];
    const double along = load.dot(right_side) / load.norm();
    if (std::abs(along) <= largest) continue;
    largest = std::abs(along);
    u = (along / load.norm()) * known_->solutions[i];
    source = (along / load.norm()) * known_->sources[i];
  }
  if (u.size() == 0) u = known_->factor.solve(right_side, &source);
  Eigen::VectorXd more_source;
  u += known_->factor.solve(right_side - product_(u, source), &more_source);
  if (pressure_source != nullptr) *pressure_source = source + more_source;
  return u;
}

}  // namespace viscard
