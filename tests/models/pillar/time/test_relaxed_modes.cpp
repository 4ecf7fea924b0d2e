// Damped modes against closed forms: rods of nu = 0 and torsion have s^2 = -omega_0^2 M~(s), with
// the modulus at the mode's own complex frequency (Christensen, Theory of Viscoelasticity (1982),
// ch. 2; correspondence principle).
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/time/relaxed_modes.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>

using namespace viscard;

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

Material rod_material(double nu, std::vector<MaterialTerm> terms) {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = nu;
  material.rho_kg_m3 = 965.0;
  material.terms = std::move(terms);
  return material;
}

PillarMedia media_of_rod(const Material& m) {
  return {isotropic_medium(m.E0_Pa, m.nu, m.rho_kg_m3), std::nullopt};
}

constexpr double kTolerance = 1e-10;

std::vector<RelaxedMode> modes_of_rod(const Material& material, const ModelOptions& options,
                                      int count, double pressure_Pa = 0.0) {
  const PillarGeometry geometry;
  const Discretisation mesh{.degree = 8, .layers = 1, .shaft_elements = 3};
  const PillarModel model(geometry, mesh, media_of_rod(material), options);
  ViscoelasticSystem body = viscoelastic_system(model, material, /*with_mass=*/true);
  if (pressure_Pa != 0.0) {
    const PillarModel axial(geometry, mesh, media_of_rod(material),
                            {.motion = Motion::kLongitudinal, .electrodes = {}});
    body.elastic.coeffs() += pressure_Pa * stress_stiffness_per_Pa(axial, model).coeffs();
  }
  return relaxed_modes(model, body, count, kTolerance);
}

// Relative error of s as a root of s^2 + omega_0^2 [M~(s) - stress], by one step of Newton.
double misfit(const RelaxedMode& mode, double omega_0, const std::vector<MaterialTerm>& terms,
              double stress = 0.0) {
  const double size =
      2.0 * pi * mode.frequency_Hz / std::sqrt(1.0 - mode.damping_ratio * mode.damping_ratio);
  const Complex s(-mode.damping_ratio * size, 2.0 * pi * mode.frequency_Hz);
  Complex modulus = 1.0 - stress;
  Complex slope = 0.0;
  for (const MaterialTerm& t : terms) {
    modulus -= t.g / (1.0 + s * t.tau_s);
    slope += t.g * t.tau_s / ((1.0 + s * t.tau_s) * (1.0 + s * t.tau_s));
  }
  const double square = omega_0 * omega_0;
  return std::abs((s * s + square * modulus) / (2.0 * s + square * slope)) / size;
}

}  // namespace

TEST_CASE("damped rods and damped torsion have the modulus of their own complex frequency",
          "[pillar]") {
  const PillarGeometry geometry;
  const double L_m = geometry.length_m;
  // One term slower than the first mode, one between the modes, one quicker than all.
  const std::vector<MaterialTerm> terms = {{0.3, 0.3, 1e-5}, {0.2, 0.2, 1e-6}, {0.1, 0.1, 1e-8}};
  const Material alike = rod_material(0.0, terms);
  const double c_m_s = std::sqrt(alike.E0_Pa / alike.rho_kg_m3);
  const double pressure_Pa = GENERATE(0.0, 2e4, -1e5);
  const auto rod =
      modes_of_rod(alike, {.motion = Motion::kLongitudinal, .electrodes = {}}, 3, pressure_Pa);
  const auto twist =
      modes_of_rod(alike, {.motion = Motion::kTorsion, .electrodes = {}}, 3, pressure_Pa);
  for (int n = 0; n < 3; ++n) {
    CAPTURE(n, pressure_Pa);
    const auto at = static_cast<std::size_t>(n);
    const double k_1_m = (n + 0.5) * pi / L_m;
    // A uniform stress -p adds -p (d_z u)^2 (eq. 21): E and G are lowered by p.
    CHECK(misfit(rod[at], k_1_m * c_m_s, terms, pressure_Pa / alike.E0_Pa) < 1e-8);
    CHECK(misfit(twist[at], k_1_m * c_m_s * std::sqrt(0.5), terms,
                 2.0 * pressure_Pa / alike.E0_Pa) < 1e-8);
    CHECK(rod[at].damping_ratio > 0.01);
  }
}

TEST_CASE("torsion takes the shear modulus alone, and a free bar half waves", "[pillar]") {
  const std::vector<MaterialTerm> terms = {{0.5, 0.1, 2e-6}, {0.2, 0.4, 1e-7}};
  const Material material = rod_material(0.33, terms);
  const double c_m_s = std::sqrt(0.5 * material.E0_Pa / 1.33 / material.rho_kg_m3);
  const bool is_fixed = GENERATE(true, false);
  const auto modes = modes_of_rod(
      material, {.motion = Motion::kTorsion, .fixed_bottom = is_fixed, .electrodes = {}}, 3);
  for (int n = 0; n < 3; ++n) {
    CAPTURE(n, is_fixed);
    const double k_1_m = (n + (is_fixed ? 0.5 : 1.0)) * pi / PillarGeometry().length_m;
    CHECK(misfit(modes[static_cast<std::size_t>(n)], k_1_m * c_m_s, terms) < 1e-8);
  }
}

TEST_CASE("damped modes continue to the incompressible limit", "[pillar]") {
  const Motion motion = GENERATE(Motion::kLateral, Motion::kLongitudinal);
  const ModelOptions options{.motion = motion, .electrodes = {}};
  const auto limit = modes_of_rod(rod_material(0.5, {{0.5, 0.0, 2e-6}}), options, 2);
  const auto near = modes_of_rod(rod_material(0.4999, {{0.5, 0.0, 2e-6}}), options, 2);
  const auto farther = modes_of_rod(rod_material(0.4998, {{0.5, 0.0, 2e-6}}), options, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CAPTURE(i);
    // The distance to the limit is proportional to 1 - 2 nu.
    const double change_Hz = near[i].frequency_Hz - farther[i].frequency_Hz;
    CHECK(limit[i].frequency_Hz - near[i].frequency_Hz == Approx(change_Hz).epsilon(0.05));
    CHECK(limit[i].damping_ratio == Approx(near[i].damping_ratio).epsilon(1e-3));
    CHECK(limit[i].damping_ratio > 0.05);
  }
}

// Under a pressure the shape changes as the material relaxes, so that the basis must grow.
TEST_CASE("damped modes under a pressure continue to the incompressible limit", "[pillar]") {
  const ModelOptions options{.motion = Motion::kLateral, .electrodes = {}};
  const std::vector<MaterialTerm> terms = {{0.3, 0.0, 2e-6}, {0.2, 0.0, 2e-5}};
  const auto limit = modes_of_rod(rod_material(0.5, terms), options, 2, 1e4);
  const auto near = modes_of_rod(rod_material(0.4999, terms), options, 2, 1e4);
  for (std::size_t i = 0; i < 2; ++i) {
    CAPTURE(i);
    CHECK(limit[i].frequency_Hz == Approx(near[i].frequency_Hz).epsilon(2e-4));
    CHECK(limit[i].damping_ratio == Approx(near[i].damping_ratio).epsilon(1e-3));
  }
}

TEST_CASE("a mode that relaxation overdamps has no frequency", "[pillar]") {
  // s^3 tau + s^2 + omega^2 tau s + omega^2 (1 - g) has three real roots at omega tau = 0.435 and
  // g = 0.97 (its discriminant is positive), and a pair of complex ones at 4.35.
  const double omega = 0.5 * pi / PillarGeometry().length_m * std::sqrt(1.8e6 / 965.0 / 2.0);
  const ModelOptions torsion{.motion = Motion::kTorsion, .electrodes = {}};
  const auto creeping = modes_of_rod(rod_material(0.0, {{0.97, 0.97, 0.435 / omega}}), torsion, 1);
  CHECK(creeping.front().frequency_Hz == 0.0);
  const std::vector<MaterialTerm> slow = {{0.97, 0.97, 4.35 / omega}};
  const auto swinging = modes_of_rod(rod_material(0.0, slow), torsion, 1);
  CHECK(misfit(swinging.front(), omega, slow) < 1e-8);
}
