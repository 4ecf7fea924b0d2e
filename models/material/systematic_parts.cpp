#include "models/material/systematic_parts.h"

#include <cmath>

namespace viscard {
namespace {

double entry(const std::vector<double>& changes, std::size_t i) {
  return i < changes.size() ? changes[i] : 0.0;
}

template <typename Change>
double root_of_squares(const std::vector<SystematicPart>& parts, const Change& change) {
  double square = 0.0;
  for (const SystematicPart& part : parts) square += std::pow(change(part), 2);
  return std::sqrt(square);
}

}  // namespace

std::vector<SystematicPart> systematic_parts_of(const MaterialUncertainty& uncertainty) {
  if (!uncertainty.systematic_parts.empty()) return uncertainty.systematic_parts;
  if (!(uncertainty.systematic_relative > 0.0)) return {};
  return {{"geometry, calibration, frame", uncertainty.systematic_relative, {}, {}}};
}

SeriesDirection direction_of(const PronySeries& series, const SystematicPart& part) {
  SeriesDirection direction = common_scale(series, part.E0);
  for (std::size_t i = 0; i < series.terms.size(); ++i) {
    const double change_Pa = series.terms[i].modulus_Pa * entry(part.g, i);
    direction.modulus_Pa[i] += change_Pa;
    direction.equilibrium_Pa -= change_Pa;
    direction.ln_tau[i] = entry(part.tau, i);
  }
  return direction;
}

double systematic_u_of_E0(const std::vector<SystematicPart>& parts) {
  return root_of_squares(parts, [](const SystematicPart& part) { return part.E0; });
}

double systematic_u_of_E_inf(const std::vector<SystematicPart>& parts, const PronySeries& series) {
  if (!(series.equilibrium_modulus_Pa > 0.0)) return 0.0;
  return root_of_squares(parts, [&](const SystematicPart& part) {
    return direction_of(series, part).equilibrium_Pa / series.equilibrium_modulus_Pa;
  });
}

double systematic_u_of_modulus(const std::vector<SystematicPart>& parts, std::size_t term) {
  return root_of_squares(parts,
                         [&](const SystematicPart& part) { return part.E0 + entry(part.g, term); });
}

double systematic_u_of_g(const std::vector<SystematicPart>& parts, std::size_t term) {
  return root_of_squares(parts, [&](const SystematicPart& part) { return entry(part.g, term); });
}

double systematic_u_of_tau(const std::vector<SystematicPart>& parts, std::size_t term) {
  return root_of_squares(parts, [&](const SystematicPart& part) { return entry(part.tau, term); });
}

}  // namespace viscard
