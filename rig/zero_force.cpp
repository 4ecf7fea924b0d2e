#include "rig/zero_force.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/run/rest_findings.h"

#include <cmath>
#include <vector>

namespace viscard {
namespace {

constexpr double kMean_s = 1.0;
constexpr std::size_t kFewestAtRest = 5;

double mean_force_N(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                    const Pump& pump) {
  double sum_N = 0.0;
  std::size_t n = 0;
  const double from_s = clock.now_s();
  load_cell.set_listener([&](const LoadSample& sample) {
    const auto force_N = force_N_from_sample(sample, rig);
    if (!force_N || sample.is_glitch || sample.is_saturated) return;
    if (load_cell.made_at_s(sample) < from_s) return;
    sum_N += *force_N;
    ++n;
  });
  while (clock.now_s() < from_s + kMean_s) pump();
  load_cell.set_listener({});
  if (n >= kFewestAtRest) return sum_N / static_cast<double>(n);
  throw RigError("only " + counted(n, "reading") +
                 " came in a second. Check the load cell with: viscard rig check");
}

}  // namespace

ZeroedForce zero_force(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                       const std::atomic<bool>* stop) {
  if (!load_cell.has_own_zero()) {
    throw RigError("a load cell with driver '" + rig.load_cell.driver +
                   "' has no zero that this program can set, and a test needs none: it measures "
                   "the force out of contact first and counts from there");
  }
  const Pump pump = [&] {
    wait_readable({&load_cell.transport()}, clock, 0.005);
    load_cell.service();
    if (stop != nullptr && *stop) throw RigError("the load cell was not zeroed: interrupted");
  };
  load_cell.connect(pump);
  ZeroedForce zeroed;
  zeroed.before_N = mean_force_N(load_cell, rig, clock, pump);
  for (const RestFinding& found : findings_at_rest({.force_N = zeroed.before_N}, rig)) {
    if (found.about == RestFinding::About::kForce) throw RigError(found.text);
  }
  load_cell.set_zero(pump);
  zeroed.after_N = mean_force_N(load_cell, rig, clock, pump);
  const double most_N = 0.01 * rig.calibration.capacity_N;
  if (std::abs(zeroed.after_N) <= most_N) return zeroed;
  throw RigError("the load cell reads " + text_from_number(zeroed.after_N, 4) +
                 " N after it was zeroed. Was it touched meanwhile? Otherwise zero_volts of the "
                 "calibration is not 0");
}

}  // namespace viscard
