#pragma once

#include "io/plots/plot.h"

#include <string>
#include <vector>

namespace viscard {

// Where the data of one panel stand in the picture; px from its upper left corner.
struct PanelBox {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
  double key_top = 0.0;    // legend above the data
  double title_top = 0.0;  // title above the legend
  int key_columns = 1;
};

// Panels row by row; all panels of a row are equally high, those of a column equally wide. Throws
// std::invalid_argument if the picture is too small for them.
std::vector<PanelBox> panel_boxes(const Plot& plot);

// Number of characters of UTF-8 text.
std::size_t length_in_characters(const std::string& text);

}  // namespace viscard
