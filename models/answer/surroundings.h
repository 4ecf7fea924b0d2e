#pragma once

#include <cmath>
#include <limits>

namespace viscard {

// What a scene stands in. NaN: not given. Without any of it, the scene has the temperature at which its material was
// measured and at which it was made, no weight and no air.
struct Surroundings {
  double temperature_C = std::numeric_limits<double>::quiet_NaN();
  double made_at_C = std::numeric_limits<double>::quiet_NaN();  // at which no part stresses another
  // By which the relaxation times of the scene's materials were multiplied for the temperature; 1: by none.
  double shift_factor = 1.0;
  double pillar_expansion_1_K = 0.0;  // linear thermal expansion
  double film_expansion_1_K = 0.0;
  double pyroelectric_C_m2K = 0.0;  // dD_z/dT of the film at constant stress
  double gravity_m_s2 = 0.0;        // along -z, toward the base
  bool air = false;
  // Of air at 20 degC and 101.325 kPa. Source: CRC Handbook of Chemistry and Physics, 97th ed. (2016), section 6.
  double air_density_kg_m3 = 1.204;
  double air_viscosity_Pa_s = 18.2e-6;

  // Since it was made; 0 unless both temperatures are given.
  double heated_K() const {
    const double difference_K = temperature_C - made_at_C;
    return std::isnan(difference_K) ? 0.0 : difference_K;
  }
  bool strains_by_heat() const {
    return heated_K() != 0.0 &&
           (pillar_expansion_1_K != 0.0 || film_expansion_1_K != 0.0 || pyroelectric_C_m2K != 0.0);
  }
};

}  // namespace viscard
