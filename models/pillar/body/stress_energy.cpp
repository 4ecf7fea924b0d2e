#include "models/pillar/body/stress_energy.h"

namespace viscard {

Eigen::MatrixXd gradient_form(const Eigen::VectorXd& s) {
  Eigen::Matrix3d stress;
  stress << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(9, 9);
  for (Eigen::Index k = 0; k < 3; ++k) form.block<3, 3>(3 * k, 3 * k) = stress;
  return form;
}

StressEnergy::StressEnergy(const PillarModel& axial)
    : axial_(axial), state_(axial.solve(-axial.top_traction())) {}

// By the quadrature of DiscreteSystem::varying_form().
double StressEnergy::per_Pa(const PillarModel& model, const Eigen::VectorXd& motion) const {
  const DiscreteSystem& system = model.system();
  const Section& section = system.section();
  const Kinematics& kinematics = system.kinematics();
  double sum = 0.0;
  for (const SectionElement& element : section.elements()) {
    const LineMesh::ElementRule in_x = section.x().rule(element.column);
    const LineMesh::ElementRule in_z = section.z().rule(element.row);
    for (Eigen::Index kz = 0; kz < in_z.x.size(); ++kz) {
      const double z = in_z.x[kz];
      const double scale = section.stretch_at(element.region, z).scale;
      for (Eigen::Index kx = 0; kx < in_x.x.size(); ++kx) {
        const double x = scale * in_x.x[kx];
        const Eigen::VectorXd gradient = system.rows_at(kinematics.gradient, motion, element, x, z);
        const Eigen::MatrixXd stress = gradient_form(axial_.stress_at(state_, element, x, z));
        const double weight =
            in_x.weight[kx] * in_z.weight[kz] * scale * (kinematics.x_power == 1 ? x : 1.0);
        sum += weight * gradient.dot(stress * gradient);
      }
    }
  }
  return kinematics.measure * sum;
}

}  // namespace viscard
