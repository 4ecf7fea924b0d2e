// Free bodies under a load on the top that oscillates or changes in time: closed forms of rods that only
// their mass holds.
#include "models/answer/scene_mistake.h"
#include "models/material/material.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr double kE_Pa = 1.8e6, kRho = 965.0, kLength_m = 120e-6, kDiameter_m = 40e-6;

PillarScene free_rod(double nu, std::vector<MaterialTerm> terms, double tolerance = 1e-4) {
  PillarScene scene;
  scene.geometry = {.diameter_m = kDiameter_m, .length_m = kLength_m};
  scene.pillar.E0_Pa = kE_Pa;
  scene.pillar.nu = nu;
  scene.pillar.rho_kg_m3 = kRho;
  scene.pillar.terms = std::move(terms);
  scene.fixed_bottom = false;
  scene.tolerance = tolerance;
  return scene;
}

std::vector<Complex> response_of(const SceneAnswer& answer, const std::string& stem) {
  const SceneCurve& real = curve_of(answer, stem + "_real");
  const SceneCurve& imaginary = curve_of(answer, stem + "_imaginary");
  std::vector<Complex> values;
  for (std::size_t i = 0; i < real.value.size(); ++i)
    values.emplace_back(real.value[i], imaginary.value[i]);
  return values;
}

// Of few frequencies, solved one by one, and of many, in a basis.
std::vector<double> frequencies_Hz(double low, double high, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(low * std::pow(high / low, i / (count - 1.0)));
  return all;
}

}  // namespace

// A rod without contraction pushed at one end: u = p cot(k L)/(E k), k = omega sqrt(rho/E) with the complex
// modulus. Graff, Wave Motion in Elastic Solids (1975), ch. 2.
TEST_CASE("a free rod oscillates under a pressure on its top as the cotangent of its phase",
          "[pillar]") {
  const int count = GENERATE(5, 40);
  PillarScene scene = free_rod(0.0, {{0.3, 0.3, 2e-6}, {0.1, 0.1, 1e-3}});
  HarmonicDrive drive;
  drive.pressure_Pa = 1e3;
  drive.frequencies_Hz = frequencies_Hz(30.0, 4e5, count);
  scene.drive = drive;
  const SceneAnswer answer = simulate_pillar(scene);
  const std::vector<Complex> moved_m = response_of(answer, "top_displacement");
  REQUIRE(moved_m.size() == static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < moved_m.size(); ++i) {
    const double omega = 2.0 * kPi * drive.frequencies_Hz[i];
    const Complex E_Pa =
        kE_Pa * relative_modulus(scene.pillar.terms, &MaterialTerm::g, Complex(0.0, omega));
    const Complex k_1_m = omega * std::sqrt(kRho / E_Pa);
    const Complex exact_m = drive.pressure_Pa / (E_Pa * k_1_m * std::tan(k_1_m * kLength_m));
    CAPTURE(count, drive.frequencies_Hz[i], moved_m[i], exact_m);
    // The tolerance allows |u| + |omega du/domega|.
    CHECK(std::abs(moved_m[i] - exact_m) <= 5e-4 * std::abs(exact_m));
  }
}

// Far below its modes a free body moves as a rigid one: u = -F/(omega^2 m) along the axis; sideways the top
// also turns about the centre, -F/omega^2 (1/m + (L/2)^2/I), I = m (L^2/12 + R^2/4).
TEST_CASE("far below its modes a free pillar moves as its mass and its inertia say", "[pillar]") {
  const bool is_lateral = GENERATE(false, true);
  const double nu = GENERATE(0.33, 0.5);
  PillarScene scene = free_rod(nu, {{0.3, 0.3, 1e-4}});
  HarmonicDrive drive;
  drive.pressure_Pa = 1.0;
  drive.direction = is_lateral ? LoadDirection::kLateral : LoadDirection::kAxial;
  drive.frequencies_Hz = {10.0};
  scene.drive = drive;
  const Complex moved_m = response_of(simulate_pillar(scene), "top_displacement").front();
  const double omega = 2.0 * kPi * 10.0;
  const double R_m = 0.5 * kDiameter_m;
  const double area_m2 = kPi * R_m * R_m;
  const double mass_kg = kRho * area_m2 * kLength_m;
  const double inertia_kg_m2 = mass_kg * (kLength_m * kLength_m / 12.0 + R_m * R_m / 4.0);
  const double lever_m2 = is_lateral ? mass_kg * kLength_m * kLength_m / 4.0 / inertia_kg_m2 : 0.0;
  const double sign =
      is_lateral ? -1.0 : 1.0;  // a pressure pushes down, and the mass answers in antiphase
  const double exact_m = sign * area_m2 / (omega * omega * mass_kg) * (1.0 + lever_m2);
  CAPTURE(is_lateral, nu, moved_m, exact_m);
  CHECK(moved_m.real() == Approx(exact_m).epsilon(1e-6));
  CHECK(std::abs(moved_m.imag()) < 1e-6 * std::abs(exact_m));
}

// Waves run up and down a free rod: the velocity of its pushed end is the pressure over rho c, plus twice
// those of 2 n L/c before (d'Alembert; Graff 1975, ch. 2). Of a pressure that rises and falls
// linearly the displacement is a sum of its impulses.
TEST_CASE("a pulse sends a free rod off with its waves inside", "[pillar]") {
  PillarScene scene = free_rod(0.0, {}, 3e-3);
  const double speed_m_s = std::sqrt(kE_Pa / kRho);
  const double way_s = kLength_m / speed_m_s;
  const double rise_s = 1.5 * way_s;
  constexpr double kPeak_Pa = 1e3;
  TransientDrive drive;
  drive.history = {{0.0, 0.0}, {rise_s, kPeak_Pa}, {2.0 * rise_s, 0.0}, {12.0 * way_s, 0.0}};
  drive.end_time_s = 12.0 * way_s;
  drive.outputs = 240;
  scene.drive = drive;
  const auto impulse_Pa_s = [&](double t) {  // of the pressure until then
    const auto square = [](double x) { return x > 0.0 ? 0.5 * x * x : 0.0; };
    return kPeak_Pa / rise_s * (square(t) - 2.0 * square(t - rise_s) + square(t - 2.0 * rise_s));
  };
  const auto exact_m = [&](double t) {
    double sum = impulse_Pa_s(t);
    for (int n = 1; n < 8; ++n) sum += 2.0 * impulse_Pa_s(t - 2.0 * n * way_s);
    return -sum / (kRho * speed_m_s);
  };
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneCurve& curve = curve_of(answer, "top_displacement");
  const double end_m = exact_m(drive.end_time_s);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    CAPTURE(curve.x[i]);
    CHECK(curve.value[i] == Approx(exact_m(curve.x[i])).margin(scene.tolerance * std::abs(end_m)));
  }
}

// The same waves where shear and bulk relax apart and the body stands on a film: the centre of mass moves
// as Newton says whatever happens inside, so that after the pulse the mean speed of the top is its momentum.
TEST_CASE("a free pillar on its film keeps the momentum of a pulse", "[pillar]") {
  PillarScene scene = free_rod(0.45, {{0.4, 0.1, 3e-6}, {0.2, 0.0, 1e-4}}, 1e-2);
  scene.geometry.film = FilmGeometry{5e-6, 30e-6};
  scene.film = isotropic_medium(1e8, 0.3, 1780.0);
  TransientDrive drive;
  const double rise_s = 2e-5;
  drive.history = {{0.0, 0.0}, {rise_s, 1e3}, {2.0 * rise_s, 0.0}, {4e-3, 0.0}};
  drive.end_time_s = 4e-3;
  drive.outputs = 400;
  scene.drive = drive;
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneCurve& curve = curve_of(answer, "top_displacement");
  const double area_m2 = kPi * kDiameter_m * kDiameter_m / 4.0;
  const double mass_kg = kRho * area_m2 * kLength_m + 1780.0 * kPi * 30e-6 * 30e-6 * 5e-6;
  const double speed_m_s = -1e3 * rise_s * area_m2 / mass_kg;
  // Damped to rest inside: the second half is a straight line.
  CHECK((curve.value[400] - curve.value[200]) / 2e-3 == Approx(speed_m_s).epsilon(1e-3));
}

TEST_CASE("a base that a free bottom does not rest on cannot shake it", "[pillar]") {
  PillarScene scene = free_rod(0.33, {});
  HarmonicDrive drive;
  drive.load_place = LoadPlace::kBase;
  drive.base_acceleration_m_s2 = 1.0;
  drive.frequencies_Hz = {1e3};
  scene.drive = drive;
  try {
    validate(scene);
    FAIL("not refused");
  } catch (const SceneMistake& mistake) {
    CHECK(mistake.key() == "analysis.load.on");
  }
}
