#include "io/flow/sweep/point_dispatcher.h"

#include <algorithm>

namespace viscard {
namespace {

constexpr int kMostLosses = 2;  // workers that one point may take with it

}  // namespace

PointDispatcher::PointDispatcher(const std::vector<std::int64_t>& open, double lost_after_s)
    : open_(open.begin(), open.end()), lost_after_s_(lost_after_s) {}

void PointDispatcher::hear(int worker, double now_s) {
  lost_.erase(worker);
  last_heard_s_ = now_s;
  const auto work = busy_.find(worker);
  if (work != busy_.end()) work->second.heard_s = now_s;
}

std::optional<std::int64_t> PointDispatcher::ask(int worker, double now_s) {
  hear(worker, now_s);
  release(worker);
  if (open_.empty()) {
    if (std::find(waiting_.begin(), waiting_.end(), worker) == waiting_.end()) {
      waiting_.push_back(worker);
    }
    return std::nullopt;
  }
  const std::int64_t point = open_.front();
  open_.pop_front();
  busy_[worker] = {point, now_s};
  return point;
}

bool PointDispatcher::take(int worker, std::int64_t point, double now_s) {
  hear(worker, now_s);
  const auto work = busy_.find(worker);
  if (work != busy_.end() && work->second.point == point) busy_.erase(work);
  if (!answered_.insert(point).second) return false;
  if (losses_.count(point) == 0) return true;
  // The point had been taken from a silent worker, which now answers after all.
  given_up_.erase(point);
  const auto again = std::find(open_.begin(), open_.end(), point);
  if (again != open_.end()) open_.erase(again);
  return true;
}

// A worker that asks without an answer to its point has begun anew.
void PointDispatcher::release(int worker) {
  const auto work = busy_.find(worker);
  if (work == busy_.end()) return;
  const std::int64_t point = work->second.point;
  busy_.erase(work);
  if (answered_.count(point) == 0) open_.push_front(point);
}

std::vector<int> PointDispatcher::find_lost(double now_s) {
  std::vector<int> silent;
  for (const auto& [worker, work] : busy_) {
    if (now_s - work.heard_s > lost_after_s_) silent.push_back(worker);
  }
  for (const int worker : silent) {
    const std::int64_t point = busy_[worker].point;
    busy_.erase(worker);
    lost_.insert(worker);
    if (answered_.count(point) > 0) continue;
    if (++losses_[point] < kMostLosses) {
      open_.push_front(point);
    } else {
      given_up_.insert(point);
    }
  }
  return silent;
}

std::vector<DispatchedPoint> PointDispatcher::assign(double now_s) {
  std::vector<DispatchedPoint> work;
  while (!open_.empty() && !waiting_.empty()) {
    const int worker = waiting_.front();
    waiting_.pop_front();
    work.push_back({worker, *ask(worker, now_s)});
  }
  return work;
}

}  // namespace viscard
