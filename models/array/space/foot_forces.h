#pragma once

#include "models/pillar/body/pillar_model.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace viscard {

class FilmTable;

// Loads on the top of a pillar, each 1 Pa: pressure down, shear along x or y, and a traction
// t_z = x/R or y/R that tilts it (R the radius of the top).
enum class TopLoad { kPressure, kShearX, kShearY, kTiltX, kTiltY };
constexpr int kTopLoads = 5;

// Forces that one pillar exerts on a rigid base, at points of its foot (N per Pa of load). They are
// those of the continuous traction that does the same work on every function of the mesh as the
// reactions of the base. Their work on smooth functions converges twice as fast as stresses do, and
// the singular rim needs no special treatment. The film is three orders stiffer than a pillar, so
// that a rigid base changes voltages by only about 1e-5 (eq. S3).
struct FootForces {
  std::vector<double> radius_m;
  // Forces on the circles of radius_m under pressure.
  struct Axial {  // under pressure: along r and z
    Eigen::VectorXd r, z;
  } pressure;
  // Forces on the circles of radius_m under sideways loads.
  struct Sideways {  // conjugate to the fields a, b, w of eq. 12
    Eigen::VectorXd a, b, w;
  } shear, tilt;
  // Motion of the top, m or rad per Pa: sinking under pressure; mean u_x and tilt about y under
  // shear and under the tilting traction. The top is treated as a plane with the same mean motion.
  double sinking_m_Pa = 0.0;
  double sideways_by_shear_m_Pa = 0.0;
  double sideways_by_tilt_m_Pa = 0.0;
  double tilt_by_shear_1_Pa = 0.0;
  double tilt_by_tilt_1_Pa = 0.0;
  int unknowns = 0;  // of the larger system
};

// The points are close enough for waves up to the largest k. With a film, the foot's traction is
// computed on that film and its backing (eq. S11), while the motions of the top remain those on a
// rigid base. Throws std::invalid_argument for a geometry that PillarModel refuses or that has a
// film.
FootForces foot_forces(const PillarGeometry& pillar, const Medium& medium,
                       const Discretisation& mesh, double largest_k_1_m = 0.0,
                       const FilmTable* on_film = nullptr);

// Fourier transforms of the foot's traction at the wave number k, Pa m^2 per Pa (eq. S3). Under
// pressure it is (tau_x, 0, t_z) at every angle theta of the wave. Under a sideways load along x it is
// -2 i (along cos theta, -across sin theta, normal cos theta).
struct AxialTransform {
  double tau_x = 0.0;
  // Along the axis, Pa m^2 per Pa.
  double t_z = 0.0;
};
// The same under a sideways load.
struct SidewaysTransform {
  // Parts of the traction, Pa m^2 per Pa.
  double along = 0.0;
  // As along.
  double across = 0.0;
  // As along.
  double normal = 0.0;
};
// The transform at a wave number of forces on circles of these radii.
AxialTransform transform(const FootForces::Axial& forces, const std::vector<double>& radius_m,
                         double k_1_m);
// The same of forces under a sideways load.
SidewaysTransform transform(const FootForces::Sideways& forces, const std::vector<double>& radius_m,
                            double k_1_m);

}  // namespace viscard
