#pragma once

#include "models/material/temperature_shift.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace viscard {

// ln a_T at a temperature, from a master curve, and ln of the vertical shift b_T of the moduli.
struct ShiftFactor {
  double temperature_C = 0.0;
  double ln_a = 0.0;
  double ln_a_se = 0.0;
  double ln_b = 0.0;
  double ln_b_se = 0.0;
};

// The laws of the shift that the factors of a master curve support.
struct ShiftLaws {
  std::optional<TemperatureShift> wlf, arrhenius;  // with 95 % intervals; none: not determined
  double wlf_chi2 = 0.0, arrhenius_chi2 = 0.0;     // weighted by the covariance of the factors
  double wlf_bic = 0.0, arrhenius_bic = 0.0;       // in units of the scatter about the better law
  bool wlf_is_better = false;
  const TemperatureShift* better() const;
};

// Fits the WLF and Arrhenius laws to the factors by generalised least squares with their covariance
// (without the reference). The covariance is scaled up if the scatter about the law exceeds it. WLF
// needs at least three temperatures besides the reference. It is omitted if its constants diverge,
// which means that a straight line describes the data as well.
ShiftLaws fit_shift_laws(const std::vector<ShiftFactor>& factors, const Eigen::MatrixXd& covariance,
                         double T_ref_C);

}  // namespace viscard
