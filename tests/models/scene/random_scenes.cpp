#include "tests/models/scene/random_scenes.h"

#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"
#include "tests/support/random_draw.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace viscard::test {
namespace {

void draw_film(Draw& draw, const Ranges& ranges, PillarScene& scene) {
  const double R = 0.5 * scene.geometry.diameter_m;
  scene.geometry.film =
      FilmGeometry{2.0 * R * draw.log_uniform(0.05, 1.5),
                   R * (draw.chance(0.2) ? 1.0 : draw.uniform(1.5, ranges.widest_film))};
  const double E = scene.pillar.E0_Pa * draw.log_uniform(10.0, 1e5);
  const double nu = draw.uniform(0.1, 0.4);
  if (!draw.chance(0.5)) {
    scene.film = isotropic_medium(E, nu, draw.uniform(1000.0, 8000.0));
    return;
  }
  PiezoMatrix d = PiezoMatrix::Zero();
  const double coupling = draw.log_uniform(0.02, 0.5);  // about k_33
  const double permittivity = kVacuumPermittivity_F_m * draw.log_uniform(8.0, 2000.0);
  d(2, 2) = coupling * std::sqrt(permittivity / E);
  d(2, 0) = d(2, 1) = -draw.uniform(0.2, 0.6) * d(2, 2);
  scene.film = piezo_medium(isotropic_moduli_Pa(E, nu), d,
                            permittivity * Eigen::Matrix3d::Identity(), 1780.0);
}

void draw_terms(Draw& draw, PillarScene& scene) {
  const int count = 1 + draw.below(4);
  const bool shear_only = draw.chance(0.3);
  for (int i = 0; i < count; ++i) {
    const double g = draw.log_uniform(1e-6, 0.8 / count);
    scene.pillar.terms.push_back({g, shear_only ? 0.0 : g, draw.log_uniform(1e-3, 1e3)});
  }
}

Course draw_history(Draw& draw, double value) {
  const double ramp_s = draw.chance(0.5) ? 0.0 : draw.log_uniform(1e-3, 10.0);
  const double hold_s = draw.log_uniform(1e-2, 100.0);
  Course history = {{0.0, value}};
  if (ramp_s > 0.0) history = {{0.0, 0.0}, {ramp_s, value}};
  history.push_back({ramp_s + hold_s, value});
  if (draw.chance(0.3)) {
    const double left = draw.chance(0.5) ? 0.0 : 0.5 * value;
    history.push_back({ramp_s + hold_s, left});
    history.push_back({ramp_s + 2.0 * hold_s, left});
  }
  return history;
}

void draw_static(Draw& draw, PillarScene& scene) {
  scene.drive = StaticDrive{};
  as<StaticDrive>(scene).pressure_Pa = draw.uniform(0.01, 0.3) * engesser_pressure_Pa(scene);
  if (scene.film && scene.film->is_piezoelectric() && draw.chance(0.7)) {
    const double R = 0.5 * scene.geometry.diameter_m;
    const double edge = std::min(R * draw.uniform(0.6, 1.0), scene.geometry.film->radius_m);
    scene.electrodes =
        ElectrodeOptions{draw.chance(0.5) ? FilmFace::kTop : FilmFace::kBottom, edge};
    scene.wanted = {"top_displacement"};
    if (draw.chance(0.7)) scene.wanted.emplace_back("electrode_voltage");
    return;
  }
  if (draw.chance(0.3)) return;  // everything
  scene.wanted = {"top_displacement"};
  if (draw.chance(0.3)) scene.wanted.emplace_back("base_stress_at_half_radius");
}

// Materials that damp the modes, and films as soft as the pillar or softer. They have a stream of
// their own, so that the other scenes of a seed stay what they were.
void draw_damped_modes(const Ranges& ranges, PillarScene& scene) {
  std::mt19937_64 own(static_cast<std::uint64_t>(1e15 * scene.geometry.length_m));
  Draw draw(own);
  if (draw.chance(0.4)) return;
  const double period_s =
      4.0 * scene.geometry.length_m / std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3);
  const int count = 1 + draw.below(3);
  const bool is_alike = draw.chance(0.4);
  scene.pillar.terms.clear();
  double& pressure_Pa = as<ModalDrive>(scene).pressure_Pa;
  for (int i = 0; i < count; ++i) {
    const double g = draw.log_uniform(1e-3, 0.7 / count);
    pressure_Pa -= pressure_Pa * g;  // stays below the long-term buckling pressure
    scene.pillar.terms.push_back(
        {g, is_alike ? g : g * draw.uniform(0.0, 1.0), period_s * draw.log_uniform(1e-3, 1e2)});
  }
  if (!scene.film || !draw.chance(0.4)) return;
  scene.film = isotropic_medium(scene.pillar.E0_Pa * draw.log_uniform(ranges.softest_film, 10.0),
                                draw.uniform(0.1, 0.4), draw.uniform(1000.0, 2000.0));
  scene.electrodes.reset();
  pressure_Pa = 0.0;  // the foot turns so easily that Engesser's pressure is no guide
}

}  // namespace

PillarScene random_scene(std::mt19937_64& random, const Ranges& ranges) {
  Draw draw(random);
  PillarScene scene;
  scene.tolerance = draw.log_uniform(ranges.least_tolerance, 1e-1);
  scene.geometry.diameter_m = draw.log_uniform(5e-6, 200e-6);
  scene.geometry.length_m =
      scene.geometry.diameter_m * draw.log_uniform(0.7, ranges.largest_aspect);
  scene.pillar.E0_Pa = draw.log_uniform(1e5, 1e8);
  scene.pillar.nu = draw.chance(0.3) ? 0.5 - draw.log_uniform(5e-4, 5e-2) : draw.uniform(0.2, 0.45);
  scene.pillar.rho_kg_m3 = draw.uniform(900.0, 1500.0);
  if (draw.chance(0.7)) draw_film(draw, ranges, scene);
  if (draw.chance(0.5)) draw_terms(draw, scene);
  switch (draw.below(5)) {
    case 0:
    case 1:
      draw_static(draw, scene);
      break;
    case 2:
      scene.drive = ModalDrive{.modes = 1 + draw.below(3)};
      if (draw.chance(0.5)) {
        as<ModalDrive>(scene).pressure_Pa =
            draw.log_uniform(1e-5, 0.5) * engesser_pressure_Pa(scene);
      }
      draw_damped_modes(ranges, scene);
      break;
    case 3:
      scene.drive = BucklingDrive{};  // stubbier ones do not bend
      scene.geometry.length_m = std::max(scene.geometry.length_m, 1.5 * scene.geometry.diameter_m);
      break;
    default:
      if (draw.chance(0.6)) {
        scene.drive = CreepDrive{};
        as<CreepDrive>(scene).history = draw_history(draw, 0.2 * engesser_pressure_Pa(scene));
      } else {
        scene.drive = RelaxationDrive{draw_history(draw, 1e-3 * scene.geometry.length_m)};
      }
      break;
  }
  return scene;
}

PillarScene with_everything_on(const PillarScene& scene) {
  PillarScene on = std::get<PillarScene>(with_all_effects_on(scene));
  on.tolerance = 0.02 * scene.tolerance;  // of time steps
  return on;
}

SceneAnswer fine_answer(const PillarScene& scene, int degree, int layers) {
  const Scene on = plan_effects(with_everything_on(scene)).reduced;
  Discretisation mesh = mesh_sequence(std::get<PillarScene>(on).geometry).back();
  mesh.degree = degree;
  mesh.layers = layers;
  return answer_on(on, mesh);
}

}  // namespace viscard::test
