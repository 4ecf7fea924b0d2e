#pragma once

#include "models/array/contact/rigid_shape.h"
#include "models/array/contact/top_compliance.h"
#include "models/array/contact/top_pressure.h"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace viscard {

// The lowest point of a sphere or paraboloid over the top of a pillar, seen from the middle of the top.
struct RoundTip {
  double x_m = 0.0, y_m = 0.0;
  double radius_m = 0.0;
  bool is_sphere = false;
  double overlap_m = 0.0;  // how far it reaches below the unloaded top
};
// Nothing for other shapes, and where the tip does not lie over the top of radius R at (x, y), or above it.
std::optional<RoundTip> round_tip(const RigidShape& shape, double x_m, double y_m, double R_m,
                                  double depth_m);

// A contact that is small beside its top, as Hertz has it on the top's own half-space: a polar grid has too few points
// in it (eq. T11). The rest of the top yields by rho = u - u_half-space, which varies over the size of the top, so that
// pressures sqrt(1 - r^2/a^2) remain and the total energy
//   Phi(F, a) = F^2/2 [3/(5 E* a) + rho(a)] - F (delta - g(a))
// is least in F and a; g is the mean of the tip's height under that pressure, a^2/(5 R) of a paraboloid. rho(a) = rho_0 +
// rho_1 <r^2> + rho_2 <r^2>^2 is found from wider, smoother pressures that the grid resolves.
// Error: of the order (a/b)^4 with b the way from the tip to the rim of the top; nothing is answered from a = 0.25 b on,
// or for a tip nearer to the rim than 0.3 of the top's radius.
// Sources: Hertz, J. reine angew. Math. 92 (1882) 156; Johnson, Contact Mechanics (1985), 3.4 and 5.8.
std::optional<TopPressure> press_round_tip(
    const RoundTip& tip, const TopCompliance& top,
    const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces_N)>& motion);

}  // namespace viscard
