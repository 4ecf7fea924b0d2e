#pragma once

#include "models/array/film/film_table.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// An unknown of a pillar's foot: its field, its node among those of the foot, and its place among the
// unknowns of the pillar.
struct FootUnknown {
  int field = 0, node = 0, dof = 0;
};

// Converts forces on the nodes of a foot to equivalent forces at points of the foot
// (foot_forces.h).
struct FootTrace {
  std::vector<double> radius_m;  // of the points
  Eigen::MatrixXd from_nodes;    // points x nodes
  std::vector<FootUnknown> unknowns;
  bool is_axial = true;  // fields u_r, u_z of harmonic 0, or a, b, w of harmonic 1 (eq. 12)
};

// The foot of a pillar on a compliant film: R = R_rigid - S u with u = C R, where S is the
// stiffness of the pillar against motions of its foot and C the compliance of the film (eq. S11).
class FootOnFilm {
 public:
  FootOnFilm(const FilmTable& film, const FootTrace& foot, const Eigen::MatrixXd& stiffness);
  // Converts the forces of the pillar on a rigid base to those on the film.
  void correct(Eigen::VectorXd& base_forces) const;

 private:
  std::vector<int> dofs_;   // of the foot's unknowns
  Eigen::MatrixXd yields_;  // 1 + S C
};

}  // namespace viscard
