// Whole answers at extremes, with the error that they claim.
#include "models/array/plane/simulate_array.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "tests/models/array/plane/seed_array.h"
#include "tests/models/pillar/drive_as.h"
#include "tests/models/pillar/stability/stability_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace viscard::test {
namespace {

// What a finer mesh is off by itself: its thin layers cost digits. Torsional frequencies at a Poisson
// ratio of 0.5 differ from the closed form by 2e-9 there.
constexpr double kRounding = 5e-9;

// The share of its claim that a number errs by, and its relative error.
Seen beside(double value, double claim, double exact, double size) {
  const double error = std::max(0.0, std::abs(value - exact) - kRounding * size);
  return {error / size, error / claim};
}

// A result against the same on a finer mesh.
template <typename Results>
Seen seen_in(const Results& answer, const Results& fine, const std::string& name) {
  for (std::size_t i = 0; i < answer.size(); ++i) {
    if (answer[i].name != name) continue;
    return beside(answer[i].value, answer[i].error_estimate, fine[i].value,
                  std::max(std::abs(fine[i].value), fine[i].scale));
  }
  throw std::runtime_error("there is no result " + name);
}

SceneAnswer fine_of(const PillarScene& scene, int degree, int layers) {
  Discretisation mesh = mesh_sequence(scene.geometry).back();
  mesh.degree = degree;
  mesh.layers = layers;
  return pillar_answer_on(scene, mesh);
}

Seen result_of(const PillarScene& scene, int degree = 10, int layers = 7) {
  return seen_in(simulate_pillar(scene).results, fine_of(scene, degree, layers).results,
                 scene.wanted.front());
}

// The worst of all modes.
Seen modes_of(const PillarScene& scene) {
  const SceneAnswer answer = simulate_pillar(scene), fine = fine_of(scene, 7, 4);
  Seen worst = 0.0;
  for (std::size_t i = 0; i < answer.modes.size(); ++i) {
    const double exact_Hz = fine.modes.at(i).frequency_Hz;
    const Seen one =
        beside(answer.modes[i].frequency_Hz, answer.modes[i].error_estimate, exact_Hz, exact_Hz);
    worst.error = std::max(worst.error, one.error);
    worst.of_claim = std::max(worst.of_claim.value_or(0.0), *one.of_claim);
  }
  return worst;
}

Seen row_of(const ArrayScene& scene, std::size_t finer = 4) {
  Discretisation mesh = array_meshes(scene).at(finer);
  mesh.layers += 1;
  return seen_in(simulate_array(scene).results, array_answer_on(scene, mesh).results,
                 scene.wanted.front() + "_1");
}

PillarScene pillar_on_film(double film_over_pillar, double radius_over_pillar, double nu) {
  PillarScene scene;
  scene.tolerance = 1e-3;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = nu;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.geometry.film = FilmGeometry{25e-6, 20e-6 * radius_over_pillar};
  scene.film = isotropic_medium(1.8e6 * film_over_pillar, 0.29, 1780.0);
  as<StaticDrive>(scene).pressure_Pa = 1.0;  // far below buckling on the softest film
  scene.wanted = {"top_displacement"};
  return scene;
}

PillarScene sensor(double film_over_pillar, double radius_over_pillar, double nu) {
  PillarScene scene = pillar_on_film(film_over_pillar, radius_over_pillar, nu);
  // As strongly coupled at every stiffness.
  const double permittivity = 12.0 * kVacuumPermittivity_F_m;
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 2) = -0.12 * std::sqrt(permittivity / (1.8e6 * film_over_pillar));
  d(2, 0) = d(2, 1) = -0.6 * d(2, 2);
  scene.film = piezo_medium(isotropic_moduli_Pa(1.8e6 * film_over_pillar, 0.29), d,
                            permittivity * Eigen::Matrix3d::Identity(), 1780.0);
  scene.electrodes = ElectrodeOptions{FilmFace::kTop, 20e-6};
  scene.wanted = {"electrode_voltage"};
  return scene;
}

PillarScene ringing(double film_over_pillar, double nu, double length_over_diameter) {
  PillarScene scene = pillar_on_film(film_over_pillar, 2.0, nu);
  scene.geometry.length_m = length_over_diameter * scene.geometry.diameter_m;
  scene.drive = ModalDrive{.modes = 2};
  scene.wanted.clear();
  return scene;
}

// On a rigid base. Above the cut-off of its section the modes lie close together.
PillarScene slender(double nu, double length_over_diameter) {
  PillarScene scene = ringing(1e3, nu, length_over_diameter);
  scene.geometry.film.reset();
  scene.film.reset();
  return scene;
}

// Relaxes by half about the first period, in shear alone.
PillarScene damped(double film_over_pillar) {
  PillarScene scene = ringing(film_over_pillar, 0.33, 3.0);
  scene.drive = ModalDrive{.modes = 1};
  scene.pillar.terms = {{0.3, 0.0, 3e-6}, {0.2, 0.0, 3e-5}};
  return scene;
}

// A row whose first pillar is pressed.
ArrayScene row(int count, double spacing_over_thickness, double edge_over_thickness) {
  ArrayScene scene = seed_scene();
  scene.tolerance = 1e-4;
  scene.geometry.count = count;
  scene.geometry.spacing_m = spacing_over_thickness * scene.geometry.film_thickness_m;
  scene.geometry.film_edge_m = edge_over_thickness * scene.geometry.film_thickness_m;
  scene.wanted = {"mean_voltage"};
  scene.loaded = {1};
  return scene;
}

// The film ends with the outer pillars and their electrodes.
ArrayScene row_without_edge() {
  ArrayScene scene = row(2, 0.8, 0.0);
  scene.tolerance = 1e-3;
  scene.electrodes.is_equipotential = true;
  scene.wanted = {"electrode_voltage"};
  return scene;
}

}  // namespace

std::vector<StabilityCase> answer_stability_cases() {
  std::vector<StabilityCase> cases;
  for (const double contrast : {1e-2, 1.0, 1e3}) {
    cases.push_back(
        {fmt::format("film as wide as the pillar, {:g} times as stiff: displacement", contrast),
         [=] { return result_of(pillar_on_film(contrast, 1.0, 0.4)); }, 2.9e-5});
  }
  cases.push_back({"film as wide as the pillar and its electrode: voltage",
                   [] { return result_of(sensor(1e3, 1.0, 0.4)); }, 2e-4});
  for (const double contrast : {1e-3, 1e-1}) {
    cases.push_back({fmt::format("film {:g} times as stiff as the pillar: displacement", contrast),
                     [=] { return result_of(pillar_on_film(contrast, 3.0, 0.4)); }, 8e-4});
  }
  cases.push_back({"film 0.1 times as stiff as the pillar: modes of all families",
                   [] { return modes_of(ringing(0.1, 0.4, 3.0)); }, 1e-3});
  for (const double contrast : {10.0, 1e3, 1e6}) {
    cases.push_back({fmt::format("Poisson ratio 0.5, piezoelectric film {:g} times as stiff: "
                                 "voltage",
                                 contrast),
                     [=] { return result_of(sensor(contrast, 3.0, 0.5), 8, 6); }, 5e-5});
  }
  for (const double contrast : {1.0, 1e3}) {
    cases.push_back(
        {fmt::format("material that relaxes in shear, film {:g} times as stiff: modes", contrast),
         [=] { return modes_of(damped(contrast)); }, 3e-4});
  }
  cases.push_back({"close modes: Poisson ratio 0.5, 10 diameters long",
                   [] { return modes_of(slender(0.5, 10.0)); }, 3e-4});
  for (const double spacing : {0.02, 0.2}) {
    cases.push_back({fmt::format("row with gaps of {:g} film thicknesses: voltage", spacing),
                     [=] { return row_of(row(3, spacing, 8.0)); }, 2e-6});
  }
  cases.push_back(
      {"row of 1000 pillars: voltage", [] { return row_of(row(1000, 0.8, 8.0)); }, 2e-6});
  cases.push_back({"row whose film ends with its pillars and electrodes: voltage",
                   [] { return row_of(row_without_edge(), 3); }, 3e-6});
  return cases;
}

}  // namespace viscard::test
