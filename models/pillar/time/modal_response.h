#pragma once

#include "models/material/material.h"
#include "models/pillar/time/transient_run.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <complex>
#include <vector>

namespace viscard {

// One mode of a body whose whole stiffness relaxes with one relative modulus,
//   q'' + omega^2 int E(t - s)/E_0 dq(s) = f(t),
// solved exactly: in the Laplace domain q = f/D with
//   D(s) = s^2 + omega^2 [1 - sum g_i/(1 + s tau_i)].
// The roots of D are one real rate near each relaxation time and one pair. Therefore, for a step of
// load, both the memory d_i of eq. 17 and the inertia are free of step errors (eq. 24b). Source:
// Christensen, Theory of Viscoelasticity (1982), ch. 3 (partial fractions of the transform).
class RelaxingMode {
 public:
  RelaxingMode(double omega_rad_s, const std::vector<MaterialTerm>& terms);

  // No load until now, then a load that varies linearly from `first` to `last` over length_s.
  void advance(double length_s, double first, double last);
  double displacement() const;
  double velocity() const;

  const std::vector<std::complex<double>>& roots_1_s() const { return root_1_s_; }

 private:
  void prepare(double length_s);
  std::vector<std::complex<double>> root_1_s_;  // only one of a conjugate pair
  std::vector<std::complex<double>> residue_;   // 1/D'(root), twice that for a pair
  std::vector<std::complex<double>> convolved_;
  double prepared_s_ = 0.0;
  std::vector<std::complex<double>> decay_, from_first_, from_last_;  // over prepared_s_
};

// True if the whole stiffness of the body relaxes with one relative modulus: it is elastic, or it
// has a constant Poisson ratio and no elastic part.
bool relaxes_alike(const ViscoelasticSystem& small);

// run_transient() by the modes of such a body: exact for the small body at any times.
TransientResult run_by_modes(const ViscoelasticSystem& small, const TransientRequest& request,
                             const Eigen::MatrixXd& observers);

}  // namespace viscard
