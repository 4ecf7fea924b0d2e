#pragma once

#include "models/pillar/time/load_history.h"

#include <vector>

namespace viscard {

struct CreepDrive {
  std::vector<HistoryPoint> history;  // pressure on the top, Pa
};

}  // namespace viscard
