#include "io/flow/sweep/point_dispatcher.h"
#include "tests/support/dispatch_model.h"

#include <catch2/catch.hpp>

#include <map>
#include <random>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("each point goes to one worker, in order, and is answered once", "[scene][sweep]") {
  PointDispatcher dispatcher({3, 5, 8}, 10.0);
  CHECK(dispatcher.ask(1, 0.0) == std::optional<std::int64_t>(3));
  CHECK(dispatcher.ask(2, 0.0) == std::optional<std::int64_t>(5));
  CHECK(dispatcher.take(2, 5, 1.0));
  CHECK(dispatcher.ask(2, 1.0) == std::optional<std::int64_t>(8));
  CHECK(dispatcher.take(1, 3, 2.0));
  CHECK_FALSE(dispatcher.ask(1, 2.0));
  CHECK_FALSE(dispatcher.is_done());
  CHECK(dispatcher.take(2, 8, 3.0));
  CHECK(dispatcher.is_done());
}

TEST_CASE("the point of a silent worker goes to one that waits", "[scene][sweep]") {
  PointDispatcher dispatcher({3, 5}, 10.0);
  dispatcher.ask(1, 0.0);
  dispatcher.ask(2, 0.0);
  CHECK(dispatcher.take(2, 5, 8.0));
  CHECK_FALSE(dispatcher.ask(2, 8.0));
  CHECK(dispatcher.find_lost(9.0).empty());
  CHECK(dispatcher.assign(9.0).empty());
  CHECK(dispatcher.find_lost(11.0) == std::vector<int>{1});
  CHECK(dispatcher.find_lost(11.0).empty());
  const std::vector<DispatchedPoint> work = dispatcher.assign(11.0);
  REQUIRE(work.size() == 1);
  CHECK(work[0].worker == 2);
  CHECK(work[0].point == 3);
  CHECK(dispatcher.n_lost() == 1);
  // It answers after all; the other answer is the second one.
  CHECK(dispatcher.take(1, 3, 12.0));
  CHECK(dispatcher.n_lost() == 0);
  CHECK_FALSE(dispatcher.take(2, 3, 13.0));
  CHECK(dispatcher.is_done());
}

TEST_CASE("signs of life keep a slow worker", "[scene][sweep]") {
  PointDispatcher dispatcher({3}, 10.0);
  dispatcher.ask(1, 0.0);
  for (double now_s = 5.0; now_s < 100.0; now_s += 5.0) {
    dispatcher.hear(1, now_s);
    CHECK(dispatcher.find_lost(now_s + 1.0).empty());
  }
}

TEST_CASE("a point that two workers were lost with goes to no third one", "[scene][sweep]") {
  PointDispatcher dispatcher({3, 5}, 10.0);
  dispatcher.ask(1, 0.0);
  CHECK(dispatcher.find_lost(11.0) == std::vector<int>{1});
  CHECK(dispatcher.ask(2, 11.0) == std::optional<std::int64_t>(3));
  CHECK(dispatcher.find_lost(22.0) == std::vector<int>{2});
  CHECK(dispatcher.given_up() == std::set<std::int64_t>{3});
  CHECK(dispatcher.ask(3, 22.0) == std::optional<std::int64_t>(5));
  CHECK(dispatcher.take(3, 5, 23.0));
  CHECK(dispatcher.is_done());
}

TEST_CASE("without workers that live the dispatcher is stuck", "[scene][sweep]") {
  PointDispatcher dispatcher({3, 5}, 10.0);
  CHECK_FALSE(dispatcher.is_stuck(9.0));  // nobody has asked yet
  dispatcher.ask(1, 9.0);
  CHECK_FALSE(dispatcher.is_stuck(18.0));
  dispatcher.find_lost(20.0);
  CHECK(dispatcher.is_stuck(20.0));
  dispatcher.hear(1, 21.0);
  CHECK_FALSE(dispatcher.is_stuck(22.0));
}

TEST_CASE("workers may be lost at any time: every point is answered at least once, few twice",
          "[scene][sweep]") {
  const int n_workers = 20;
  std::vector<std::int64_t> points(2000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<std::int64_t>(i);
  PointDispatcher dispatcher(points, 10.0);
  std::mt19937 random(1);
  std::map<int, std::int64_t> at_work;
  std::map<std::int64_t, int> begun;
  std::set<int> dead;
  const auto begin = [&](int worker, const std::optional<std::int64_t>& point) {
    if (!point) return;
    at_work[worker] = *point;
    ++begun[*point];
  };
  for (int worker = 0; worker < n_workers; ++worker) begin(worker, dispatcher.ask(worker, 0.0));
  int n_first = 0;
  for (double now_s = 1.0; !dispatcher.is_done() && now_s < 1e4; now_s += 1.0) {
    for (int worker = 0; worker < n_workers; ++worker) {
      if (dead.count(worker) > 0 || at_work.count(worker) == 0) continue;
      if (now_s == 40.0 && worker < 6) dead.insert(worker);  // in the midst of a point
      if (dead.count(worker) > 0) continue;
      dispatcher.hear(worker, now_s);
      if (random() % 3 != 0) continue;
      const std::int64_t point = at_work[worker];
      at_work.erase(worker);
      n_first += dispatcher.take(worker, point, now_s) ? 1 : 0;
      begin(worker, dispatcher.ask(worker, now_s));
    }
    dispatcher.find_lost(now_s);
    for (const DispatchedPoint& work : dispatcher.assign(now_s)) begin(work.worker, work.point);
  }
  CHECK(dispatcher.is_done());
  CHECK(n_first == 2000);
  int n_twice = 0;
  for (const auto& [point, times] : begun) n_twice += times > 1 ? 1 : 0;
  CHECK(n_twice == 6);  // the points of the workers that died
}

TEST_CASE("the dispatcher keeps 1000 workers busy until its own work limits them",
          "[scene][sweep]") {
  DispatchModel model{.n_workers = 1000, .n_points = 40000, .point_s = 1.0, .spread = 0.5};
  model.latency_s = 50e-6;
  model.service_s = 100e-6;  // a tenth of the time of the dispatcher
  CHECK(simulated_dispatch(model).efficiency > 0.9);
  model.service_s = 5e-3;  // five times too slow
  const DispatchTime slow = simulated_dispatch(model);
  CHECK(bound_of_efficiency(model) == Approx(0.2));
  CHECK(slow.efficiency == Approx(0.2).epsilon(0.05));
  CHECK(slow.efficiency < 0.2 * 1.01);
  CHECK(slow.busy > 0.98);
}
