#pragma once

#include "models/pillar/system/stiffness_factor.h"
#include "models/pillar/time/model_reduction.h"

#include <Eigen/Core>

#include <complex>

namespace viscard {

// The lower triangle of a full symmetric matrix, with its zeros.
SymmetricSparse full_lower(const Eigen::MatrixXd& matrix);

// The growing span of a ReducedBody, with the product of every matrix of the body and the basis. Vectors
// are orthonormal in the energy of the instantaneous stiffness. The rigid motions of a body that nothing
// holds come first; its energy has a multiple of the mass added, so that all other vectors move no mass
// as a whole, and rigid and elastic motions are not coupled.
class ReducedSpan {
 public:
  // The body must outlive the span.
  explicit ReducedSpan(const ViscoelasticSystem& body);
  ReducedSpan(const ReducedSpan&) = delete;  // its factor refers to it
  ReducedSpan& operator=(const ReducedSpan&) = delete;

  // Factors the body's stiffness at relative moduli.
  void factor(double shear, double bulk, StiffnessFactor& factored) const;
  const StiffnessFactor& instantaneous() const { return instantaneous_; }
  Eigen::Index rigid_count() const { return body_.rigid.cols(); }
  // The part of a load that does not accelerate the body as a whole: f - M R (R'MR)^-1 R'f.
  Eigen::VectorXd balanced(const Eigen::VectorXd& load) const;
  Eigen::Index count() const { return basis_.cols(); }
  const Eigen::MatrixXd& basis() const { return basis_; }
  bool has_mass() const { return body_.mass.size() > 0; }

  // Adds the component of v orthogonal to the basis; returns false if it is zero to rounding.
  bool add(Eigen::VectorXd v);

  // The products of the matrices with the basis.
  const Eigen::MatrixXd& elastic_image() const { return elastic_; }
  const Eigen::MatrixXd& shear_image() const { return shear_; }
  const Eigen::MatrixXd& bulk_image() const { return bulk_; }

  // The part of v in the span, in the inner product of the energy.
  Eigen::VectorXd projected(const Eigen::VectorXd& v) const;

  // basis' (elastic + shear S + bulk B - omega^2 M) basis.
  Eigen::MatrixXcd restricted(std::complex<double> shear, std::complex<double> bulk,
                              std::complex<double> omega2) const;
  // (elastic + shear S + bulk B - omega^2 M) basis c, without forming the sum.
  Eigen::VectorXcd image_of(std::complex<double> shear, std::complex<double> bulk,
                            std::complex<double> omega2, const Eigen::VectorXcd& c) const;
  // basis' times the mass, shear and bulk matrices times basis.
  const Eigen::MatrixXd& small_mass() const { return small_mass_; }
  const Eigen::MatrixXd& small_shear() const { return small_shear_; }
  const Eigen::MatrixXd& small_bulk() const { return small_bulk_; }

  // The pressures of an incompressible body balance most of a residual without moving anything. They are
  // removed first, so that the rest keeps its digits.
  Eigen::VectorXd without_pressures(Eigen::VectorXd residual) const;
  // Norm of a residual in the inverse of the instantaneous stiffness.
  double dual_norm(const Eigen::VectorXd& residual) const;

  ReducedBody reduced() const;

 private:
  // The products of the matrices with a vector.
  struct Images {
    Eigen::VectorXd elastic, shear, bulk, mass;
  };
  double energy_norm(const Eigen::VectorXd& v) const;
  Eigen::VectorXd keeping_volume(const Eigen::VectorXd& v) const;
  void append(const Eigen::VectorXd& v, const Images& images);
  void add_rigid_motions();
  Eigen::VectorXd elastic_times(const Eigen::VectorXd& v) const;

  const ViscoelasticSystem& body_;
  bool has_elastic_;   // false: the elastic matrix, that of a film, is zero
  double shift_1_s2_;  // multiple of the mass in the energy
  StiffnessFactor instantaneous_;
  Eigen::MatrixXd basis_, elastic_, shear_, bulk_, mass_;  // unknowns x count()
  Eigen::MatrixXd force_;  // their sum in the energy, times the basis
  // basis' times the matrices above, count() x count().
  Eigen::MatrixXd small_elastic_, small_shear_, small_bulk_, small_mass_;
};

}  // namespace viscard
