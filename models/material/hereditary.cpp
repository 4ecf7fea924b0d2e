#include "models/material/hereditary.h"

#include "models/maths/branch_step.h"
#include "models/maths/text_of_number.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {

HereditaryStress::HereditaryStress(PronySeries series)
    : series_(std::move(series)), branch_Pa_(series_.terms.size(), 0.0) {
  validate(series_, /*allow_negative=*/true);
}

double HereditaryStress::advance(double dt_s, double strain) {
  if (!(dt_s >= 0.0) || !std::isfinite(dt_s)) {
    throw std::invalid_argument("time step of " + text_of(dt_s) +
                                " s; steps must be finite and not negative");
  }
  const double increment = strain - strain_;
  for (std::size_t i = 0; i < branch_Pa_.size(); ++i) {
    const BranchStep step(dt_s, series_.terms[i].relaxation_time_s);
    branch_Pa_[i] =
        step.decay * branch_Pa_[i] + series_.terms[i].modulus_Pa * step.gain * increment;
  }
  strain_ = strain;
  return stress_Pa();
}

double HereditaryStress::algorithmic_modulus_Pa(double dt_s) const {
  double modulus_Pa = series_.equilibrium_modulus_Pa;
  for (const MaxwellTerm& term : series_.terms) {
    modulus_Pa += term.modulus_Pa * phi1(dt_s / term.relaxation_time_s);
  }
  return modulus_Pa;
}

double HereditaryStress::carried_Pa(double dt_s) const {
  double carried_Pa = 0.0;
  for (std::size_t i = 0; i < branch_Pa_.size(); ++i) {
    const BranchStep step(dt_s, series_.terms[i].relaxation_time_s);
    carried_Pa += step.decay * branch_Pa_[i] - series_.terms[i].modulus_Pa * step.gain * strain_;
  }
  return carried_Pa;
}

double HereditaryStress::stress_Pa() const {
  double stress_Pa = series_.equilibrium_modulus_Pa * strain_;
  for (const double branch_Pa : branch_Pa_) stress_Pa += branch_Pa;
  return stress_Pa;
}

double HereditaryStress::falling_Pa_s() const {
  double rate_Pa_s = 0.0;
  for (std::size_t i = 0; i < branch_Pa_.size(); ++i) {
    rate_Pa_s += branch_Pa_[i] / series_.terms[i].relaxation_time_s;
  }
  return rate_Pa_s;
}

}  // namespace viscard
