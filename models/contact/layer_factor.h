#pragma once

namespace viscard {

// kappa(a/H, nu): force of a flat punch of radius a on a layer of thickness H bonded to a rigid
// base, over its force on a half-space, 2 a E h/(1 - nu^2)   (eq. 9). Dimensionless, 1 for a/H ->
// 0.
//
// Frictionless punch: the dual integral equations of Hayes, Keer, Herrmann & Mockros, J. Biomech. 5
// (1972) 541, become a Fredholm equation of the second kind, solved here by Gauss-Legendre Nystrom
// collocation.
//
// Preconditions: 0 <= radius_over_thickness <= 10, 0 <= poisson_ratio <= 0.5; otherwise throws
// std::invalid_argument. Relative error below 1e-10 (against twice as many points). About 0.5 ms.
double layer_factor(double radius_over_thickness, double poisson_ratio);

// The same for a punch that sticks to the layer (no slip under it), over the force of a
// frictionless punch on a half-space   (eq. 29). Pressure and radial shear come from Galerkin's
// method in Hankel space; on the half-space it is Mossakovskii's (1 - nu) ln(3 - 4 nu)/(1 - 2 nu),
// Appl. Math. Mech. (PMM) 18 (1954) 187 and 27 (1963) 418; Spence, Proc. R. Soc. A 305 (1968) 55.
// The same preconditions; relative error below 2e-6 for a/H up to 2, 2e-5 up to 10 (tests). About
// 10 ms.
double sticking_layer_factor(double radius_over_thickness, double poisson_ratio);

}  // namespace viscard
