#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// A point for a worker.
struct DispatchedPoint {
  int worker = 0;
  std::int64_t point = 0;
};

// Distributes the points of a study: each worker gets one point at a time and the next one when it
// has answered, so workers stay busy even if single points take long. A worker that is silent for
// too long counts as lost, and its point goes to another one. A point with which two workers were
// lost is not given to a third. The dispatcher has no clock, no threads and no messages: times are
// passed in, in seconds since it was made.
class PointDispatcher {
 public:
  // open: the points to answer, in this order. lost_after_s: silence after which a worker counts as
  // lost.
  PointDispatcher(const std::vector<std::int64_t>& open, double lost_after_s);

  // A sign of life from a worker.
  void hear(int worker, double now_s);
  // A worker is idle. It gets a point now, or from assign() later.
  std::optional<std::int64_t> ask(int worker, double now_s);
  // A worker has answered a point. Returns whether this is the point's first answer.
  bool take(int worker, std::int64_t point, double now_s);

  // Workers that have been silent for too long since the last call. Their points are open again.
  std::vector<int> find_lost(double now_s);
  // Open points for workers that wait for one.
  std::vector<DispatchedPoint> assign(double now_s);

  // True if no point is open or being answered.
  bool is_done() const { return open_.empty() && busy_.empty(); }
  // True if points are open, and nobody is at work or has been heard of for so long that all workers
  // count as lost.
  bool is_stuck(double now_s) const {
    return !open_.empty() && busy_.empty() && waiting_.empty() &&
           now_s - last_heard_s_ > lost_after_s_;
  }
  // Points with which two workers were lost, ascending.
  const std::set<std::int64_t>& given_up() const { return given_up_; }
  std::size_t n_lost() const { return lost_.size(); }  // workers that are silent now

 private:
  struct Work {
    std::int64_t point = 0;
    double heard_s = 0.0;
  };
  void release(int worker);

  std::deque<std::int64_t> open_;
  std::set<std::int64_t> answered_, given_up_;  // of those handed out
  std::map<int, Work> busy_;                    // by worker
  std::deque<int> waiting_;
  std::set<int> lost_;
  std::map<std::int64_t, int> losses_;  // workers lost with a point
  double lost_after_s_;
  double last_heard_s_ = 0.0;  // of any worker
};

}  // namespace viscard
