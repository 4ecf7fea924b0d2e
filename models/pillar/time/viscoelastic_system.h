#pragma once

#include "models/material/material.h"
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/stiffness_factor.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// Matrices of a body of one viscoelastic material, possibly joined to elastic ones:
//   force(t) = elastic u + int [G(t-s)/G_0 shear + K(t-s)/K_0 bulk] du(s)   (eq. 16)
// with the instantaneous moduli in `shear` (G_0) and `bulk` (K_0), all with one sparsity pattern.
struct ViscoelasticSystem {
  SymmetricSparse elastic;
  SymmetricSparse shear;
  SymmetricSparse bulk;  // an incompressible body: the volume form times a penalty modulus
  bool incompressible = false;
  SymmetricSparse mass;  // empty: quasi-static
  std::vector<MaterialTerm> terms;
  Eigen::VectorXd load;  // force vector of a unit load; load.u is the conjugate displacement
  // Rigid motions of a body that nothing holds, unknowns x motions; a reduced body's are its leading unknowns.
  Eigen::MatrixXd rigid;
  // The multiple of the mass that makes the stiffness of such a body regular.
  double free_shift_1_s2 = 0.0;
  // Products of `shear` and `bulk` that keep more digits than the entries; empty where these serve as well.
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> by_shear, by_bulk;
};

// shear u and bulk u.
Eigen::VectorXd shear_times(const ViscoelasticSystem& system, const Eigen::VectorXd& u);
Eigen::VectorXd bulk_times(const ViscoelasticSystem& system, const Eigen::VectorXd& u);

// elastic + shear_factor shear + bulk_factor bulk; an incompressible body's penalty keeps factor 1.
SymmetricSparse stiffness_at(const ViscoelasticSystem& system, double shear_factor,
                             double bulk_factor);
// Its product, with the bulk part of a source of pressures, where the entries keep too few digits; else
// empty. shear_factor, bulk_factor: plain numbers, as in stiffness_at(). The system must outlive it.
StiffnessFactor::Product product_at(const ViscoelasticSystem& system, double shear_factor,
                                    double bulk_factor);

// What a step prescribes.
enum class Control { kForce, kDisplacement };

// Steps the body with internal variables d_i = int exp(-(t-s)/tau_i) du(s). The recursion
//   d_i <- exp(-x) d_i + sum_m weight_m(x) (increment of step m), x = dt/tau_i   (eq. 17)
// integrates them exactly for any x if u is a polynomial through the last `order` + 1 points. Order
// 1 is the usual recursion for strain linear per step, exact for relaxation at constant Poisson
// ratio. For steps much longer than every tau_i it becomes the backward differentiation formula of
// that order. Sources: Taylor, Pister & Goudreau, IJNME 2 (1970) 45; Simo & Hughes, Computational
// Inelasticity (1998), ch. 10; Hairer & Wanner, Solving ODEs II (1996), V.1.
class ViscoelasticStepper {
 public:
  // The system must outlive the stepper.
  explicit ViscoelasticStepper(const ViscoelasticSystem& system, int order = 1);

  // A step of dt_s >= 0 to `value`, a multiple of the unit load or load.u; dt_s = 0 is
  // a jump. Factors the matrix again only if dt_s differs from that of the last step. Throws
  // std::invalid_argument if dt_s is negative or not finite.
  void advance(double dt_s, Control control, double value);

  // Drops the earlier points of the polynomial, because the rate of loading is about to jump.
  void start_anew() { earlier_s_.clear(); }

  double force() const { return force_; }  // multiple of load
  double displacement() const { return system_->load.dot(displacement_vector_); }  // load.u
  const Eigen::VectorXd& displacement_vector() const { return displacement_vector_; }
  int factorisations() const { return factorisations_; }

 private:
  void prepare(double dt_s);
  void remember(double dt_s, const Eigen::VectorXd& increment);

  const ViscoelasticSystem* system_;
  SymmetricSparse matrix_;
  StiffnessFactor factor_;
  int order_;
  std::vector<double> factored_s_;  // at the last factoring: the new step, and those before it
  std::vector<double> earlier_s_;   // lengths of earlier steps in use, latest first
  Eigen::MatrixXd increments_;      // unknowns x (order - 1): displacement increments of these
  Eigen::VectorXd decay_;           // exp(-x_i)
  Eigen::MatrixXd weights_;         // steps x terms
  Eigen::VectorXd g_, k_;           // relative moduli
  Eigen::VectorXd load_response_;   // matrix^-1 load
  Eigen::MatrixXd memory_;          // unknowns x terms, d_i
  Eigen::VectorXd displacement_vector_;
  double force_ = 0.0;
  int factorisations_ = 0;
};

}  // namespace viscard
