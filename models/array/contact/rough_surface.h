#pragma once

#include "models/array/contact/rigid_shape.h"

#include <cstdint>

namespace viscard {

// A rough surface: Gaussian heights of mean 0 with the correlation rms^2 exp(-(r/c)^2) between places r
// apart (eq. T4). A seed stands for one surface without end, of which a table is a part.
struct RoughSurface {
  double rms_m = 0.0;
  double correlation_length_m = 0.0;  // c
  std::uint64_t seed = 0;
};

// Lines of a table per correlation length; bilinear between them, a table lacks up to 1e-3 of the rms.
constexpr int kLinesPerCorrelation = 16;
// Most places of a table.
constexpr double kMostRoughPlaces = 4e6;

// What a table spans, m.
struct RoughExtent {
  double low_x_m = 0.0, high_x_m = 0.0, low_y_m = 0.0, high_y_m = 0.0;
};
// Places that the table of an extent would have.
double rough_places(const RoughSurface& surface, const RoughExtent& extent);

// Heights over the extent. Throws std::invalid_argument for lengths that are not positive or too many
// places.
HeightTable rough_heights(const RoughSurface& surface, const RoughExtent& extent);

}  // namespace viscard
