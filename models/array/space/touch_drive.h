#pragma once

#include "models/pillar/time/load_history.h"
#include "models/pillar/time/readout.h"

#include <optional>
#include <vector>

namespace viscard {

// How a shape presses on an array in time, from rest.
struct SpaceTouch {
  bool is_creep = false;              // the history is that of the force, otherwise of the depth
  std::vector<HistoryPoint> history;  // N or m
  std::optional<Readout> readout;     // the circuit of each electrode; nothing: open electrodes
};

}  // namespace viscard
