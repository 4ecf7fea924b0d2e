#pragma once

#include <cstddef>
#include <vector>

namespace viscard {

// Where contact begins in a table of force and depth.
struct TableContact {
  bool is_fitted = false;
  double depth_m = 0.0;   // depth at which contact begins, counted as in the table
  std::size_t first = 0;  // first sample beyond it
};

// Depth at which the line through the loading curve (force^(1/power) over depth, between a fifth
// and four fifths of the force) meets zero force. The contact is fitted if there are samples before
// that depth. Otherwise the table's own zero of depth is used (or its first sample, if the record
// begins under load).
//   loaded: index of the last sample of loading.
//   power: the force grows with this power of the depth.
TableContact find_contact(const std::vector<double>& force_N, const std::vector<double>& depth_m,
                          std::size_t loaded, double power);

// A table of a capture also holds the touch that found the surface. That is an indentation of its
// own, which the model of a single ramp does not describe. Returns the first row after it, 0 if
// there is none.
std::size_t end_of_earlier_touch(const std::vector<double>& depth_m, std::size_t loaded,
                                 double contact_m);

}  // namespace viscard
