#pragma once

#include "models/pillar/time/load_history.h"

#include <vector>

namespace viscard {

struct RelaxationDrive {
  std::vector<HistoryPoint> history;  // shortening, m
};

}  // namespace viscard
