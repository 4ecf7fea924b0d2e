#pragma once

namespace viscard {

// Shape of the tip.
enum class TipShape { kFlat, kSphere, kCone };

// A rigid tip that is pressed into a specimen.
// A flat punch of radius a, frictionless or sticking, on a layer of thickness H bonded to a rigid
// base (or on a half-space, thickness 0). The force is linear in depth, so the hereditary integral
// is exact:
//   F(t) = (2 a kappa(a/H, nu)/(1 - nu^2)) int E(t - s) d(depth)/ds ds   (eq. 8)
// Source: Sneddon, Int. J. Eng. Sci. 3 (1965) 47 for the half-space; layer_factor() for kappa.
// A frictionless sphere of radius R or cone of half-angle alpha on a half-space:
//   F(t) = (4 sqrt(R)/(3 (1 - nu^2))) int E(t - s) d(depth^(3/2))/ds ds          (eq. 31)
//   F(t) = (2 tan(alpha)/(pi (1 - nu^2))) int E(t - s) d(depth^2)/ds ds          (eq. 32)
// valid while the contact does not shrink: Lee & Radok, J. Appl. Mech. 27 (1960) 438; Ting, J.
// Appl. Mech. 33 (1966) 845. Elastic: Hertz; Sneddon (1965).
struct PunchContact {
  double punch_radius_m = 0.0;     // of a flat punch, or of the sphere
  double layer_thickness_m = 0.0;  // 0: half-space
  double poisson_ratio = 0.5;
  TipShape shape = TipShape::kFlat;
  double half_angle_rad = 0.0;  // of a cone, between its axis and its surface
  bool is_sticking = false;     // flat punch: no slip

  // Standard uncertainties of the inputs. They scale all moduli together, and no time.
  double punch_radius_u_m = 0.0;
  double layer_thickness_u_m = 0.0;
  double poisson_ratio_u = 0.0;   // a pure number
  double half_angle_u_rad = 0.0;  // of a cone
};

// Throws std::invalid_argument on a radius that is not positive, a negative thickness, a Poisson
// ratio outside [0, 0.5], a cone whose half-angle is not between 0 and 90 degrees, or a sphere or
// cone that sticks or presses on a layer, for which there is no formula here.
void validate(const PunchContact& contact);

// kappa of this contact; 1 for a frictionless punch on a half-space.
double layer_factor(const PunchContact& contact);

// F = factor * E * depth^power for an elastic specimen; factor in m^(2 - power).
struct DepthLaw {
  double factor = 0.0;  // m^(2 - power)
  double power = 1.0;   // 1 for a punch, 3/2 for a sphere, 2 for a cone
};
DepthLaw depth_law(const PunchContact& contact);

// F/(E depth) of a flat punch, 2a kappa/(1 - nu^2), m. Throws std::invalid_argument for other tips.
double force_per_modulus_and_depth_m(const PunchContact& contact);

// Relative standard uncertainty of DepthLaw::factor, to first order in those of the inputs.
double relative_uncertainty(const PunchContact& contact);

// kappa(a/H, nu): the force of a flat punch of radius a on a layer of thickness H bonded to a rigid
// base, over its force 2 a E h/(1 - nu^2) on a half-space   (eq. 9). Dimensionless; 1 for a/H -> 0.
// radius_over_thickness is a/H.
//
// The punch is frictionless. The dual integral equations of Hayes, Keer, Herrmann & Mockros, J.
// Biomech. 5 (1972) 541, are reduced to a Fredholm equation of the second kind and solved by
// Gauss-Legendre Nystrom collocation.
//
// Throws std::invalid_argument by require_layer(). Relative error below 1e-10 (compared with twice
// as many points). Takes about 0.5 ms.
double layer_factor(double radius_over_thickness, double poisson_ratio);

// The same for a punch that sticks to the layer (no slip), of radius_over_thickness a/H, also over the
// force of a frictionless punch on a half-space   (eq. 29). Pressure and radial shear are solved for by Galerkin's method
// in Hankel space. On the half-space the result is Mossakovskii's (1 - nu) ln(3 - 4 nu)/(1 - 2 nu),
// Appl. Math. Mech. (PMM) 18 (1954) 187 and 27 (1963) 418; Spence, Proc. R. Soc. A 305 (1968) 55.
// Throws likewise. Relative error below 2e-6 for a/H up to 2 and below 2e-5 up to 10 (tests).
// Takes about 10 ms.
double sticking_layer_factor(double radius_over_thickness, double poisson_ratio);

// Throws std::invalid_argument unless 0 <= radius_over_thickness <= 10 and 0 <= poisson_ratio <=
// 0.5, where the layer factors hold.
void require_layer(double radius_over_thickness, double poisson_ratio);

}  // namespace viscard
