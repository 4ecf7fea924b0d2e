#pragma once

#include <vector>

namespace viscard {

// One reading of a calibration.
struct CellReading {
  double force_N = 0.0;
  double value = 0.0;   // reading
  double branch = 0.0;  // 1: the load rises to it, -1: it falls to it, 0: no load
  std::size_t series = 0;
};

// What the readings of a cell show besides a straight line.
struct CellShape {
  double per_N2 = 0.0, per_N2_se = 0.0;  // of a parabola, the same on the way up and down
  // What an open loop adds to the gain of a straight line through all readings, and did the readings show one?
  double of_loop = 0.0;
  bool has_loop = false;
  double scatter = 0.0;   // of one reading about parabola and loop; 0 if too few readings show it
  bool is_known = false;  // more readings than unknowns
};

// Least squares with a zero for each series, a slope, a parabola and, if the readings differ by more
// than chance between rising and falling load, a slope and a parabola of that difference. The
// largest load is reached from below only: a loop that does not close there tilts the straight line.
CellShape cell_shape(const std::vector<CellReading>& readings);

}  // namespace viscard
