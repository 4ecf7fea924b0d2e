#pragma once

#include "models/pillar/time/transient_request.h"

#include <vector>

namespace viscard {

// Times at which a step of a transient must end: the outputs, and the corners of the load.
struct TransientStop {
  double time_s = 0.0;
  bool is_output = false;
};
std::vector<TransientStop> stops_of(const TransientRequest& request);

// Load factor just after (before) a time that may be a jump.
double factor_at(const TransientRequest& request, double time_s, bool after);

// One interval between two stops: its length, and the factors at its ends, linear in between.
struct TransientPiece {
  double length_s = 0.0;
  double first = 0.0;
  double last = 0.0;
  bool ends_with_output = false;
};
std::vector<TransientPiece> pieces_of(const TransientRequest& request);

}  // namespace viscard
