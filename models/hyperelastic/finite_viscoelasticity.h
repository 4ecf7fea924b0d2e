#pragma once

#include "models/hyperelastic/hyperelastic_law.h"
#include "models/maths/course.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// One term of the relaxation beside a law: share g of the instantaneous stress, relaxing with tau. Not a MaterialTerm:
// the body keeps its volume, so there is no share k of a bulk modulus; who needs one chooses it.
struct RubberTerm {
  double g = 0.0;
  double tau_s = 0.0;
};

// Throws std::invalid_argument for a g that is negative or not finite, a tau that is not positive, and a
// sum of g above 1.
void validate(const std::vector<RubberTerm>& terms);

// Finite linear viscoelasticity of an incompressible body (Simo, Comput. Methods Appl. Mech. Eng. 60
// (1987) 153; Simo & Hughes, Computational Inelasticity (1998), sect. 10.3). With the instantaneous
// deviatoric second Piola-Kirchhoff stress S = DEV(2 dW/dC) of the law,
//   S(t) = -p C^-1 + (1 - sum g_i) S + sum g_i H_i,   H_i(t) = int exp(-(t - s)/tau_i) dS(s).     (2)
// The principal directions do not turn, so that S_j = dev(dW/de)_j/s_j^2. The pressure p follows from
// the free side: the nominal stress is (s_1^2 S_1 - s_3^2 S_3)/s_1 for all three deformations. H is
// integrated exactly for a stress that is linear in time within a step,
//   H <- exp(-x) H + phi_1(x) (S_new - S_old),   x = dt/tau,  phi_1 = (1 - exp(-x))/x,
// and steps of more than 2 % of strain are divided, so that the stress is linear within 1e-4 of itself.
// FEBio's "uncoupled viscoelastic" has this rule with the long-term law (FEUncoupledViscoElasticMaterial.cpp).
// More than a Course: it holds the steps for one deformation. The history is the course of the measured stretch. Before its first point the body was at rest; a first stretch
// other than 1 is a jump.
class StretchCourse {
 public:
  // Throws std::invalid_argument for times that decrease, a stretch that is not positive, numbers that
  // are not finite.
  StretchCourse(Deformation deformation, const Course& history);

  // Number of points of the history.
  Eigen::Index size() const { return static_cast<Eigen::Index>(at_.size()); }

  // S_1 and S_3 at all steps: one row for each column of a model, one column for each step.
  struct Stress {
    Eigen::MatrixXd first, third;
    // Rows combined with weights.
    Stress times(const Eigen::VectorXd& weights) const {
      return {weights.transpose() * first, weights.transpose() * third};
    }
  };
  // For a unit of each modulus, and its derivative by each shape.
  struct UnitStress {
    Stress values;
    std::vector<Stress> slopes;
  };
  // For a law of this form, with its shapes as in HyperelasticLaw; no slopes unless they are asked for.
  UnitStress unit_stress(HyperelasticForm form, const Eigen::VectorXd& shapes,
                         bool with_slopes) const;

  // Nominal stress at the points of the history (rows) of S itself, and of H with one time.
  Eigen::MatrixXd instantaneous(const Stress& stress) const;
  // The nominal stress of H, Pa per unit of each column, and its derivative by ln tau.
  struct Relaxed {
    Eigen::MatrixXd values, by_ln_tau;  // points x columns
  };
  // Of one time tau_s; without the derivative unless with_slope.
  Relaxed relaxed(const Stress& stress, double tau_s, bool with_slope) const;

 private:
  double nominal(std::size_t step, double first, double third) const;

  Deformation deformation_ = Deformation::kUniaxial;
  std::vector<double> log_stretch_, dt_s_;  // of the steps; the first comes from rest
  std::vector<std::size_t> at_;             // step of each point of the history
};

// Nominal stress at each point of a history, Pa, by (2).
std::vector<double> nominal_stress_Pa(const HyperelasticLaw& law,
                                      const std::vector<RubberTerm>& terms, Deformation deformation,
                                      const Course& history);

}  // namespace viscard
