#include "models/pillar/body/section_grid.h"

#include <cmath>

namespace viscard {

std::array<double, 3> displacement_at(const SectionGrid& grid, const SectionField& field,
                                      std::size_t point, double theta) {
  const auto& [r, t, z] = field.value[point];
  const double m = grid.harmonic;
  const double radial = r * std::cos(m * theta);
  const double around = grid.harmonic == 0 ? t : t * std::sin(m * theta);
  return {radial * std::cos(theta) - around * std::sin(theta),
          radial * std::sin(theta) + around * std::cos(theta), z * std::cos(m * theta)};
}

double scalar_at(const SectionGrid& grid, const SectionField& field, std::size_t point,
                 double theta) {
  return field.value[point][0] * std::cos(grid.harmonic * theta);
}

}  // namespace viscard
