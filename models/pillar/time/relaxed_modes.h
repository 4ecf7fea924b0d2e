#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <complex>
#include <vector>

namespace viscard {

// A free vibration exp(s t) of a body that relaxes, s = -damping |s| + 2 pi i frequency.
struct RelaxedMode {
  double frequency_Hz = 0.0;   // at which it rings; 0 if it does not oscillate
  double damping_ratio = 0.0;  // -Re(s)/|s|
  double error = 0.0;          // of s, relative to |s|: what the reduced basis leaves out
  std::complex<double> s;      // 1/s; 0 if it does not oscillate
  Eigen::VectorXcd shape;      // unknowns of the model; empty likewise
};

// The lowest modes of one family of motion, damping included:
//   [K_el + G~(s)/G_0 K_shear + K~(s)/K_0 K_bulk + s^2 M] u = 0   (eq. 22b)
// with the moduli at the mode's own complex frequency. The k-th is the k-th of the body whose
// moduli are the storage moduli at its frequency, followed as its loss grows. A mode
// that creeps back (or, under a pressure, creeps away) without oscillating has frequency 0.
//
// The equation is restricted to a basis that holds the modes at the instantaneous moduli and at
// those of the lowest and highest mode asked for, and grows by the residual of each mode. Restricted
// and whole matrix are complex symmetric, so the error of s is the square of the residual's.
// Sources: Voss, BIT Numer. Math. 44 (2004) 387 (Arnoldi's method for nonlinear eigenproblems); Voss
// & Werner, Math. Meth. Appl. Sci. 4 (1982) 415 (which numbers the modes); Ruhe, SIAM J. Numer. Anal.
// 10 (1973) 674 (inverse iteration).
//
// `body` must belong to the model; its elastic part may contain the stiffness of a stress. Throws
// std::runtime_error if a mode cannot be found to the tolerance (relative, of s).
std::vector<RelaxedMode> relaxed_modes(const PillarModel& model, ViscoelasticSystem body, int count,
                                       double tolerance);

// The mode of a body near one with this mode, whose shape y it keeps: the root of y' T(s) y = 0, exact to
// first order, because T is complex symmetric and y' T(s) y stationary in y.
RelaxedMode relaxed_mode_nearby(const ViscoelasticSystem& body, std::complex<double> s,
                                const Eigen::VectorXcd& shape);

}  // namespace viscard
