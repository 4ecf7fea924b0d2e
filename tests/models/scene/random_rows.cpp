#include "tests/models/scene/random_rows.h"

#include "models/pillar/analyses/buckling_limit.h"
#include "tests/models/array/plane/seed_array.h"
#include "tests/support/random_draw.h"

#include <cmath>

namespace viscard::test {
namespace {

void draw_materials(Draw& draw, ArrayScene& scene) {
  scene.pillar.E0_Pa = draw.log_uniform(1e5, 1e8);
  scene.pillar.nu = draw.chance(0.3) ? 0.5 - draw.log_uniform(5e-4, 5e-2) : draw.uniform(0.2, 0.45);
  if (draw.chance(0.3)) return;  // PVDF, for any pillars
  const double E = scene.pillar.E0_Pa * draw.log_uniform(10.0, 1e5);
  const double nu = draw.uniform(0.1, 0.4);
  const double permittivity = kVacuumPermittivity_F_m * draw.log_uniform(8.0, 2000.0);
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 2) = draw.log_uniform(0.02, 0.5) * std::sqrt(permittivity / E);
  d(2, 0) = -draw.uniform(0.2, 0.8) * d(2, 2);
  d(2, 1) = -draw.uniform(0.1, 0.8) * d(2, 2);
  scene.film = piezo_medium(isotropic_moduli_Pa(E, nu), d,
                            permittivity * Eigen::Matrix3d::Identity(), 1780.0);
}
}  // namespace

ArrayScene random_row(std::mt19937_64& random) {
  Draw draw(random);
  ArrayScene scene;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = seed_pvdf();
  draw_materials(draw, scene);
  scene.tolerance = draw.log_uniform(1e-4, 1e-1);
  ArrayGeometry& g = scene.geometry;
  g.count = 2 + draw.below(4);
  g.diameter_m = draw.log_uniform(10e-6, 80e-6);
  g.length_m = g.diameter_m * draw.uniform(1.5, 4.0);
  g.film_thickness_m = g.diameter_m * draw.log_uniform(0.1, 2.0);
  g.spacing_m = g.film_thickness_m * draw.log_uniform(0.3, 12.0);
  g.film_edge_m = g.film_thickness_m * draw.uniform(0.5, 8.0);
  if (draw.chance(0.2)) g.ends = FilmEnds::kMirror;
  scene.plane = draw.chance(0.5) ? PlaneState::kStress : PlaneState::kStrain;
  scene.electrodes.grounded = draw.chance(0.5) ? FilmFace::kTop : FilmFace::kBottom;
  scene.electrodes.is_equipotential = draw.chance(0.3);
  if (draw.chance(0.3)) scene.electrodes.half_width_m = 0.5 * g.diameter_m * draw.uniform(0.6, 1.0);
  scene.load_Pa = draw.uniform(0.01, 0.3) * engesser_pressure_Pa(single_pillar(scene));
  const double kind = draw.uniform(0.0, 1.0);
  if (kind < 0.2) {
    scene.drive = RowModal{.modes = 1 + draw.below(3)};
  } else if (kind < 0.4) {
    scene.wanted = {"top_displacement"};
    if (draw.chance(0.3)) scene.load = ArrayLoad::kShear;
  } else {
    const bool is_read = !scene.electrodes.is_equipotential;
    scene.wanted = {is_read ? "centre_voltage" : "electrode_voltage"};
    if (is_read && draw.chance(0.6)) scene.wanted.emplace_back("mean_voltage");
    if (draw.chance(0.2)) scene.wanted.emplace_back("neighbours_percent");
    if (draw.chance(0.2)) scene.load = ArrayLoad::kShear;
  }
  if (draw.chance(0.5)) scene.loaded = {1};
  return scene;
}

}  // namespace viscard::test
