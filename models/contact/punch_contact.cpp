#include "models/contact/punch_contact.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {
namespace {

void validate_tip(const PunchContact& contact) {
  const bool is_cone = contact.shape == TipShape::kCone;
  if (is_cone) {
    const double angle_rad = contact.half_angle_rad;
    require_value(angle_rad > 0.0 && angle_rad < std::numbers::pi / 2, "half-angle of the cone",
                  angle_rad * 180.0 / std::numbers::pi, "degrees", "between 0 and 90");
  }
  const std::string name = is_cone ? "cone" : "sphere";
  require(!(contact.layer_thickness_m > 0.0),
          "a " + name +
              " on a bonded layer has no correction here; if the specimen is much thicker than the "
              "contact is wide, set layer_thickness = \"half-space\"");
  require(!contact.is_sticking, "a sticking " + name +
                                    " has no formula here; remove sticking (at nu = 0.5 it makes "
                                    "no difference)");
}

}  // namespace

void validate(const PunchContact& contact) {
  if (contact.shape != TipShape::kFlat) validate_tip(contact);
  if (contact.shape != TipShape::kCone) {
    require_positive("punch radius", contact.punch_radius_m, "m");
  }
  require_value(contact.layer_thickness_m >= 0.0, "layer thickness", contact.layer_thickness_m, "m",
                "positive, or 0 for a half-space");
  require_value(contact.poisson_ratio >= 0.0 && contact.poisson_ratio <= 0.5, "Poisson ratio",
                contact.poisson_ratio, "", "in [0, 0.5]");
}

double layer_factor(const PunchContact& contact) {
  const bool is_layer = contact.layer_thickness_m > 0.0;
  const double ratio = is_layer ? contact.punch_radius_m / contact.layer_thickness_m : 0.0;
  if (contact.is_sticking) return sticking_layer_factor(ratio, contact.poisson_ratio);
  return is_layer ? layer_factor(ratio, contact.poisson_ratio) : 1.0;
}

DepthLaw depth_law(const PunchContact& contact) {
  validate(contact);
  const double nu = contact.poisson_ratio;
  const double plane_strain = 1.0 / (1.0 - nu * nu);
  switch (contact.shape) {
    case TipShape::kFlat:
      return {2.0 * contact.punch_radius_m * layer_factor(contact) * plane_strain, 1.0};
    case TipShape::kSphere:
      return {4.0 / 3.0 * std::sqrt(contact.punch_radius_m) * plane_strain, 1.5};
    case TipShape::kCone:
      break;
  }
  return {2.0 / std::numbers::pi * std::tan(contact.half_angle_rad) * plane_strain, 2.0};
}

double force_per_modulus_and_depth_m(const PunchContact& contact) {
  require(
      contact.shape == TipShape::kFlat,
      "the force of a sphere or cone is not proportional to depth; a flat punch is needed here");
  return depth_law(contact).factor;
}

double relative_uncertainty(const PunchContact& contact) {
  const double nominal_m = depth_law(contact).factor;
  const auto change = [&](double PunchContact::*member, double uncertainty, double largest) {
    if (!(uncertainty > 0.0)) return 0.0;
    // One-sided difference if the other side would leave the valid range.
    PunchContact up = contact;
    PunchContact down = contact;
    up.*member = std::min(contact.*member + uncertainty, largest);
    down.*member = contact.*member - uncertainty;
    const double span = up.*member - down.*member;
    if (!(span > 0.0) || !(down.*member > 0.0)) return 0.0;
    const double slope_m = (depth_law(up).factor - depth_law(down).factor) / span;
    return slope_m * uncertainty / nominal_m;
  };
  constexpr double kNoLimit = 1e300;
  const double angle = change(&PunchContact::half_angle_rad, contact.half_angle_u_rad, kNoLimit);
  const double radius = change(&PunchContact::punch_radius_m, contact.punch_radius_u_m, kNoLimit);
  const double thickness =
      contact.layer_thickness_m > 0.0
          ? change(&PunchContact::layer_thickness_m, contact.layer_thickness_u_m, kNoLimit)
          : 0.0;
  const double poisson = change(&PunchContact::poisson_ratio, contact.poisson_ratio_u, 0.5);
  return std::sqrt(angle * angle + radius * radius + thickness * thickness + poisson * poisson);
}

}  // namespace viscard
