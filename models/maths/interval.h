#pragma once

namespace viscard {

// 95 % interval of one parameter, and how sure we are that it can be told at all.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

}  // namespace viscard
