#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <complex>
#include <functional>
#include <vector>

namespace viscard {

// Inverse Laplace transform at one time t > 0 by the fixed Talbot contour with `nodes` points; the
// transform must be analytic off the negative real axis. Relative error about 10^(-0.6 nodes) down
// to about 1e-11 in double precision. Source: Abate & Valko, IJNME 60 (2004) 979.
double inverse_laplace(const std::function<std::complex<double>(std::complex<double>)>& transform,
                       double time_s, int nodes = 22);

// Exact answer of a discretised body of one viscoelastic material (no elastic part) by the
// correspondence principle: `shear` and `bulk` are diagonal together, so the compliance under the
// unit load is  sum_m w_m / (G~(s) + theta_m K~(s))  in the Laplace domain, with G~ = s G^(s)/G_0
// (eq. 19). Each mode is a generalised Maxwell solid of its own.
class ExactViscoelasticBody {
 public:
  // Dense eigenproblem of system.load.size() unknowns. Throws std::invalid_argument if the system
  // has an elastic part or is incompressible (its Poisson ratio is then constant and E(t) is all it
  // needs).
  explicit ExactViscoelasticBody(const ViscoelasticSystem& system);

  double creep_displacement(double time_s) const;  // load.u under the unit load applied at 0
  double relaxation_force(double time_s) const;    // force that holds load.u = 1 from 0 on
  // The same creep by the retardation spectrum of every mode: slower, with no numerical inversion.
  double creep_displacement_by_spectra(double time_s) const;

 private:
  std::complex<double> compliance(std::complex<double> s) const;

  std::vector<MaterialTerm> terms_;
  std::vector<double> weight_;  // w_m
  std::vector<double> theta_;
};

}  // namespace viscard
