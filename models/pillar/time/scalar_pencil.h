#pragma once

#include "models/material/material.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace viscard {

// Real relative moduli: the storage moduli at a frequency.
RelativeModuli storage_at(const std::vector<MaterialTerm>& terms, double omega_rad_s);
// d/ds of the relative moduli.
RelativeModuli slopes_at(const std::vector<MaterialTerm>& terms, std::complex<double> s);

// The moduli of a material of which only a share of every term relaxes: 1 + share (M~(s) - 1).
struct Softening {
  const std::vector<MaterialTerm>& terms;
  double share = 1.0;

  RelativeModuli at(std::complex<double> s) const;
  RelativeModuli slopes(std::complex<double> s) const;
};

// y' T(s) y of the eigenproblem of relaxed_modes.h for one vector y, as a function of s.
struct ScalarPencil {
  std::complex<double> elastic, shear, bulk, mass;

  std::complex<double> value(std::complex<double> s, const RelativeModuli& m) const {
    return elastic + m.shear * shear + m.bulk * bulk + s * s * mass;
  }
  std::complex<double> slope(std::complex<double> s, const RelativeModuli& m) const {
    return m.shear * shear + m.bulk * bulk + 2.0 * s * mass;
  }
};

// That of a body and one of its motions, y' T(s) y. The motion does not change the volume of an
// incompressible body.
ScalarPencil scalar_pencil(const ViscoelasticSystem& body, const Eigen::VectorXcd& motion);

// The root that Newton's method finds from s.
std::complex<double> root_near(const ScalarPencil& pencil, const Softening& moduli,
                               std::complex<double> s);

// True if a motion exp(s t) oscillates.
bool oscillates(std::complex<double> s);

// The oscillating root of a real vector, followed from the undamped one while the terms grow to
// their full shares; 0 if it stops oscillating on the way.
std::complex<double> oscillation_of(const ScalarPencil& pencil,
                                    const std::vector<MaterialTerm>& terms);

// The largest frequency at which the storage stiffness of a real vector balances its inertia,
// rad/s; 0 if there is none above a millionth of `start_rad_s`.
double storage_frequency_rad_s(const ScalarPencil& pencil, const std::vector<MaterialTerm>& terms,
                               double start_rad_s);

}  // namespace viscard
