#pragma once

#include "models/material/material.h"
#include "models/pillar/time/transient_request.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <complex>
#include <vector>

namespace viscard {

// One mode of a body all of whose stiffness relaxes alike, q'' + omega^2 int E(t - s)/E_0 dq(s) =
// f(t), solved exactly: in the Laplace domain q = f/D with
//   D(s) = s^2 + omega^2 [1 - sum g_i/(1 + s tau_i)],
// whose roots are one real rate beside each relaxation time and one pair. For a step of load the
// memory d_i of eq. 17 and the inertia are thus both free of any step error (eq. 24b).
// Source: Christensen, Theory of Viscoelasticity (1982), ch. 3 (partial fractions of the
// transform).
class RelaxingMode {
 public:
  RelaxingMode(double omega_rad_s, const std::vector<MaterialTerm>& terms);

  // Free of load until now; then a load linear in time from `first` to `last` over length_s.
  void advance(double length_s, double first, double last);
  double displacement() const;

  const std::vector<std::complex<double>>& roots_1_s() const { return root_1_s_; }

 private:
  void prepare(double length_s);
  std::vector<std::complex<double>> root_1_s_;  // of a conjugate pair only one
  std::vector<std::complex<double>> residue_;   // 1/D'(root), twice that for a pair
  std::vector<std::complex<double>> convolved_;
  double prepared_s_ = 0.0;
  std::vector<std::complex<double>> decay_, from_first_, from_last_;  // over prepared_s_
};

// True when all of the body's stiffness relaxes alike: elastic, or constant Poisson ratio and
// nothing elastic beside it.
bool relaxes_alike(const ViscoelasticSystem& small);

// run_transient() by the modes of such a body: exact for the small body, whatever the times.
TransientResult run_by_modes(const ViscoelasticSystem& small, const TransientRequest& request,
                             const Eigen::MatrixXd& observers);

}  // namespace viscard
