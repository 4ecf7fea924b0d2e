#include "models/hyperelastic/law_energy.h"

#include <cmath>
#include <iterator>

namespace viscard {
namespace {

using EnergyForm = HyperelasticForm;

// An energy and its derivative by a shape.
struct EnergyPart {
  double value = 0.0, by_shape = 0.0;
};

// (exp(x) - 1 - x)/x^2 and its derivative. Near 0 by their series, where the formulas lose digits.
EnergyPart second_difference(double x) {
  constexpr double kNear = 0.5;
  constexpr int kTerms = 16;
  if (std::abs(x) > kNear) {
    const double less_one = std::expm1(x);
    return {(less_one - x) / (x * x), (x * less_one - 2.0 * less_one + 2.0 * x) / (x * x * x)};
  }
  EnergyPart sum;
  double power = 1.0, factorial = 2.0;  // x^k, (k + 2)!
  for (int k = 0; k < kTerms; ++k) {
    sum.value += power / factorial;
    sum.by_shape += (k + 1) * power / (factorial * (k + 3));
    power *= x;
    factorial *= k + 3;
  }
  return sum;
}

// 2/alpha^2 (s_1^alpha + s_2^alpha + s_3^alpha - 3). The logarithmic strains sum to 0, so that alpha times
// their sum may be subtracted.
EnergyPart ogden_energy(const Eigen::Vector3d& log_strain, double alpha) {
  EnergyPart sum;
  for (const double e : log_strain) {
    const EnergyPart part = second_difference(alpha * e);
    sum.value += 2.0 * e * e * part.value;
    sum.by_shape += 2.0 * e * e * e * part.by_shape;
  }
  return sum;
}

// Sum of C_i/s_m^(2i - 2) (I1^i - 3^i), with I1^i - 3^i = (I1 - 3)(I1^(i-1) + 3 I1^(i-2) + ...).
EnergyPart arruda_boyce_energy(double excess, double limit) {
  EnergyPart sum;
  double quotient = 1.0, power_of_3 = 1.0, scale = 1.0;  // quotient: (I1^i - 3^i)/(I1 - 3)
  for (std::size_t i = 0; i < std::size(kArrudaBoyceSeries); ++i) {
    const double term = kArrudaBoyceSeries[i] * scale * quotient * excess;
    sum.value += term;
    sum.by_shape -= 2.0 * static_cast<double>(i) * term / limit;
    power_of_3 *= 3.0;
    quotient = quotient * (3.0 + excess) + power_of_3;
    scale /= limit * limit;
  }
  return sum;
}

EnergyPart gent_energy(double excess, double limit) {
  const double logarithm = std::log1p(-excess / limit);
  return {-0.5 * limit * logarithm, -0.5 * logarithm - 0.5 * excess / (limit - excess)};
}

// For a unit of one modulus.
EnergyPart unit_energy(EnergyForm form, Eigen::Index modulus, const Eigen::VectorXd& shapes,
                       const Eigen::Vector3d& log_strain) {
  const auto excess_of = [&](double exponent) {
    return log_strain.unaryExpr([&](double e) { return std::expm1(exponent * e); }).sum();
  };
  switch (form) {
    case EnergyForm::kOgden1:
    case EnergyForm::kOgden2:
    case EnergyForm::kOgden3:
      return ogden_energy(log_strain, shapes[modulus]);
    case EnergyForm::kArrudaBoyce:
      return arruda_boyce_energy(excess_of(2.0), shapes[0]);
    case EnergyForm::kGent:
      return gent_energy(excess_of(2.0), shapes[0]);
    case EnergyForm::kMooneyRivlin:
      return {excess_of(modulus == 0 ? 2.0 : -2.0), 0.0};
    case EnergyForm::kNeoHooke:
    case EnergyForm::kYeoh:
      break;
  }
  return {std::pow(excess_of(2.0), static_cast<double>(modulus + 1)), 0.0};
}

}  // namespace

EnergyColumns energy_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                             const Eigen::Vector3d& log_strain) {
  EnergyColumns out{Eigen::VectorXd(n_moduli(form)),
                    Eigen::MatrixXd::Zero(n_moduli(form), n_shapes(form))};
  const bool has_own_shapes = n_shapes(form) == n_moduli(form);  // one of each term (Ogden)
  for (Eigen::Index j = 0; j < n_moduli(form); ++j) {
    const EnergyPart part = unit_energy(form, j, shapes, log_strain);
    out.values[j] = part.value;
    if (has_own_shapes) out.shape_slopes(j, j) = part.by_shape;
  }
  return out;
}

double energy_Pa(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain) {
  return energy_columns(law.form, law.shapes, log_strain).values.dot(law.moduli_Pa);
}

}  // namespace viscard
