#pragma once

#include <functional>

namespace viscard {

// Lets long work of this thread be ended from outside: `check` runs between its parts and throws what ends
// it, until this goes out of scope. Rooms that compute have no clock of their own.
class StopCheck {
 public:
  explicit StopCheck(std::function<void()> check);
  ~StopCheck();
  StopCheck(const StopCheck&) = delete;
  StopCheck& operator=(const StopCheck&) = delete;

 private:
  std::function<void()> outer_;
};

// Called between parts that take milliseconds: blocks of a factor, solutions.
void may_stop();

}  // namespace viscard
