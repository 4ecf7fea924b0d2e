#include "models/pillar/time/viscoelastic_exact.h"

#include "models/material/material.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace viscard {

double inverse_laplace(const std::function<std::complex<double>(std::complex<double>)>& transform,
                       double time_s, int nodes) {
  const double r = 2.0 * nodes / (5.0 * time_s);
  double sum = 0.5 * std::real(transform(r)) * std::exp(r * time_s);
  for (int k = 1; k < nodes; ++k) {
    const double angle = k * std::numbers::pi / nodes;
    const double cotangent = 1.0 / std::tan(angle);
    const std::complex<double> s = r * angle * std::complex<double>(cotangent, 1.0);
    const double slope = angle + (angle * cotangent - 1.0) * cotangent;
    sum += std::real(std::exp(s * time_s) * transform(s) * std::complex<double>(1.0, slope));
  }
  return sum * r / nodes;
}

ExactViscoelasticBody::ExactViscoelasticBody(const ViscoelasticSystem& system)
    : terms_(system.terms) {
  if (system.incompressible || system.elastic.coeffs().cwiseAbs().sum() > 0.0) {
    throw std::invalid_argument(
        "the exact answer by common modes needs a body of one compressible material alone");
  }
  const Eigen::MatrixXd shear(system.shear);  // lower triangles, all that the eigensolver reads
  const Eigen::MatrixXd bulk(system.bulk);
  const EigenSystem modes = generalized_eigen(bulk, shear);
  const Eigen::VectorXd amplitude = modes.vectors.transpose() * system.load;
  for (Eigen::Index m = 0; m < amplitude.size(); ++m) {
    weight_.push_back(amplitude[m] * amplitude[m]);
    theta_.push_back(std::max(modes.values[m], 0.0));
  }
}

std::complex<double> ExactViscoelasticBody::compliance(std::complex<double> s) const {
  const auto [shear, bulk] = relative_moduli(terms_, s);
  std::complex<double> sum = 0.0;
  for (std::size_t m = 0; m < weight_.size(); ++m) sum += weight_[m] / (shear + theta_[m] * bulk);
  return sum;
}

double ExactViscoelasticBody::creep_displacement(double time_s) const {
  if (time_s == 0.0) return std::real(compliance(std::numeric_limits<double>::max()));
  return inverse_laplace([this](std::complex<double> s) { return compliance(s) / s; }, time_s);
}

double ExactViscoelasticBody::relaxation_force(double time_s) const {
  if (time_s == 0.0) return 1.0 / creep_displacement(0.0);
  return inverse_laplace([this](std::complex<double> s) { return 1.0 / (compliance(s) * s); },
                         time_s);
}

double ExactViscoelasticBody::creep_displacement_by_spectra(double time_s) const {
  double displacement = 0.0;
  for (std::size_t m = 0; m < weight_.size(); ++m) {
    PronySeries mode{1.0 + theta_[m], {}};
    for (const MaterialTerm& term : terms_) {
      const double modulus = term.g + theta_[m] * term.k;
      mode.equilibrium_modulus_Pa -= modulus;
      mode.terms.push_back({modulus, term.tau_s});
    }
    displacement += weight_[m] * creep_compliance_1_Pa(retardation_from_relaxation(mode), time_s);
  }
  return displacement;
}

}  // namespace viscard
