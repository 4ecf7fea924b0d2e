#include "rig/travel_limit.h"

#include "rig/rig_error.h"
#include "rig/text_number.h"

namespace viscard {

void check_travel(double to_m, double start_m, double travel_m) {
  if (to_m <= start_m + travel_m) return;
  throw RigError("the move to " + text_from_number((to_m - start_m) * 1e3, 3) +
                 " mm goes beyond the stage's travel of " + text_from_number(travel_m * 1e3, 3) +
                 " mm from where it started. Bring the punch nearer to the specimen by hand, or "
                 "raise travel in the rig file");
}

}  // namespace viscard
