#include "models/pillar/time/harmonic_response.h"

#include "models/material/material.h"
#include "models/maths/dense.h"
#include "models/maths/require.h"

#include <Eigen/SparseLU>

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Complex = std::complex<double>;

void require_frequency(double omega_rad_s) {
  require_not_negative("angular frequency", omega_rad_s, "rad/s");
}

}  // namespace

Eigen::VectorXcd solve_harmonic(const ViscoelasticSystem& body, const Eigen::VectorXd& load,
                                double omega_rad_s) {
  return solve_harmonics(body, {load}, omega_rad_s).front();
}

std::vector<Eigen::VectorXcd> solve_harmonics(const ViscoelasticSystem& body,
                                              const std::vector<Eigen::VectorXd>& loads,
                                              double omega_rad_s) {
  require_frequency(omega_rad_s);
  if (body.incompressible) {
    throw std::invalid_argument(
        "an incompressible body must be reduced before a frequency is solved");
  }
  const auto [shear, bulk] = relative_moduli(body.terms, Complex(0.0, omega_rad_s));
  Eigen::SparseMatrix<Complex> lower = body.elastic.cast<Complex>();
  lower.coeffs() +=
      shear * body.shear.coeffs().cast<Complex>() + bulk * body.bulk.coeffs().cast<Complex>();
  if (body.mass.size() > 0) {
    lower.coeffs() -= omega_rad_s * omega_rad_s * body.mass.coeffs().cast<Complex>();
  }
  const Eigen::SparseMatrix<Complex> upper =
      lower.triangularView<Eigen::StrictlyLower>().transpose();
  const Eigen::SparseMatrix<Complex> whole = lower + upper;
  Eigen::SparseLU<Eigen::SparseMatrix<Complex>> lu(whole);
  if (lu.info() != Eigen::Success) {
    throw std::runtime_error("at " + text_of(omega_rad_s / (2.0 * M_PI)) +
                             " Hz the body resonates without damping, so no steady answer exists; "
                             "choose another frequency or add damping");
  }
  std::vector<Eigen::VectorXcd> solutions;
  for (const Eigen::VectorXd& load : loads) {
    solutions.emplace_back(lu.solve(load.cast<Complex>()));
  }
  return solutions;
}

HarmonicSolver::HarmonicSolver(const ViscoelasticSystem& small)
    : terms_(small.terms),
      elastic_(dense(small.elastic)),
      shear_(dense(small.shear)),
      bulk_(dense(small.bulk)),
      mass_(dense(small.mass)) {}

Eigen::MatrixXcd HarmonicSolver::solve(double omega_rad_s, const Eigen::MatrixXcd& loads) const {
  require_frequency(omega_rad_s);
  const auto [shear, bulk] = relative_moduli(terms_, Complex(0.0, omega_rad_s));
  Eigen::MatrixXcd matrix(elastic_.rows(), elastic_.cols());
  matrix.real() =
      elastic_ + shear.real() * shear_ + bulk.real() * bulk_ - omega_rad_s * omega_rad_s * mass_;
  matrix.imag() = shear.imag() * shear_ + bulk.imag() * bulk_;
  return ComplexLuFactor(matrix).solve(loads);
}

}  // namespace viscard
