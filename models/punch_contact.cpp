#include "models/punch_contact.h"

#include "models/layer_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {

void validate(const PunchContact& contact) {
  if (!(contact.punch_radius_m > 0.0) || !std::isfinite(contact.punch_radius_m)) {
    throw std::invalid_argument("punch radius is " + std::to_string(contact.punch_radius_m) +
                                " m; it must be positive");
  }
  if (!(contact.layer_thickness_m >= 0.0) || !std::isfinite(contact.layer_thickness_m)) {
    throw std::invalid_argument("layer thickness is " + std::to_string(contact.layer_thickness_m) +
                                " m; it must be positive, or 0 for a half-space");
  }
  if (!(contact.poisson_ratio >= 0.0 && contact.poisson_ratio <= 0.5)) {
    throw std::invalid_argument("Poisson ratio is " + std::to_string(contact.poisson_ratio) +
                                "; it must lie in [0, 0.5]");
  }
}

double layer_factor(const PunchContact& contact) {
  if (contact.layer_thickness_m == 0.0) return 1.0;
  return layer_factor(contact.punch_radius_m / contact.layer_thickness_m, contact.poisson_ratio);
}

double force_per_modulus_and_depth_m(const PunchContact& contact) {
  validate(contact);
  const double nu = contact.poisson_ratio;
  return 2.0 * contact.punch_radius_m * layer_factor(contact) / (1.0 - nu * nu);
}

double relative_uncertainty(const PunchContact& contact) {
  const double nominal_m = force_per_modulus_and_depth_m(contact);
  const auto change = [&](double PunchContact::*member, double uncertainty, double largest) {
    if (!(uncertainty > 0.0)) return 0.0;
    // A one-sided difference where the other side leaves the valid range.
    PunchContact up = contact;
    PunchContact down = contact;
    up.*member = std::min(contact.*member + uncertainty, largest);
    down.*member = contact.*member - uncertainty;
    const double span = up.*member - down.*member;
    if (!(span > 0.0) || !(down.*member > 0.0)) return 0.0;
    const double slope_m =
        (force_per_modulus_and_depth_m(up) - force_per_modulus_and_depth_m(down)) / span;
    return slope_m * uncertainty / nominal_m;
  };
  constexpr double kNoLimit = 1e300;
  const double radius = change(&PunchContact::punch_radius_m, contact.punch_radius_u_m, kNoLimit);
  const double thickness =
      contact.layer_thickness_m > 0.0
          ? change(&PunchContact::layer_thickness_m, contact.layer_thickness_u_m, kNoLimit)
          : 0.0;
  const double poisson = change(&PunchContact::poisson_ratio, contact.poisson_ratio_u, 0.5);
  return std::sqrt(radius * radius + thickness * thickness + poisson * poisson);
}

}  // namespace viscard
