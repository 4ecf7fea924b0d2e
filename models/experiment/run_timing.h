#pragma once

#include <string>
#include <vector>

namespace viscard {

// When the readings and moves of a captured run happened, on the run's host clock. Better than the
// receive times and the commanded starts, which are late and early by unknown delays.
struct RunTiming {
  std::vector<double> sample_s;      // of each load sample, in the order of the capture
  std::vector<double> move_start_s;  // of each move, in the order of the capture
  double move_speed = 1.0;           // true speed of all moves over the commanded one
  std::string description;           // one sentence: where these times come from
};

}  // namespace viscard
