#pragma once

#include "models/array/plane/array_scene.h"

#include <string>
#include <utility>
#include <vector>

namespace viscard {

// How the pillars of a row move in one mode.
struct RowShape {
  std::string family;
  int cluster = 1;  // number, from 1, of the single pillar's mode in its family
  Eigen::VectorXd
      top;  // mean motion of each top, along x if lateral, else along z; the largest is 1
  // Motion of the outline's places (rows: x, then z, of one after the other) by pillar; the largest
  // is 1. The base, which moves with the film, is at rest: each is the sum of modes on a fixed base
  // that has the least kinetic energy of what is missing.
  Eigen::MatrixXd outline;
};

// The modes of a row, in the order of the answer.
struct RowShapes {
  ArrayGeometry geometry;
  bool are_coupled = true;  // false: equal frequencies, and any mixture of a cluster is a mode
  std::vector<std::pair<double, double>> outline_m;  // of a pillar at rest around x = 0
  std::vector<RowShape> modes;
};

// Of a scene whose drive is RowModal, without the plan; solved anew on that mesh.
RowShapes row_shapes(const ArrayScene& scene, const Discretisation& mesh);

}  // namespace viscard
