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
        const std::vector<Eigen::Matrix4d> responses = film.at(k_1_m);
        const auto last = static_cast<double>(responses.size() - 1);
        for (std::size_t j = 0; j < responses.size(); ++j) {
          const bool is_end = j == 0 || j + 1 == responses.size();
          const double share = (is_end ? 0.5 : 1.0) / last;
          const double angle = 0.5 * std::numbers::pi * static_cast<double>(j) / last;
          Eigen::Vector3d along(1.0, 1.0, 1.0);
          if (!foot.is_axial)
            along << 2.0 * std::cos(angle), -2.0 * std::sin(angle), 2.0 * std::cos(angle);
          const Eigen::MatrixXd turned = along.asDiagonal() * waves;
          compliance +=
              share * weight * turned.transpose() * responses[j].topLeftCorner<3, 3>() * turned;
        }
      });
  return compliance;
}

}  // namespace

FootOnFilm::FootOnFilm(const FilmTable& film, const FootTrace& foot,
                       const Eigen::MatrixXd& stiffness)
    : unknowns_(foot.unknowns), yields_(stiffness * film_compliance(film, foot)) {
  yields_.diagonal().array() += 1.0;
}

void FootOnFilm::correct(Eigen::VectorXd& base_forces) const {
  Eigen::VectorXd of_foot(static_cast<Eigen::Index>(unknowns_.size()));
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    of_foot[static_cast<Eigen::Index>(i)] = base_forces[unknowns_[i].dof];
  }
  of_foot = LuFactor(yields_).solve(of_foot);
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    base_forces[unknowns_[i].dof] = of_foot[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace viscard
