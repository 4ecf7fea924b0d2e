#pragma once

#include "models/material/material.h"

#include <complex>
#include <vector>

namespace viscard {

// A band of frequencies of a steady vibration.
struct FrequencyBand {
  double from_Hz = 0.0, to_Hz = 0.0;
};

// Throws std::invalid_argument unless 0 < from < to, both finite.
void validate(const FrequencyBand& band);

// The band that the material's data support: f = 1/(2 pi t) over its validity window. Without a
// window: the relaxation times and a decade beyond them; for a material without terms, 1 to 1000
// Hz.
FrequencyBand supported_band(const Material& material);

// Logarithmically equidistant, both ends included.
std::vector<double> frequencies_Hz(const FrequencyBand& band, int count);

// Complex moduli at omega = 2 pi f: G* and K* by eq. 2, and E* = 9 K* G*/(3 K* + G*), 3 G* at
// nu = 0.5, where K* is infinite.
struct DynamicModuli {
  std::complex<double> young_Pa, shear_Pa, bulk_Pa;

  double loss_factor() const { return young_Pa.imag() / young_Pa.real(); }
};
// Storage and loss moduli of the material at a frequency.
DynamicModuli dynamic_moduli(const Material& material, double frequency_Hz);

// The largest deviation of a reduced loss factor from the material's.
struct LossDeviation {
  double value = 0.0;  // absolute, of the loss factor
  double at_Hz = 0.0;
  double loss_factor = 0.0;  // of the material there
};

// Parameters for a code with constant moduli that represent a material over a band. A structure
// with stiffness matrix K and damping matrix C = alpha M + beta K has the damping ratio alpha/(2
// omega) + beta omega/2 at omega (Clough and Penzien, Dynamics of Structures, 2nd ed. (1993),
// section 12-5), which is half its loss factor. alpha and beta >= 0 are those of least squares over
// the band, integrated over the logarithm of the frequency.
struct BandReduction {
  double young_Pa = 0.0;        // between the ends of E'(f): equally far from both, relatively
  double poisson = 0.0;         // of the storage moduli in the middle of the band
  double storage_change = 0.0;  // largest relative difference of young_Pa from E'(f)
  double storage_ratio = 1.0;   // largest over smallest E'(f)
  double loss_factor = 0.0;     // constant, least squares
  double alpha_1_s = 0.0, beta_s = 0.0;
  double beta_alone_s = 0.0;  // of C = beta K
  LossDeviation of_loss_factor, of_rayleigh, of_beta_alone;
};
BandReduction reduce_to_band(const Material& material, const FrequencyBand& band);

// The largest relative error of G* between the rows of a table that is interpolated linearly, over
// frequency or over its logarithm, whichever is worse.
double interpolation_error(const Material& material, const std::vector<double>& table_Hz);

}  // namespace viscard
