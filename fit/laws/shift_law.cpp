#include "fit/laws/shift_law.h"

#include "models/maths/dense.h"
#include "models/maths/distributions.h"
#include "models/maths/interval.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

using Index = Eigen::Index;

// y and the columns whitened by the covariance, so that ordinary least squares apply.
struct Whitened {
  Cholesky factor;
  Eigen::VectorXd y;
  Eigen::VectorXd of(const Eigen::VectorXd& column) const { return factor.solve_lower(column); }
};

struct Line {  // y = slope * column
  double slope = 0.0, chi2 = std::numeric_limits<double>::infinity(), variance = 0.0;
};
Line fit_line(const Whitened& data, const Eigen::VectorXd& column) {
  const Eigen::VectorXd x = data.of(column);
  Line line;
  line.slope = x.dot(data.y) / x.squaredNorm();
  line.chi2 = (data.y - line.slope * x).squaredNorm();
  line.variance = 1.0 / x.squaredNorm();
  return line;
}

Eigen::VectorXd wlf_column(const Eigen::VectorXd& warmer_K, double C2_K) {
  return -std::numbers::ln10 * warmer_K.cwiseQuotient((warmer_K.array() + C2_K).matrix());
}

Interval around(double value, double half) {
  return {value - half, value + half};
}

// Half-width of the 95 % interval: the variance is scaled up if the scatter exceeds it, with
// Student's t for the degrees of freedom.
double half_width(double variance, double chi2, Index dof) {
  const double excess = dof > 0 ? std::max(1.0, chi2 / static_cast<double>(dof)) : 1.0;
  const double quantile = dof > 0 ? student_t_975(static_cast<double>(dof)) : kNormal95;
  return quantile * std::sqrt(variance * excess);
}

void fit_wlf(const Whitened& data, const Eigen::VectorXd& warmer_K, double T_ref_C,
             ShiftLaws& laws) {
  const Index n = warmer_K.size();
  if (n < 3) return;
  // C1 is linear: scan ln C2 above the pole, then narrow the interval by thirds.
  const double least_K = std::max(0.0, -warmer_K.minCoeff());
  const auto chi2_at = [&](double ln_over) {
    return fit_line(data, wlf_column(warmer_K, least_K + std::exp(ln_over))).chi2;
  };
  constexpr double kLow = -2.0, kHigh = 9.0, kStep = 0.1;  // up to 8000 K
  double best = kLow;
  for (double ln = kLow; ln <= kHigh; ln += kStep) {
    if (chi2_at(ln) < chi2_at(best)) best = ln;
  }
  if (best > kHigh - 2.0 * kStep) return;  // equivalent to a straight line in temperature
  double low = best - kStep, high = best + kStep;
  while (high - low > 1e-9) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (chi2_at(a) < chi2_at(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  const double C2_K = least_K + std::exp(0.5 * (low + high));
  const Line line = fit_line(data, wlf_column(warmer_K, C2_K));
  if (!(line.slope > 0.0)) return;
  Eigen::MatrixXd jacobian(n, 2);
  jacobian.col(0) = data.of(wlf_column(warmer_K, C2_K));
  jacobian.col(1) = data.of(std::numbers::ln10 * line.slope *
                            warmer_K.cwiseQuotient((warmer_K.array() + C2_K).square().matrix()));
  const Eigen::Matrix2d covariance = (jacobian.transpose() * jacobian).inverse();
  TemperatureShift shift{.law = ShiftLaw::kWlf, .T_ref_C = T_ref_C, .C1 = line.slope, .C2_K = C2_K};
  shift.C1_95 = around(shift.C1, half_width(covariance(0, 0), line.chi2, n - 2));
  shift.C2_K_95 = around(shift.C2_K, half_width(covariance(1, 1), line.chi2, n - 2));
  laws.wlf = shift;
  laws.wlf_chi2 = line.chi2;
}

void fit_arrhenius(const Whitened& data, const Eigen::VectorXd& temperature_C, double T_ref_C,
                   ShiftLaws& laws) {
  const Index n = temperature_C.size();
  const double reference_K = T_ref_C - kAbsoluteZero_C;
  const Eigen::VectorXd column =
      ((temperature_C.array() - kAbsoluteZero_C).inverse() - 1.0 / reference_K).matrix() /
      kGasConstant_J_mol_K;
  const Line line = fit_line(data, column);
  laws.arrhenius_chi2 = line.chi2;
  if (!(line.slope >= 0.0)) return;
  TemperatureShift shift{
      .law = ShiftLaw::kArrhenius, .T_ref_C = T_ref_C, .activation_J_mol = line.slope};
  shift.activation_J_mol_95 = around(line.slope, half_width(line.variance, line.chi2, n - 1));
  laws.arrhenius = shift;
}

}  // namespace

const TemperatureShift* ShiftLaws::better() const {
  if (wlf_is_better && wlf) return &*wlf;
  return arrhenius ? &*arrhenius : nullptr;
}

ShiftLaws fit_shift_laws(const std::vector<ShiftFactor>& factors, const Eigen::MatrixXd& covariance,
                         double T_ref_C) {
  const auto n = static_cast<Index>(factors.size());
  if (n < 1 || covariance.rows() != n) {
    throw std::invalid_argument("shift factors and their covariance differ in number");
  }
  Eigen::VectorXd ln_a(n), temperature_C(n);
  for (Index i = 0; i < n; ++i) {
    ln_a[i] = factors[static_cast<std::size_t>(i)].ln_a;
    temperature_C[i] = factors[static_cast<std::size_t>(i)].temperature_C;
  }
  Whitened data;
  data.factor = Cholesky(covariance + 1e-14 * Eigen::MatrixXd::Identity(n, n));
  if (!data.factor.is_definite()) {
    throw std::runtime_error("the shift factors are not determined by the data");
  }
  data.y = data.factor.solve_lower(ln_a);
  ShiftLaws laws;
  fit_wlf(data, (temperature_C.array() - T_ref_C).matrix(), T_ref_C, laws);
  fit_arrhenius(data, temperature_C, T_ref_C, laws);
  for (auto* shift : {&laws.wlf, &laws.arrhenius}) {
    if (!*shift) continue;
    (*shift)->T_min_C = std::min(T_ref_C, temperature_C.minCoeff());
    (*shift)->T_max_C = std::max(T_ref_C, temperature_C.maxCoeff());
  }
  // BIC in units of the scatter about the better law, which is at least the factors' own error.
  double scale = std::max(1.0, laws.arrhenius_chi2 / std::max(1.0, static_cast<double>(n) - 1.0));
  if (laws.wlf && n > 2) {
    scale = std::min(scale, std::max(1.0, laws.wlf_chi2 / (static_cast<double>(n) - 2.0)));
  }
  const double ln_n = std::log(static_cast<double>(n));
  laws.wlf_bic = laws.wlf_chi2 / scale + 2.0 * ln_n;
  laws.arrhenius_bic = laws.arrhenius_chi2 / scale + ln_n;
  laws.wlf_is_better = laws.wlf && (!laws.arrhenius || laws.wlf_bic < laws.arrhenius_bic);
  return laws;
}

}  // namespace viscard
