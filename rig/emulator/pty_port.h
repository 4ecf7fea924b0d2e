#pragma once

#include <string>
#include <string_view>

namespace viscard {

// The device's end of a pseudo-terminal: a host opens path() as if it were a serial port.
class PtyPort {
 public:
  // Throws std::runtime_error when the system has no pseudo-terminal left.
  PtyPort();
  ~PtyPort();
  PtyPort(const PtyPort&) = delete;
  PtyPort& operator=(const PtyPort&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return master_; }
  bool is_open_by_host() const;

  std::string read_available();
  // Queues the bytes and sends what the host's side has room for; the rest goes with later calls.
  void write(std::string_view bytes);
  bool has_unsent() const { return !unsent_.empty(); }
  // What the host wrote and has not been read, and what waits to be sent, is gone (as in a reset).
  void discard();
  // Pulls the cable: the host sees a hang-up. Nothing works any more afterwards.
  void hang_up();

 private:
  int master_ = -1;
  std::string path_;
  std::string unsent_;
};

}  // namespace viscard
