#pragma once

namespace viscard {

// Rigid flat punch of radius a on a layer of thickness H bonded to a rigid base (or on a
// half-space, thickness 0), frictionless. Force follows depth linearly, so the hereditary integral
// is exact:
//   F(t) = (2 a kappa(a/H, nu)/(1 - nu^2)) int E(t - s) d(depth)/ds ds   (eq. 8)
// Source: Sneddon, Int. J. Eng. Sci. 3 (1965) 47 for the half-space; layer_factor.h for kappa.
struct PunchContact {
  double punch_radius_m = 0.0;
  double layer_thickness_m = 0.0;  // 0: half-space
  double poisson_ratio = 0.5;

  // Standard uncertainties of the inputs; they scale every modulus together and no time.
  double punch_radius_u_m = 0.0;
  double layer_thickness_u_m = 0.0;
  double poisson_ratio_u = 0.0;
};

// Throws std::invalid_argument on a radius that is not positive, a negative thickness, a Poisson
// ratio outside [0, 0.5], or a radius over thickness outside layer_factor()'s range.
void validate(const PunchContact& contact);

// kappa of this contact; 1 on a half-space.
double layer_factor(const PunchContact& contact);

// F/(E depth) = 2 a kappa/(1 - nu^2), m. Force in N = this * modulus in Pa * depth in m.
double force_per_modulus_and_depth_m(const PunchContact& contact);

// Relative standard uncertainty of that factor, first order in the three inputs' own.
double relative_uncertainty(const PunchContact& contact);

}  // namespace viscard
