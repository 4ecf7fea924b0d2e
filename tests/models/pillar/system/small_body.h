#pragma once

// Bodies simple enough for closed forms: a rectangle of the meridian or plane section, with its
// edges held as the case needs.
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/medium.h"
#include "models/pillar/system/stiffness_factor.h"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace viscard::test {

using Where = std::function<bool(double x, double z)>;

inline Where x_is(double at) {
  return [at](double x, double) { return std::abs(x - at) < 1e-9 * (1.0 + std::abs(at)); };
}
inline Where z_is(double at) {
  return [at](double, double z) { return std::abs(z - at) < 1e-9 * (1.0 + std::abs(at)); };
}
inline Where everywhere() {
  return [](double, double) { return true; };
}

class SmallBody {
 public:
  SmallBody(Kinematics kinematics, std::vector<double> x, std::vector<double> z, int degree)
      : kinematics_(std::move(kinematics)),
        section_(LineMesh(std::move(x), degree), LineMesh(std::move(z), degree),
                 [](double, double) { return 0; }),
        dofs_(kinematics_.field_count, section_.node_count()) {}

  // Holds first, then ties, then done().
  void hold(int field, const Where& where) {
    for (const int node : nodes(where)) dofs_.fix(field, node);
  }
  int tie(int field, const Where& where) { return dofs_.tie(field, nodes(where)); }
  void done() {
    dofs_.number();
    system_ = std::make_unique<DiscreteSystem>(section_, kinematics_, dofs_);
  }

  const Section& section() const { return section_; }
  const DiscreteSystem& system() const { return *system_; }
  const Kinematics& kinematics() const { return kinematics_; }
  int tied_dof(int handle) const { return system_->dofs().tied_dof(handle); }

  SymmetricSparse stiffness(const Eigen::MatrixXd& form) const {
    std::vector<OperatorRow> rows = kinematics_.strain;
    rows.insert(rows.end(), kinematics_.electric_field.begin(), kinematics_.electric_field.end());
    return system_->form(rows, {form});
  }
  // Force per unit traction along `field` on the upper edge, or times weight(x).
  Eigen::VectorXd top_load(int field, const std::function<double(double)>& weight = {}) const {
    return edge_load(field, section_.x(), kinematics_.x_power, weight,
                     [this](int i) { return section_.node(i, section_.z().node_count() - 1); });
  }
  // The same on the edge at the smallest x.
  Eigen::VectorXd left_load(int field) const {
    const double x = section_.x().breaks().front();
    return std::pow(x, kinematics_.x_power) *
           edge_load(field, section_.z(), 0, {}, [this](int i) { return section_.node(0, i); });
  }
  double value_at(const Eigen::VectorXd& solution, int field, double x, double z) const {
    return system_->rows_at({{{field, 0, 0, 0, 1.0}}}, solution, element_at(x, z), x, z)[0];
  }
  const SectionElement& element_at(double x, double z) const {
    const int column = section_.x().element_at(x, true);
    const int row = section_.z().element_at(z, true);
    return section_
        .elements()[static_cast<std::size_t>(row * section_.x().element_count() + column)];
  }

 private:
  std::vector<int> nodes(const Where& where) const {
    std::vector<int> found;
    for (int node = 0; node < section_.node_count(); ++node) {
      if (where(section_.node_x(node), section_.node_z(node))) found.push_back(node);
    }
    return found;
  }
  Eigen::VectorXd edge_load(int field, const LineMesh& line, int power,
                            const std::function<double(double)>& weight,
                            const std::function<int(int)>& node_of) const {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(system_->size());
    for (int e = 0; e < line.element_count(); ++e) {
      const LineMesh::ElementRule rule = line.rule(e);
      for (Eigen::Index k = 0; k < rule.x.size(); ++k) {
        const double traction =
            rule.weight[k] * std::pow(rule.x[k], power) * (weight ? weight(rule.x[k]) : 1.0);
        for (int i = 0; i <= line.degree(); ++i) {
          const int dof = system_->dofs().dof(field, node_of(e * line.degree() + i));
          if (dof >= 0) load[dof] += kinematics_.measure * traction * rule.value(k, i);
        }
      }
    }
    return load;
  }

  Kinematics kinematics_;
  Section section_;
  DofMap dofs_;
  std::unique_ptr<DiscreteSystem> system_;
};

inline Eigen::VectorXd solve(const SymmetricSparse& matrix, const Eigen::VectorXd& load) {
  StiffnessFactor factor;
  factor.factor(matrix);
  return factor.solve(load);
}

}  // namespace viscard::test
