#pragma once

#include <cstdint>

namespace viscard::test {

// A machine on which a PointDispatcher hands out points. Times in s.
struct DispatchModel {
  int n_workers = 1;
  std::int64_t n_points = 1;
  double point_s = 1.0;    // mean time of one point
  double spread = 0.0;     // standard deviation of ln(time of a point)
  double latency_s = 0.0;  // of one message
  double service_s = 0.0;  // of the dispatcher for one answer: receive, keep, send the next point
};

struct DispatchTime {
  double wall_s = 0.0;
  double efficiency = 0.0;  // time of all points over that of all workers
  double busy = 0.0;        // share of the time in which the dispatcher works
};

// What the model's machine does with the product's dispatcher, event by event: a worker's answer travels,
// waits until the dispatcher has served those before it, and the next point travels back.
DispatchTime simulated_dispatch(const DispatchModel& model);

// Largest efficiency that any order of work allows: the dispatcher serves one answer at a time, so that
// n workers need at least n service_s for a point each.
double bound_of_efficiency(const DispatchModel& model);

}  // namespace viscard::test
