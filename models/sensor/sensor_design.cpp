#include "models/sensor/sensor_design.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kVacuumPermittivity_F_m = 8.8541878128e-12;  // CODATA 2018

double plane_modulus_Pa(const SensorMaterial& m) {
  return m.young_modulus_Pa / (1.0 - m.poisson_ratio * m.poisson_ratio);
}

// Limits that diameter and spacing meet or break at any length.
std::vector<DesignLimit> limits_in_plane(double diameter_m, double spacing_m,
                                         const SensorMaterial& m, const SensorRequirements& r) {
  std::vector<DesignLimit> limits = {
      {"flaw", diameter_m, widest_flaw_insensitive_m(m), true, "m"},
      {"feature", std::min(diameter_m, spacing_m), r.smallest_feature_m, false, "m"}};
  if (r.coarsest_pitch_m > 0.0) {
    limits.push_back({"resolution", diameter_m + spacing_m, r.coarsest_pitch_m, true, "m"});
  }
  if (r.least_relative_sensitivity > 0.0) {
    limits.push_back({"sensitivity", stress_concentration(diameter_m, spacing_m, r.lattice),
                      r.least_relative_sensitivity, false, ""});
  }
  return limits;
}

}  // namespace

double stress_concentration(double diameter_m, double spacing_m, Lattice lattice) {
  const double pitch = 1.0 + spacing_m / diameter_m;
  switch (lattice) {
    case Lattice::kSquare:
      return 4.0 / kPi * pitch * pitch;
    case Lattice::kHexagonal:
      return 2.0 * std::sqrt(3.0) / kPi * pitch * pitch;
    case Lattice::kPlain:
      return pitch * pitch;
  }
  throw std::invalid_argument("unknown lattice");
}

double longest_unbuckled_m(double diameter_m, double spacing_m, const SensorMaterial& m,
                           const SensorRequirements& r) {
  const double stress_Pa = r.pressure_Pa * stress_concentration(diameter_m, spacing_m, r.lattice);
  return kPi * diameter_m / (4.0 * r.end_factor) * std::sqrt(m.young_modulus_Pa / stress_Pa);
}

double longest_unmatted_m(double diameter_m, double spacing_m, const SensorMaterial& m) {
  const double gamma = m.surface_energy_J_m2;
  return std::pow(3.0 * std::pow(kPi, 4.0 / 3.0) / 128.0, 0.25) *
         std::pow(m.young_modulus_Pa / gamma, 0.25) *
         std::pow(plane_modulus_Pa(m) / gamma, 1.0 / 12.0) * std::pow(diameter_m, 5.0 / 6.0) *
         std::sqrt(spacing_m);
}

double longest_upright_m(double diameter_m, const SensorMaterial& m) {
  return std::pow(kPi, 5.0 / 3.0) / (std::pow(2.0, 11.0 / 3.0) * std::sqrt(3.0)) *
         std::pow(1.0 - m.poisson_ratio * m.poisson_ratio, -1.0 / 6.0) *
         std::pow(m.young_modulus_Pa / (2.0 * m.surface_energy_J_m2), 2.0 / 3.0) *
         std::pow(diameter_m, 5.0 / 3.0);
}

double widest_flaw_insensitive_m(const SensorMaterial& m) {
  return 16.0 * plane_modulus_Pa(m) * m.work_of_adhesion_J_m2 /
         (kPi * m.adhesion_strength_Pa * m.adhesion_strength_Pa);
}

double pull_off_force_N(double diameter_m, const SensorMaterial& m) {
  return std::sqrt(kPi * plane_modulus_Pa(m) * m.work_of_adhesion_J_m2 * diameter_m * diameter_m *
                   diameter_m);
}

double sensitivity_V_Pa(double diameter_m, double spacing_m, const SensorMaterial& m,
                        const SensorRequirements& r) {
  const double g33 = m.charge_constant_C_N / (m.relative_permittivity * kVacuumPermittivity_F_m);
  return g33 * r.film_thickness_m * stress_concentration(diameter_m, spacing_m, r.lattice);
}

void validate(const SensorGeometry& g, const SensorMaterial& m, const SensorRequirements& r) {
  require_positive("the diameter", g.diameter_m, "m");
  require_positive("the spacing", g.spacing_m, "m");
  require_positive("the length", g.length_m, "m");
  require_positive("Young's modulus", m.young_modulus_Pa, "Pa");
  require_value(m.poisson_ratio > -1.0 && m.poisson_ratio <= 0.5, "the Poisson ratio",
                m.poisson_ratio, "", "above -1 and at most 0.5");
  require_positive("the surface energy", m.surface_energy_J_m2, "J/m2");
  require_positive("the work of adhesion", m.work_of_adhesion_J_m2, "J/m2");
  require_positive("the adhesion strength", m.adhesion_strength_Pa, "Pa");
  require_positive("the charge constant", m.charge_constant_C_N, "C/N");
  require_positive("the relative permittivity", m.relative_permittivity);
  require_positive("the pressure", r.pressure_Pa, "Pa");
  require_value(r.end_factor >= 0.5 && r.end_factor <= 2.0, "the end factor K", r.end_factor, "",
                "from 0.5 (both ends held) to 2 (one end free)");
  require_positive("the film thickness", r.film_thickness_m, "m");
  require_positive("the smallest feature", r.smallest_feature_m, "m");
  require_positive("the largest aspect ratio", r.largest_aspect_ratio);
  require_not_negative("the pitch (0: any)", r.coarsest_pitch_m, "m");
  require_not_negative("the sensitivity (0: any)", r.least_relative_sensitivity);
}

std::vector<DesignLimit> design_limits(const SensorGeometry& g, const SensorMaterial& m,
                                       const SensorRequirements& r) {
  validate(g, m, r);
  std::vector<DesignLimit> limits = {
      {"buckling", g.length_m, longest_unbuckled_m(g.diameter_m, g.spacing_m, m, r), true, "m"},
      {"matting", g.length_m, longest_unmatted_m(g.diameter_m, g.spacing_m, m), true, "m"},
      {"ground_collapse", g.length_m, longest_upright_m(g.diameter_m, m), true, "m"},
      {"aspect_ratio", g.length_m / g.diameter_m, r.largest_aspect_ratio, true, ""}};
  for (DesignLimit& limit : limits_in_plane(g.diameter_m, g.spacing_m, m, r)) {
    limits.push_back(std::move(limit));
  }
  return limits;
}

bool is_admissible(const std::vector<DesignLimit>& limits) {
  return std::all_of(limits.begin(), limits.end(), [](const DesignLimit& l) { return l.is_met(); });
}

LongestPillar longest_pillar(double diameter_m, double spacing_m, const SensorMaterial& m,
                             const SensorRequirements& r) {
  for (const DesignLimit& limit : limits_in_plane(diameter_m, spacing_m, m, r)) {
    if (!limit.is_met()) return {0.0, limit.name};
  }
  LongestPillar best{std::numeric_limits<double>::infinity(), ""};
  const auto consider = [&](const char* name, double length_m) {
    if (length_m < best.length_m) best = {length_m, name};
  };
  consider("buckling", longest_unbuckled_m(diameter_m, spacing_m, m, r));
  consider("matting", longest_unmatted_m(diameter_m, spacing_m, m));
  consider("ground_collapse", longest_upright_m(diameter_m, m));
  consider("aspect_ratio", r.largest_aspect_ratio * diameter_m);
  return best;
}

}  // namespace viscard
