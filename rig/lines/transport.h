#pragma once

#include "rig/lines/rig_clock.h"

#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Bytes that arrived together; time_s is the rig time right after poll() reported them.
struct Chunk {
  double time_s = 0.0;
  std::string bytes;
};

// A byte stream to one device: a serial line, or a stand-in of a test.
class Transport {
 public:
  virtual ~Transport() = default;
  Transport& operator=(Transport&&) = delete;  // neither copied nor moved

  virtual std::string name() const = 0;
  virtual int baud() const = 0;
  // What to check if nothing, or nothing readable, comes: "is the baud rate of 115200 right?".
  virtual std::string question() const {
    return "is the baud rate of " + std::to_string(baud()) + " right?";
  }
  // For poll().
  virtual int descriptor() const = 0;
  // The bytes that have arrived, without waiting. Throws PortHungUp once the other end is gone and
  // all its bytes have been read.
  virtual Chunk read_available() = 0;
  // Returns when the operating system has taken all bytes. Throws PortHungUp, or RigError if that
  // takes longer than timeout_s of wall time.
  virtual void write(std::string_view bytes, double timeout_s = 0.5) = 0;
  // Opens the same path again after a hang-up, such as that of a USB plug with a loose contact. False
  // if nothing that can be opened is there (yet). Which device answers must be verified.
  virtual bool reopen() { return false; }
};

// Sleeps until one of the transports has bytes to read or hangs up, a signal arrives, or timeout_s
// of wall time is over. A rig that waits for this program goes on meanwhile, until it sends bytes on
// any line.
void wait_readable(const std::vector<const Transport*>& transports, const RigClock& clock,
                   double timeout_s);

}  // namespace viscard
