#include "models/material/ratio_causes.h"

#include "models/maths/interval.h"

#include <cmath>

namespace viscard {
namespace {

void without_spread(RatioModel& model) {
  model.spread_ln_E0 = model.spread_ln_g = model.spread_ln_tau = 0.0;
}

// 97.5 % quantile behind the interval of E0 over that of the normal distribution.
double widening_of(const Material& material) {
  const MaterialUncertainty& uncertainty = *material.uncertainty;
  const auto n_moduli = static_cast<Eigen::Index>(material.terms.size()) + 1;
  const double variance_Pa2 = uncertainty.covariance.topLeftCorner(n_moduli, n_moduli).sum();
  const double ln_half = 0.5 * std::log(uncertainty.E0_Pa_95.high / uncertainty.E0_Pa_95.low);
  if (!(variance_Pa2 > 0.0) || !std::isfinite(ln_half)) return 1.0;
  return ln_half * material.E0_Pa / (kNormal95 * std::sqrt(variance_Pa2));
}

// The difference of two covariances without parameters whose variances agree within rounding.
Eigen::MatrixXd without_rounding(Eigen::MatrixXd difference, const Eigen::MatrixXd& beside) {
  for (Eigen::Index i = 0; i < difference.rows(); ++i) {
    if (difference(i, i) > 1e-12 * beside(i, i)) continue;
    difference.row(i).setZero();
    difference.col(i).setZero();
  }
  return difference;
}

}  // namespace

MaterialCauses causes_at_ratio(const RatioFit& fit, double ratio) {
  Material whole = material_at_ratio(fit, ratio);
  RatioFit law_alone = fit;
  without_spread(law_alone.best);
  without_spread(law_alone.law);
  const Eigen::MatrixXd law = material_at_ratio(law_alone, ratio).uncertainty->covariance;
  const std::vector<std::string>& names = whole.uncertainty->covariance_parameters;
  const double variance_factor = std::pow(widening_of(whole), 2);
  const Eigen::MatrixXd scatter =
      variance_factor * without_rounding(whole.uncertainty->covariance - law, law);
  whole.uncertainty->covariance = variance_factor * law;
  MaterialCauses out = causes_of(whole);
  for (MaterialCause& cause : out.causes) {
    if (cause.name == kRandomPart) cause.name = "error of the law in the ratio";
  }
  std::vector<SeriesDirection> directions = directions_of(names, scatter, whole.terms.size());
  if (!directions.empty()) {
    out.causes.push_back({"scatter between specimens", std::move(directions)});
  }
  return out;
}

}  // namespace viscard
