#include "rig/run/contact_estimate.h"

#include <algorithm>

namespace viscard {

ContactEstimate contact_from_stops(const JogEnd& before, const JogEnd& touched, double noise_N,
                                   double step_m, double guess_N_m) {
  constexpr double kFeltSigmas = 6.0;
  const double felt_N = kFeltSigmas * noise_N;
  const double way_m = touched.position_m - before.position_m;
  ContactEstimate estimate;
  estimate.position_m = touched.position_m - touched.force_N / guess_N_m;
  if (!(way_m > 0.0)) return estimate;
  const bool was_felt = before.force_N > felt_N;
  const double rise_N = touched.force_N - (was_felt ? before.force_N : 0.0);
  estimate.least_stiffness_N_m = std::max(0.0, rise_N - felt_N) / (way_m + step_m);
  if (!was_felt) {
    estimate.position_m = std::max(estimate.position_m, before.position_m);
  } else if (rise_N > felt_N) {
    estimate.position_m = touched.position_m - touched.force_N * way_m / rise_N;
  }
  return estimate;
}

}  // namespace viscard
