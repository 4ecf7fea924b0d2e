#include "models/pillar/time/scalar_pencil.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Complex = std::complex<double>;

}  // namespace

ScalarPencil scalar_pencil(const ViscoelasticSystem& body, const Eigen::VectorXcd& motion) {
  const Eigen::VectorXd a = motion.real(), b = motion.imag();
  const auto form = [&](const SymmetricSparse& matrix) {
    const Eigen::VectorXd of_a = times(matrix, a);
    return Complex(a.dot(of_a) - b.dot(times(matrix, b)), 2.0 * b.dot(of_a));
  };
  const Complex bulk = body.incompressible ? Complex(0.0) : form(body.bulk);
  return {form(body.elastic), form(body.shear), bulk, form(body.mass)};
}

RelativeModuli storage_at(const std::vector<MaterialTerm>& terms, double omega_rad_s) {
  const RelativeModuli m = relative_moduli(terms, Complex(0.0, omega_rad_s));
  return {m.shear.real(), m.bulk.real()};
}

RelativeModuli slopes_at(const std::vector<MaterialTerm>& terms, Complex s) {
  RelativeModuli slopes;
  for (const MaterialTerm& term : terms) {
    const Complex each = term.tau_s / ((1.0 + s * term.tau_s) * (1.0 + s * term.tau_s));
    slopes.shear += term.g * each;
    slopes.bulk += term.k * each;
  }
  return slopes;
}

RelativeModuli Softening::at(Complex s) const {
  const RelativeModuli m = relative_moduli(terms, s);
  return {1.0 + share * (m.shear - 1.0), 1.0 + share * (m.bulk - 1.0)};
}

RelativeModuli Softening::slopes(Complex s) const {
  const RelativeModuli m = slopes_at(terms, s);
  return {share * m.shear, share * m.bulk};
}

Complex root_near(const ScalarPencil& pencil, const Softening& moduli, Complex s) {
  constexpr int kIterations = 50;
  for (int i = 0; i < kIterations; ++i) {
    const Complex change = pencil.value(s, moduli.at(s)) / pencil.slope(s, moduli.slopes(s));
    s -= change;
    if (!(std::abs(change) > 1e-14 * std::abs(s))) break;
  }
  return s;
}

bool oscillates(Complex s) {
  constexpr double kLeast = 1e-6;  // of |s|
  return s.imag() > kLeast * std::abs(s);
}

Complex oscillation_of(const ScalarPencil& pencil, const std::vector<MaterialTerm>& terms) {
  Complex s(0.0, std::sqrt(std::max(0.0, (pencil.value(0.0, {1.0, 1.0}) / pencil.mass).real())));
  constexpr int kSteps = 50;
  for (int step = 1; step <= kSteps && oscillates(s); ++step) {
    s = root_near(pencil, {terms, static_cast<double>(step) / kSteps}, s);
  }
  return oscillates(s) ? s : 0.0;
}

double storage_frequency_rad_s(const ScalarPencil& pencil, const std::vector<MaterialTerm>& terms,
                               double start_rad_s) {
  const auto surplus = [&](double omega) {
    const Complex s(0.0, omega);
    return pencil.value(s, storage_at(terms, omega)).real();
  };
  double high = start_rad_s;
  while (surplus(high) > 0.0) high *= 1.5;
  double low = high;
  while (surplus(low) <= 0.0) {
    low /= 1.1;
    if (low < 1e-6 * start_rad_s) return 0.0;
  }
  high = std::min(high, 1.1 * low);
  for (int i = 0; i < 60 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (surplus(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace viscard
