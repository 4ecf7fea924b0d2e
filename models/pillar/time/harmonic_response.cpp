#include "models/pillar/time/harmonic_response.h"

#include "models/material/material.h"
#include "models/maths/dense.h"
#include "models/maths/require.h"
#include "models/pillar/system/supernodal_factor.h"

#include <Eigen/SparseLU>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<Complex>;

void require_frequency(double omega_rad_s) {
  require_not_negative("angular frequency", omega_rad_s, "rad/s");
}

// The product of a real map with a complex vector.
template <typename Map>
Eigen::VectorXcd apart(const Map& map, const Eigen::VectorXcd& u) {
  Eigen::VectorXcd product(u.size());
  product.real() = map(Eigen::VectorXd(u.real()));
  product.imag() = map(Eigen::VectorXd(u.imag()));
  return product;
}

// The factored dynamic stiffness of a body at one frequency. That of an incompressible body has a large
// penalty on volume, whose pressures are then iterated until the volume stays, as in StiffnessFactor;
// conjugate gradients in the bilinear product, because the matrix is complex symmetric. Source: van der Vorst
// & Melissen, IEEE Trans. Magn. 26 (1990) 706.
class DynamicFactor {
 public:
  DynamicFactor(const ViscoelasticSystem& body, double omega_rad_s)
      : body_(body), omega2_(omega_rad_s * omega_rad_s) {
    moduli_ = relative_moduli(body.terms, Complex(0.0, omega_rad_s));
    constexpr double kStiffening =
        1e3;  // of the body's own penalty: the error falls by 1e3 or more
    if (body.incompressible) moduli_.bulk = kStiffening * std::abs(moduli_.shear);
    Sparse lower = body.elastic.cast<Complex>();
    lower.coeffs() += moduli_.shear * body.shear.coeffs().cast<Complex>() +
                      moduli_.bulk * body.bulk.coeffs().cast<Complex>();
    if (body.mass.size() > 0) lower.coeffs() -= omega2_ * body.mass.coeffs().cast<Complex>();
    whole_ = lower + Sparse(lower.triangularView<Eigen::StrictlyLower>().transpose());
    largest_ = whole_.coeffs().abs().maxCoeff();
    symmetric_.analyse(body.shear);
    if (!symmetric_.factor(lower)) pivot_anew();
  }

  Eigen::VectorXcd solve(const Eigen::VectorXcd& load) const {
    Eigen::VectorXcd source;
    Eigen::VectorXcd u = solve_once(load, source);
    if (!body_.by_shear) return u;
    double last = u.norm();
    for (int i = 0; i < 4; ++i) {
      Eigen::VectorXcd more;
      const Eigen::VectorXcd change = solve_once(load - product(u, source), more);
      if (!(change.norm() < 0.5 * last)) break;
      u += change;
      source += more;
      last = change.norm();
      if (last <= 1e-9 * u.norm()) break;
    }
    return u;
  }

 private:
  Eigen::VectorXcd bulk(const Eigen::VectorXcd& u) const {
    return moduli_.bulk * apart([&](const auto& x) { return bulk_times(body_, x); }, u);
  }
  Eigen::VectorXcd product(const Eigen::VectorXcd& u, const Eigen::VectorXcd& source) const {
    Eigen::VectorXcd sum = apart([&](const auto& x) { return times(body_.elastic, x); }, u);
    sum += moduli_.shear * apart([&](const auto& x) { return shear_times(body_, x); }, u);
    sum += bulk(source);
    if (body_.mass.size() > 0) {
      sum -= omega2_ * apart([&](const auto& x) { return times(body_.mass, x); }, u);
    }
    return sum;
  }
  // By the symmetric factors while they keep their digits, else by those with pivoting.
  Eigen::VectorXcd eliminated(const Eigen::VectorXcd& load) const {
    constexpr double kSound = 1e-12;  // rest over |A| |x|
    if (!pivoted_) {
      Eigen::VectorXcd x = symmetric_.solve(load);
      x += symmetric_.solve(load - whole_ * x);
      if ((load - whole_ * x).norm() <= kSound * largest_ * x.norm()) return x;
      pivot_anew();
    }
    return pivoted_->solve(load);
  }
  void pivot_anew() const {
    pivoted_ = std::make_unique<Eigen::SparseLU<Sparse, Eigen::AMDOrdering<int>>>(whole_);
    if (pivoted_->info() == Eigen::Success) return;
    throw std::runtime_error("at " + text_of(std::sqrt(omega2_) / (2.0 * std::numbers::pi)) +
                             " Hz the body resonates without damping, so no steady answer exists; "
                             "choose another frequency or add damping");
  }
  // `source`: of the bulk part, u itself where the volume may change.
  Eigen::VectorXcd solve_once(const Eigen::VectorXcd& load, Eigen::VectorXcd& source) const {
    Eigen::VectorXcd u = eliminated(load);
    source = u;
    if (!body_.incompressible) return u;
    constexpr int kIterations = 30;
    Eigen::VectorXcd added = Eigen::VectorXcd::Zero(u.size());
    Eigen::VectorXcd C_u = bulk(u);
    Eigen::VectorXcd direction = u, C_direction = C_u;
    Complex violation = (u.transpose() * C_u).value();
    for (int i = 0; i < kIterations; ++i) {
      const Eigen::VectorXcd response = eliminated(C_direction);
      const Complex step = violation / (C_direction.transpose() * response).value();
      const Eigen::VectorXcd next = u - step * response;
      C_u = bulk(next);
      const Complex remaining = (next.transpose() * C_u).value();
      if (!(std::abs(remaining) < 0.5 * std::abs(violation))) break;
      u = next;
      added += step * direction;
      const Complex share = remaining / violation;
      direction = u + share * direction;
      C_direction = C_u + share * C_direction;
      violation = remaining;
    }
    source = u + added;
    return u;
  }

  const ViscoelasticSystem& body_;
  double omega2_;
  RelativeModuli moduli_;
  Sparse whole_;
  double largest_ = 0.0;  // of its entries
  ComplexSupernodalFactor symmetric_;
  mutable std::unique_ptr<Eigen::SparseLU<Sparse, Eigen::AMDOrdering<int>>> pivoted_;
};

}  // namespace

Eigen::VectorXcd solve_harmonic(const ViscoelasticSystem& body, const Eigen::VectorXd& load,
                                double omega_rad_s) {
  return solve_harmonics(body, {load}, omega_rad_s).front();
}

std::vector<Eigen::VectorXcd> solve_harmonics(const ViscoelasticSystem& body,
                                              const std::vector<Eigen::VectorXd>& loads,
                                              double omega_rad_s) {
  require_frequency(omega_rad_s);
  const DynamicFactor factor(body, omega_rad_s);
  std::vector<Eigen::VectorXcd> solutions;
  for (const Eigen::VectorXd& load : loads) solutions.push_back(factor.solve(load.cast<Complex>()));
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
