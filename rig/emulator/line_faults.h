#pragma once

namespace viscard {

// Probabilities of faults, for each piece of the stream that is passed on.
struct FaultRates {
  double drop = 0.0;       // a few of its bytes are lost
  double duplicate = 0.0;  // it is passed on twice
  double split = 0.0;      // its second half arrives some milliseconds later
  double delay = 0.0;      // it and everything after it arrive later
  double garble = 0.0;     // one digit becomes another, or one bit of another byte flips
  double insert = 0.0;     // a few bytes of noise are inserted
  double hang_up = 0.0;    // the line hangs up for good
};

struct FaultCounts {
  int pieces = 0;     // of the stream, passed on or not
  int faults = 0;     // of all kinds
  int corrupted = 0;  // faults that change a line: garbled, inserted or dropped bytes
  bool has_hung_up = false;
};

}  // namespace viscard
