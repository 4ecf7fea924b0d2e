#pragma once

#include <string>
#include <vector>

namespace viscard {

// Closed-form limits of a pillar sensor: pillars of diameter d and length l stand at an
// edge-to-edge spacing s on a piezoelectric film of thickness t and carry a mean pressure p.

// The arrangement of the pillars determines their share of the area (README.md, eq. D1).
enum class Lattice {
  kSquare,     // unit cell (d + s)^2
  kHexagonal,  // unit cell sqrt(3)/2 (d + s)^2
  kPlain       // stress taken as p (1 + s/d)^2, without the factor of a circle in its cell
};

struct SensorMaterial {
  double young_modulus_Pa = 1.8e6;
  double poisson_ratio = 0.33;
  double surface_energy_J_m2 = 0.02;    // gamma, PDMS 0.0198 to 0.022
  double work_of_adhesion_J_m2 = 0.04;  // w, 2 gamma for equal surfaces
  double adhesion_strength_Pa = 4e4;    // sigma_th, beyond which a contact parts uniformly
  double charge_constant_C_N = 30e-12;  // |d33| of the film
  double relative_permittivity = 12.0;  // of the film, at constant stress
};

struct SensorRequirements {
  double pressure_Pa = 1e4;  // largest, mean over the sensor
  double end_factor = 1.0;   // K of Euler's formula: 0.5 clamped-clamped, 0.699, 1, 2 free
  Lattice lattice = Lattice::kSquare;
  double film_thickness_m = 25e-6;
  double smallest_feature_m = 10e-6;        // narrowest pillar and gap that can be made
  double largest_aspect_ratio = 10.0;       // l/d that can be demoulded
  double coarsest_pitch_m = 0.0;            // d + s the wanted resolution allows; 0: any
  double least_relative_sensitivity = 0.0;  // S_rel wanted; 0: any
};

struct SensorGeometry {
  double diameter_m = 40e-6;
  double spacing_m = 60e-6;
  double length_m = 120e-6;
};

// Pillar stress over mean pressure, from the balance of forces on a unit cell (eq. D1). It is also
// the sensitivity relative to a film without pillars.
double stress_concentration(double diameter_m, double spacing_m, Lattice lattice);

// Longest pillar before Euler buckling (eq. D2). Source: Timoshenko & Gere, Theory of Elastic
// Stability (1961), ch. 2. For slender pillars: at l = 3 d shear lowers the load by some per cent.
double longest_unbuckled_m(double diameter_m, double spacing_m, const SensorMaterial& material,
                           const SensorRequirements& requirements);

// Longest pillar that does not stick to its neighbour (matting, lateral collapse, eq. D3). Source:
// Glassmaker, Jagota, Hui & Kim, J. R. Soc. Interface 1 (2004) 23.
double longest_unmatted_m(double diameter_m, double spacing_m, const SensorMaterial& material);

// Longest pillar that does not lie down on the film (ground collapse, eq. D4). Source:
// Roca-Cusachs, Rico, Martinez, Toset, Farre & Navajas, Langmuir 21 (2005) 5542.
double longest_upright_m(double diameter_m, const SensorMaterial& material);

// Widest pillar whose contact parts at the adhesion strength and not by a crack from a flaw,
// d = 16 E* w/(pi sigma_th^2) (eq. D5). Source: Gao & Yao, PNAS 101 (2004) 7851.
double widest_flaw_insensitive_m(const SensorMaterial& material);

// Pull-off force of a flat pillar with a crack at its rim, sqrt(pi E* w d^3) (eq. D5). Source:
// Kendall, J. Phys. D 4 (1971) 1186.
double pull_off_force_N(double diameter_m, const SensorMaterial& material);

// V per Pa of mean pressure: g33 t times the stress concentration (eq. D6).
double sensitivity_V_Pa(double diameter_m, double spacing_m, const SensorMaterial& material,
                        const SensorRequirements& requirements);

// One limit on a design: the value it has and the one it may have.
struct DesignLimit {
  std::string name;  // buckling, matting, ground_collapse, flaw, feature, aspect_ratio, resolution,
                     // sensitivity
  double value = 0.0;
  double limit = 0.0;
  bool is_upper = true;  // value <= limit
  std::string unit;

  bool is_met() const { return is_upper ? value <= limit : value >= limit; }
  // Limit over value, or its inverse for a lower limit: below 1 the design fails.
  double margin() const { return is_upper ? limit / value : value / limit; }
};

// Throws std::invalid_argument naming the first input outside its range.
void validate(const SensorGeometry& geometry, const SensorMaterial& material,
              const SensorRequirements& requirements);
std::vector<DesignLimit> design_limits(const SensorGeometry& geometry,
                                       const SensorMaterial& material,
                                       const SensorRequirements& requirements);
bool is_admissible(const std::vector<DesignLimit>& limits);

// Longest admissible pillar at a diameter and spacing, and the limit that determines it; 0 if d or
// s alone violate a limit, with the first one they violate.
struct LongestPillar {
  double length_m = 0.0;
  std::string limited_by;
};
LongestPillar longest_pillar(double diameter_m, double spacing_m, const SensorMaterial& material,
                             const SensorRequirements& requirements);

}  // namespace viscard
