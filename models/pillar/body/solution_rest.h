#pragma once

#include "models/pillar/body/pillar_model.h"

#include <vector>

namespace viscard {

// Estimate of what a solution lacks because its degree is finite, from the solution itself: in
// every element, the energy of its highest polynomials, and how quickly it falls with the degree.
// If the solution is smooth, or layers shrink toward a corner, it falls exponentially; in an
// element that touches a singular corner without layers it falls as a power of the degree, and the
// missing part is large. The change by a mesh that was refined elsewhere does not show this.
// Source: Mavriplis, A posteriori error estimators for adaptive spectral element techniques, Notes
// Numer. Fluid Mech. 29 (1990) 333 (extrapolation of the spectrum of an element); Houston & Suli,
// Comput. Methods Appl. Mech. Eng. 194 (2005) 229 (power or exponential).
class SolutionRest {
 public:
  // Below this degree no estimate is possible, and nothing counts as missing.
  static constexpr int kLeastDegree = 4;

  SolutionRest(const PillarModel& model, const Eigen::VectorXd& solution);

  // About |a(u - u_h, z - z_h)|, J: the error of a functional of u with the dual solution z. For
  // the work of a load z equals u. Both solutions must belong to one model.
  friend double missing_work(const SolutionRest& u, const SolutionRest& z);

 private:
  // One element: nodal values of the part of the two highest degrees, field by field, its gradient
  // form applied to them, and the energies of this part and of the two degrees below.
  struct Shells {
    Eigen::VectorXd part, form_of_part;
    double high = 0.0, low = 0.0;
  };
  int degree_;
  std::vector<Shells> elements_;  // empty below kLeastDegree
};

double missing_work(const SolutionRest& u, const SolutionRest& z);
// The same relative to a(u, z); 0 if that is 0.
double missing_share(const SolutionRest& u, const SolutionRest& z, double work);

}  // namespace viscard
