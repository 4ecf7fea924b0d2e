#pragma once

#include "fit/master_segments.h"
#include "fit/samples/fit_data.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// First values of the shifts of a master curve, and the relative scatter about the best spectrum.
struct MasterStart {
  std::size_t reference = 0;
  std::vector<double> ln_a;  // of all segments; the reference has 0
  std::vector<double> ln_b;  // levels of the segments about the best spectrum
  double noise = 0.0;
};

// Shifts every segment onto its neighbour, by equal moduli and by the least difference of the curves
// that overlap, and searches the constants of the Arrhenius and WLF laws from there. All are compared
// by the scatter about the best spectrum on a fixed grid of times. Segments that overlap neither way with those around the
// reference are left out and named; throws std::runtime_error if fewer than two remain.
MasterStart master_start(MasterSegments& all, const std::optional<double>& T_ref_C,
                         const FitOptions& options);

}  // namespace viscard
