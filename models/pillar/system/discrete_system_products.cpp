// Forms applied to a vector, without their matrices: from the strains at the points of quadrature. A matrix
// squares what its entries cancel; the strains of a motion that is nearly rigid keep their digits.
#include "models/maths/dense.h"
#include "models/pillar/system/discrete_system.h"

#include <algorithm>
#include <array>

namespace viscard {
namespace {

// A field of an element (nodes along x down, along z across) at its points of quadrature: the value, d/dx
// and d/dz. Derivatives do not see the constant that is taken off first.
using FieldAtPoints = std::array<Eigen::MatrixXd, 3>;

int kind_of(const OperatorTerm& term) {
  return term.dx == 1 ? 1 : term.dz == 1 ? 2 : 0;
}

// Bases of one element on its rectangle of points.
struct RectanglePoints {
  LineMesh::ElementRule x, z;

  FieldAtPoints of(const Eigen::MatrixXd& nodes) const {
    const Eigen::MatrixXd change = nodes.array() - nodes(0, 0);
    return {x.value * nodes * z.value.transpose(), x.derivative * change * z.value.transpose(),
            x.value * change * z.derivative.transpose()};
  }
  // The transposed map.
  Eigen::MatrixXd to_nodes(const FieldAtPoints& forces) const {
    return (x.value.transpose() * forces[0] + x.derivative.transpose() * forces[1]) * z.value +
           x.value.transpose() * forces[2] * z.derivative;
  }
};

// sum_ij D_ij int row_i(v) row_j(u) for all nodal values v of one element, u = local.
Eigen::VectorXd product_on_rectangle(const RectanglePoints& at, const Kinematics& kinematics,
                                     const std::vector<OperatorRow>& rows, const Eigen::MatrixXd& D,
                                     const Eigen::VectorXd& local) {
  const Eigen::Index n1 = at.x.value.cols(), nx = at.x.x.size(), nz = at.z.x.size();
  const auto fields = static_cast<std::size_t>(kinematics.field_count);
  std::vector<FieldAtPoints> values, forces(fields);
  for (std::size_t f = 0; f < fields; ++f) {
    values.push_back(
        at.of(local.segment(static_cast<Eigen::Index>(f) * n1 * n1, n1 * n1).reshaped(n1, n1)));
    forces[f].fill(Eigen::MatrixXd::Zero(nx, nz));
  }
  const Eigen::VectorXd inverse_x = at.x.x.cwiseInverse();
  const auto n_rows = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd strain = Eigen::MatrixXd::Zero(nx * nz, n_rows);
  for (Eigen::Index r = 0; r < n_rows; ++r) {
    auto of_row = strain.col(r).reshaped(nx, nz);
    for (const OperatorTerm& t : rows[static_cast<std::size_t>(r)]) {
      const Eigen::MatrixXd& value =
          values[static_cast<std::size_t>(t.field)][static_cast<std::size_t>(kind_of(t))];
      if (t.inverse_x == 1) {
        of_row += t.factor * (inverse_x.asDiagonal() * value);
      } else {
        of_row += t.factor * value;
      }
    }
  }
  Eigen::VectorXd weight_x = kinematics.measure * at.x.weight;
  if (kinematics.x_power == 1) weight_x = weight_x.cwiseProduct(at.x.x);
  Eigen::MatrixXd stress = strain * D;
  for (Eigen::Index r = 0; r < n_rows; ++r) {
    stress.col(r).reshaped(nx, nz).array() *= (weight_x * at.z.weight.transpose()).array();
    const auto of_row = stress.col(r).reshaped(nx, nz);
    for (const OperatorTerm& t : rows[static_cast<std::size_t>(r)]) {
      Eigen::MatrixXd& force =
          forces[static_cast<std::size_t>(t.field)][static_cast<std::size_t>(kind_of(t))];
      if (t.inverse_x == 1) {
        force += t.factor * (inverse_x.asDiagonal() * of_row);
      } else {
        force += t.factor * of_row;
      }
    }
  }
  Eigen::VectorXd product(local.size());
  for (std::size_t f = 0; f < fields; ++f) {
    product.segment(static_cast<Eigen::Index>(f) * n1 * n1, n1 * n1) =
        at.to_nodes(forces[f]).reshaped();
  }
  return product;
}

}  // namespace

Eigen::VectorXd DiscreteSystem::form_times(const std::vector<OperatorRow>& rows,
                                           const std::vector<Eigen::MatrixXd>& per_region,
                                           const Eigen::VectorXd& solution) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  for (std::size_t e = 0; e < section_->elements().size(); ++e) {
    const SectionElement& element = section_->elements()[e];
    const Eigen::MatrixXd& D = per_region[static_cast<std::size_t>(element.region)];
    if (D.size() == 0) continue;
    const Eigen::VectorXd local = element_values(element, solution);
    if (section_->is_stretched(element.region)) {
      const auto everywhere = [&](double, double) { return D; };
      scatter(e, Eigen::VectorXd(quadrature_form(rows, element, everywhere) * local), result);
      continue;
    }
    const RectanglePoints at{section_->x().rule(element.column), section_->z().rule(element.row)};
    scatter(e, product_on_rectangle(at, kinematics_, rows, D, local), result);
  }
  return result;
}

Eigen::VectorXd DiscreteSystem::volume_form_times(const std::vector<double>& per_region,
                                                  bool projected,
                                                  const Eigen::VectorXd& solution) const {
  if (!projected) {
    std::vector<Eigen::MatrixXd> D;
    for (const double factor : per_region) D.push_back(Eigen::MatrixXd::Constant(1, 1, factor));
    return form_times({kinematics_.divergence}, D, solution);
  }
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  for (std::size_t e = 0; e < section_->elements().size(); ++e) {
    const SectionElement& element = section_->elements()[e];
    const double factor =
        per_region.at(static_cast<std::size_t>(element.region)) * kinematics_.measure;
    if (factor == 0.0) continue;
    const Projection p = projection(element);
    const Eigen::VectorXd pressure = SymmetricFactor(p.mass).solve(
        Eigen::VectorXd(p.divergence * element_values(element, solution)));
    scatter(e, Eigen::VectorXd(factor * (p.divergence.transpose() * pressure)), result);
  }
  return result;
}

}  // namespace viscard
