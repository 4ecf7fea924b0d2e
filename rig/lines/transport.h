#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Bytes that arrived together; time_s is rig time, taken right after poll() said there was
// something.
struct Chunk {
  double time_s = 0.0;
  std::string bytes;
};

// A byte stream to one device: a serial line, or whatever a test puts in its place.
class Transport {
 public:
  virtual ~Transport() = default;
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  virtual std::string name() const = 0;
  virtual int baud() const = 0;
  // For poll().
  virtual int descriptor() const = 0;
  // What has arrived, without waiting; no bytes if nothing has.
  // Throws PortHungUp once the other end is gone and everything it sent has been read.
  virtual Chunk read_available() = 0;
  // Returns when all bytes are with the operating system. Throws PortHungUp, or RigError if that
  // takes longer than timeout_s (wall).
  virtual void write(std::string_view bytes, double timeout_s = 0.5) = 0;
};

// Sleeps until one of the transports has something to read (or hung up), a signal came, or
// timeout_s (wall) is over.
void wait_readable(const std::vector<const Transport*>& transports, double timeout_s);

}  // namespace viscard
