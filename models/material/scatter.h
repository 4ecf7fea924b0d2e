#pragma once

#include "models/maths/interval.h"

#include <string>

namespace viscard {

// Scatter at one level of a campaign, as a standard deviation.
struct ScatterLevel {
  double deviation = 0.0;  // in the unit of the quantity
  Interval interval_95;
  int degrees_of_freedom = 0;  // 0: these records cannot identify the level
  std::string note;            // why it cannot be identified, or which other scatter it includes
};
// True if the records can identify the level.
inline bool is_identified(const ScatterLevel& level) {
  return level.degrees_of_freedom > 0;
}

// How one quantity scatters between repeated touches on one specimen, between specimens of one
// mixing ratio, and between the ratios about the law. The known error of each record's own fit is
// in none of them.
struct Scatter {
  std::string quantity;    // "ln_E0" or "sum_g"
  double mean = 0.0;       // of all records
  double own_error = 0.0;  // median standard error of one record's own fit
  ScatterLevel touch, specimen, ratio;
};

}  // namespace viscard
