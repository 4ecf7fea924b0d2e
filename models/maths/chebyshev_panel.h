#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// A row of functions of x on panels: in each, the polynomials through their values at Chebyshev points of the first
// kind, in barycentric form: Berrut & Trefethen, SIAM Rev. 46 (2004) 501.
class ChebyshevPanels {
 public:
  ChebyshevPanels() = default;
  // The breaks ascend, at least two.
  ChebyshevPanels(std::vector<double> breaks, int points,
                  const std::function<Eigen::RowVectorXd(double x)>& values_at);

  // At an x between the outer breaks.
  Eigen::RowVectorXd at(double x) const;
  const std::vector<double>& breaks() const { return breaks_; }

 private:
  std::vector<double> breaks_;
  std::vector<Eigen::MatrixXd> values_;  // by panel: points x functions
};

}  // namespace viscard
