#include "fit/curves/creep_rows.h"

#include "models/material/retardation_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;

// Inverse Laplace transform by the midpoint rule on the cotangent contour of Weideman: f(t) =
// (2/N) sum Im(e^z F(z/t) z'/t) over the upper half, z = N (0.5017 a cot(0.6407 a) - 0.6122 + 0.2645 i
// a). With singularities on the negative real axis only, its error is 3.89^-N, below rounding for 24
// (Trefethen, Weideman & Schmelzer, BIT 46 (2006) 653, eq. 3.2).
constexpr int kPoints = 24;

struct ContourPoint {
  Complex z, weight;  // weight: (2/N) e^z z'
};

std::vector<ContourPoint> contour() {
  std::vector<ContourPoint> points;
  constexpr double kWidth = 0.5017, kBend = 0.6407, kShift = 0.6122, kHeight = 0.2645;
  for (int k = 0; k < kPoints / 2; ++k) {
    const double a = (2.0 * k + 1.0) * std::numbers::pi / kPoints;
    const double sine = std::sin(kBend * a), cotangent = std::cos(kBend * a) / sine;
    const Complex z =
        static_cast<double>(kPoints) * Complex(kWidth * a * cotangent - kShift, kHeight * a);
    const Complex slope = static_cast<double>(kPoints) *
                          Complex(kWidth * cotangent - kWidth * kBend * a / (sine * sine), kHeight);
    points.push_back({z, 2.0 / kPoints * std::exp(z) * slope});
  }
  return points;
}

// s E(s) of a series.
Complex operational_modulus(const PronySeries& series, Complex s) {
  Complex sum = series.equilibrium_modulus_Pa;
  for (const MaxwellTerm& term : series.terms) {
    const Complex x = s * term.relaxation_time_s;
    sum += term.modulus_Pa * x / (1.0 + x);
  }
  return sum;
}

// A creep record may contain t = 0, where every term begins.
double nearly_zero_s(const std::vector<LogBin>& bins) {
  constexpr double kSmall = 1e-6;
  for (const LogBin& bin : bins) {
    if (bin.time_s > 0.0) return kSmall * bin.time_s;
  }
  return kSmall;
}

// The steady flow of a liquid is a column of its own; that of a solid stays zero.
FitOptions with_flow(FitOptions options) {
  options.is_liquid = true;
  return options;
}

}  // namespace

CreepRows::CreepRows(std::span<const double> time_s, std::span<const double> compliance_1_Pa,
                     const PronySeries& reference, const FitOptions& options)
    : step_(time_s, compliance_1_Pa, StepShape::kCreep, with_flow(options)),
      with_equilibrium_(!options.is_liquid) {
  if (with_equilibrium_) common_.push_back({"E_inf", false});
  ln_tau_min_ = step_.ln_tau_min();
  ln_tau_max_ = step_.ln_tau_max();
  const std::vector<ContourPoint> points = contour();
  const auto n_rows = static_cast<Index>(step_.bins().size());
  s_1_s_.resize(n_rows, static_cast<Index>(points.size()));
  const double least_s = nearly_zero_s(step_.bins());
  for (Index row = 0; row < n_rows; ++row) {
    const double t_s = std::max(step_.bins()[static_cast<std::size_t>(row)].time_s, least_s);
    for (std::size_t k = 0; k < points.size(); ++k) {
      s_1_s_(row, static_cast<Index>(k)) = points[k].z / t_s;
    }
  }
  refer_to(reference);
}

void CreepRows::refer_to(const PronySeries& series) {
  data_ = step_.data() - 2.0 * step_.fitted(creep_state(series));
  const std::vector<ContourPoint> points = contour();
  weight_.resize(s_1_s_.rows(), s_1_s_.cols());
  for (Index row = 0; row < s_1_s_.rows(); ++row) {
    const LogBin& bin = step_.bins()[static_cast<std::size_t>(row)];
    for (Index k = 0; k < s_1_s_.cols(); ++k) {
      const ContourPoint& point = points[static_cast<std::size_t>(k)];
      const Complex s = s_1_s_(row, k);
      // The mean over the samples of the row, by the derivatives of the curve at their mean time.
      const Complex mean = 1.0 + s * s * (bin.m2 / 2.0 + s * (bin.m3 / 6.0 + s * bin.m4 / 24.0));
      const Complex modulus = operational_modulus(series, s);
      weight_(row, k) =
          -std::sqrt(bin.count) * mean * point.weight * (s / point.z) / (modulus * modulus);
    }
  }
}

ModelColumns CreepRows::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                                bool with_slopes) const {
  ModelColumns out;
  out.values.resize(n_rows(), n_common() + ln_tau.size());
  if (with_slopes) out.term_slopes.resize(n_rows(), ln_tau.size());
  if (with_equilibrium_) {
    out.values.col(0) = (weight_.array() / s_1_s_.array()).rowwise().sum().imag();
  }
  for (Index i = 0; i < ln_tau.size(); ++i) {
    const double rate_1_s = std::exp(-ln_tau[i]);
    const Eigen::ArrayXXcd inverse = (s_1_s_.array() + Complex(rate_1_s)).inverse();
    const Eigen::ArrayXXcd product = weight_.array() * inverse;
    out.values.col(n_common() + i) = product.rowwise().sum().imag();
    if (with_slopes) {
      out.term_slopes.col(i) = rate_1_s * (product * inverse).rowwise().sum().imag();
    }
  }
  return out;
}

PronySeries CreepRows::series_of(const SpectralState& state) const {
  PronySeries series{with_equilibrium_ ? state.coefficients[0] : 0.0, {}};
  for (Index i = 0; i < state.n_terms(); ++i) {
    series.terms.push_back({state.coefficients[n_common() + i], std::exp(state.ln_tau[i])});
  }
  return series;
}

SpectralState CreepRows::creep_state(const PronySeries& series) const {
  const RetardationSpectrum spectrum = retardation_from_relaxation(series);
  const auto n_terms = static_cast<Index>(spectrum.terms.size());
  SpectralState state;
  state.ln_tau.resize(n_terms);
  state.coefficients.resize(2 + n_terms);
  state.coefficients[0] = spectrum.instantaneous_compliance_1_Pa;
  state.coefficients[1] = spectrum.fluidity_1_Pa_s;
  for (Index i = 0; i < n_terms; ++i) {
    const RetardationTerm& term = spectrum.terms[static_cast<std::size_t>(i)];
    state.ln_tau[i] = std::log(term.retardation_time_s);
    state.coefficients[2 + i] = term.compliance_1_Pa;
  }
  return state;
}

Eigen::VectorXd CreepRows::compliance_of(const SpectralState& state) const {
  return step_.fitted(creep_state(series_of(state)));
}

double CreepRows::hidden_rss(const SpectralState& state) const {
  const PronySeries series = series_of(state);
  if (!(instantaneous_modulus_Pa(series) > 0.0)) return 0.0;
  return step_.hidden_rss(creep_state(series));
}

}  // namespace viscard
