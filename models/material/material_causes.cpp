#include "models/material/material_causes.h"

#include "models/material/series_band.h"
#include "models/material/systematic_parts.h"

#include <algorithm>

namespace viscard {

MaterialCauses causes_of(const Material& material) {
  MaterialCauses out;
  if (!material.uncertainty) return out;
  const MaterialUncertainty& uncertainty = *material.uncertainty;
  const std::size_t n_terms = material.terms.size();
  if (has_band(material)) {
    std::vector<SeriesDirection> directions =
        directions_of(uncertainty.covariance_parameters, uncertainty.covariance, n_terms);
    if (!directions.empty()) out.causes.push_back({kRandomPart, std::move(directions)});
  } else {
    out.left_out = has_constant_poisson_ratio(material)
                       ? "the material states no covariance; only its systematic part counts"
                       : "shear and bulk of the material relax differently, and its covariance "
                         "describes E(t) alone; only its systematic part counts";
  }
  const PronySeries series = young_series(material);
  for (const SystematicPart& part : systematic_parts_of(uncertainty)) {
    // Terms of E(t) are those of the material only if its Poisson ratio is constant.
    const SystematicPart scale{part.cause, part.E0, {}, {}};
    const bool has_terms = has_constant_poisson_ratio(material);
    const bool is_stated = !uncertainty.systematic_parts.empty();
    out.causes.push_back({kSystematicPart + (is_stated ? ", " + part.cause : std::string()),
                          {direction_of(series, has_terms ? part : scale)}});
  }
  return out;
}

Material material_at(const Material& material, const std::vector<MaterialCause>& causes,
                     const Eigen::VectorXd& deviates) {
  Material out = material;
  if (!has_constant_poisson_ratio(material)) {  // scaled as a whole, by the systematic part
    const double E0_Pa = instantaneous_modulus_Pa(young_series(material));
    Eigen::Index next = 0;
    for (const MaterialCause& cause : causes) {
      for (const SeriesDirection& direction : cause.directions) {
        double change_Pa = direction.equilibrium_Pa;
        for (const double part_Pa : direction.modulus_Pa) change_Pa += part_Pa;
        out.E0_Pa *= 1.0 + deviates[next++] * change_Pa / E0_Pa;
      }
    }
    return out;
  }
  PronySeries series = young_series(material);
  Eigen::Index next = 0;
  for (const MaterialCause& cause : causes) {
    for (const SeriesDirection& direction : cause.directions) {
      series = moved(series, direction, deviates[next++]);
    }
  }
  out.E0_Pa = instantaneous_modulus_Pa(series);
  for (std::size_t i = 0; i < out.terms.size(); ++i) {
    const double share = series.terms[i].modulus_Pa / out.E0_Pa;
    out.terms[i] = {share, share, series.terms[i].relaxation_time_s};
  }
  return out;
}

}  // namespace viscard
