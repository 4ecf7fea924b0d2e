#pragma once

#include "models/material/material.h"

#include <functional>
#include <vector>

namespace viscard {

// Any curve that follows from the relaxation series of E: a modulus over time, a strain history.
using CurveOfSeries = std::function<std::vector<double>(const PronySeries&)>;

// A curve and its band, in the unit of the quantity.
struct BandedCurve {
  std::vector<double> value, low_95, high_95;  // no band: the last two are empty
};

// True if the material states a covariance that applies to E(t): its Poisson ratio is constant.
bool has_band(const Material& material);

// The curve of the material with its 95 % band, to first order in the parameters: the variance is
// J C J', where J holds the derivatives of the curve by the moduli and ln tau. The systematic parts
// are included (in quadrature). J is taken along the eigenvectors
// of the correlation matrix, by central differences, so the variance cannot become negative.
BandedCurve banded_curve(const Material& material, const CurveOfSeries& curve);

// The material at another temperature: all times and the window multiplied by a_T (eq. 26, 27).
// Throws std::invalid_argument if it states no temperature shift, and as ln_shift_factor() does.
Material material_at_temperature(const Material& material, double temperature_C);

}  // namespace viscard
