#pragma once

namespace viscard {

enum class TipShape { kFlat, kSphere, kCone };

// A rigid tip pressed into a specimen. Flat punch of radius a on a layer of thickness H bonded to a
// rigid base (or on a half-space, thickness 0), frictionless or sticking. Force follows depth
// linearly, so the hereditary integral is exact:
//   F(t) = (2 a kappa(a/H, nu)/(1 - nu^2)) int E(t - s) d(depth)/ds ds   (eq. 8)
// Source: Sneddon, Int. J. Eng. Sci. 3 (1965) 47 for the half-space; layer_factor.h for kappa.
// Sphere of radius R and cone of half-angle alpha on a half-space, frictionless:
//   F(t) = (4 sqrt(R)/(3 (1 - nu^2))) int E(t - s) d(depth^(3/2))/ds ds          (eq. 31)
//   F(t) = (2 tan(alpha)/(pi (1 - nu^2))) int E(t - s) d(depth^2)/ds ds          (eq. 32)
// while the contact does not shrink: Lee & Radok, J. Appl. Mech. 27 (1960) 438; Ting, J. Appl.
// Mech. 33 (1966) 845; elastic: Hertz; Sneddon (1965).
struct PunchContact {
  double punch_radius_m = 0.0;     // of a flat punch, or of the sphere
  double layer_thickness_m = 0.0;  // 0: half-space
  double poisson_ratio = 0.5;
  TipShape shape = TipShape::kFlat;
  double half_angle_rad = 0.0;  // of a cone, between its axis and its flank
  bool is_sticking = false;     // flat punch: no slip under it

  // Standard uncertainties of the inputs; they scale every modulus together and no time.
  double punch_radius_u_m = 0.0;
  double layer_thickness_u_m = 0.0;
  double poisson_ratio_u = 0.0;
  double half_angle_u_rad = 0.0;
};

// Throws std::invalid_argument on a radius that is not positive, a negative thickness, a Poisson
// ratio outside [0, 0.5], a radius over thickness outside layer_factor()'s range, a cone whose
// half-angle is not between 0 and 90 degrees, or a sphere or cone on a layer or sticking: for those
// there is no such formula here.
void validate(const PunchContact& contact);

// kappa of this contact; 1 on a half-space.
double layer_factor(const PunchContact& contact);

// F = factor E depth^power for an elastic specimen, factor in m^(2 - power).
struct DepthLaw {
  double factor = 0.0;
  double power = 1.0;
};
DepthLaw depth_law(const PunchContact& contact);

// F/(E depth) of a flat punch; throws std::invalid_argument for other tips. = 2 a kappa/(1 - nu^2),
// m. Force in N = this * modulus in Pa * depth in m.
double force_per_modulus_and_depth_m(const PunchContact& contact);

// Relative standard uncertainty of that factor, first order in the three inputs' own.
double relative_uncertainty(const PunchContact& contact);

}  // namespace viscard
