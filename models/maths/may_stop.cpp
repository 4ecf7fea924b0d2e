#include "models/maths/may_stop.h"

#include <utility>

namespace viscard {
namespace {

std::function<void()>& current_check() {
  thread_local std::function<void()> check;
  return check;
}

}  // namespace

StopCheck::StopCheck(std::function<void()> check) : outer_(current_check()) {
  current_check() = [inner = std::move(check), outer = outer_] {
    if (outer) outer();
    inner();
  };
}

StopCheck::~StopCheck() {
  current_check() = std::move(outer_);
}

void may_stop() {
  if (current_check()) current_check()();
}

}  // namespace viscard
