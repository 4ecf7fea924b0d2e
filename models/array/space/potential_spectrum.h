#pragma once

#include "models/array/space/disc_charge.h"
#include "models/array/space/foot_forces.h"
#include "models/array/space/layered_film.h"

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

// The part of the spectrum that comes from the charge which the pillar's own open electrode gains
// without a net charge (eq. S5); amplitudes by wave, j x loads.
std::vector<Eigen::MatrixXd> induced_amplitudes(const PotentialSpectrum& spectrum,
                                                const LayeredFilm& film, const DiscCharge& charge,
                                                const PotentialAccuracy& accuracy);

// Voltage of an open electrode per charge on another one at the distance between their axes, over the
// voltage of that one: the coefficient of potential p12/p11. Its square is what electrodes without net
// charge change in each other's readings.
double mutual_influence(const LayeredFilm& film, const DiscCharge& charge, double distance_m,
                        const PotentialAccuracy& accuracy);

}  // namespace viscard
