#pragma once

#include "models/material/temperature_shift.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace viscard {

// ln a_T against temperature, from a master curve.
struct ShiftFactor {
  double temperature_C = 0.0;
  double ln_a = 0.0;
  double ln_a_se = 0.0;
};

struct ShiftLaws {
  std::optional<TemperatureShift> wlf, arrhenius;  // with 95 % intervals; none: not determined
  double wlf_chi2 = 0.0, arrhenius_chi2 = 0.0;     // weighted by the factors' own covariance
  double wlf_bic = 0.0, arrhenius_bic = 0.0;       // of the scatter about the better of the two
  bool wlf_is_better = false;
  const TemperatureShift* better() const;
};

// WLF and Arrhenius laws through the factors by generalised least squares with their covariance
// (reference left out of both), widened where the scatter about the law exceeds it. WLF needs at
// least three temperatures beside the reference; it is left out when its constants run away, which
// says that a straight line does as well.
ShiftLaws fit_shift_laws(const std::vector<ShiftFactor>& factors, const Eigen::MatrixXd& covariance,
                         double T_ref_C);

}  // namespace viscard
