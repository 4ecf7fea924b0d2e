#include "models/array/space/foot_on_film.h"

#include "models/maths/dense.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Traction on the film, (tau_x, tau_y, t_z) of eq. S3, per unit force on each unknown of the foot; under
// sideways loads without the cosine and sine of the wave's angle.
Eigen::MatrixXd waves_of_forces(const FootTrace& foot, double k_1_m) {
  Eigen::MatrixXd J(3, static_cast<Eigen::Index>(foot.radius_m.size()));  // orders 0 to 2
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    const double x = k_1_m * foot.radius_m[static_cast<std::size_t>(i)];
    J.col(i) << ::j0(x), ::j1(x), ::jn(2, x);
  }
  const Eigen::MatrixXd of_nodes = J * foot.from_nodes;
  Eigen::MatrixXd waves = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(foot.unknowns.size()));
  for (std::size_t i = 0; i < foot.unknowns.size(); ++i) {
    const Eigen::Vector3d order = of_nodes.col(foot.unknowns[i].node);
    const int field = foot.unknowns[i].field;
    auto column = waves.col(static_cast<Eigen::Index>(i));
    if (foot.is_axial && field == 0) {
      column << -order[1], 0.0, 0.0;
    } else if (foot.is_axial) {
      column << 0.0, 0.0, order[0];
    } else if (field == 0) {
      column << -order[2], order[2], 0.0;
    } else if (field == 1) {
      column << order[0], order[0], 0.0;
    } else {
      column << 0.0, 0.0, order[1];
    }
  }
  return waves;
}

// Motion of the foot's unknowns on the film under forces on them (eq. S11).
Eigen::MatrixXd film_compliance(const FilmTable& film, const FootTrace& foot) {
  const auto count = static_cast<Eigen::Index>(foot.unknowns.size());
  Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(count, count);
  const double longest_1_m = 2.0 / foot.radius_m.back();
  each_graded_wave(
      film.smallest_k_1_m(), film.largest_k_1_m(), longest_1_m, [&](double k_1_m, double weight) {
        const Eigen::MatrixXd waves = waves_of_forces(foot, k_1_m);
        film.each_direction(k_1_m, [&](double angle, double share, const Eigen::Matrix4d& at) {
          Eigen::Vector3d along(1.0, 1.0, 1.0);
          if (!foot.is_axial)
            along << 2.0 * std::cos(angle), -2.0 * std::sin(angle), 2.0 * std::cos(angle);
          const Eigen::MatrixXd turned = along.asDiagonal() * waves;
          compliance += share * weight * turned.transpose() * at.topLeftCorner<3, 3>() * turned;
        });
      });
  return compliance;
}

}  // namespace

FootOnFilm::FootOnFilm(const FilmTable& film, const FootTrace& foot,
                       const Eigen::MatrixXd& stiffness)
    : yields_(stiffness * film_compliance(film, foot)) {
  for (const FootUnknown& one : foot.unknowns) dofs_.push_back(one.dof);
  yields_.diagonal().array() += 1.0;
}

void FootOnFilm::correct(Eigen::VectorXd& base_forces) const {
  const Eigen::VectorXd of_foot = base_forces(dofs_);
  base_forces(dofs_) = LuFactor(yields_).solve(of_foot);
}

}  // namespace viscard
