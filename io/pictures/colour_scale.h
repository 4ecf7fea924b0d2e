#pragma once

#include <string>
#include <vector>

namespace viscard {

// Colours for values, the same in all pictures: from dark to light for sizes (viridis), blue through
// white to red for signed values. Equal steps of the share look equally far apart. `share` is 0 to 1.
std::string colour_of(double share, bool is_signed);

struct ColourTick {
  double share = 0.0;
  std::string text;
};
// An upright bar of the colours, 16 pixels wide, with words beside it.
std::string colour_bar(double x_px, double top_px, double height_px, bool is_signed,
                       const std::vector<ColourTick>& ticks);

// Round numbers (1, 2 or 5 times a power of ten) from `low` to `high`, four to nine of them; the middle
// alone if the range is empty.
std::vector<double> round_ticks(double low, double high);

}  // namespace viscard
