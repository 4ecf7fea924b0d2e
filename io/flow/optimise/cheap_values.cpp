#include "io/flow/optimise/cheap_values.h"

#include "io/flow/design/single_bodies.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/time/readout.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace viscard {
namespace {

// Euler-Bernoulli cantilever, (1.8751)^2/(2 pi) sqrt(E I/(rho A))/l^2. Timoshenko, Vibration Problems in
// Engineering.
double cantilever_Hz(const PillarScene& one) {
  const double d_m = one.geometry.diameter_m, l_m = one.geometry.length_m;
  const double radius_of_gyration_m = one.plane ? d_m / std::sqrt(12.0) : 0.25 * d_m;
  const double speed_m_s = std::sqrt(one.pillar.E0_Pa / one.pillar.rho_kg_m3);
  return 3.516 / (2.0 * std::numbers::pi) * speed_m_s * radius_of_gyration_m / (l_m * l_m);
}

double film_thickness_m(const Scene& scene) {
  if (const auto* row = std::get_if<ArrayScene>(&scene)) return row->geometry.film_thickness_m;
  if (const auto* array = std::get_if<SpaceScene>(&scene)) return array->film_thickness_m;
  const auto* pillar = std::get_if<PillarScene>(&scene);
  return pillar != nullptr && pillar->geometry.film ? pillar->geometry.film->thickness_m : 1.0;
}

// Corner frequency with the capacitance of a plate (eq. 23).
double plate_cut_off_Hz(const PillarScene& one) {
  if (!one.readout || !one.electrodes || !one.film || !one.geometry.film) return 1.0;
  const double r_m = one.electrodes->electrode_radius_m;
  const double capacitance_F = one.film->permittivity_F_m(2, 2) * std::numbers::pi * r_m * r_m /
                               one.geometry.film->thickness_m;
  const double T_s = readout_filter(*one.readout, capacitance_F).time_constant_s;
  return std::isinf(T_s) ? 1.0 : 1.0 / (2.0 * std::numbers::pi * T_s);
}

}  // namespace

double cheap_value(const RequirementKind& kind, const Scene& scene,
                   const Requirements& requirements) {
  const std::string key = kind.key;
  if (key == "pillars_per_tactel" || key == "resolved_wavelength" || key == "collapse_margin") {
    if (std::holds_alternative<LayerScene>(scene)) return 1.0;
    return kind.compute(scene, requirements, simulate).value;
  }
  const auto one = single_body(scene);
  const auto share = pressure_share(scene);
  if (!one || !share) return 1.0;
  if (key == "largest_pressure" || key == "largest_force") {
    PillarScene pressed = long_term_scene(*one);
    pressed.drive = BucklingDrive{requirements.top == "plate"};
    return engesser_pressure_Pa(pressed) / *share;
  }
  if (key == "bandwidth") return cantilever_Hz(*one);
  if (key == "nonlinearity") return *share / one->pillar.E0_Pa;
  if (key == "voltage_per_pressure") return *share * film_thickness_m(scene);  // eq. D6
  if (key == "lowest_frequency") {
    const auto* pillar = std::get_if<PillarScene>(&scene);
    return pillar == nullptr ? 1.0 : plate_cut_off_Hz(*pillar);
  }
  return 1.0;
}

}  // namespace viscard
