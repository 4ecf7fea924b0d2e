#include "io/cards/plausible_card.h"

#include "io/cards/unit_system.h"

#include <fmt/format.h>

#include <string_view>

namespace viscard {
namespace {

std::optional<Doubt> doubt_of(const CardScale& scale, Plausible judged) {
  if (!(scale.modulus_Pa > 0.0)) return std::nullopt;
  if (const auto doubt = doubt_about(quantities::kModulus, scale.modulus_Pa, judged)) return doubt;
  return doubt_about(quantities::kDensity, scale.rho_kg_m3, judged);
}

// The card's numbers as another system means them.
CardScale read_in(const CardScale& scale, const UnitSystem& other) {
  const UnitSystem& own = *scale.read_in;
  return {from_card(scale.modulus_Pa, other.stress_exponent - own.stress_exponent),
          from_card(scale.rho_kg_m3, other.density_exponent - own.density_exponent), &other};
}

// The first other system in which a solid would have these numbers; empty if there is none.
std::string other_units(const CardScale& scale, Plausible judged) {
  for (const UnitSystem& other : unit_systems()) {
    if (std::string_view(other.name) == scale.read_in->name) continue;
    const CardScale meant = read_in(scale, other);
    if (doubt_of(meant, judged)) continue;
    return fmt::format(
        "; in {} the modulus is {}{} (--units {})", other.name,
        text_with_unit(meant.modulus_Pa, "Pa"),
        meant.rho_kg_m3 > 0.0 ? fmt::format(" and the density {:g} kg/m3", meant.rho_kg_m3) : "",
        other.name);
  }
  return "";
}

}  // namespace

std::optional<CardFinding> implausible_finding(const std::string& text, const CardScale& scale,
                                               Plausible judged) {
  if (text.find(kPlausibleOffText) != std::string::npos) return std::nullopt;
  const auto doubt = doubt_of(scale, judged);
  if (!doubt) return std::nullopt;
  const bool is_stiff = doubt_about(quantities::kModulus, scale.modulus_Pa, judged).has_value();
  std::string why =
      fmt::format("the {} of the card {}", is_stiff ? "modulus" : "density", doubt->text());
  if (scale.read_in != nullptr) why += other_units(scale, judged);
  if (doubt->sign.empty()) why += "; if the value is right, add --plausible off";
  return CardFinding{"implausible", why, true};
}

}  // namespace viscard
