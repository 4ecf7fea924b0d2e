#include "models/material/material_bound.h"

#include "models/material/series_band.h"
#include "models/material/systematic_parts.h"
#include "models/maths/require.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace viscard {
namespace {

double end_of(const Interval& interval, double value, double systematic_u, IntervalEnd end) {
  const double random = end == IntervalEnd::kLower ? value - interval.low : interval.high - value;
  const double half = std::hypot(std::max(0.0, random), kNormal95 * systematic_u * value);
  return end == IntervalEnd::kLower ? value - half : value + half;
}

double change_of_E0_Pa(const SeriesDirection& direction) {
  return std::accumulate(direction.modulus_Pa.begin(), direction.modulus_Pa.end(),
                         direction.equilibrium_Pa);
}

void add_scaled(SeriesDirection& sum, const SeriesDirection& direction, double factor) {
  sum.equilibrium_Pa += factor * direction.equilibrium_Pa;
  for (std::size_t i = 0; i < sum.modulus_Pa.size(); ++i) {
    sum.modulus_Pa[i] += factor * direction.modulus_Pa[i];
    sum.ln_tau[i] += factor * direction.ln_tau[i];
  }
}

// The covariance as directions, widened until the interval of E0 that it implies is the stated one.
std::vector<SeriesDirection> random_directions(const Material& material, IntervalEnd end) {
  const MaterialUncertainty& found = *material.uncertainty;
  std::vector<SeriesDirection> directions =
      directions_of(found.covariance_parameters, found.covariance, material.terms.size());
  double variance_Pa2 = 0.0;
  for (const SeriesDirection& one : directions) variance_Pa2 += std::pow(change_of_E0_Pa(one), 2);
  const double half_Pa =
      std::abs(end_of(found.E0_Pa_95, material.E0_Pa, 0.0, end) - material.E0_Pa);
  if (!(variance_Pa2 > 0.0) || !std::isfinite(half_Pa)) return directions;
  const SeriesDirection none = common_scale(young_series(material), 0.0);
  for (SeriesDirection& one : directions) {
    SeriesDirection wide = none;
    add_scaled(wide, one, half_Pa / (kNormal95 * std::sqrt(variance_Pa2)));
    one = wide;
  }
  return directions;
}

}  // namespace

double end_of_E0_Pa(const Material& material, IntervalEnd end) {
  require(material.uncertainty && material.uncertainty->E0_Pa_95.high > 0.0,
          "the material states no interval of E0");
  return end_of(material.uncertainty->E0_Pa_95, material.E0_Pa,
                systematic_u_of_E0(systematic_parts_of(*material.uncertainty)), end);
}

double end_of_E_inf_Pa(const Material& material, IntervalEnd end) {
  require(material.uncertainty.has_value(), "the material states no interval of E_inf");
  const PronySeries series = young_series(material);
  const double systematic_u =
      systematic_u_of_E_inf(systematic_parts_of(*material.uncertainty), series);
  return end_of(material.uncertainty->E_inf_Pa_95, series.equilibrium_modulus_Pa, systematic_u,
                end);
}

Material material_at_end(const Material& material, IntervalEnd end) {
  require(has_band(material), "the material states no covariance");
  const double end_Pa = end_of_E0_Pa(material, end);
  require_positive("E0 at the end of its interval", end_Pa, "Pa");
  const PronySeries series = young_series(material);
  std::vector<SeriesDirection> directions = random_directions(material, end);
  for (const SystematicPart& part : systematic_parts_of(*material.uncertainty)) {
    directions.push_back(direction_of(series, part));
  }
  double variance_Pa2 = 0.0;
  for (const SeriesDirection& one : directions) variance_Pa2 += std::pow(change_of_E0_Pa(one), 2);
  require(variance_Pa2 > 0.0, "the covariance of the material says that E0 is exact");
  SeriesDirection step = common_scale(series, 0.0);
  for (const SeriesDirection& one : directions) {
    add_scaled(step, one, change_of_E0_Pa(one) * (end_Pa - material.E0_Pa) / variance_Pa2);
  }
  const PronySeries at_end = moved(series, step, 1.0);
  Material out = material;
  out.uncertainty.reset();
  out.E0_Pa = instantaneous_modulus_Pa(at_end);
  for (std::size_t i = 0; i < out.terms.size(); ++i) {
    const double share = at_end.terms[i].modulus_Pa / out.E0_Pa;
    out.terms[i] = {share, share, at_end.terms[i].relaxation_time_s};
  }
  return out;
}

}  // namespace viscard
