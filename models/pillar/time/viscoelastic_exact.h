#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <complex>
#include <functional>
#include <vector>

namespace viscard {

// Inverse Laplace transform at one time t > 0 by the fixed Talbot contour with `nodes` points. The
// transform must be analytic off the negative real axis. The relative error is about 10^(-0.6
// nodes), down to about 1e-11 in double precision. Source: Abate & Valko, IJNME 60 (2004) 979.
double inverse_laplace(const std::function<std::complex<double>(std::complex<double>)>& transform,
                       double time_s, int nodes = 22);

// Exact solution of a discretised body of one viscoelastic material (no elastic part) by the
// correspondence principle. `shear` and `bulk` are diagonalised together, so in the Laplace domain
// the compliance under the unit load is
//   sum_m w_m / (G~(s) + theta_m K~(s)),  G~ = s G^(s)/G_0   (eq. 19).
// Each mode is a separate generalised Maxwell solid.
class ExactViscoelasticBody {
 public:
  // Dense eigenproblem of system.load.size() unknowns. Throws std::invalid_argument if the system
  // has an elastic part or is incompressible (then the Poisson ratio is constant; E(t) suffices).
  explicit ExactViscoelasticBody(const ViscoelasticSystem& system);

  double creep_displacement(double time_s) const;  // load.u under the unit load applied at 0
  double relaxation_force(double time_s) const;    // force that holds load.u = 1 from 0 on
  // The same creep from the retardation spectrum of every mode: slower, no numerical inversion.
  double creep_displacement_by_spectra(double time_s) const;

 private:
  std::complex<double> compliance(std::complex<double> s) const;

  std::vector<MaterialTerm> terms_;
  std::vector<double> weight_;  // w_m
  std::vector<double> theta_;
};

}  // namespace viscard
