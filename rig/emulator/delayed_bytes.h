#pragma once

#include <deque>
#include <string>
#include <utility>

namespace viscard {

// Bytes on their way to the other end of a line; they leave in the order in which they came.
class DelayedBytes {
 public:
  void add(double due_s, std::string bytes) { pieces_.push_back({due_s, std::move(bytes)}); }
  double last_due_s() const { return pieces_.empty() ? -1e300 : pieces_.back().due_s; }
  void clear() { pieces_.clear(); }

  // The bytes that are due at time_s, and not behind bytes that are not.
  std::string take_due(double time_s) {
    std::string bytes;
    for (; !pieces_.empty() && pieces_.front().due_s <= time_s; pieces_.pop_front()) {
      bytes += pieces_.front().bytes;
    }
    return bytes;
  }

 private:
  struct Piece {
    double due_s;
    std::string bytes;
  };
  std::deque<Piece> pieces_;
};

}  // namespace viscard
