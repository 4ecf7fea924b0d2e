#include "tests/support/dispatch_model.h"

#include "io/flow/sweep/point_dispatcher.h"
#include "tests/support/random_draw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <random>
#include <vector>

namespace viscard::test {
namespace {

// A message on its way to the dispatcher.
struct Arrival {
  double at_s = 0.0;
  int worker = 0;
  std::optional<std::int64_t> answered;
  bool operator>(const Arrival& other) const { return at_s > other.at_s; }
};

}  // namespace

DispatchTime simulated_dispatch(const DispatchModel& model) {
  std::vector<std::int64_t> points(static_cast<std::size_t>(model.n_points));
  std::iota(points.begin(), points.end(), std::int64_t{0});
  PointDispatcher dispatcher(points, std::numeric_limits<double>::infinity());
  std::mt19937_64 random(1);
  Draw draw(random);
  const double median_s = model.point_s * std::exp(-0.5 * model.spread * model.spread);
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> arrivals;
  for (int worker = 0; worker < model.n_workers; ++worker) {
    arrivals.push({model.latency_s, worker, std::nullopt});
  }
  double free_s = 0.0, served_s = 0.0, work_s = 0.0;
  while (!arrivals.empty()) {
    const Arrival next = arrivals.top();
    arrivals.pop();
    free_s = std::max(free_s, next.at_s) + model.service_s;
    served_s += model.service_s;
    if (next.answered) dispatcher.take(next.worker, *next.answered, free_s);
    if (const auto point = dispatcher.ask(next.worker, free_s)) {
      const double time_s = median_s * std::exp(model.spread * draw.normal());
      work_s += time_s;
      arrivals.push({free_s + 2.0 * model.latency_s + time_s, next.worker, point});
    }
  }
  return {free_s, work_s / (free_s * model.n_workers), served_s / free_s};
}

double bound_of_efficiency(const DispatchModel& model) {
  return std::min(1.0, model.point_s / (model.n_workers * model.service_s));
}

}  // namespace viscard::test
