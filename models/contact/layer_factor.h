#pragma once

namespace viscard {

// kappa(a/H, nu): the force of a flat punch of radius a on a layer of thickness H bonded to a rigid
// base, over its force 2 a E h/(1 - nu^2) on a half-space   (eq. 9). Dimensionless; 1 for a/H -> 0.
//
// The punch is frictionless. The dual integral equations of Hayes, Keer, Herrmann & Mockros, J.
// Biomech. 5 (1972) 541, are reduced to a Fredholm equation of the second kind and solved by
// Gauss-Legendre Nystrom collocation.
//
// Throws std::invalid_argument unless 0 <= radius_over_thickness <= 10 and 0 <= poisson_ratio <=
// 0.5. Relative error below 1e-10 (compared with twice as many points). Takes about 0.5 ms.
double layer_factor(double radius_over_thickness, double poisson_ratio);

// The same for a punch that sticks to the layer (no slip), also over the force of a frictionless
// punch on a half-space   (eq. 29). Pressure and radial shear are solved for by Galerkin's method
// in Hankel space. On the half-space the result is Mossakovskii's (1 - nu) ln(3 - 4 nu)/(1 - 2 nu),
// Appl. Math. Mech. (PMM) 18 (1954) 187 and 27 (1963) 418; Spence, Proc. R. Soc. A 305 (1968) 55.
// Same preconditions. Relative error below 2e-6 for a/H up to 2 and below 2e-5 up to 10 (tests).
// Takes about 10 ms.
double sticking_layer_factor(double radius_over_thickness, double poisson_ratio);

}  // namespace viscard
