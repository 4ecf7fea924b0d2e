// Rows of pillars inside one process: processor time of static voltage maps to 0.1 %, and wall time
// of a sweep over diameters and spacings on all cores.
#include "models/array/plane/simulate_array.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <thread>

using namespace viscard;

namespace {

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ArrayScene seed_row(int count) {
  ArrayScene scene;
  scene.geometry.count = count;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = 22e-12;
  d(2, 1) = 3e-12;
  d(2, 2) = -30e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.load_Pa = 1e3;
  scene.wanted = {"centre_voltage", "mean_voltage"};
  return scene;
}

// The whole map: the voltage under every pillar for a load on every pillar, with its error estimate.
void bench_voltages(int count, double allowed_s) {
  double best_s = std::numeric_limits<double>::infinity();
  SceneAnswer answer;
  for (int i = 0; i < 7; ++i) {
    const double start_s = cpu_s();
    answer = simulate_array(seed_row(count));
    best_s = std::min(best_s, cpu_s() - start_s);
  }
  fmt::print(
      "{:>3} pillars, voltages to 0.1 %: {:7.1f} ms (aim {:.0f}), error {:.1e}, degree {}, {} "
      "unknowns\n",
      count, 1e3 * best_s, 1e3 * allowed_s, answer.largest_relative_error,
      answer.discretisation.degree, answer.unknowns);
}

void bench_map(int across) {
  std::vector<Scene> points;
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < across; ++j) {
      ArrayScene scene = seed_row(1);
      scene.geometry.ends = FilmEnds::kMirror;
      scene.geometry.diameter_m = (20.0 + 60.0 * i / (across - 1)) * 1e-6;
      scene.geometry.length_m = 3.0 * scene.geometry.diameter_m;
      scene.geometry.spacing_m = (10.0 + 90.0 * j / (across - 1)) * 1e-6;
      scene.wanted = {"centre_voltage", "deviation_percent"};
      points.push_back(scene);
    }
  }
  const double start_s = wall_s();
  const double cpu_start_s = cpu_s();
  double worst = 0.0;
  simulate_all(points, [&](std::size_t, const SceneAnswer& answer) {
    worst = std::max(worst, answer.largest_relative_error);
  });
  fmt::print(
      "{} x {} diameters and spacings to 0.1 %: {:.1f} s on {} cores ({:.1f} s of processor "
      "time; aim 60 s on two), error {:.1e}\n",
      across, across, wall_s() - start_s, std::thread::hardware_concurrency(),
      cpu_s() - cpu_start_s, worst);
}

}  // namespace

int main(int argc, char** argv) {
  const int across = argc > 1 ? std::atoi(argv[1]) : 20;
  bench_voltages(8, 0.05);
  bench_voltages(64, 0.4);
  if (across > 1) bench_map(across);
  return 0;
}
