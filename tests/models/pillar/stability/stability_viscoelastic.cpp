#include "models/material/material.h"
#include "models/material/retardation_spectrum.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/viscoelastic_pillar.h"
#include "tests/models/pillar/drive_as.h"
#include "tests/models/pillar/stability/stability_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace viscard::test {
namespace {

ViscoelasticPillar small_pillar(const Material& material) {
  return {{}, {.degree = 2, .layers = 1, .shaft_elements = 1}, material, TopCondition::kRigidPlate};
}

Material material_of(std::vector<MaterialTerm> terms) {
  Material material;
  material.E0_Pa = 1e6;
  material.nu = 0.4;
  material.terms = std::move(terms);
  return material;
}

// Thirty terms from 1e-10 to 1e10 s with the sum `total` of the modulus.
Material thirty_terms(double total) {
  std::vector<MaterialTerm> terms;
  for (int i = 0; i < 30; ++i) {
    const double g = total / 30.0;
    terms.push_back({g, g, std::pow(10.0, -10.0 + 20.0 * i / 29.0)});
  }
  return material_of(terms);
}

// Creep under a step of load, against J(t) of the series, at every recorded time after the jump.
double creep_error(const Material& material, double end_s, double tolerance) {
  const ViscoelasticPillar pillar = small_pillar(material);
  const PronySeries series = young_series(material);
  const RetardationSpectrum J = retardation_from_relaxation(series);
  HistoryOptions options;
  options.tolerance = tolerance;
  const HistoryResult run =
      run_history(pillar.system(), Control::kForce, {{0.0, 1.0}, {end_s, 1.0}}, options);
  const double scale = run.displacement[1] / creep_compliance_1_Pa(J, 0.0);
  double worst = 0.0;
  for (std::size_t i = 2; i < run.time_s.size(); ++i) {
    const double exact = scale * creep_compliance_1_Pa(J, run.time_s[i]);
    worst = std::max(worst, std::abs(run.displacement[i] / exact - 1.0));
  }
  return worst;
}

double relaxation_error(const Material& material, double dt_s) {
  const ViscoelasticPillar pillar = small_pillar(material);
  const PronySeries series = young_series(material);
  ViscoelasticStepper stepper(pillar.system());
  stepper.advance(0.0, Control::kDisplacement, 1.0);
  const double at_once = stepper.force();
  double worst = 0.0;
  for (int i = 1; i <= 20; ++i) {
    stepper.advance(dt_s, Control::kDisplacement, 1.0);
    const double exact = relaxation_modulus_Pa(series, i * dt_s) / instantaneous_modulus_Pa(series);
    worst = std::max(worst, std::abs(stepper.force() / at_once / exact - 1.0));
  }
  return worst;
}

// A dashpot beside a spring: an instantaneous modulus 1e8 times the equilibrium one.
double kelvin_voigt_error() {
  const double rest = 1e-8;
  const double tau_s = 1e-8;  // eta/E_inf = (E_0 - E_inf) tau/E_inf = 1 s
  const Material material = material_of({{1.0 - rest, 1.0 - rest, tau_s}});
  const ViscoelasticPillar pillar = small_pillar(material);
  HistoryOptions options;
  options.tolerance = 1e-8;
  options.output_times_s = {0.1, 0.5, 1.0, 3.0};
  const HistoryResult run =
      run_history(pillar.system(), Control::kForce, {{0.0, 1.0}, {10.0, 1.0}}, options);
  const double final_m = run.displacement[1] / rest;  // u(0) times E_0/E_inf
  double worst = 0.0;
  for (std::size_t i = 0; i < run.time_s.size(); ++i) {
    if (run.time_s[i] < 0.05) continue;
    const double exact = -std::expm1(-run.time_s[i]);  // eq. of Kelvin and Voigt
    worst = std::max(worst, std::abs(run.displacement[i] / final_m / exact - 1.0));
  }
  return worst;
}

// A rod without contraction, three diameters long, under an oscillating pressure, against
// -p tan(k L)/(k E*), k = w sqrt(rho/E*).
double oscillation_error(double frequency_Hz, double diameter_m, double E0_Pa,
                         const std::vector<MaterialTerm>& terms) {
  PillarScene scene;
  scene.drive = HarmonicDrive{};
  scene.geometry.diameter_m = diameter_m;
  scene.geometry.length_m = 3.0 * diameter_m;
  scene.pillar.E0_Pa = E0_Pa;
  scene.pillar.nu = 0.0;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.pillar.terms = terms;
  test::as<HarmonicDrive>(scene).pressure_Pa = 1e3;
  scene.tolerance = 5e-4;
  test::as<HarmonicDrive>(scene).frequencies_Hz = {frequency_Hz};
  const SceneAnswer answer = simulate_pillar(scene);
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  const std::complex<double> modulus_Pa =
      E0_Pa * relative_modulus(terms, &MaterialTerm::g, {0.0, omega});
  const std::complex<double> k = omega * std::sqrt(965.0 / modulus_Pa);
  const std::complex<double> exact =
      -1e3 * std::tan(k * scene.geometry.length_m) / (k * modulus_Pa);
  const std::complex<double> found(answer.curves[0].value[0], answer.curves[1].value[0]);
  return std::abs(found / exact - 1.0);
}

}  // namespace

std::vector<StabilityCase> viscoelastic_stability_cases() {
  std::vector<StabilityCase> cases;
  for (const double over_tau : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
    cases.push_back({fmt::format("relaxation in steps of {:g} times tau", over_tau),
                     [=] {
                       return relaxation_error(material_of({{.5, .5, 1.0}}), over_tau);
                     },
                     5e-13});
  }
  cases.push_back({"thirty terms over twenty decades: relaxation in steps of 1 s",
                   [] { return relaxation_error(thirty_terms(.9), 1.0); }, 5e-13});
  cases.push_back({"thirty terms over twenty decades: creep to 1e6 s",
                   [] { return creep_error(thirty_terms(.9), 1e6, 1e-6); }, 1.5e-8});
  cases.push_back({"Maxwell liquid (a share of 1e-9 stays): creep to 1000 times tau",
                   [] {
                     return creep_error(material_of({{1.0 - 1e-9, 1.0 - 1e-9, 1.0}}), 1e3, 1e-7);
                   },
                   5e-13});
  cases.push_back(
      {"Kelvin-Voigt limit (instantaneous modulus 1e8 times the last)", kelvin_voigt_error, 9e-7});
  const std::vector<MaterialTerm> soft = {{.2, .2, 1e-9}, {.1, .1, 1e-5}, {.05, .05, 1.0}};
  for (const auto& [f_Hz, bound] :
       {std::pair{1e-6, 1e-12}, {1.0, 3e-12}, {1e6, 3e-12}, {1e8, 1.5e-8}, {1e9, 5e-4}}) {
    cases.push_back({fmt::format("oscillation at {:g} Hz, pillar of 40 nm: rod", f_Hz),
                     [=, f_Hz = f_Hz] { return oscillation_error(f_Hz, 40e-9, 1.8e6, soft); },
                     bound});
  }
  // Waves in a polymer near its glass transition decay within the pillar.
  const std::vector<MaterialTerm> glassy = {{.5, .5, 1e-10},  {.2, .2, 1e-9},   {.1, .1, 1e-8},
                                            {.05, .05, 1e-7}, {.05, .05, 1e-6}, {.05, .05, 1e-3}};
  for (const auto& [f_Hz, bound] :
       {std::pair{1e-6, 2e-12}, {1e6, 1e-8}, {1e8, 2.5e-6}, {1e9, 1.5e-7}}) {
    cases.push_back({fmt::format("oscillation at {:g} Hz, pillar of 40 um, glassy: rod", f_Hz),
                     [=, f_Hz = f_Hz] { return oscillation_error(f_Hz, 40e-6, 1e9, glassy); },
                     bound});
  }
  return cases;
}

}  // namespace viscard::test
