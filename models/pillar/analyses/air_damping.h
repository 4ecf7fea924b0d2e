#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/scene/pillar_scene.h"

#include <complex>
#include <string>

namespace viscard {

// A long cylinder that vibrates in a viscous fluid at rest moves fluid with it. The force of the fluid over that of the
// cylinder's own inertia is (rho_air/rho) Gamma, with z = R sqrt(i omega rho_air/mu) and exp(i omega t):
//   sideways   Gamma = 1 + 4 K_1(z)/(z K_0(z))
//   along      Gamma = 2 K_1(z)/(z K_0(z))
//   turning    Gamma = 4 K_2(z)/(z K_1(z))   (eq. 22d)
//   ovalling   half of that sideways, as the harmonic 2 has in an ideal fluid (Lamb, Hydrodynamics (1932), 68)
// A small part -Im of it damps, the real part adds mass. Sources: Stokes, Trans. Camb. Phil. Soc. 9 (1851) 8;
// Rosenhead, Laminar Boundary Layers (1963), ch. 7 (sideways); the other two follow from the same equation.
enum class AirMotion { kSideways, kAlong, kTurning, kOvalling };
// `motion` at z; Re z > 0.
std::complex<double> air_factor(AirMotion motion, std::complex<double> z);

// What air does to one mode, pure numbers.
struct AirLoad {
  double damping_ratio = 0.0;    // added
  double frequency_share = 0.0;  // by which the frequency falls
};
AirLoad air_load(const PillarScene& scene, AirMotion motion, double frequency_Hz);
// Sideways at the first frequency of a clamped beam, the lowest of the pillar, where air counts most.
AirLoad air_load_of_slowest_mode(const PillarScene& scene);

// Air on the modes of one mesh. A mode of an elastic pillar gets the damping ratio of the air alone.
void add_air(const PillarScene& scene, SceneAnswer& answer);
// The errors of that: the formulas hold for a cylinder without ends, so that the share of the end faces, R/L, of what
// air does is unknown, and all of it for ovalling.
void add_air_errors(const PillarScene& scene, SceneAnswer& answer);

}  // namespace viscard
