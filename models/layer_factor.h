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

}  // namespace viscard
