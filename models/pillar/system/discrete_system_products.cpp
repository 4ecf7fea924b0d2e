// Forms applied to a vector, without their matrices.
#include "models/maths/dense.h"
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/kronecker_form.h"

namespace viscard {

Eigen::VectorXd DiscreteSystem::form_times(const std::vector<OperatorRow>& rows,
                                           const std::vector<Eigen::MatrixXd>& per_region,
                                           const Eigen::VectorXd& solution) const {
  using Nodal = Eigen::Map<const Eigen::MatrixXd>;
  const Eigen::Index n1 = section_->degree() + 1;
  const Eigen::Index nn = n1 * n1;
  const KroneckerForm products(*section_, kinematics_, rows, per_region);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  for (std::size_t e = 0; e < section_->elements().size(); ++e) {
    const SectionElement& element = section_->elements()[e];
    if (products.is_empty(element.region)) continue;
    const Eigen::VectorXd local = element_values(element, solution);
    if (section_->is_stretched(element.region)) {
      const Eigen::MatrixXd& D = per_region[static_cast<std::size_t>(element.region)];
      const auto everywhere = [&](double, double) { return D; };
      scatter(e, Eigen::VectorXd(quadrature_form(rows, element, everywhere) * local), result);
      continue;
    }
    Eigen::VectorXd product = Eigen::VectorXd::Zero(local.size());
    // (z (x) x) v = x V z', where V holds the nodal values of a field with x along its columns.
    products.each(element, [&](int f, int g, const Eigen::MatrixXd& z, const Eigen::MatrixXd& x) {
      const Nodal at_f(local.data() + f * nn, n1, n1), at_g(local.data() + g * nn, n1, n1);
      Eigen::Map<Eigen::MatrixXd> to_f(product.data() + f * nn, n1, n1);
      to_f += x * at_g * z.transpose();
      if (f == g) return;
      Eigen::Map<Eigen::MatrixXd> to_g(product.data() + g * nn, n1, n1);
      to_g += x.transpose() * at_f * z;
    });
    scatter(e, product, result);
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
