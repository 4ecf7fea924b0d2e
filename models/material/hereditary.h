#pragma once

#include "models/material/prony_series.h"

#include <vector>

namespace viscard {

// Hereditary integral of a generalised Maxwell solid,
//   sigma(t) = int_0^t E(t - s) d(strain)/ds ds   (eq. 5),
// for strain that is linear in each step. "Strain" may be any input in which stress is linear: the
// depth of a flat punch gives its force. Sources: Taylor, Pister & Goudreau, IJNME 2 (1970) 45;
// Simo & Hughes, Computational Inelasticity (1998), ch. 10.
class HereditaryStress {
 public:
  explicit HereditaryStress(PronySeries series);

  // Takes a step of dt_s >= 0 in which the strain goes to `strain` linearly; dt_s = 0 is a jump.
  // Returns the stress at its end. Throws std::invalid_argument if dt_s < 0 or not finite.
  double advance(double dt_s, double strain);

  // Stress at the end of a step is algorithmic_modulus_Pa(dt) * strain + carried_Pa(dt), the split
  // an implicit solver needs (a spring in series, a finite element).
  double algorithmic_modulus_Pa(double dt_s) const;
  double carried_Pa(double dt_s) const;

  double stress_Pa() const;
  double falling_Pa_s() const;  // the rate at which it falls if the strain stays
  double strain() const { return strain_; }

 private:
  PronySeries series_;
  std::vector<double> branch_Pa_;  // q_i
  double strain_ = 0.0;
};

}  // namespace viscard
