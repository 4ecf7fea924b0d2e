#pragma once

#include "models/array/film/disc_coupling.h"
#include "models/array/film/film_table.h"
#include "models/array/film/layered_film.h"
#include "models/array/film/metal_quarters.h"
#include "models/array/space/foot_forces.h"
#include "models/maths/near_sums.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// How finely the potential of eq. S4 is integrated and tabled.
struct PotentialAccuracy {
  int film_degree = 8;       // elements across the film
  double largest_kt = 10.0;  // waves up to this over the thickness of all layers: the bottom face
                             // reads a wave as exp(-k t)
  double own_kt = 0.0;       // on the load's own axis: waves up to this; 0: no more than elsewhere
  int harmonics = 2;         // L: the film's answer over the angle has the harmonics 0, 2, ... 2 L
  double reach_m = 0.0;      // farthest point from the pillar's axis that is asked for
  double far_m = 0.0;        // on a backing, farthest pillar that is asked for (wide_table.h)
};

// The potential that one loaded pillar leaves on the face of the film that is read, in Fourier space
// (eq. S4): phi(r, alpha) = sum over waves and harmonics of amplitude J_m(k r) cos(m alpha), or
// sin(m alpha) for loads along y; m = 2 j under pressure, 2 j + 1 under the other loads.
struct PotentialSpectrum {
  // The amplitudes at one wave number.
  struct Wave {
    double k_1_m = 0.0;
    double weight_1_m2 = 0.0;   // k dk/(2 pi) of the quadrature
    Eigen::MatrixXd amplitude;  // V/Pa, weight included: j x loads
  };
  std::vector<Wave> waves;
  // Shorter waves that only matter on the load's own axis, where pressure alone gives a potential.
  struct OwnWave {
    double k_1_m = 0.0;
    double amplitude = 0.0;  // V/Pa, weight included
  };
  std::vector<OwnWave> own;
};

// The spectrum of a pillar with these forces at its foot, with waves as short as the accuracy takes.
PotentialSpectrum potential_spectrum(const LayeredFilm& film, const FootForces& foot,
                                     const PotentialAccuracy& accuracy);
// The additional short waves, beyond those of the other spectrum, that only matter on the load's
// own axis (eq. S6).
std::vector<PotentialSpectrum::OwnWave> own_waves(const LayeredFilm& film, const FootForces& foot,
                                                  const PotentialAccuracy& accuracy);

constexpr double kWavePhase = 5.0;  // largest radius times a panel of k
constexpr double kWaveStep = 0.7;   // panel of k times the thickness of the film
// Amplitude of each harmonic of the potential of one wave number, for every load (eq. S4), from what is
// read per unit (tau_x, tau_y, t_z) along the directions j pi/(2 L), j = 0 to L.
Eigen::MatrixXd harmonics_of(const std::vector<Eigen::Vector4d>& at_angles, const FootForces& foot,
                             double k_1_m);

// The part of the spectrum that is due to the charge on the pillar's own open electrode, whose net
// charge is zero (eq. S5); amplitudes by wave, j x loads.
std::vector<Eigen::MatrixXd> induced_amplitudes(const PotentialSpectrum& spectrum,
                                                const LayeredFilm& film, const DiscCharge& charge,
                                                const PotentialAccuracy& accuracy);

// The potential over the disc under the pillar as amplitudes of the polynomials of quarters of metal, V/Pa: functions x
// loads.
Eigen::MatrixXd disc_amplitudes(const PotentialSpectrum& spectrum, const MetalQuarters& quarters);
// The same part of the spectrum by these charges on the quarters (MetalQuarters::induced): functions x loads.
std::vector<Eigen::MatrixXd> induced_amplitudes(const PotentialSpectrum& spectrum,
                                                const LayeredFilm& film,
                                                const MetalQuarters& quarters,
                                                const Eigen::MatrixXd& charges,
                                                const PotentialAccuracy& accuracy);

// The potential around a loaded pillar, for electrodes that influence each other (coupled_discs.h).
AxialField field_around(const PotentialSpectrum& spectrum);

// Voltage of an open electrode per charge on another one at a given distance of the axes, divided
// by the voltage of that other one: the ratio p12/p11 of the coefficients of potential. Its square
// is the relative change of each other's readings by electrodes without net charge.
double mutual_influence(const LayeredFilm& film, const DiscCharge& charge, double distance_m,
                        const PotentialAccuracy& accuracy);
// Of equal discs at these points, the square of the largest sum over the others of p12/p11: what charges that are induced
// on the discs, and there induce others, add to a voltage at most, relative to the largest one. (An induced charge
// follows from the voltages around a disc and adds to the voltages around it; a load raises them farther out than a charge,
// which is a factor here.)
// Of many points, some of every part are tried.
double influence_of_all(const LayeredFilm& film, const DiscCharge& charge,
                        const std::vector<SourcePoint>& points, const PotentialAccuracy& accuracy);

}  // namespace viscard
