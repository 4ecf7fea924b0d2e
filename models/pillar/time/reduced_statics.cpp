#include "models/material/material.h"
#include "models/maths/dense.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/reduced_span.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace viscard {
namespace {

struct LaplaceModuli {
  double shear = 1.0, bulk = 1.0;
};

LaplaceModuli laplace_moduli_at(const ViscoelasticSystem& body, double s) {
  const RelativeModuli moduli = relative_moduli(body.terms, s);
  return {std::real(moduli.shear), body.incompressible ? 1.0 : std::real(moduli.bulk)};
}

// Laplace variables that cover every relaxation time: one per decade from well below the slowest
// rate to well above the fastest, and zero for a solid.
std::vector<double> laplace_points(const std::vector<MaterialTerm>& terms) {
  const auto [fastest_s, slowest_s] = relaxation_times(terms);
  std::vector<double> points;
  if (slowest_s == 0.0) return points;
  for (double s = 1e-2 / slowest_s; s < 20.0 / fastest_s; s *= 10.0) points.push_back(s);
  return points;
}

// Relative error of the restricted solution at one s, in the energy norm.
double error_at(const ReducedSpan& span, const ViscoelasticSystem& body, double s) {
  const LaplaceModuli m = laplace_moduli_at(body, s);
  const Eigen::MatrixXd image = span.image(m.shear, m.bulk);
  const Eigen::MatrixXd small = span.basis().transpose() * image;
  const Eigen::VectorXd c =
      SymmetricFactor(small).solve(Eigen::VectorXd(span.basis().transpose() * body.load));
  const double size = std::sqrt(std::abs(c.dot(small * c)));
  const double softest = std::max(std::min({1.0, m.shear, m.bulk}), 1e-12);
  return span.dual_norm(body.load - image * c) / std::sqrt(softest) / size;
}

}  // namespace

ReducedBody reduce_quasi_static(const ViscoelasticSystem& system, double tolerance) {
  ReducedSpan span(system);
  span.add(span.instantaneous().solve(system.load));
  const std::vector<double> points = laplace_points(system.terms);
  double error = 0.0;
  constexpr int kLargest = 40;
  while (span.count() < kLargest) {
    error = 0.0;
    double worst_s = 0.0;
    for (const double s : points) {
      const double here = error_at(span, system, s);
      if (here > error) {
        error = here;
        worst_s = s;
      }
    }
    if (error <= tolerance) break;
    const LaplaceModuli m = laplace_moduli_at(system, worst_s);
    StiffnessFactor factor;
    span.factor(m.shear, m.bulk, factor);
    if (!span.add(factor.solve(system.load))) break;  // rounding: no better answer exists
  }
  ReducedBody result = span.reduced();
  result.error = error;
  return result;
}

}  // namespace viscard
