// Values of a solution, and loads.
#include "models/maths/dense.h"
#include "models/pillar/system/discrete_system.h"

#include <cmath>
#include <stdexcept>

namespace viscard {

Eigen::VectorXd DiscreteSystem::element_values(const SectionElement& element,
                                               const Eigen::VectorXd& solution) const {
  const std::vector<int> dofs = element_dofs(element);
  Eigen::VectorXd local = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs.size()));
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i] >= 0) local[static_cast<Eigen::Index>(i)] = solution[dofs[i]];
  }
  return local;
}

void DiscreteSystem::scatter(std::size_t element, const Eigen::VectorXd& local,
                             Eigen::VectorXd& vector) const {
  const auto& [dofs, place] = structure_->local[element];
  for (std::size_t i = 0; i < dofs.size(); ++i) vector[dofs[i]] += local[place[i]];
}

double DiscreteSystem::projected_divergence_at(const Eigen::VectorXd& solution,
                                               const SectionElement& element, double x,
                                               double z) const {
  const Projection p = projection(element);
  const Eigen::VectorXd local = element_values(element, solution);
  const Eigen::VectorXd coefficient =
      SymmetricFactor(p.mass).solve(Eigen::VectorXd(p.divergence * local));
  return pressure_basis_at(element, x, z).dot(coefficient);
}

Eigen::VectorXd DiscreteSystem::line_load(int field, int break_row, int first_column,
                                          int last_column, int power) const {
  const int p = section_->degree();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size());
  const double z = section_->z().breaks()[static_cast<std::size_t>(break_row)];
  for (int column = first_column; column < last_column; ++column) {
    // At a bond both sides have the same width, so the stretch of either region is correct.
    const int below = section_->region(column, break_row - 1);
    const int region = below != Section::kEmpty ? below : section_->region(column, break_row);
    const int x_power = kinematics_.x_power + power;
    const double scale = std::pow(section_->stretch_at(region, z).scale, x_power + 1);
    const Eigen::MatrixXd mass = scale * section_->x().integral(column, x_power, 0, 0);
    for (int i = 0; i <= p; ++i) {
      const int node = section_->node(column * p + i, break_row * p);
      if (node < 0) throw std::invalid_argument("a load acts where there is no material");
      const int dof = dofs_.dof(field, node);
      if (dof >= 0) load[dof] += kinematics_.measure * mass.row(i).sum();
    }
  }
  return load;
}

}  // namespace viscard
