#include "models/hyperelastic/hyperelastic_law.h"

#include "models/maths/require.h"

#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Form = HyperelasticForm;

bool is_ogden(Form form) {
  return form == Form::kOgden1 || form == Form::kOgden2 || form == Form::kOgden3;
}

// Derivatives of a function f of I1 for a unit of its modulus, and of its first by the shape.
struct OfInvariant {
  double first = 0.0, second = 0.0, first_by_shape = 0.0;
};

OfInvariant arruda_boyce(double invariant, double limit) {
  OfInvariant out;
  const double ratio = invariant / (limit * limit);
  double power = 1.0;  // ratio^(i - 1)
  for (int i = 1; i <= 5; ++i, power *= ratio) {
    out.first += i * kArrudaBoyceSeries[i - 1] * power;
    out.second += i * (i - 1) * kArrudaBoyceSeries[i - 1] * power / invariant;
    out.first_by_shape -= i * (2 * i - 2) * kArrudaBoyceSeries[i - 1] * power / limit;
  }
  return out;
}

// excess: I1 - 3.
OfInvariant gent(double excess, double limit) {
  const double left = limit - excess;
  return {0.5 * limit / left, 0.5 * limit / (left * left), -0.5 * excess / (left * left)};
}

// Power k + 1 of I1 - 3.
OfInvariant power_of_excess(double excess, Eigen::Index k) {
  const double n = static_cast<double>(k + 1);
  return {n * std::pow(excess, n - 1.0), k == 0 ? 0.0 : n * (n - 1.0) * std::pow(excess, n - 2.0),
          0.0};
}

OfInvariant of_invariant(Form form, Eigen::Index modulus, const Eigen::VectorXd& shapes,
                         double excess) {
  if (form == Form::kArrudaBoyce) return arruda_boyce(3.0 + excess, shapes[0]);
  if (form == Form::kGent) return gent(excess, shapes[0]);
  return power_of_excess(excess, modulus);
}

// s^a - 1 for each logarithmic strain, without loss of digits near 1.
Eigen::Vector3d powers_less_one(const Eigen::Vector3d& log_strain, double exponent) {
  return log_strain.unaryExpr([&](double e) { return std::expm1(exponent * e); });
}

double excess_of(const Eigen::Vector3d& log_strain) {
  return powers_less_one(log_strain, 2.0).sum();
}

// (x exp(x) - expm1(x))/x^2
double ogden_slope(double x) {
  if (std::abs(x) < 1e-4) return 0.5 + x / 3.0 + x * x / 8.0;
  return (x * std::exp(x) - std::expm1(x)) / (x * x);
}

// One term 2/alpha^2 (s_1^alpha + s_2^alpha + s_3^alpha - 3); the limit for alpha = 0 is the sum of
// the squared logarithmic strains.
LogDerivatives ogden_term(const Eigen::Vector3d& log_strain, double alpha) {
  LogDerivatives out;
  const bool is_zero = std::abs(alpha) < 1e-12;
  out.gradient = is_zero ? Eigen::Vector3d(2.0 * log_strain)
                         : Eigen::Vector3d(2.0 / alpha * powers_less_one(log_strain, alpha));
  for (Eigen::Index i = 0; i < 3; ++i) out.hessian(i, i) = 2.0 * std::exp(alpha * log_strain[i]);
  return out;
}

LogDerivatives invariant_term(const Eigen::Vector3d& log_strain, const OfInvariant& f) {
  const Eigen::Vector3d less_one = powers_less_one(log_strain, 2.0);
  const Eigen::Vector3d squares = less_one.array() + 1.0;
  LogDerivatives out;
  out.gradient = 2.0 * f.first * less_one;
  out.hessian = 4.0 * f.second * squares * squares.transpose();
  out.hessian.diagonal() += 4.0 * f.first * squares;
  return out;
}

// I2 - 3, the sum of 1/s^2 - 1 of an incompressible body.
LogDerivatives second_invariant(const Eigen::Vector3d& log_strain) {
  const Eigen::Vector3d less_one = powers_less_one(log_strain, -2.0);
  LogDerivatives out;
  out.gradient = -2.0 * less_one;
  out.hessian.diagonal() = 4.0 * (less_one.array() + 1.0);
  return out;
}

// For a unit of one modulus.
LogDerivatives unit_term(Form form, Eigen::Index modulus, const Eigen::VectorXd& shapes,
                         const Eigen::Vector3d& log_strain) {
  if (is_ogden(form)) return ogden_term(log_strain, shapes[modulus]);
  if (form == Form::kMooneyRivlin && modulus == 1) return second_invariant(log_strain);
  return invariant_term(log_strain, of_invariant(form, modulus, shapes, excess_of(log_strain)));
}

// The gradient's derivative by a shape that enters this modulus; zero for the others.
Eigen::Vector3d gradient_slope(Form form, Eigen::Index modulus, Eigen::Index shape,
                               const Eigen::VectorXd& shapes, const Eigen::Vector3d& log_strain) {
  if (is_ogden(form)) {
    if (modulus != shape) return Eigen::Vector3d::Zero();
    return log_strain.unaryExpr(
        [&](double e) { return 2.0 * e * e * ogden_slope(shapes[shape] * e); });
  }
  const OfInvariant f = of_invariant(form, modulus, shapes, excess_of(log_strain));
  return 2.0 * f.first_by_shape * powers_less_one(log_strain, 2.0);
}

}  // namespace

const std::vector<std::string>& hyperelastic_names() {
  static const std::vector<std::string> kNames{"neo-hooke",    "mooney-rivlin", "yeoh",
                                               "ogden-1",      "ogden-2",       "ogden-3",
                                               "arruda-boyce", "gent"};
  return kNames;
}

const std::string& name_of(HyperelasticForm form) {
  return hyperelastic_names()[static_cast<std::size_t>(form)];
}

const std::vector<HyperelasticForm>& hyperelastic_forms() {
  static const std::vector<Form> kForms{Form::kNeoHooke,    Form::kMooneyRivlin, Form::kYeoh,
                                        Form::kOgden1,      Form::kOgden2,       Form::kOgden3,
                                        Form::kArrudaBoyce, Form::kGent};
  return kForms;
}

std::vector<std::string> modulus_names(HyperelasticForm form) {
  switch (form) {
    case Form::kNeoHooke:
      return {"C10_Pa"};
    case Form::kMooneyRivlin:
      return {"C10_Pa", "C01_Pa"};
    case Form::kYeoh:
      return {"C10_Pa", "C20_Pa", "C30_Pa"};
    case Form::kOgden1:
      return {"mu_1_Pa"};
    case Form::kOgden2:
      return {"mu_1_Pa", "mu_2_Pa"};
    case Form::kOgden3:
      return {"mu_1_Pa", "mu_2_Pa", "mu_3_Pa"};
    case Form::kArrudaBoyce:
    case Form::kGent:
      break;
  }
  return {"mu_Pa"};
}

std::vector<std::string> shape_names(HyperelasticForm form) {
  if (form == Form::kOgden1) return {"alpha_1"};
  if (form == Form::kOgden2) return {"alpha_1", "alpha_2"};
  if (form == Form::kOgden3) return {"alpha_1", "alpha_2", "alpha_3"};
  if (form == Form::kArrudaBoyce) return {"locking_stretch"};
  if (form == Form::kGent) return {"J_m"};
  return {};
}

void validate(const HyperelasticLaw& law) {
  const std::string& name = name_of(law.form);
  require(law.moduli_Pa.size() == n_moduli(law.form) && law.shapes.size() == n_shapes(law.form),
          name + " has " + std::to_string(n_moduli(law.form)) + " moduli and " +
              std::to_string(n_shapes(law.form)) + " shapes, but " +
              std::to_string(law.moduli_Pa.size()) + " and " + std::to_string(law.shapes.size()) +
              " are given");
  for (Eigen::Index j = 0; j < law.moduli_Pa.size(); ++j) {
    require_value(true, modulus_names(law.form)[static_cast<std::size_t>(j)] + " of " + name,
                  law.moduli_Pa[j], "Pa", "finite");
  }
  for (Eigen::Index k = 0; k < law.shapes.size(); ++k) {
    require_value(is_ogden(law.form) || law.shapes[k] > 0.0,
                  shape_names(law.form)[static_cast<std::size_t>(k)] + " of " + name, law.shapes[k],
                  "", is_ogden(law.form) ? "finite" : "positive and finite");
  }
  require_positive("the modulus at rest of " + name, youngs_modulus_Pa(law), "Pa");
}

LogDerivatives log_derivatives(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain) {
  LogDerivatives sum;
  for (Eigen::Index j = 0; j < law.moduli_Pa.size(); ++j) {
    const LogDerivatives unit = unit_term(law.form, j, law.shapes, log_strain);
    sum.gradient += law.moduli_Pa[j] * unit.gradient;
    sum.hessian += law.moduli_Pa[j] * unit.hessian;
  }
  return sum;
}

bool is_within_limit(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain) {
  return law.form != Form::kGent || excess_of(log_strain) < law.shapes[0];
}

// The work of the force on a change of the stretch is that of the energy: with e = ln s, the nominal
// stress is (direction . gradient)/(number of loaded directions)/s.
double nominal_stress_Pa(const HyperelasticLaw& law, Deformation deformation, double stretch) {
  const Eigen::Vector3d direction = strain_direction(deformation);
  const Eigen::Vector3d log_strain = std::log(stretch) * direction;
  if (!is_within_limit(law, log_strain)) return std::numeric_limits<double>::quiet_NaN();
  const LogDerivatives w = log_derivatives(law, log_strain);
  return direction.dot(w.gradient) / n_loaded_directions(deformation) / stretch;
}

double nominal_tangent_Pa(const HyperelasticLaw& law, Deformation deformation, double stretch) {
  const Eigen::Vector3d direction = strain_direction(deformation);
  const Eigen::Vector3d log_strain = std::log(stretch) * direction;
  if (!is_within_limit(law, log_strain)) return std::numeric_limits<double>::quiet_NaN();
  const LogDerivatives w = log_derivatives(law, log_strain);
  const double change = direction.dot(w.hessian * direction) - direction.dot(w.gradient);
  return change / n_loaded_directions(deformation) / (stretch * stretch);
}

StressColumns stress_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                             Deformation deformation, double stretch) {
  const Eigen::Vector3d direction = strain_direction(deformation);
  const Eigen::Vector3d log_strain = std::log(stretch) * direction;
  const Eigen::Vector3d work = direction / (n_loaded_directions(deformation) * stretch);
  StressColumns out{Eigen::VectorXd(n_moduli(form)),
                    Eigen::MatrixXd::Zero(n_moduli(form), n_shapes(form))};
  for (Eigen::Index j = 0; j < n_moduli(form); ++j) {
    out.values[j] = work.dot(unit_term(form, j, shapes, log_strain).gradient);
    for (Eigen::Index k = 0; k < n_shapes(form); ++k) {
      out.shape_slopes(j, k) = work.dot(gradient_slope(form, j, k, shapes, log_strain));
    }
  }
  return out;
}

PrincipalColumns principal_columns(HyperelasticForm form, const Eigen::VectorXd& shapes,
                                   const Eigen::Vector3d& log_strain, bool with_slopes) {
  PrincipalColumns out{Eigen::Matrix3Xd(3, n_moduli(form)), {}};
  const Eigen::Index n_slopes = with_slopes ? n_shapes(form) : 0;
  out.shape_slopes.assign(static_cast<std::size_t>(n_slopes), out.values);
  for (Eigen::Index j = 0; j < n_moduli(form); ++j) {
    out.values.col(j) = unit_term(form, j, shapes, log_strain).gradient;
    for (Eigen::Index k = 0; k < n_slopes; ++k) {
      out.shape_slopes[static_cast<std::size_t>(k)].col(j) =
          gradient_slope(form, j, k, shapes, log_strain);
    }
  }
  return out;
}

Eigen::VectorXd youngs_columns(HyperelasticForm form, const Eigen::VectorXd& shapes) {
  const Eigen::Vector3d direction = strain_direction(Deformation::kUniaxial);
  Eigen::VectorXd columns(n_moduli(form));
  for (Eigen::Index j = 0; j < columns.size(); ++j) {
    const LogDerivatives unit = unit_term(form, j, shapes, Eigen::Vector3d::Zero());
    columns[j] = direction.dot(unit.hessian * direction);
  }
  return columns;
}

double youngs_modulus_Pa(const HyperelasticLaw& law) {
  return youngs_columns(law.form, law.shapes).dot(law.moduli_Pa);
}

}  // namespace viscard
