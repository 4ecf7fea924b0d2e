#include "rig/stages/travel_limit.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cmath>

namespace viscard {

void check_travel(double to_m, double start_m, double travel_m) {
  if (to_m <= start_m + travel_m) return;
  throw RigError("the move to " + text_from_number((to_m - start_m) * 1e3, 3) +
                 " mm goes beyond the stage's travel of " + text_from_number(travel_m * 1e3, 3) +
                 " mm from where it started. Bring the punch nearer to the specimen by hand, or "
                 "raise travel in the rig file");
}

double within_travel_m(double from_m, double to_m, const StageDynamics& dynamics) {
  constexpr double kSlack = 1e-6;  // of a step: rounding of the limits themselves
  const double slack_m = kSlack / dynamics.steps_per_m;
  if (from_m < dynamics.lowest_m - slack_m || from_m > dynamics.highest_m + slack_m) {
    throw RigError("the stage stands at " + text_from_number(from_m * 1e3, 3) +
                   " mm, outside of the travel that the controller allows ($20=1), so it "
                   "refuses every move. Home it (home = true under [stage] of the rig file), or "
                   "switch its soft limits off ($20=0)");
  }
  if (to_m < from_m && to_m < dynamics.lowest_m) {
    const double step = std::ceil(dynamics.lowest_m * dynamics.steps_per_m - kSlack);
    return std::min(from_m, step / dynamics.steps_per_m);
  }
  if (to_m > from_m && to_m > dynamics.highest_m + slack_m) {
    throw RigError("the move to " + text_from_number(to_m * 1e3, 3) +
                   " mm goes beyond the controller's own travel, which ends at " +
                   text_from_number(dynamics.highest_m * 1e3, 3) +
                   " mm ($20 and $130-132). Bring the punch nearer to the specimen by hand, or "
                   "correct these settings");
  }
  return to_m;
}

}  // namespace viscard
