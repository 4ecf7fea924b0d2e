#pragma once

#include "models/array/plane/array_geometry.h"
#include "models/pillar/system/medium.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace viscard {

// The materials of a row of pillars. Plane stress or plane strain; 1 m thick across the plane.
struct ArrayMedia {
  Medium pillar;
  Medium film;  // with a permittivity, the potential is an unknown too, coupled both ways (eq. 20)
  PlaneState plane = PlaneState::kStress;
};

// Ports (plane_system.h) of a pillar, in order: 1 Pa of pressure on its top, 1 Pa of shear along +x
// there, then those of PillarPorts.
constexpr int kPressurePort = 0;
constexpr int kShearPort = 1;
constexpr int kFirstModePort = 2;

// More ports of a pillar. Either the inertia of shapes on a fixed base (eq. A2), of unit mass norm:
// its lowest modes, or waves, which are the shapes that a load on the top and motions of the base
// excite, by weight. Or tractions on its top that vary as Legendre polynomials P_1 to P_top_degree of
// 2 x/d: pressures of all degrees, then shears (eq. A7).
struct PillarPorts {
  int modes = 0;
  int waves = 0;  // more than 0: instead of modes
  int load_port = kPressurePort;
  int top_degree = 0;  // more than 0: instead of shapes
};
// The port of a traction of that degree on the top.
constexpr int traction_port(int load_port, int degree, int top_degree) {
  if (degree == 0) return load_port;
  return kFirstModePort + (load_port == kShearPort ? top_degree : 0) + degree - 1;
}

// One pillar condensed to the nodes of its base: matrix on [base, ports].
struct CondensedPillar {
  Eigen::MatrixXd matrix;
  int base_size = 0;
  Eigen::VectorXd mode_rad_s;         // angular frequencies of the modes on a fixed base, ascending
  std::vector<bool> mode_is_lateral;  // sideways; the others move along the axis
  // Places along the free outline, from the left end of the base over the top to the right end, and
  // the motion there (x, then z, of one place after the other) in each mode of unit mass norm.
  std::vector<std::pair<double, double>> outline_m;
  Eigen::MatrixXd mode_on_outline;
  int shapes = 0;    // with a port for their inertia
  int unknowns = 0;  // before condensation

  int port_count() const { return static_cast<int>(matrix.rows()) - base_size; }
  // F' K^-1 F of the pillar on a fixed base.
  Eigen::MatrixXd fixed_base_compliance() const {
    return -matrix.bottomRightCorner(port_count(), port_count());
  }
};
// `modes`: how many get ports; 0 for statics. At nu = 0.5 in plane strain the bulk modulus is 1e6
// shear moduli, which moves answers by about 1e-6. Throws std::runtime_error without convergence.
CondensedPillar condensed_pillar(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                                 const PillarPorts& extra = {});

// Mean of the film's potential over [from, to] on the ungrounded face, or its value at from = to.
struct PotentialReading {
  double from_m = 0.0;
  double to_m = 0.0;
};

// A length of film, perhaps with a pillar on it, condensed to its two vertical ends: matrix on
// [left end, right end, ports]. Ports are the pillar's, then the readings in V per unit (a film
// without permittivity has none), then, for an equipotential electrode, its voltage in V, whose
// load is minus the charge in C.
struct CondensedPiece {
  Eigen::MatrixXd matrix;
  int end_size = 0;
  std::vector<bool> end_is_across;  // of the unknowns of an end: displacement along x?
  // For both ends: unknowns that the piece does not have, because its electrode reaches the end and
  // its single voltage is a port. Their rows are zero, and nothing can be joined there.
  std::vector<bool> end_is_bare;
  int unknowns = 0;

  int port_count() const { return static_cast<int>(matrix.rows()) - 2 * end_size; }
};

// A length of film before it is condensed.
struct FilmPiece {
  CellMesh mesh;  // without a pillar the columns of the pillar have no meaning
  std::vector<PotentialReading> readings;
  const CondensedPillar* pillar = nullptr;
  double electrode_half_width_m = 0.0;  // of an equipotential electrode around x = 0; 0: none
};
// The piece condensed with elements of that degree; one face of the film is grounded.
CondensedPiece condensed_film(const FilmPiece& piece, const ArrayMesh& mesh,
                              const ArrayMedia& media, FilmFace grounded, int degree);
// The piece mirrored across x. Its ports must be symmetric, as readings of the potential are.
CondensedPiece mirrored(const CondensedPiece& piece);
// The piece with its port `port` held at a reading of 0, such as an electrode at 0 V. This port
// then reads the load that holds it; the other ports keep their meaning. (One sweep of Gauss and
// Jordan, or principal pivot transform: Tsatsomeros, Linear Algebra Appl. 307 (2000) 151.)
CondensedPiece with_port_held(const CondensedPiece& piece, int port);

}  // namespace viscard
