#include "models/material/series_band.h"

#include "models/material/series_directions.h"
#include "models/material/systematic_parts.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The step that changes no time by more than this share and no modulus by more than this share of
// itself (or of 1e-4 E0, if that is more). 0 if the direction changes nothing.
double step_along(const PronySeries& series, const SeriesDirection& direction) {
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
double only_side(const PronySeries& series, const SeriesDirection& direction, double step) {
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
  const MaterialUncertainty& uncertainty = *material.uncertainty;
  std::vector<SeriesDirection> directions =
      directions_of(uncertainty.covariance_parameters, uncertainty.covariance, series.terms.size());
  for (const SystematicPart& part : systematic_parts_of(uncertainty)) {
    directions.push_back(direction_of(series, part));
  }
  std::vector<double> variance(out.value.size(), 0.0);
  for (const SeriesDirection& direction : directions) {
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
