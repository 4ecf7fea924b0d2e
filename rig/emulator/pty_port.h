#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viscard {

// The device's end of a pseudo-terminal. A host opens path() as if it were a serial port.
class PtyPort {
 public:
  // Throws std::runtime_error when the system has no pseudo-terminal left.
  PtyPort();
  ~PtyPort();
  PtyPort& operator=(PtyPort&&) = delete;  // neither copied nor moved

  const std::string& path() const { return path_; }
  int descriptor() const { return master_; }
  bool is_open_by_host() const;

  std::string read_available();
  // Queues the bytes and sends as many as the host's side has room for; later calls send the rest.
  void write(std::string_view bytes);
  std::size_t n_sent() const { return n_sent_; }  // bytes, since the beginning
  bool has_unsent() const { return !unsent_.empty(); }
  // Drops unread bytes from the host and unsent bytes, as a reset does.
  void discard();
  // Pulls the cable: the host sees a hang-up.
  void hang_up();

  // From now on path() is a name that stays when the port comes back, as those in /dev/serial/by-id.
  void name_stably();
  // Plugs the cable in again; only a host that opens a stable name finds the port.
  void come_back();

 private:
  void open();

  std::string link_;  // the stable name; empty: none
  int master_ = -1;
  std::string path_;
  std::string unsent_;
  std::size_t n_sent_ = 0;
};

}  // namespace viscard
