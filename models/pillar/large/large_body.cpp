#include "models/pillar/large/large_body.h"

#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Penalty at nu = 0.5 over the shear modulus: each augmentation leaves a thousandth of the change of
// volume, and six digits of the factorisation stay.
constexpr double kVolumePenalty = 1e3;

std::vector<Gradient5> gradients_of(const DiscreteSystem::ElementRows& at,
                                    const Eigen::VectorXd& local) {
  const Eigen::VectorXd all = at.B * local;
  std::vector<Gradient5> gradients;
  for (Eigen::Index k = 0; k < at.weight.size(); ++k) gradients.push_back(all.segment<5>(5 * k));
  return gradients;
}

// Coefficients of the projection of values at the points of an element on Q_(p-2).
Eigen::VectorXd projected(const DiscreteSystem::ElementRows& at, const Eigen::VectorXd& values) {
  const Eigen::MatrixXd weighted = at.weight.asDiagonal() * at.pressure;
  return SymmetricFactor(weighted.transpose() * at.pressure)
      .solve(Eigen::VectorXd(weighted.transpose() * values));
}

Eigen::VectorXd projected_change(const DiscreteSystem::ElementRows& at,
                                 const std::vector<Gradient5>& gradients) {
  Eigen::VectorXd change(at.weight.size());
  for (Eigen::Index k = 0; k < change.size(); ++k) {
    change[k] = volume_change(gradients[static_cast<std::size_t>(k)]);
  }
  return projected(at, change);
}

}  // namespace

LargeBody::LargeBody(const PillarModel& model, FiniteLaw law)
    : model_(&model), law_(std::move(law)) {
  if (model.options().motion != Motion::kLongitudinal || model.options().electrodes) {
    throw std::invalid_argument(
        "large strain is computed for round pillars along their axis, without a potential");
  }
  const std::vector<OperatorRow>& gradient = model.system().kinematics().gradient;
  rows_ = {gradient[0], gradient[2], gradient[4], gradient[6], gradient[8]};
  if (model.geometry().film) film_ = model.stiffness_of(kFilmRegion);
}

bool LargeBody::is_incompressible() const {
  return std::isinf(law_.bulk_Pa);
}

bool LargeBody::condenses() const {
  const bool is_split = law_.rubber.has_value();
  return is_split &&
         (is_incompressible() || law_.poisson_ratio >= model_->options().condense_pressures_from);
}

double LargeBody::bulk_Pa() const {
  return is_incompressible() ? kVolumePenalty * law_.shear_Pa : law_.bulk_Pa;
}

DiscreteSystem::ElementRows LargeBody::rows_of(std::size_t element) const {
  return model_->system().element_rows(rows_, model_->system().section().elements()[element]);
}

void LargeBody::add_condensed(std::size_t element, const DiscreteSystem::ElementRows& at,
                              const std::vector<Gradient5>& gradients, bool with_tangent,
                              const Eigen::VectorXd* own_pressure, Local& local) const {
  Eigen::VectorXd coefficients = bulk_Pa() * projected_change(at, gradients);
  if (!pressures_.empty()) coefficients += pressures_[element];
  const Eigen::VectorXd pressure = at.pressure * coefficients;
  const Eigen::VectorXd geometric =
      own_pressure == nullptr ? pressure : at.pressure * *own_pressure;
  Eigen::MatrixXd by_volume(at.weight.size(), at.B.cols());  // weight dJ/du
  Eigen::MatrixXd second(at.B.rows(), at.B.cols());
  for (Eigen::Index k = 0; k < at.weight.size(); ++k) {
    const GradientDerivatives J = volume_derivatives(gradients[static_cast<std::size_t>(k)]);
    const auto B = at.B.middleRows<5>(5 * k);
    by_volume.row(k) = at.weight[k] * J.stress.transpose() * B;
    if (with_tangent) second.middleRows<5>(5 * k) = at.weight[k] * geometric[k] * J.tangent * B;
  }
  local.force += by_volume.transpose() * pressure;
  if (!with_tangent) return;
  const Eigen::MatrixXd D = at.pressure.transpose() * by_volume;
  const Eigen::MatrixXd mass = at.pressure.transpose() * at.weight.asDiagonal() * at.pressure;
  local.tangent += at.B.transpose() * second;
  local.tangent += bulk_Pa() * D.transpose() * SymmetricFactor(mass).solve(D);
}

LargeBody::Local LargeBody::local_forces(std::size_t element, const Eigen::VectorXd& u,
                                         bool with_tangent, const Eigen::VectorXd* pressure) const {
  const DiscreteSystem& system = model_->system();
  const DiscreteSystem::ElementRows at = rows_of(element);
  const std::vector<Gradient5> gradients =
      gradients_of(at, system.element_values(system.section().elements()[element], u));
  const bool is_pointwise = law_.rubber && !condenses();
  Eigen::VectorXd stress(at.B.rows());
  Eigen::MatrixXd DB(with_tangent ? at.B.rows() : 0, at.B.cols());
  Local local;
  for (Eigen::Index k = 0; k < at.weight.size(); ++k) {
    const Gradient5& gradient = gradients[static_cast<std::size_t>(k)];
    GradientDerivatives w = shape_energy(law_, gradient);
    if (is_pointwise) {
      const GradientDerivatives J = volume_derivatives(gradient);
      const double pressure_Pa = law_.bulk_Pa * volume_change(gradient);
      w.stress += pressure_Pa * J.stress;
      w.tangent += pressure_Pa * J.tangent + law_.bulk_Pa * J.stress * J.stress.transpose();
    }
    local.is_finite = local.is_finite && w.stress.allFinite();
    stress.segment<5>(5 * k) = at.weight[k] * w.stress;
    if (with_tangent)
      DB.middleRows<5>(5 * k) = at.weight[k] * w.tangent * at.B.middleRows<5>(5 * k);
  }
  local.force = at.B.transpose() * stress;
  if (with_tangent) local.tangent = at.B.transpose() * DB;
  if (local.is_finite && condenses()) {
    add_condensed(element, at, gradients, with_tangent, pressure, local);
  }
  return local;
}

LargeBody::Forces LargeBody::forces(const Eigen::VectorXd& u, bool with_tangent) const {
  return forces(u, with_tangent, nullptr);
}

LargeBody::Forces LargeBody::forces_with(const Eigen::VectorXd& u,
                                         const Pressures& pressures) const {
  return forces(u, true, condenses() ? &pressures : nullptr);
}

LargeBody::Pressures LargeBody::pressures_after(const Eigen::VectorXd& u,
                                                const Eigen::VectorXd* du) const {
  const DiscreteSystem& system = model_->system();
  const std::vector<SectionElement>& elements = system.section().elements();
  Pressures out(elements.size());
  for (std::size_t e = 0; condenses() && e < elements.size(); ++e) {
    if (elements[e].region != kPillarRegion) continue;
    const DiscreteSystem::ElementRows at = rows_of(e);
    const std::vector<Gradient5> gradients =
        gradients_of(at, system.element_values(elements[e], u));
    Eigen::VectorXd change(at.weight.size());
    Eigen::VectorXd step = Eigen::VectorXd::Zero(at.B.rows());
    if (du != nullptr) step = at.B * system.element_values(elements[e], *du);
    for (Eigen::Index k = 0; k < change.size(); ++k) {
      const Gradient5& gradient = gradients[static_cast<std::size_t>(k)];
      change[k] =
          volume_change(gradient) + volume_derivatives(gradient).stress.dot(step.segment<5>(5 * k));
    }
    out[e] = bulk_Pa() * projected(at, change);
    if (!pressures_.empty()) out[e] += pressures_[e];
  }
  return out;
}

LargeBody::Forces LargeBody::forces(const Eigen::VectorXd& u, bool with_tangent,
                                    const Pressures* pressures) const {
  const DiscreteSystem& system = model_->system();
  Forces out{film_.size() > 0 ? times(film_, u) : Eigen::VectorXd::Zero(u.size()), {}};
  if (with_tangent) out.tangent = film_.size() > 0 ? film_ : system.zero();
  const std::vector<SectionElement>& elements = system.section().elements();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements[e].region != kPillarRegion) continue;
    const Eigen::VectorXd* pressure = pressures == nullptr ? nullptr : &(*pressures)[e];
    const Local local = local_forces(e, u, with_tangent, pressure);
    if (!local.is_finite) return {Eigen::VectorXd(), {}, false};
    system.scatter(e, local.force, out.internal);
    if (with_tangent) system.scatter(e, local.tangent, out.tangent);
  }
  return out;
}

double LargeBody::augment(const Eigen::VectorXd& u) {
  if (!is_incompressible()) return 0.0;
  const DiscreteSystem& system = model_->system();
  const std::vector<SectionElement>& elements = system.section().elements();
  const bool is_first = pressures_.empty();
  pressures_.resize(elements.size());
  double largest = 0.0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements[e].region != kPillarRegion) continue;
    const DiscreteSystem::ElementRows at = rows_of(e);
    const Eigen::VectorXd change =
        projected_change(at, gradients_of(at, system.element_values(elements[e], u)));
    largest = std::max(largest, (at.pressure * change).lpNorm<Eigen::Infinity>());
    if (is_first) pressures_[e] = Eigen::VectorXd::Zero(change.size());
    pressures_[e] += bulk_Pa() * change;
  }
  return largest;
}

Eigen::Vector4d LargeBody::true_stress_at_Pa(const Eigen::VectorXd& u,
                                             const SectionElement& element, double x,
                                             double z) const {
  const DiscreteSystem& system = model_->system();
  const Gradient5 gradient = system.rows_at(rows_, u, element, x, z);
  double pressure_Pa = law_.rubber ? bulk_Pa() * volume_change(gradient) : 0.0;
  if (condenses()) {
    const auto e = static_cast<std::size_t>(&element - system.section().elements().data());
    const DiscreteSystem::ElementRows at = rows_of(e);
    Eigen::VectorXd coefficients =
        bulk_Pa() * projected_change(at, gradients_of(at, system.element_values(element, u)));
    if (!pressures_.empty()) coefficients += pressures_[e];
    pressure_Pa = system.pressure_basis_at(element, x, z).dot(coefficients);
  }
  const Gradient5 nominal_Pa =
      shape_energy(law_, gradient).stress + pressure_Pa * volume_derivatives(gradient).stress;
  return true_stress_Pa(nominal_Pa, gradient);
}

// Virtual work -int (rho rho' d zeta - zeta' rho d rho) 2 pi dxi over the top, whose points are
// (rho, zeta) when deformed. Bonet & Wood (2008), eq. 8.22.
Eigen::VectorXd LargeBody::following_pressure(const Eigen::VectorXd& u) const {
  const DiscreteSystem& system = model_->system();
  const Section& section = system.section();
  const PillarMesh& mesh = model_->mesh();
  const int p = section.degree();
  const double top_m = section.z().breaks()[static_cast<std::size_t>(mesh.top_row)];
  const double scale = section.stretch_at(kPillarRegion, top_m).scale;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(system.size());
  for (int column = 0; column < mesh.pillar_columns; ++column) {
    const LineMesh::ElementRule rule = section.x().rule(column);
    Eigen::MatrixXd nodal = Eigen::MatrixXd::Zero(p + 1, 2);
    Eigen::MatrixXi dofs(p + 1, 2);
    for (int i = 0; i <= p; ++i) {
      const int node = section.node(column * p + i, mesh.top_row * p);
      for (int field = 0; field < 2; ++field) {
        dofs(i, field) = system.dofs().dof(field, node);
        if (dofs(i, field) >= 0) nodal(i, field) = u[dofs(i, field)];
      }
    }
    const Eigen::VectorXd rho = scale * rule.x + rule.value * nodal.col(0);
    const Eigen::VectorXd rho_slope = (rule.derivative * nodal.col(0)).array() + scale;
    const Eigen::VectorXd zeta_slope = rule.derivative * nodal.col(1);
    const Eigen::VectorXd w = system.kinematics().measure * rule.weight.cwiseProduct(rho);
    Eigen::MatrixXd local(p + 1, 2);
    local.col(0) = rule.value.transpose() * w.cwiseProduct(zeta_slope);
    local.col(1) = -rule.value.transpose() * w.cwiseProduct(rho_slope);
    for (int i = 0; i <= p; ++i) {
      for (int field = 0; field < 2; ++field) {
        if (dofs(i, field) >= 0) force[dofs(i, field)] += local(i, field);
      }
    }
  }
  return force;
}

}  // namespace viscard
