#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/pillar_modes.h"
#include "tests/models/pillar/stability/stability_cases.h"

#include <cmath>

namespace viscard::test {
namespace {

const Discretisation kCoarse{.degree = 6, .layers = 3, .film_elements = 2};
const Discretisation kFine{.degree = 8, .layers = 5, .film_elements = 2};

// The same pillar measured in a unit of length of `unit_m`: kg, s and C stay.
struct Body {
  PillarGeometry geometry;
  PillarMedia media;
  double pressure;
};

Body pillar_on_film(double unit_m, double permittivity = 12.0) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << 23e-12, 23e-12, -33e-12, 0, 0, 0;
  const double per_stress = unit_m;                // Pa = kg/(m s2)
  const double per_density = std::pow(unit_m, 3);  // kg/m3
  const double epsilon = permittivity * kVacuumPermittivity_F_m * std::pow(unit_m, 3);
  Body body;
  body.geometry.diameter_m = 40e-6 / unit_m;
  body.geometry.length_m = 120e-6 / unit_m;
  body.geometry.film = FilmGeometry{25e-6 / unit_m, 60e-6 / unit_m};
  body.media.pillar = isotropic_medium(1.8e6 * per_stress, 0.49, 965.0 * per_density);
  body.media.film = piezo_medium(isotropic_moduli_Pa(2e9 * per_stress, 0.29), d * unit_m,
                                 epsilon * Eigen::Matrix3d::Identity(), 1780.0 * per_density);
  body.pressure = 1e4 * per_stress;
  return body;
}

PiezoAnswer answer(const Body& body, const Discretisation& mesh, double unit_m,
                   double radius_m = 20e-6) {
  const PillarModel model(body.geometry, mesh, body.media,
                          {.electrodes = ElectrodeOptions{FilmFace::kBottom, radius_m / unit_m}});
  return piezo_static(model, body.pressure);
}

double centre_V(const Discretisation& mesh) {
  const Body body = pillar_on_film(1.0);
  const PillarModel model(body.geometry, mesh, body.media,
                          {.electrodes = ElectrodeOptions{FilmFace::kTop, 0.0}});
  return potential_at_V(model, piezo_sampled(model, body.pressure), 0.0, -25e-6);
}

double lateral_Hz(double unit_m) {
  const Body body = pillar_on_film(unit_m);
  // Layers thinner than these would amplify the rounding of the matrix itself above 1e-10.
  const PillarModel model(body.geometry, {.degree = 4, .layers = 2}, body.media,
                          {.motion = Motion::kLateral});
  return lowest_modes(model, 1).front().frequency_Hz;
}

double reciprocity_error(double permittivity) {
  const Body body = pillar_on_film(1.0, permittivity);
  const PiezoAnswer a = answer(body, kCoarse, 1.0);
  const double force_N = -1e4 * std::acos(-1.0) * 400e-12;
  return std::abs(a.charge_C / force_N / a.displacement_per_V_m - 1.0);
}

}  // namespace

std::vector<StabilityCase> electric_and_unit_stability_cases() {
  constexpr double kMicrometre = 1e-6;
  return {
      {"electrode of the pillar's size: voltage",
       [] {
         const Body body = pillar_on_film(1.0);
         return std::abs(answer(body, kCoarse, 1.0).voltage_V / answer(body, kFine, 1.0).voltage_V -
                         1.0);
       },
       2e-3},
      {"electrode over the whole film: voltage",
       [] {
         const Body body = pillar_on_film(1.0);
         return std::abs(answer(body, kCoarse, 1.0, 60e-6).voltage_V /
                             answer(body, kFine, 1.0, 60e-6).voltage_V -
                         1.0);
       },
       2.5e-6},
      {"no electrode, a charge-free face: potential at the centre",
       [] { return std::abs(centre_V(kCoarse) / centre_V(kFine) - 1.0); }, 1e-4},
      {"sensor and actuator reciprocal, permittivity 12", [] { return reciprocity_error(12.0); },
       5e-13},
      {"sensor and actuator reciprocal, permittivity 1e6", [] { return reciprocity_error(1e6); },
       5e-13},
      {"micrometres or metres: lateral frequency",
       [] { return std::abs(lateral_Hz(1.0) / lateral_Hz(kMicrometre) - 1.0); }, 2.5e-11},
      {"micrometres or metres: top displacement",
       [] {
         return std::abs(
             answer(pillar_on_film(1.0), kCoarse, 1.0).top_displacement_m /
                 answer(pillar_on_film(kMicrometre), kCoarse, kMicrometre).top_displacement_m /
                 kMicrometre -
             1.0);
       },
       1.1e-11},
      {"micrometres or metres: voltage",
       [] {
         const double volt = kMicrometre * kMicrometre;  // V = kg m2/(s2 C)
         return std::abs(
             answer(pillar_on_film(1.0), kCoarse, 1.0).voltage_V /
                 (answer(pillar_on_film(kMicrometre), kCoarse, kMicrometre).voltage_V * volt) -
             1.0);
       },
       1.5e-11},
  };
}

}  // namespace viscard::test
