#include "models/pillar/reduced_span.h"
#include "models/pillar/relative_modulus.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// Distance to a pole below which a residual is not held against the basis: there every answer is as
// uncertain as the frequency of the pole itself.
constexpr double kNearestPole = 0.02;

struct ComplexModuli {
  Complex shear, bulk;
};

ComplexModuli moduli_at(const ViscoelasticSystem& body, double omega_rad_s) {
  const Complex s(0.0, omega_rad_s);
  return {relative_modulus(body.terms, &MaterialTerm::g, s),
          relative_modulus(body.terms, &MaterialTerm::k, s)};
}

// Relative error of the restricted answer in the energy norm at one frequency, by its residual and
// the smallest singular value of the restricted dynamic stiffness.
double error_at(const ReducedSpan& span, const ViscoelasticSystem& body,
                const Eigen::VectorXd& load, double omega_rad_s) {
  const ComplexModuli m = moduli_at(body, omega_rad_s);
  const Eigen::MatrixXcd image = span.image(m.shear, m.bulk, omega_rad_s * omega_rad_s);
  const Eigen::MatrixXcd small = span.basis().transpose() * image;
  const Eigen::VectorXcd c =
      small.partialPivLu().solve((span.basis().transpose() * load).cast<Complex>());
  const Eigen::VectorXcd residual = load.cast<Complex>() - image * c;
  const double nearest = Eigen::BDCSVD<Eigen::MatrixXcd>(small).singularValues().tail<1>()[0];
  return std::hypot(span.dual_norm(residual.real()), span.dual_norm(residual.imag())) /
         (std::max(nearest, kNearestPole) * c.norm());
}

// Densest near the top, where the basis is weakest.
std::vector<double> test_frequencies(const DynamicRange& range) {
  std::vector<double> test;
  for (const double share : {1.0, 0.87, 0.71, 0.53, 0.36, 0.2, 0.1}) {
    test.push_back(share * range.highest_rad_s);
  }
  for (double omega = 0.03 * range.highest_rad_s; omega > range.lowest_rad_s && test.size() < 24;
       omega *= 0.1) {
    test.push_back(omega);
  }
  if (range.lowest_rad_s > 0.0) test.push_back(range.lowest_rad_s);
  return test;
}

// Stops at the first frequency that is not met; the error and the sound range go to `body`.
bool meets(const ReducedSpan& span, const ViscoelasticSystem& system,
           const std::vector<Eigen::VectorXd>& loads, const DynamicRange& range, bool all,
           ReducedBody& body) {
  body.error = 0.0;
  body.sound_up_to_rad_s = 0.0;
  bool met = true;
  for (const double omega : test_frequencies(range)) {
    for (const Eigen::VectorXd& load : loads) {
      const double error = error_at(span, system, load, omega);
      const double beyond = range.corner_rad_s > 0.0 ? omega / range.corner_rad_s : 1.0;
      const double weight = std::max(1.0, beyond * beyond);
      if (error <= range.tolerance * weight) {
        body.sound_up_to_rad_s = std::max(body.sound_up_to_rad_s, omega);
        body.error = std::max(body.error, error / weight);
        continue;
      }
      met = false;
      if (!all) return false;
    }
  }
  return met;
}

// Chains of vectors (K^-1 M)^j K^-1 load, each grown by one operator.
struct Chain {
  std::shared_ptr<StiffnessFactor> factor;
  Eigen::VectorXd last;
  bool is_exhausted = false;
};

// Moduli at which chains are started: Chebyshev points between those at the lowest frequency and
// the instantaneous ones, as many as interpolation over that range needs for the tolerance
// (Trefethen, Approximation Theory and Approximation Practice (2013), ch. 8). One if shape does not
// depend on them: constant Poisson ratio and no elastic part.
std::vector<std::pair<double, double>> chain_moduli(const ViscoelasticSystem& system,
                                                    const DynamicRange& range) {
  const ComplexModuli slow = moduli_at(system, range.lowest_rad_s);
  const double g = std::max(std::abs(slow.shear), 1e-6);
  const double k = system.incompressible ? g : std::max(std::abs(slow.bulk), 1e-6);
  const bool has_film = system.elastic.coeffs().cwiseAbs().sum() > 0.0;
  const double spread = has_film ? -std::log(std::min(g, k)) : std::abs(std::log(g / k));
  int count = 1;
  for (double left = spread; left > 30.0 * range.tolerance && count < 5; ++count) {
    left *= 0.25 * spread;
  }
  std::vector<std::pair<double, double>> moduli;
  for (int i = 0; i < count; ++i) {
    const double angle = (2 * i + 1) * std::numbers::pi / (2 * count);
    const double share = count == 1 ? 0.0 : 0.5 * (1.0 - std::cos(angle));
    moduli.emplace_back(std::pow(g, share), std::pow(k, share));
  }
  return moduli;
}

std::vector<Chain> chains_of(const ReducedSpan& span, const ViscoelasticSystem& system,
                             const std::vector<Eigen::VectorXd>& loads, const DynamicRange& range) {
  std::vector<Chain> chains;
  for (const auto& [shear, bulk] : chain_moduli(system, range)) {
    const auto factor = std::make_shared<StiffnessFactor>();
    span.factor(shear, bulk, *factor);
    for (const Eigen::VectorXd& load : loads) chains.push_back({factor, factor->solve(load)});
  }
  return chains;
}

}  // namespace

ReducedBody reduce_dynamic(const ViscoelasticSystem& system,
                           const std::vector<Eigen::VectorXd>& loads, const DynamicRange& range) {
  if (!(range.highest_rad_s > 0.0) || system.mass.size() == 0) {
    throw std::invalid_argument("a dynamic analysis needs masses and a highest frequency");
  }
  ReducedSpan span(system);
  std::vector<Chain> chains = chains_of(span, system, loads, range);
  ReducedBody tested;
  bool met = false;
  bool grows = true;
  Eigen::Index next_check = 4;
  while (grows && !met && span.count() < range.largest_basis) {
    grows = false;
    for (Chain& chain : chains) {
      if (chain.is_exhausted) continue;
      chain.is_exhausted = !span.add(chain.last);
      if (chain.is_exhausted) continue;
      chain.last = chain.factor->solve(times(system.mass, span.basis().rightCols<1>()));
      grows = true;
    }
    if (span.count() >= next_check || !grows) {
      met = meets(span, system, loads, range, false, tested);
      next_check = span.count() + std::max<Eigen::Index>(3, span.count() / 3);
    }
  }
  if (!met) meets(span, system, loads, range, true, tested);
  ReducedBody result = span.reduced();
  result.error = tested.error;
  result.sound_up_to_rad_s = met ? range.highest_rad_s : tested.sound_up_to_rad_s;
  return result;
}

}  // namespace viscard
