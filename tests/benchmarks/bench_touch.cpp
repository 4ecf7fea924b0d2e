// Arrays in the plane inside one process: processor time of forces on thousands of pillars to what quarters read, of the
// forces back from the voltages, and of a sphere on pillars on a soft half-space.
#include "models/array/space/simulate_space.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>

using namespace viscard;

namespace {

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Pillars of 40 x 120 um of PDMS at a pitch of 100 um on the thesis' film.
SpaceScene square(int across) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = 22e-12;
  d(2, 1) = 3e-12;
  d(2, 2) = -30e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.rows = scene.columns = across;
  scene.pillars = lattice_places(SpaceLattice::kSquare, across, across, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 1e-3;
  return scene;
}

SpaceScene loaded(int across) {
  SpaceScene scene = square(across);
  scene.electrode = SpaceElectrode::kQuadrants;
  scene.pressure_Pa = 1e3;
  scene.shear_x_Pa = 300.0;
  scene.shear_y_Pa = -200.0;
  scene.wanted = {"mean_voltage", "quadrant_1_voltage", "quadrant_2_voltage", "quadrant_3_voltage",
                  "quadrant_4_voltage"};
  return scene;
}

SpaceScene pressed(int across, double depth_m) {
  SpaceScene scene = square(across);
  scene.electrode = SpaceElectrode::kQuadrants;
  ShapePress press;
  press.shape.kind = ShapeKind::kSphere;
  press.shape.radius_m = 100e-3;
  press.depth_m = depth_m;
  scene.press = press;
  scene.wanted = {"mean_voltage",
                  "quadrant_1_voltage",
                  "quadrant_2_voltage",
                  "quadrant_3_voltage",
                  "quadrant_4_voltage",
                  "pillar_force",
                  "contacts"};
  return scene;
}

void bench(const std::string& what, const SpaceScene& scene, double allowed_s, int repeats) {
  double best_s = std::numeric_limits<double>::infinity();
  SceneAnswer answer;
  for (int i = 0; i < repeats; ++i) {
    const double start_s = cpu_s();
    answer = simulate(scene);
    best_s = std::min(best_s, cpu_s() - start_s);
  }
  fmt::print("{:<58} {:7.3f} s (aim {:.1f}), error {:.1e}, degree {}{}\n", what, best_s, allowed_s,
             answer.largest_relative_error, answer.discretisation.degree,
             best_s > allowed_s ? "   short of its aim" : "");
}

}  // namespace

int main(int argc, char** argv) {
  const int across = argc > 1 ? std::atoi(argv[1]) : 316;
  bench("100 x 100, three-axis loads to quarters, 0.1 %", loaded(100), 0.3, 5);
  bench("100 x 100, sphere to 208 contacts and quarters, 0.1 %", pressed(100, 3e-6), 0.3, 3);
  SpaceScene back = loaded(100);
  back.wanted = {"sensed_normal_force", "sensed_shear_x_force", "sensed_shear_y_force",
                 "without_neighbours_percent"};
  bench("100 x 100, and the forces back from the quarters", back, 1.0, 3);
  SpaceScene soft = pressed(100, 3e-6);
  soft.backing = Backing{1.8e6, 0.49};
  soft.electrode = SpaceElectrode::kSampled;
  soft.wanted = {"pillar_force", "contacts"};
  soft.film_edge_m = 20e-3;
  soft.tolerance = 1e-2;
  try {
    bench("100 x 100, sphere on PDMS half-space, contact, 1 %", soft, 1.0, 3);
  } catch (const std::exception& error) {
    fmt::print("100 x 100 on PDMS half-space: {}\n", error.what());
  }
  if (across > 100) {
    bench(fmt::format("{0} x {0}, three-axis loads to quarters, 0.1 %", across), loaded(across),
          10.0, 1);
  }
  return 0;
}
