#include "models/pillar/analyses/wave_mesh.h"

#include "models/answer/scene_mistake.h"
#include "models/material/material.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// More elements than this, at the highest degree, would be too many unknowns.
constexpr double kMostCells = 400.0;
// Share of the tolerance to which a wave must have decayed before elements may grow.
constexpr double kLeftOfTolerance = 0.1;

struct Waves {
  double length_m = 0.0;   // of the bar's wave, which sets the size of elements
  double decay_1_m = 0.0;  // of the wave that decays slowest
};

Waves waves_at(const PillarScene& scene, double frequency_Hz) {
  const Material& m = scene.pillar;
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  const Complex s(0.0, omega);
  const RelativeModuli relative = relative_moduli(m.terms, s);
  const Complex G = m.E0_Pa / (2.0 * (1.0 + m.nu)) * relative.shear;
  const auto decay = [&](Complex modulus_Pa) {
    return std::abs((omega * std::sqrt(m.rho_kg_m3 / modulus_Pa)).imag());
  };
  Complex E = 3.0 * G;
  double slowest = decay(G);
  if (m.nu < 0.5) {  // an incompressible body has no pressure waves except the bar's
    const Complex K = m.E0_Pa / (3.0 * (1.0 - 2.0 * m.nu)) * relative.bulk;
    E = 9.0 * K * G / (3.0 * K + G);
    slowest = std::min(slowest, decay(K + 4.0 / 3.0 * G));
  }
  const double k_1_m = (omega * std::sqrt(m.rho_kg_m3 / E)).real();
  return {2.0 * std::numbers::pi / k_1_m, std::min(slowest, decay(E))};
}

// Number of elements on a line from its loaded end: equal ones over the skin, then growing ones.
double elements_over(double line_m, const WaveMesh& mesh) {
  if (mesh.skin_m == 0.0 || line_m <= mesh.skin_m) return line_m / mesh.longest_m;
  return mesh.skin_m / mesh.longest_m + std::log1p((line_m - mesh.skin_m) / mesh.longest_m);
}

double cells_of(const PillarScene& scene, const WaveMesh& mesh) {
  return elements_over(0.5 * scene.geometry.diameter_m, mesh) *
         elements_over(scene.geometry.length_m, mesh);
}

WaveMesh mesh_for(const PillarScene& scene, const std::vector<double>& frequencies_Hz) {
  WaveMesh mesh{.longest_m = std::numeric_limits<double>::infinity()};
  double slowest_1_m = std::numeric_limits<double>::infinity();
  for (const double frequency_Hz : frequencies_Hz) {
    const Waves waves = waves_at(scene, frequency_Hz);
    mesh.longest_m = std::min(mesh.longest_m, waves.length_m);
    slowest_1_m = std::min(slowest_1_m, waves.decay_1_m);
  }
  mesh.cells = cells_of(scene, mesh);
  WaveMesh skin = mesh;
  skin.skin_m = -std::log(kLeftOfTolerance * std::min(scene.tolerance, 1.0)) / slowest_1_m;
  skin.cells = std::isfinite(skin.skin_m) ? cells_of(scene, skin) : mesh.cells;
  return skin.cells < mesh.cells ? skin : mesh;
}

// The frequency up to which the whole body can be meshed, by bisection in its logarithm.
double highest_Hz(const PillarScene& scene, double refused_Hz) {
  double low = std::log(1e-12 * refused_Hz);
  double high = std::log(refused_Hz);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (mesh_for(scene, {std::exp(middle)}).cells > kMostCells ? high : low) = middle;
  }
  return std::exp(low);
}

}  // namespace

WaveMesh wave_mesh(const PillarScene& scene, const std::vector<double>& frequencies_Hz) {
  const std::vector<double>& f = frequencies_Hz;
  const WaveMesh mesh = mesh_for(scene, f);
  if (mesh.cells <= kMostCells) return mesh;
  constexpr double kUnknowns = 200.0;  // of an element of degree 10 with two fields
  const double unknowns = kUnknowns * mesh.cells;
  throw SceneMistake(
      "analysis.frequencies",
      "at " + text_of(f.back(), 4) + " Hz waves are " + micrometres(mesh.longest_m, 4) + " long, " +
          text_of(scene.geometry.length_m / mesh.longest_m, 4) +
          " to the length of the pillar and " +
          text_of(scene.geometry.diameter_m / mesh.longest_m, 4) +
          " to its diameter, and too little damped to die out near the load: that needs about " +
          text_of(mesh.cells, 2) + " elements with " + text_of(unknowns, 2) +
          " unknowns, more than the limit of " + text_of(kMostCells, 3) +
          " elements. The highest possible frequency of this pillar is " +
          text_of(highest_Hz(scene, f.back()), 4) +
          " Hz; a smaller pillar, or a material with more damping, allows a higher one");
}

}  // namespace viscard
