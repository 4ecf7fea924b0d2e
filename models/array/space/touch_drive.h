#pragma once

#include "models/pillar/time/load_history.h"
#include "models/pillar/time/readout.h"

#include <optional>
#include <utility>
#include <vector>

namespace viscard {

// How a shape presses on an array in time, from rest.
struct SpaceTouch {
  bool is_creep = false;  // the history is that of the force, otherwise of the depth
  Course history;         // N or m
  // Of a shape that moves: where its point (x, y) is at each point of the history, and on the straight line between
  // them; empty: it stays.
  std::vector<std::pair<double, double>> place_m;
  bool is_path() const { return !place_m.empty(); }
  std::optional<Readout> readout;  // the circuit of each electrode; nothing: open electrodes
};

}  // namespace viscard
