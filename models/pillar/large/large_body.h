#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/large/finite_law.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Internal forces of a pillar at large strain on the unknowns of a model, total Lagrangian:
//   int P : grad(delta u) dV = forces . delta u, dV at rest                                  (N2)
// with the nominal stress P of a FiniteLaw. Its film, if it has one, stays linear: it strains a
// thousandth as much. Source: Bonet & Wood (2008), ch. 8 and 9.
//
// From the Poisson ratio on at which the model condenses pressures (eq. 14) the volumetric part is
// (K/2) int (Q (J - 1))^2 dV with Q the L2 projection on discontinuous Q_(p-2), so that the pressure
// K Q (J - 1) is condensed in each element. At nu = 0.5, K is a penalty and the pressures are
// iterated (augment()). Source: Simo, Taylor & Pister, CMAME 51 (1985) 177.
class LargeBody {
 public:
  // The model, longitudinal and without a potential, must outlive the body. Throws
  // std::invalid_argument for another model.
  LargeBody(const PillarModel& model, FiniteLaw law);

  // At a displacement; is_finite is false where the law ends or an element is turned inside out.
  struct Forces {
    Eigen::VectorXd internal;
    SymmetricSparse tangent;  // the derivative of internal; empty unless it was asked for
    bool is_finite = true;
  };
  Forces forces(const Eigen::VectorXd& u, bool with_tangent) const;

  // Condensed pressures, coefficients of Q_(p-2) per element in Pa; empty entries where none are. As
  // unknowns of their own in Newton's method they stay moderate: where K is large, a step that
  // changes the volume by its square would make the K Q (J - 1) that belongs to it spoil the tangent.
  using Pressures = std::vector<Eigen::VectorXd>;
  Pressures pressures_at(const Eigen::VectorXd& u) const { return pressures_after(u, nullptr); }
  // Those that belong to u + du by the linear change of volume.
  Pressures pressures_after(const Eigen::VectorXd& u, const Eigen::VectorXd& du) const {
    return pressures_after(u, &du);
  }
  // The derivative of the forces when the geometric part has these pressures.
  Forces forces_with(const Eigen::VectorXd& u, const Pressures& pressures) const;

  // Moves the pressures of an incompressible body toward those of unit volume; returns the largest
  // projected change of volume that was left. 0 below nu = 0.5.
  double augment(const Eigen::VectorXd& u);
  bool is_incompressible() const;

  // True stress (Pa) of the pillar at a point of an element, which lies at (x, z) at rest: rr, tt,
  // zz, rz.
  Eigen::Vector4d true_stress_at_Pa(const Eigen::VectorXd& u, const SectionElement& element,
                                    double x, double z) const;

  // Force of a pressure of 1 Pa that stays normal to the deformed top; N.
  Eigen::VectorXd following_pressure(const Eigen::VectorXd& u) const;

  const PillarModel& model() const { return *model_; }
  const FiniteLaw& law() const { return law_; }

 private:
  bool condenses() const;
  double bulk_Pa() const;  // or the penalty
  struct Local {
    Eigen::VectorXd force;
    Eigen::MatrixXd tangent;
    bool is_finite = true;
  };
  Forces forces(const Eigen::VectorXd& u, bool with_tangent, const Pressures* pressures) const;
  Local local_forces(std::size_t element, const Eigen::VectorXd& u, bool with_tangent,
                     const Eigen::VectorXd* pressure) const;
  void add_condensed(std::size_t element, const DiscreteSystem::ElementRows& at,
                     const std::vector<Gradient5>& gradients, bool with_tangent,
                     const Eigen::VectorXd* pressure, Local& local) const;
  Pressures pressures_after(const Eigen::VectorXd& u, const Eigen::VectorXd* du) const;
  DiscreteSystem::ElementRows rows_of(std::size_t element) const;

  const PillarModel* model_;
  FiniteLaw law_;
  std::vector<OperatorRow> rows_;  // the five of Gradient5
  SymmetricSparse film_;           // stiffness of the film; empty without one
  Pressures pressures_;            // the iterated part; empty below nu = 0.5
};

}  // namespace viscard
