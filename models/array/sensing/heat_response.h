#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace viscard {

// What conducts heat. Axis 3 of the film is z; it conducts alike in all directions.
struct HeatConductor {
  double conductivity_W_mK = 0.0;  // W/(m K)
  double capacity_J_m3K = 0.0;     // J/(m3 K), density times specific heat
};

// One pillar on a pyroelectric film on a base that stays cold; its sides and the film beside it lose no heat.
// The face of the film under the pillar is grounded, the other one carries no charge (eq. H1 to H3).
struct HeatPath {
  double radius_m = 0.0, length_m = 0.0;  // of the pillar
  HeatConductor pillar;
  double thickness_m = 0.0;  // of the film
  HeatConductor film;
  double pyroelectric_C_m2K = 0.0;  // dD_z/dT
  double permittivity_F_m = 0.0;    // along z and across, at constant stress
};

// A dummy electrode beside the sensor, whose voltage is subtracted: V = V_sensor - ratio V_dummy
// (eq. H4).
struct DummyElectrode {
  double ratio = 1.0;  // by which its voltage is multiplied
  double mismatch =
      0.0;  // relative difference of p t/eps of the two electrodes, which the ratio cannot correct
};

// Heat section of a scene: tops that are warmer than the base, at rest or from time 0 on.
struct HeatScene {
  double temperature_K = 0.0;  // of the tops above the base
  HeatConductor pillar, film;
  double pyroelectric_C_m2K = 0.0;  // dD_z/dT, C/(m2 K)
  std::optional<DummyElectrode> dummy;
  double end_time_s = 0.0;  // of a curve after the top has become warm; 0: none
};

// Weight of the potential under an electrode by wave number: 1 at wave number 0.
using ElectrodeWeight = std::function<double(double k_1_m)>;

// The steady state per kelvin at the top.
struct SteadyHeat {
  double foot_K_W = 0.0;    // thermal resistance, K/W: mean of the foot
  double pillar_K_W = 0.0;  // and along the pillar, K/W
  double foot_K = 0.0;      // mean temperature of the foot
  double own_V = 0.0;       // reading under the pillar, per kelvin at its top
  // Relative, of the numbers above: the change from a coarser quadrature, and from heat that enters the film
  // as through a foot of one temperature. That of a pillar lies between this and the even flux.
  double quadrature_error = 0.0, flux_error = 0.0;
};
SteadyHeat steady_heat(const HeatPath& path, const ElectrodeWeight& weight);

// Steady reading at a distance from the axis of a warm pillar, V/K.
double heat_at_distance_V(const HeatPath& path, const ElectrodeWeight& weight, double distance_m);

// Reading after the top's temperature has jumped by 1 K at time 0; times above 0. And its largest error.
struct HeatCurve {
  std::vector<double> value_V;
  double error_V = 0.0;
};
// At these times, s, all above 0.
HeatCurve heat_step(const HeatPath& path, const ElectrodeWeight& weight,
                    const std::vector<double>& time_s);

// Reading when pillar, film and base are all 1 K warmer: p t/eps.
double uniform_heat_V(const HeatPath& path);

// Times after which heat has passed through: t^2/(pi^2 a), or four times that if one face is
// insulated.
double film_time_s(const HeatPath& path);
double pillar_time_s(const HeatPath& path);

// What remains, with a dummy, of a temperature change of 1 K of everything, and of the touch's own
// heat if the dummy is `distance_m` away.
double drift_left_V(const HeatPath& path, const DummyElectrode& dummy);
// V per 1 K at the top.
double touch_left_V(const HeatPath& path, const ElectrodeWeight& weight,
                    const DummyElectrode& dummy, double distance_m);

}  // namespace viscard
