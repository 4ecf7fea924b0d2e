// What is read from a solution, and loads; the matrices are in discrete_system.cpp.
#include "models/pillar/discrete_system.h"

#include <Eigen/Cholesky>

#include <stdexcept>

namespace viscard {

double DiscreteSystem::projected_divergence_at(const Eigen::VectorXd& solution,
                                               const SectionElement& element, double x,
                                               double z) const {
  const Projection p = projection(element);
  const std::vector<int> dofs = element_dofs(element);
  Eigen::VectorXd local = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs.size()));
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i] >= 0) local[static_cast<Eigen::Index>(i)] = solution[dofs[i]];
  }
  const Eigen::VectorXd coefficient = p.mass.ldlt().solve(p.divergence * local);
  const auto along = [&](const LineMesh& line, int e, double at) {
    return legendre_values(p.degree,
                           {(at - line.breaks()[static_cast<std::size_t>(e)]) / line.length(e)});
  };
  const Eigen::MatrixXd in_x = along(section_->x(), element.column, x);
  const Eigen::MatrixXd in_z = along(section_->z(), element.row, z);
  double value = 0.0;
  for (Eigen::Index kz = 0; kz <= p.degree; ++kz) {
    for (Eigen::Index kx = 0; kx <= p.degree; ++kx) {
      value += coefficient[kz * (p.degree + 1) + kx] * in_z(0, kz) * in_x(0, kx);
    }
  }
  return value;
}

Eigen::VectorXd DiscreteSystem::line_load(int field, int break_row, int first_column,
                                          int last_column) const {
  const int p = section_->degree();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size());
  for (int column = first_column; column < last_column; ++column) {
    const Eigen::MatrixXd mass = section_->x().integral(column, kinematics_.x_power, 0, 0);
    for (int i = 0; i <= p; ++i) {
      const int node = section_->node(column * p + i, break_row * p);
      if (node < 0) throw std::invalid_argument("a load acts where there is no material");
      const int dof = dofs_.dof(field, node);
      if (dof >= 0) load[dof] += kinematics_.measure * mass.row(i).sum();
    }
  }
  return load;
}

Eigen::VectorXd DiscreteSystem::field_values(int field, const Eigen::VectorXd& solution) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(section_->node_count());
  for (int node = 0; node < section_->node_count(); ++node) {
    const int dof = dofs_.dof(field, node);
    if (dof >= 0) values[node] = solution[dof];
  }
  return values;
}

Eigen::VectorXd DiscreteSystem::rows_at(const std::vector<OperatorRow>& rows,
                                        const Eigen::VectorXd& solution,
                                        const SectionElement& element, double x, double z) const {
  const BasisValues in_x = section_->x().basis_at(element.column, x);
  const BasisValues in_z = section_->z().basis_at(element.row, z);
  const Eigen::Index n1 = section_->degree() + 1;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const OperatorTerm& t : rows[r]) {
      const Eigen::MatrixXd& bx = t.dx == 0 ? in_x.value : in_x.derivative;
      const Eigen::MatrixXd& bz = t.dz == 0 ? in_z.value : in_z.derivative;
      double sum = 0.0;
      for (Eigen::Index iz = 0; iz < n1; ++iz) {
        for (Eigen::Index ix = 0; ix < n1; ++ix) {
          const int dof = dofs_.dof(t.field, element.nodes[static_cast<std::size_t>(iz * n1 + ix)]);
          if (dof >= 0) sum += bz(0, iz) * bx(0, ix) * solution[dof];
        }
      }
      values[static_cast<Eigen::Index>(r)] += t.factor * (t.inverse_x == 1 ? 1.0 / x : 1.0) * sum;
    }
  }
  return values;
}

}  // namespace viscard
