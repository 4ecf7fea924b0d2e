#pragma once

#include "fit/master_segments.h"
#include "fit/samples/fit_data.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// First values of the shifts of a master curve, and the relative scatter about the best spectrum.
struct MasterStart {
  std::size_t reference = 0;
  std::vector<double> ln_a;  // of all segments; the reference has 0
  std::vector<double> ln_b;  // levels of the segments about the best spectrum
  double noise = 0.0;
  bool is_as_given = false;  // the shifts are the given ones, with what follows from them
  // "0 C and 30 C": neighbours without a modulus in common, which only given shifts join.
  std::vector<std::string> apart;
  std::size_t n_overlaps = 0;  // other neighbours
};

// Shifts every segment onto its neighbour, by equal moduli and by the least difference of the curves
// that overlap, and searches the constants of the Arrhenius and WLF laws from there. All are compared
// by the scatter about the best spectrum on a fixed grid of times. Segments that overlap neither way with those around the
// reference are left out and named; throws std::runtime_error if fewer than two remain.
//
// Given shifts (MasterData::start_shifts) are compared with these, and taken unless the rows scatter
// clearly more about them. A segment without one follows its neighbour. They also keep segments
// without overlap. Throws std::runtime_error for one at a temperature that was not measured, a second one, and one
// other than 0 at the reference.
MasterStart master_start(MasterSegments& all, const MasterData& data, const FitOptions& options);

}  // namespace viscard
