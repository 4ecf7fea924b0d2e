#pragma once

#include "io/plots/plot_points.h"

#include <string>
#include <vector>

namespace viscard {

// A name beside a dot: from the dot to the left end of the text, px to the right and upward.
struct PlacedName {
  std::string text;
  double x = 0.0, y = 0.0;  // the dot
  double right_px = 0.0, up_px = 0.0;
  Ink ink = Ink::kBlack;
};

// The names of all dots of a panel for which there is room: within the panel, over no dot and no
// other name. To the right of the dot if possible, else to the left, above or below.
std::vector<PlacedName> placed_names(const PlotPanel& panel, const PanelSpans& spans,
                                     double width_px, double height_px);

}  // namespace viscard
