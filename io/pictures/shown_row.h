#pragma once

#include "models/array/plane/array_geometry.h"

#include <utility>
#include <vector>

namespace viscard {

inline constexpr double kRowWidth_px = 980.0;

// The pillars drawn and their middles. A long row shows its first and last ones, with a short gap.
struct ShownRow {
  std::vector<std::pair<int, double>> pillars;  // number from 1, middle in m
  double left_m = 0.0, right_m = 0.0;           // of the film
  double cut_m = 0.0;                           // middle of the gap
  bool is_cut = false;
};

ShownRow shown_row(const ArrayGeometry& g);

}  // namespace viscard
