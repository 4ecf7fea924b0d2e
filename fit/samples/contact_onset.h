#pragma once

#include "fit/samples/fit_data.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// Contact as seen in the force record of a captured run alone. The surface position that the rig
// assumed during the run is not used, because it depends on a guess of the modulus.

// Force out of contact.
struct QuietForce {
  double before_N = 0.0;  // median before the first move
  double after_N = 0.0;   // median after the last move; before_N if nothing was recorded then
  // Standard deviation of one sample about a straight line through its stretch; not below the
  // converter's step/sqrt(12) if readings differ at all.
  double sigma_N = 0.0;
  std::size_t n = 0;  // number of samples used
};
QuietForce quiet_force(const IndentationData& data);

// Start of the first move and the stage position at first contact.
struct ContactOnset {
  double shift_s = 0.0;    // actual minus commanded start of the move
  double contact_m = 0.0;  // stage position
};

// Least-squares fit of a spring behind a gap, F = k max(0, z(t - shift) - contact), to the baseline
// and the first move: a grid search over all shifts that the clocks allow and all positions along
// the move, then finer grids around the best point. One sample under load is enough. Drift and
// noise change the result little, because both kinks of the force (contact, end of the move) count.
// Throws std::runtime_error if the force does not rise with the move.
ContactOnset contact_onset(const IndentationData& data);

// First move after which the punch is out of contact although the run meant to keep it: the force
// is back at its zero. Returns the index of the move in data.moves (at least 1), or nothing if
// contact was kept.
std::optional<std::size_t> first_lifting_move(const IndentationData& data);

// The same run without the samples in contact from that move on; samples out of contact stay.
IndentationData before_move(IndentationData data, std::size_t move);

// Where contact begins in a table of force and depth.
struct TableContact {
  bool is_fitted = false;
  double depth_m = 0.0;   // depth at which contact begins, counted as in the table
  std::size_t first = 0;  // first sample beyond it
};

// Depth at which the line through the loading curve (force^(1/power) over depth, between a fifth
// and four fifths of the force) meets zero force. The contact is fitted if samples precede that
// depth. Otherwise the table's zero of depth is used (or its first sample if it begins under load).
//   loaded: index of the last sample of loading.
//   power: the force grows with this power of the depth.
TableContact find_contact(const std::vector<double>& force_N, const std::vector<double>& depth_m,
                          std::size_t loaded, double power);

// A table of a capture also holds the touch that found the surface. That is an indentation of its
// own, which the model of a single ramp does not describe. Returns the first row after it, or 0.
std::size_t end_of_earlier_touch(const std::vector<double>& depth_m, std::size_t loaded,
                                 double contact_m);

}  // namespace viscard
