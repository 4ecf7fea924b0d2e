#include "models/material/material.h"
#include "models/maths/dense.h"
#include "models/pillar/time/harmonic_response.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/reduced_span.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// Relative distance to a pole below which a residual is not counted against the basis: there every
// solution is as uncertain as the frequency of the pole itself.
constexpr double kNearestPole = 0.02;
constexpr int kMostAnswers = 10;  // of the whole body; each costs a sparse complex elimination

// Smallest singular value of a factored matrix, by a few inverse iterations (converges from above,
// accurate enough for an estimate). Source: Golub & Van Loan, Matrix Computations (2013), 8.2.
double smallest_singular_value(const ComplexLuFactor& lu) {
  Eigen::VectorXcd v =
      Eigen::VectorXcd::LinSpaced(lu.size(), Complex(1.0, 0.5), Complex(2.0, -0.5));
  double value = 0.0;
  for (int i = 0; i < 4; ++i) {
    v.normalize();
    const Eigen::VectorXcd image = lu.solve(v);
    value = 1.0 / image.norm();
    v = lu.solve_adjoint(image);
  }
  return value;
}

// Largest relative error of the restricted solutions in the energy norm at one frequency, from
// their residuals and the smallest singular value of the restricted dynamic stiffness.
double error_at(const ReducedSpan& span, const ViscoelasticSystem& body,
                const std::vector<Eigen::VectorXd>& loads, double omega_rad_s,
                bool keeps_digits = false) {
  const auto size_of = [&](const Eigen::VectorXd& part) {
    return span.dual_norm(keeps_digits ? span.without_pressures(part) : part);
  };
  const RelativeModuli m = relative_moduli(body.terms, Complex(0.0, omega_rad_s));
  const double omega2 = omega_rad_s * omega_rad_s;
  const Eigen::Index bent = span.count() - span.rigid_count();  // rigid motions are exact
  const ComplexLuFactor lu(
      Eigen::MatrixXcd(span.restricted(m.shear, m.bulk, omega2).bottomRightCorner(bent, bent)));
  const double nearest = std::max(smallest_singular_value(lu), kNearestPole);
  double largest = 0.0;
  for (const Eigen::VectorXd& load : loads) {
    Eigen::VectorXcd c = Eigen::VectorXcd::Zero(span.count());
    c.tail(bent) = lu.solve(
        Eigen::VectorXcd((span.basis().rightCols(bent).transpose() * load).cast<Complex>()));
    const Eigen::VectorXcd residual =
        load.cast<Complex>() - span.image_of(m.shear, m.bulk, omega2, c);
    const double size = std::hypot(size_of(residual.real()), size_of(residual.imag()));
    largest = std::max(largest, size / (nearest * c.norm()));
  }
  return largest;
}

// Test frequencies, densest near the top, where the basis is weakest.
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

// Result of the test of a basis.
struct Verdict {
  double error = 0.0;              // largest ratio to the allowed error, times the tolerance
  double worst_rad_s = 0.0;        // frequency of that error
  double sound_up_to_rad_s = 0.0;  // all test frequencies below this one meet the tolerance
};

// Factor by which the tolerance at this frequency is larger than at rest.
double allowance(const DynamicRange& range, double omega_rad_s) {
  const auto beyond = [omega_rad_s](double corner_rad_s) {
    return corner_rad_s > 0.0 ? std::max(1.0, omega_rad_s / corner_rad_s) : 1.0;
  };
  const double first = beyond(range.corner_rad_s);
  return first * first * beyond(range.second_corner_rad_s);
}

Verdict test_basis(const ReducedSpan& span, const ViscoelasticSystem& system,
                   const std::vector<Eigen::VectorXd>& loads, const DynamicRange& range) {
  Verdict verdict;
  verdict.sound_up_to_rad_s = range.highest_rad_s;
  for (const double omega : test_frequencies(range)) {
    const double error = error_at(span, system, loads, omega) / allowance(range, omega);
    if (!(error <= range.tolerance)) {
      verdict.sound_up_to_rad_s = std::min(verdict.sound_up_to_rad_s, 0.99 * omega);
    }
    if (!(error <= verdict.error)) {
      verdict.error = error;
      verdict.worst_rad_s = omega;
    }
  }
  return verdict;
}

// A chain of vectors (K^-1 M)^j K^-1 load.
struct Chain {
  Eigen::VectorXd last;
  bool is_exhausted = false;
};

// True if the shape of the solutions depends on how far the material has relaxed: shear and bulk
// relax differently, or the body has an elastic part.
bool shape_relaxes(const ViscoelasticSystem& system, const DynamicRange& range) {
  const RelativeModuli slow = relative_moduli(system.terms, Complex(0.0, range.lowest_rad_s));
  const double g = std::abs(slow.shear);
  const double k = system.incompressible ? g : std::abs(slow.bulk);
  const bool has_film = system.elastic.coeffs().cwiseAbs().sum() > 0.0;
  return (has_film ? 1.0 - std::min(g, k) : std::abs(g - k)) > 1e-9;
}

// Adds whole-body answers at one frequency.
bool add_answers(const ViscoelasticSystem& system, const std::vector<Eigen::VectorXd>& loads,
                 double omega_rad_s, ReducedSpan& span) {
  bool grew = false;
  for (const Eigen::VectorXcd& u : solve_harmonics(system, loads, omega_rad_s)) {
    grew = span.add(u.real()) || grew;
    grew = span.add(u.imag()) || grew;
  }
  return grew;
}

// Without what accelerates a body that nothing holds: its rigid motions, exact in the basis, take that.
std::vector<Eigen::VectorXd> balanced(const ReducedSpan& span, std::vector<Eigen::VectorXd> loads) {
  if (span.rigid_count() == 0) return loads;
  for (Eigen::VectorXd& load : loads) load = span.balanced(load);
  return loads;
}

// Grows every chain by one vector.
bool grow(std::vector<Chain>& chains, const StiffnessFactor& factor,
          const ViscoelasticSystem& system, ReducedSpan& span) {
  bool grew = false;
  for (Chain& chain : chains) {
    if (chain.is_exhausted) continue;
    chain.is_exhausted = !span.add(chain.last);
    if (chain.is_exhausted) continue;
    chain.last = factor.solve(times(system.mass, span.basis().rightCols<1>()));
    grew = true;
  }
  return grew;
}

}  // namespace

ReducedBody reduce_dynamic(const ViscoelasticSystem& system,
                           const std::vector<Eigen::VectorXd>& all_loads,
                           const DynamicRange& range) {
  if (!(range.highest_rad_s > 0.0) || system.mass.size() == 0) {
    throw std::invalid_argument("a dynamic analysis needs a mass and a highest frequency");
  }
  ReducedSpan span(system);
  const std::vector<Eigen::VectorXd> loads = balanced(span, all_loads);
  std::vector<Chain> chains;
  for (const Eigen::VectorXd& load : loads) {
    chains.push_back({span.instantaneous().solve(load)});
  }
  int answers_left = shape_relaxes(system, range) ? kMostAnswers : 0;
  Verdict verdict;
  bool grows = true;
  double last_error = std::numeric_limits<double>::infinity();
  Eigen::Index next_check = 4;
  const auto next_after = [](Eigen::Index count) {
    return count + std::max<Eigen::Index>(2, count / 4);
  };
  while (grows && span.count() < range.largest_basis) {
    grows = grow(chains, span.instantaneous(), system, span);
    const bool is_last = !grows || span.count() >= range.largest_basis;
    if (!is_last && span.count() < next_check) continue;
    // Chains lack the highest frequencies longest; where no answers are added these alone tell whether to go on.
    if (!is_last && answers_left == 0 &&
        !(error_at(span, system, loads, range.highest_rad_s) <=
          range.tolerance * allowance(range, range.highest_rad_s))) {
      next_check = next_after(span.count());
      continue;
    }
    verdict = test_basis(span, system, loads, range);
    if (verdict.error <= range.tolerance) break;
    // Krylov chains lack the relaxation of shapes. If they stall, a whole-body solution helps.
    if (answers_left > 0 && verdict.error > 0.1 * last_error) {
      grows = add_answers(system, loads, verdict.worst_rad_s, span) || grows;
      --answers_left;
    }
    last_error = verdict.error;
    next_check = next_after(span.count());
  }
  ReducedBody result = span.reduced();
  result.error = verdict.error;
  result.sound_up_to_rad_s = verdict.sound_up_to_rad_s;
  return result;
}

ReducedBody reduce_at(const ViscoelasticSystem& system, const std::vector<Eigen::VectorXd>& loads,
                      const std::vector<double>& omega_rad_s) {
  ReducedSpan span(system);
  const std::vector<Eigen::VectorXd> bending = balanced(span, loads);
  // Far below the first resonance a solution at rest and the next of its chain are exact to rounding. Of the
  // energy; a film's voltage may err a hundred times as much.
  constexpr double kExact = 1e-7;
  constexpr double kFar = 1e-3;
  for (const Eigen::VectorXd& load : bending) {
    if (!span.add(span.instantaneous().solve(load))) continue;
    span.add(span.instantaneous().solve(times(system.mass, span.basis().rightCols<1>())));
  }
  double largest = 0.0, error = 0.0;
  for (const double omega : omega_rad_s) {
    if (error <= kFar) error = error_at(span, system, bending, omega, true);
    if (error <= kExact) {
      largest = std::max(largest, error);
    } else {
      add_answers(system, bending, omega, span);
    }
  }
  ReducedBody result = span.reduced();
  result.error = largest;
  result.sound_up_to_rad_s = omega_rad_s.back();
  return result;
}

}  // namespace viscard
