#pragma once

#include "fit/samples/fit_data.h"

#include <cstddef>
#include <optional>

namespace viscard {

// What the force record of a captured run says about contact by itself. The position the rig took
// for the surface while it ran is no part of it: that one leans on a guess of the modulus.

// Force out of contact.
struct QuietForce {
  double before_N = 0.0;  // median before the first move
  double after_N = 0.0;   // median after the last; before_N where nothing was recorded then
  double sigma_N = 0.0;   // of one sample about a straight line through its stretch; never 0 where
                          // readings differ at all (then at least the converter's step/sqrt(12))
  std::size_t n = 0;      // samples it was taken from
};
QuietForce quiet_force(const IndentationData& data);

// When the first move began and where on its way the punch touched.
struct ContactOnset {
  double shift_s = 0.0;    // of the move's start, against its command
  double contact_m = 0.0;  // stage position
};

// Least squares of a spring behind a gap, F = k max(0, z(t - shift) - contact), over baseline and
// first move: every shift the clocks allow by every position on the way, then finer about the best.
// Needs one sample under load only, and drift or noise move it little, as the force's two kinks
// (contact, end of the move) both count. Throws std::runtime_error if no force rises with the move.
ContactOnset contact_onset(const IndentationData& data);

// First move after which the punch hangs free, though the run meant to stay in contact: the force
// stands at its zero. Number of the move in data.moves, at least 1; nothing if contact was kept.
std::optional<std::size_t> first_lifting_move(const IndentationData& data);

// The same run up to that move; samples out of contact stay.
IndentationData before_move(IndentationData data, std::size_t move);

}  // namespace viscard
