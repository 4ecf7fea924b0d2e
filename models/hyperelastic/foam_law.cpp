#include "models/hyperelastic/foam_law.h"

#include "models/maths/require.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

double beta_of(double nu) {
  return nu / (1.0 - 2.0 * nu);
}

// (J^(-alpha beta) - 1)/beta, and its limit for beta = 0.
double volume_part(double alpha, double beta, double log_volume) {
  if (beta == 0.0) return -alpha * log_volume;
  return std::expm1(-alpha * beta * log_volume) / beta;
}

// The logarithmic strains of a test with free sides of the logarithmic strain `side`.
Vector3d strains_of(FoamTest test, double measured, double side) {
  if (test == FoamTest::kShear) {
    const double e = std::asinh(0.5 * measured);  // of the stretch gamma/2 + sqrt(1 + gamma^2/4)
    return {e, 0.0, -e};
  }
  const double e = std::log(measured);
  switch (test) {
    case FoamTest::kUniaxial:
      return {e, side, side};
    case FoamTest::kPlanar:
      return {e, 0.0, side};
    case FoamTest::kEquibiaxial:
      return {e, e, side};
    case FoamTest::kVolumetric:
      return {e, e, e};
    case FoamTest::kConfined:
    case FoamTest::kShear:
      break;
  }
  return {e, 0.0, 0.0};
}

bool has_free_side(FoamTest test) {
  return test == FoamTest::kUniaxial || test == FoamTest::kPlanar || test == FoamTest::kEquibiaxial;
}

// The free side's strain at which its stress is 0: Newton's steps within a bracket that shrinks.
double free_side(const FoamLaw& law, FoamTest test, double measured) {
  const auto stress_at = [&](double side) {
    return kirchhoff_Pa(law, strains_of(test, measured, side))[2];
  };
  constexpr double kFarthest = 6.0;
  constexpr int kMost = 200;
  double low = -kFarthest, high = kFarthest;
  if (!(stress_at(low) < 0.0) || !(stress_at(high) > 0.0)) return std::nan("");
  double side = -poisson_ratio(law) * std::log(measured);
  for (int i = 0; i < kMost; ++i) {
    const Vector3d strain = strains_of(test, measured, side);
    const double stress = kirchhoff_Pa(law, strain)[2];
    const Matrix3d tangent = kirchhoff_tangent_Pa(law, strain);
    const double slope = tangent(2, 2) + (test == FoamTest::kUniaxial ? tangent(2, 1) : 0.0);
    // Newton's steps square the error: behind one of this size only rounding is left.
    constexpr double kLastStep = 1e-9;
    const double next = side - stress / slope;
    if (std::abs(next - side) <= kLastStep) return next;
    (stress > 0.0 ? high : low) = side;
    side = next > low && next < high ? next : 0.5 * (low + high);
  }
  return side;
}

// The end of the stable range from rest towards `last`; is_open if there is none.
double stable_end(const FoamLaw& law, FoamTest test, double last, bool& is_open) {
  constexpr int kSteps = 400, kHalvings = 50;
  const bool is_shear = test == FoamTest::kShear;
  const auto at = [&](double share) {
    return is_shear ? share * last : std::exp(share * std::log(last));
  };
  const auto holds = [&](double share) {
    const FoamState state = foam_state(law, test, at(share));
    return std::isfinite(state.nominal_stress_Pa) && is_stable(law, state.log_strain);
  };
  is_open = true;
  double good = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    if (holds(share)) {
      good = share;
      continue;
    }
    is_open = false;
    double bad = share;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (good + bad);
      (holds(middle) ? good : bad) = middle;
    }
    break;
  }
  return at(good);
}

}  // namespace

std::string foam_name(Index n_terms) {
  return "hyperfoam-" + std::to_string(n_terms);
}

std::optional<Index> foam_terms_of(const std::string& name) {
  for (Index n = 1; n <= kMostFoamTerms; ++n) {
    if (name == foam_name(n)) return n;
  }
  return std::nullopt;
}

void validate(const FoamLaw& law) {
  const Index n = law.mu_Pa.size();
  require(n >= 1 && n <= kMostFoamTerms && law.alpha.size() == n && law.nu.size() == n,
          "a foam has 1 to " + std::to_string(kMostFoamTerms) +
              " terms with one mu, alpha and nu each, but " + std::to_string(n) + ", " +
              std::to_string(law.alpha.size()) + " and " + std::to_string(law.nu.size()) +
              " are given");
  for (Index i = 0; i < n; ++i) {
    const std::string of_term = "_" + std::to_string(i + 1) + " of " + foam_name(n);
    require_value(true, "mu" + of_term, law.mu_Pa[i], "Pa", "finite");
    require_value(law.alpha[i] != 0.0, "alpha" + of_term, law.alpha[i], "", "finite and not 0");
    require_value(law.nu[i] > -1.0 && law.nu[i] < 0.5, "nu" + of_term, law.nu[i], "",
                  "between -1 and 0.5");
  }
  require_positive("the shear modulus at rest of " + foam_name(n), shear_modulus_Pa(law), "Pa");
  require_positive("the bulk modulus at rest of " + foam_name(n), bulk_modulus_Pa(law), "Pa");
}

double shear_modulus_Pa(const FoamLaw& law) {
  return law.mu_Pa.sum();
}

double bulk_modulus_Pa(const FoamLaw& law) {
  double sum = 0.0;
  for (Index i = 0; i < law.mu_Pa.size(); ++i)
    sum += 2.0 * law.mu_Pa[i] * (1.0 / 3.0 + beta_of(law.nu[i]));
  return sum;
}

double poisson_ratio(const FoamLaw& law) {
  const double G = shear_modulus_Pa(law), K = bulk_modulus_Pa(law);
  return (3.0 * K - 2.0 * G) / (6.0 * K + 2.0 * G);
}

double youngs_modulus_Pa(const FoamLaw& law) {
  return 2.0 * shear_modulus_Pa(law) * (1.0 + poisson_ratio(law));
}

double energy_Pa(const FoamLaw& law, const Vector3d& log_strain) {
  const double log_volume = log_strain.sum();
  double sum = 0.0;
  for (Index i = 0; i < law.mu_Pa.size(); ++i) {
    const double alpha = law.alpha[i];
    double part = volume_part(alpha, beta_of(law.nu[i]), log_volume);
    for (const double e : log_strain) part += std::expm1(alpha * e);
    sum += 2.0 * law.mu_Pa[i] / (alpha * alpha) * part;
  }
  return sum;
}

Vector3d kirchhoff_Pa(const FoamLaw& law, const Vector3d& log_strain) {
  const double log_volume = log_strain.sum();
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < law.mu_Pa.size(); ++i) {
    const double alpha = law.alpha[i];
    const double volume = std::expm1(-alpha * beta_of(law.nu[i]) * log_volume);
    for (Index k = 0; k < 3; ++k)
      sum[k] += 2.0 * law.mu_Pa[i] / alpha * (std::expm1(alpha * log_strain[k]) - volume);
  }
  return sum;
}

Matrix3d kirchhoff_tangent_Pa(const FoamLaw& law, const Vector3d& log_strain) {
  const double log_volume = log_strain.sum();
  Matrix3d out = Matrix3d::Zero();
  for (Index i = 0; i < law.mu_Pa.size(); ++i) {
    const double alpha = law.alpha[i], beta = beta_of(law.nu[i]), mu_Pa = law.mu_Pa[i];
    out.array() += 2.0 * mu_Pa * beta * std::exp(-alpha * beta * log_volume);
    for (Index k = 0; k < 3; ++k) out(k, k) += 2.0 * mu_Pa * std::exp(alpha * log_strain[k]);
  }
  return out;
}

const std::vector<std::string>& foam_test_names() {
  static const std::vector<std::string> kNames{"uniaxial", "planar",     "equibiaxial",
                                               "confined", "volumetric", "shear"};
  return kNames;
}

const std::string& name_of(FoamTest test) {
  return foam_test_names()[static_cast<std::size_t>(test)];
}

double FoamState::lateral_stretch() const {
  return std::exp(log_strain[2]);
}

FoamState foam_state(const FoamLaw& law, FoamTest test, double measured) {
  const double side = has_free_side(test) ? free_side(law, test, measured) : 0.0;
  FoamState state{strains_of(test, measured, side)};
  const Vector3d tau = kirchhoff_Pa(law, state.log_strain);
  // The work of the force on a change of what is measured is that of the energy: of simple shear
  // dW/dgamma = (tau_1 - tau_3)/(l + 1/l), otherwise tau_1/s.
  state.nominal_stress_Pa = test == FoamTest::kShear
                                ? (tau[0] - tau[2]) / (2.0 * std::cosh(state.log_strain[0]))
                                : tau[0] / measured;
  return state;
}

bool is_stable(const FoamLaw& law, const Vector3d& log_strain) {
  if (!log_strain.allFinite()) return false;
  const Matrix3d tangent = kirchhoff_tangent_Pa(law, log_strain);
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver(tangent, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] > 0.0;
}

StableRange stable_range(const FoamLaw& law, FoamTest test) {
  constexpr double kLeast = 0.1, kMost = 10.0;
  StableRange range;
  range.high = stable_end(law, test, kMost, range.high_is_open);
  if (test == FoamTest::kShear)
    return {-range.high, range.high, range.high_is_open, range.high_is_open};
  range.low = stable_end(law, test, kLeast, range.low_is_open);
  return range;
}

}  // namespace viscard
