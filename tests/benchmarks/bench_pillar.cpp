// Processor time of the pillar solver inside one process, with the error of each answer.
// bench_pillar_peers times the whole command beside its peers.
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/time/harmonic_response.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <ctime>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

using namespace viscard;

namespace {

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double best_of(int repeats, const std::function<void()>& work) {
  double best_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double start_s = cpu_s();
    work();
    best_s = std::min(best_s, cpu_s() - start_s);
  }
  return best_s;
}

PillarGeometry on_film() {
  PillarGeometry geometry;
  geometry.film = FilmGeometry{25e-6, 60e-6};
  return geometry;
}

PillarMedia media() {
  return {isotropic_medium(1.8e6, .33, 965.0), isotropic_medium(2e9, .29, 1780.0)};
}

// The twelve lowest modes: four double lateral, two longitudinal, two torsional. Hz, converged.
struct Family {
  Motion motion;
  std::vector<double> converged_Hz;
};
const std::vector<Family> kTwelve = {{Motion::kLateral, {16026.87, 77403.97, 173645.7, 274668.4}},
                                     {Motion::kLongitudinal, {90760.26, 268141.2}},
                                     {Motion::kTorsion, {55165.77, 165497.3}}};

void bench_modes(const Discretisation& mesh) {
  double error = 0.0;
  int unknowns = 0;
  const double spent_s = best_of(20, [&] {
    error = 0.0;
    for (const Family& family : kTwelve) {
      const PillarModel model(on_film(), mesh, media(), {.motion = family.motion});
      unknowns = std::max(unknowns, model.system().size());
      const auto modes = lowest_modes(model, static_cast<int>(family.converged_Hz.size()));
      for (std::size_t i = 0; i < modes.size(); ++i) {
        error = std::max(error, std::abs(modes[i].frequency_Hz / family.converged_Hz[i] - 1.0));
      }
    }
  });
  fmt::print("twelve modes, degree {}, {} layers  {:>8} unknowns {:>9.2f} ms  error {:.4f} %\n",
             mesh.degree, mesh.layers, unknowns, 1e3 * spent_s, 100.0 * error);
}

// 100 equal steps of creep under 10 kPa to 10 s, shear and bulk relaxing alike, so that J(t) is
// exact up to the film's share; the mesh error is that of the converged 659.763 nm.
void bench_creep() {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = .33;
  material.terms = {{.008206, .008206, .1945}, {.01386, .01386, 2.403}};
  double first_m = 0.0;
  double last_m = 0.0;
  const double spent_s = best_of(10, [&] {
    const ViscoelasticPillar pillar(on_film(), {.degree = 4, .layers = 2}, material,
                                    TopCondition::kPressure, media().film);
    ViscoelasticStepper stepper(pillar.system());
    const double force_N = 1e4 * pillar.top_area_m2();
    stepper.advance(0.0, Control::kForce, force_N);
    first_m = stepper.displacement();
    for (int i = 0; i < 100; ++i) stepper.advance(0.1, Control::kForce, force_N);
    last_m = stepper.displacement();
  });
  const double error =
      std::max(std::abs(first_m / 659.763e-9 - 1.0), std::abs(last_m / 674.492e-9 - 1.0));
  fmt::print("creep, 100 steps with set-up {:>27.2f} ms  error {:.4f} %\n", 1e3 * spent_s,
             100.0 * error);
}

// A base shaken sideways at 1000 frequencies from 1 Hz to 100 kHz, shear and bulk relaxing; the
// error is that of the small basis against the whole body at ten of them.
void bench_sweep() {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = .33;
  material.terms = {{.008206, 0.0, .1945}, {.01386, 0.0, 2.403}};
  constexpr int kPoints = 1000;
  const double low_rad_s = 2.0 * std::numbers::pi;
  std::vector<double> size(kPoints);
  const auto omega = [&](int i) { return low_rad_s * std::pow(1e5, i / (kPoints - 1.0)); };
  const PillarModel model(on_film(), {.degree = 5, .layers = 2}, media(),
                          {.motion = Motion::kLateral});
  const ViscoelasticSystem body = viscoelastic_system(model, material, true);
  const Eigen::VectorXd shaken = unit_acceleration_force(model);
  const Eigen::VectorXd top = unit_top_force(model);
  const double spent_s = best_of(5, [&] {
    const PillarModel again(on_film(), {.degree = 5, .layers = 2}, media(),
                            {.motion = Motion::kLateral});
    const ViscoelasticSystem system = viscoelastic_system(again, material, true);
    const ReducedBody small =
        reduce_dynamic(system, {shaken, top}, {low_rad_s, omega(kPoints - 1), 1e-5});
    const HarmonicSolver solver(small.system);
    const Eigen::VectorXcd load = small.load(shaken).cast<std::complex<double>>();
    const Eigen::VectorXd seen = small.load(top);
    for (int i = 0; i < kPoints; ++i) {
      const Eigen::MatrixXcd u = solver.solve(omega(i), load);
      size[static_cast<std::size_t>(i)] = std::abs(seen.cast<std::complex<double>>().dot(u.col(0)));
    }
  });
  double error = 0.0;
  for (int i = 0; i < kPoints; i += 111) {
    const double whole =
        std::abs(top.cast<std::complex<double>>().dot(solve_harmonic(body, shaken, omega(i))));
    error = std::max(error, std::abs(size[static_cast<std::size_t>(i)] / whole - 1.0));
  }
  fmt::print("sweep, 1000 frequencies with set-up {:>8} unknowns {:>6.2f} ms  error {:.1e} %\n",
             shaken.size(), 1e3 * spent_s, 100.0 * error);
}

// Static solutions on finer and finer quadratic elements: set-up, factor and solve. The exponent is
// the slope of the least-squares line through the logarithms.
void bench_growth() {
  double last_n = 0.0, last_s = 0.0;
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const std::vector<double> sizes_um = {6.0, 4.0, 3.0, 2.0, 1.5, 1.1, 0.8, 0.55};
  for (const double size_um : sizes_um) {
    int n = 0;
    const double spent_s = best_of(size_um > 2.0 ? 10 : 3, [&] {
      const PillarModel model(on_film(), {.degree = 2, .uniform_m = size_um * 1e-6}, media(), {});
      n = model.system().size();
      model.solve(model.top_traction());
    });
    fmt::print("static, quadratic elements of {:>4} um {:>8} unknowns {:>9.2f} ms", size_um, n,
               1e3 * spent_s);
    if (last_n > 0.0) {
      fmt::print("  grows as n^{:.2f}", std::log(spent_s / last_s) / std::log(n / last_n));
    }
    fmt::print("\n");
    last_n = n;
    last_s = spent_s;
    sx += std::log(n);
    sy += std::log(spent_s);
    sxx += std::log(n) * std::log(n);
    sxy += std::log(n) * std::log(spent_s);
  }
  const auto count = static_cast<double>(sizes_um.size());
  fmt::print("up to {:.0f} unknowns the cost grows as n^{:.2f} (least squares)\n", last_n,
             (count * sxy - sx * sy) / (count * sxx - sx * sx));
}

// The twelve modes on one mesh in one process, for timing beside other programs: a pillar on the
// film, or a cylinder on a fixed base.
int print_modes(const Discretisation& mesh, bool has_film) {
  PillarMedia of = media();
  if (!has_film) of.film.reset();
  for (const Family& family : kTwelve) {
    const PillarModel model(has_film ? on_film() : PillarGeometry{}, mesh, of,
                            {.motion = family.motion});
    for (const PillarMode& mode :
         lowest_modes(model, static_cast<int>(family.converged_Hz.size()))) {
      fmt::print("mode {:.4f}\n", mode.frequency_Hz);
    }
  }
  return 0;
}

}  // namespace

// bench_pillar: the table. bench_pillar film|fixed DEGREE LAYERS: the modes alone.
int main(int argc, char** argv) {
  if (argc == 4) {
    return print_modes({.degree = std::stoi(argv[2]), .layers = std::stoi(argv[3])},
                       std::string(argv[1]) == "film");
  }
  for (const Discretisation& mesh :
       {Discretisation{.degree = 4, .layers = 1}, Discretisation{.degree = 4, .layers = 2},
        Discretisation{.degree = 5, .layers = 2}, Discretisation{.degree = 8, .layers = 3}}) {
    bench_modes(mesh);
  }
  bench_creep();
  bench_sweep();
  bench_growth();
}
