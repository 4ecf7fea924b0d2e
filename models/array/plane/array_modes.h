#pragma once

#include "models/array/plane/array_statics.h"

#include <vector>

namespace viscard {

// Modes of the whole row: one cluster of `count` for every mode of the single pillar.
struct ArrayMode {
  double frequency_Hz = 0.0;
  bool is_lateral = false;
  Eigen::VectorXd share;  // squared amplitude of each pillar; sums to 1
  Eigen::MatrixXd
      amplitude;  // of the modes on a fixed base (rows) of each pillar; squares sum to 1
  // Mean motion of each top, along x if lateral, else along z; the largest is 1.
  Eigen::VectorXd top;
};

// The lowest modes, `clusters` times the number of pillars of each family, ascending. With the
// inertia carried by the modes of the pillars on a fixed base, u = omega^2 A^-1 M u becomes the
// dense symmetric eigenproblem  G a = a/omega^2,  G the static compliance between the inertia ports
// of all pillars (eq. A2); clusters come out whole. The model must have inertia ports for at least
// twice the modes asked for; the film's own inertia is left out, see film_inertia_error(). Throws
// std::invalid_argument if the ports do not suffice.
std::vector<ArrayMode> array_modes(const ArrayModel& model, int clusters);

// Relative error of a frequency from leaving the film's inertia out: the film's share of the
// compliance, 1 - (f/f_fixed)^2, times (f/f_film)^2, with f_film = c_s/(4 t) the film's lowest
// shear resonance across its thickness (Graff, Wave Motion in Elastic Solids (1975), ch. 8).
double film_inertia_error(const ArrayModel& model, const ArrayMedia& media,
                          const std::vector<ArrayMode>& modes);

// Number of pillar modes that get ports, so that `clusters` of each family are among the lowest of
// them and the left-out ones have an effect only in the second order of the film's compliance.
int inertia_ports_for(int clusters);

}  // namespace viscard
