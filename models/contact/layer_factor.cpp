#include "models/contact/punch_contact.h"
#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

// 1 - K(x); K is the compliance of the bonded layer in Hankel space over that of the half-space
// (eq. 10). Numerator and denominator are divided by cosh 2x, so they never overflow.
double missing_compliance(double x, double nu) {
  const double k = 3.0 - 4.0 * nu;
  const double e = std::exp(-2.0 * x);
  const double numerator = k * (1.0 - e * e) - 4.0 * x * e;
  const double denominator =
      k * (1.0 + e * e) + 2.0 * e * (2.0 * x * x + 5.0 - 12.0 * nu + 8.0 * nu * nu);
  return 1.0 - numerator / denominator;
}

}  // namespace

void require_layer(double radius_over_thickness, double poisson_ratio) {
  require_value(radius_over_thickness >= 0.0 && radius_over_thickness <= 10.0,
                "punch radius over layer thickness", radius_over_thickness, "",
                "from 0 to 10 for the layer factor");
  require_value(poisson_ratio >= 0.0 && poisson_ratio <= 0.5, "Poisson ratio", poisson_ratio, "",
                "from 0 to 0.5 for the layer factor");
}

double layer_factor(double radius_over_thickness, double poisson_ratio) {
  require_layer(radius_over_thickness, poisson_ratio);
  if (radius_over_thickness == 0.0) return 1.0;

  // Quadrature over the transform variable x in panels of length 1; 1 - K is below 1e-20 beyond 30.
  static const QuadratureRule panel = gauss_legendre(24);
  constexpr int kPanels = 30;
  std::vector<double> x, weight;
  for (int p = 0; p < kPanels; ++p) {
    for (std::size_t i = 0; i < panel.points.size(); ++i) {
      x.push_back(p + panel.points[i]);
      weight.push_back(panel.weights[i] * missing_compliance(x.back(), poisson_ratio));
    }
  }

  // chi(t) - (2 r/pi) int_0^1 [int (1 - K(x)) cos(x r t) cos(x r s) dx] chi(s) ds = 1, r = a/H, and
  // kappa = int chi. The inner integral separates into a product of cosines.
  const int count = radius_over_thickness > 2.0 ? 60 : 24;
  const QuadratureRule rule = gauss_legendre(count);
  const auto n_x = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd cosines(count, n_x);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < n_x; ++k) {
      cosines(i, k) = std::cos(x[static_cast<std::size_t>(k)] * radius_over_thickness *
                               rule.points[static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::Map<const Eigen::VectorXd> x_weights(weight.data(), n_x);
  const Eigen::Map<const Eigen::VectorXd> t_weights(rule.weights.data(), count);
  const Eigen::MatrixXd kernel = (2.0 * radius_over_thickness / std::numbers::pi) * cosines *
                                 x_weights.asDiagonal() * cosines.transpose();
  const Eigen::MatrixXd system =
      Eigen::MatrixXd::Identity(count, count) - kernel * t_weights.asDiagonal();
  const Eigen::VectorXd chi = LuFactor(system).solve(Eigen::VectorXd(Eigen::VectorXd::Ones(count)));
  return t_weights.dot(chi);
}

}  // namespace viscard
