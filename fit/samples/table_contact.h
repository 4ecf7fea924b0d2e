#pragma once

#include <cstddef>
#include <vector>

namespace viscard {

// Where contact begins in a table of force and depth.
struct TableContact {
  bool is_fitted = false;
  double depth_m = 0.0;   // where contact begins, in the table's own count
  std::size_t first = 0;  // first sample beyond it
};

// Where the line through the loading curve (force^(1/power) over depth) between a fifth and four
// fifths of the force meets zero force. With samples before that the contact is fitted; without,
// the table's own zero of depth holds (or its first sample, when the record begins under load).
//   loaded: number of the last sample of loading. power: of the depth that the force grows with.
TableContact find_contact(const std::vector<double>& force_N, const std::vector<double>& depth_m,
                          std::size_t loaded, double power);

// The table of a capture holds the touch that found the surface, too: an indentation of its own,
// which the model of the one ramp does not know. First row after it; 0 where there is none.
std::size_t end_of_earlier_touch(const std::vector<double>& depth_m, std::size_t loaded,
                                 double contact_m);

}  // namespace viscard
