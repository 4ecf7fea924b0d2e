#include "models/material/series_band.h"

#include "models/maths/dense.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

// A direction in which the parameters scatter with standard deviation 1: changes of E_inf, of the
// E_i and of the ln tau_i.
struct Direction {
  double equilibrium_Pa = 0.0;
  std::vector<double> modulus_Pa, ln_tau;
};

Direction none(std::size_t n_terms) {
  return {0.0, std::vector<double>(n_terms, 0.0), std::vector<double>(n_terms, 0.0)};
}

// Adds `amount` to the parameter with that name. Names of other parameters are ignored.
void add_to(Direction& direction, const std::string& name, double amount) {
  if (name == "E_inf_Pa") direction.equilibrium_Pa += amount;
  for (std::size_t i = 0; i < direction.ln_tau.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    if (name == "E_" + number + "_Pa") direction.modulus_Pa[i] += amount;
    if (name == "ln_tau_" + number) direction.ln_tau[i] += amount;
  }
}

std::vector<Direction> directions_of(const MaterialUncertainty& uncertainty, std::size_t n_terms) {
  const Index count = uncertainty.covariance.rows();
  const Eigen::VectorXd deviation = uncertainty.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < count; ++j) {
      const double scale = deviation[i] * deviation[j];
      if (i != j && scale > 0.0) correlation(i, j) = uncertainty.covariance(i, j) / scale;
    }
  }
  const EigenSystem found = symmetric_eigen(correlation);
  std::vector<Direction> directions;
  for (Index k = 0; k < count; ++k) {
    if (!(found.values[k] > 0.0)) continue;
    Direction direction = none(n_terms);
    for (Index i = 0; i < count; ++i) {
      add_to(direction, uncertainty.covariance_parameters[static_cast<std::size_t>(i)],
             std::sqrt(found.values[k]) * deviation[i] * found.vectors(i, k));
    }
    directions.push_back(direction);
  }
  return directions;
}

Direction common_scale(const PronySeries& series, double relative) {
  Direction direction = none(series.terms.size());
  direction.equilibrium_Pa = relative * series.equilibrium_modulus_Pa;
  for (std::size_t i = 0; i < series.terms.size(); ++i) {
    direction.modulus_Pa[i] = relative * series.terms[i].modulus_Pa;
  }
  return direction;
}

// Moduli that would become negative stay at zero.
PronySeries moved(const PronySeries& series, const Direction& direction, double step) {
  PronySeries out = series;
  out.equilibrium_modulus_Pa =
      std::max(0.0, series.equilibrium_modulus_Pa + step * direction.equilibrium_Pa);
  for (std::size_t i = 0; i < out.terms.size(); ++i) {
    MaxwellTerm& term = out.terms[i];
    term.modulus_Pa = std::max(0.0, term.modulus_Pa + step * direction.modulus_Pa[i]);
    term.relaxation_time_s *= std::exp(step * direction.ln_tau[i]);
  }
  return out;
}

// The step that changes no time by more than this share and no modulus by more than this share of
// itself (or of 1e-4 E0, if that is more). 0 if the direction changes nothing.
double step_along(const PronySeries& series, const Direction& direction) {
  constexpr double kShare = 1e-4;
  const double least_Pa = kShare * instantaneous_modulus_Pa(series);
  double largest = 0.0;
  const auto see = [&](double change, double value) {
    largest = std::max(largest, std::abs(change) / value);
  };
  see(direction.equilibrium_Pa, std::max(least_Pa, series.equilibrium_modulus_Pa));
  for (std::size_t i = 0; i < series.terms.size(); ++i) {
    see(direction.modulus_Pa[i], std::max(least_Pa, series.terms[i].modulus_Pa));
    see(direction.ln_tau[i], 1.0);
  }
  return largest > 0.0 ? kShare / largest : 0.0;
}

// 0 if the curve may be followed to both sides. If a modulus would become negative on one side, the
// other one (1 or -1).
double only_side(const PronySeries& series, const Direction& direction, double step) {
  const auto side = [step](double value, double change) {
    return std::abs(step * change) <= value ? 0.0 : change > 0.0 ? 1.0 : -1.0;
  };
  double only = side(series.equilibrium_modulus_Pa, direction.equilibrium_Pa);
  for (std::size_t i = 0; only == 0.0 && i < series.terms.size(); ++i) {
    only = side(series.terms[i].modulus_Pa, direction.modulus_Pa[i]);
  }
  return only;
}

}  // namespace

bool has_band(const Material& material) {
  if (!material.uncertainty || !has_constant_poisson_ratio(material)) return false;
  const MaterialUncertainty& uncertainty = *material.uncertainty;
  const auto count = static_cast<Index>(uncertainty.covariance_parameters.size());
  return count > 0 && uncertainty.covariance.rows() == count &&
         uncertainty.covariance.cols() == count && uncertainty.covariance.allFinite();
}

BandedCurve banded_curve(const Material& material, const CurveOfSeries& curve) {
  const PronySeries series = young_series(material);
  BandedCurve out;
  out.value = curve(series);
  if (!has_band(material)) return out;
  std::vector<Direction> directions = directions_of(*material.uncertainty, series.terms.size());
  directions.push_back(common_scale(series, material.uncertainty->systematic_relative));
  std::vector<double> variance(out.value.size(), 0.0);
  for (const Direction& direction : directions) {
    const double step = step_along(series, direction);
    if (!(step > 0.0)) continue;
    const double side = only_side(series, direction, step);
    const std::vector<double> up = curve(moved(series, direction, side < 0.0 ? -step : step));
    const std::vector<double> down =
        side == 0.0 ? curve(moved(series, direction, -step)) : out.value;
    const double width = side == 0.0 ? 2.0 * step : step;
    for (std::size_t i = 0; i < variance.size(); ++i) {
      variance[i] += std::pow((up[i] - down[i]) / width, 2);
    }
  }
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const double half = kNormal95 * std::sqrt(variance[i]);
    out.low_95.push_back(out.value[i] - half);
    out.high_95.push_back(out.value[i] + half);
  }
  return out;
}

Material material_at_temperature(const Material& material, double temperature_C) {
  require(material.shift.has_value(),
          "the material states no temperature shift, so its times are known at its own temperature "
          "only; fit a table with several temperatures");
  const double a_T = std::exp(ln_shift_factor(*material.shift, temperature_C));
  Material out = material;
  for (MaterialTerm& term : out.terms) term.tau_s *= a_T;
  out.valid.t_min_s *= a_T;
  out.valid.t_max_s *= a_T;
  out.shift.reset();
  out.T_ref_C = temperature_C;
  return out;
}

}  // namespace viscard
