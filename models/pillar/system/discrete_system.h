#pragma once

#include "models/pillar/mesh/section.h"
#include "models/pillar/system/dof_map.h"
#include "models/pillar/system/kinematics.h"

#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <vector>

namespace viscard {

// Symmetric; only the lower triangle is stored.
using SymmetricSparse = Eigen::SparseMatrix<double>;

// Quadratic forms over a section (eq. 13):
//   sum_ij D_ij int row_i(u) row_j(v) measure x^x_power dx dz,
// assembled element by element from Kronecker products of one-dimensional matrices. All matrices of
// one system share one sparsity pattern, so their stored values may be added directly.
class DiscreteSystem {
 public:
  // The section must outlive the system.
  DiscreteSystem(const Section& section, Kinematics kinematics, DofMap dofs);
  // On a section that differs from that of `like` only in the places of its nodes.
  DiscreteSystem(const Section& section, Kinematics kinematics, const DiscreteSystem& like);

  const Section& section() const { return *section_; }
  const Kinematics& kinematics() const { return kinematics_; }
  const DofMap& dofs() const { return dofs_; }
  int size() const { return dofs_.count(); }

  // One square matrix D per region, rows.size() wide and symmetric; an empty one skips the region.
  SymmetricSparse form(const std::vector<OperatorRow>& rows,
                       const std::vector<Eigen::MatrixXd>& per_region) const;

  // factor * int (div u)(div v) with the factor of each region in per_region (a modulus, Pa). With a
  // projection, div u enters as its L2 projection on discontinuous Q_(p-2); this is a pressure of that
  // space, condensed per element (eq. 14). Degree 1 projects on constants.
  // Source: Stenberg & Suri, Math. Comp. 65 (1996) 1.
  SymmetricSparse volume_form(const std::vector<double>& per_region, bool projected) const;

  // form() applied to a vector, element by element without the matrix.
  Eigen::VectorXd form_times(const std::vector<OperatorRow>& rows,
                             const std::vector<Eigen::MatrixXd>& per_region,
                             const Eigen::VectorXd& solution) const;
  // volume_form() applied to a vector; the factor of each region in per_region, Pa.
  Eigen::VectorXd volume_form_times(const std::vector<double>& per_region, bool projected,
                                    const Eigen::VectorXd& solution) const;

  // int value(field) over the part of the horizontal line z = breaks[row] between the columns
  // [first, last), weighted with x^power: force per unit traction, m^2, for power = 0.
  Eigen::VectorXd line_load(int field, int break_row, int first_column, int last_column,
                            int power = 0) const;

  // rows(u) at one point (x, z) of the body, which must lie in the element.
  Eigen::VectorXd rows_at(const std::vector<OperatorRow>& rows, const Eigen::VectorXd& solution,
                          const SectionElement& element, double x, double z) const;

  // The projected div u (eq. 14) at a point of an element.
  double projected_divergence_at(const Eigen::VectorXd& solution, const SectionElement& element,
                                 double x, double z) const;

  // A form whose matrix D(element, x, z) varies within the elements, by full quadrature; of those elements
  // that `counts` names, unless it is empty.
  SymmetricSparse varying_form(
      const std::vector<OperatorRow>& rows,
      const std::function<Eigen::MatrixXd(const SectionElement&, double, double)>& D,
      const std::function<bool(const SectionElement&)>& counts = {}) const;

  // Unknowns of one element, field slowest: field_count * (p + 1)^2, -1 where held.
  std::vector<int> element_dofs(const SectionElement& element) const;
  SymmetricSparse zero() const;

  // Operator rows at the quadrature points of an element, for forms that are not quadratic.
  struct ElementRows {
    Eigen::MatrixXd B;  // of point k: rows k n to (k + 1) n - 1, with n rows; element_dofs() wide
    Eigen::VectorXd weight;  // of each point, with measure x^x_power dx dz
    // Legendre products of Q_(p-2), the pressures of eq. 14: points x (p - 1)^2.
    Eigen::MatrixXd pressure;
  };
  // Of the given rows on one element.
  ElementRows element_rows(const std::vector<OperatorRow>& rows,
                           const SectionElement& element) const;
  // Those Legendre products at a point (x, z) of an element.
  Eigen::RowVectorXd pressure_basis_at(const SectionElement& element, double x, double z) const;
  // Values on element_dofs(), 0 where held.
  Eigen::VectorXd element_values(const SectionElement& element,
                                 const Eigen::VectorXd& solution) const;
  // Adds the vector of an element (number in section().elements()) to one of this system.
  void scatter(std::size_t element, const Eigen::VectorXd& local, Eigen::VectorXd& vector) const;
  // Adds an element matrix to a matrix of this system; only its lower triangle is read.
  void scatter(std::size_t element, const Eigen::MatrixXd& local, SymmetricSparse& matrix) const;

 private:
  // int L (div N) and int L L of one element, L the Legendre products of Q_(p-2).
  struct Projection {
    int degree = 0;
    Eigen::MatrixXd divergence;
    Eigen::MatrixXd mass;
  };
  Projection projection(const SectionElement& element) const;
  Projection stretched_projection(const SectionElement& element) const;
  Eigen::MatrixXd quadrature_form(
      const std::vector<OperatorRow>& rows, const SectionElement& element,
      const std::function<Eigen::MatrixXd(double x, double z)>& D) const;

  const Section* section_;
  Kinematics kinematics_;
  DofMap dofs_;
  // Unknowns of an element that are not held, ascending (tied ones appear several times), and the
  // local number of each, which is its index in element_dofs().
  struct LocalOrder {
    std::vector<int> dofs;
    std::vector<int> local;
  };
  struct Structure {
    std::vector<int> column_start;  // the pattern of all matrices, as they store it
    std::vector<int> row;
    std::vector<LocalOrder> local;
  };
  void order_elements(Structure& structure) const;
  void build_pattern(Structure& structure) const;
  std::shared_ptr<const Structure>
      structure_;  // systems that differ in the places of nodes share it
};

}  // namespace viscard
