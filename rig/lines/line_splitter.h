#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// One line and when it arrived.
struct ReceivedLine {
  std::string text;     // without its terminator
  double time_s = 0.0;  // latest rig time at which its last byte can have arrived; ascending
};

// The first bytes of a line for a message: what is no printable ASCII is written as \xHH.
std::string shown_bytes(std::string_view bytes, std::size_t most = 60);

// Cuts a byte stream into lines ended by CR, LF, CRLF or LFCR, however reads split it. A line
// longer than max_length is dropped up to its terminator and counted, so that a stream without
// terminators cannot fill the memory. Empty lines are kept, because GRBL answers them; CRLF and
// LFCR end one line, not two.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_length = 256) : max_length_(max_length) {}

  // time_s: when the bytes were read. byte_s: time of one byte on the wire (10/baud, or 0). A line
  // with n bytes after it in the same read was complete n byte times earlier.
  void feed(std::string_view bytes, double time_s, double byte_s = 0.0);
  std::optional<ReceivedLine> next();

  std::size_t n_bytes() const { return n_bytes_; }
  std::size_t n_overlong() const { return n_overlong_; }  // lines that were dropped
  // Share of bytes that no text protocol sends; a large share means a wrong baud rate.
  double unprintable_fraction() const;

 private:
  void end_line(double time_s);

  std::size_t max_length_;
  std::string begun_;
  bool is_overlong_ = false;
  char last_terminator_ = '\0';  // the previous byte, if it was a terminator
  std::deque<ReceivedLine> lines_;
  double last_line_s_ = -1e300;
  std::size_t n_overlong_ = 0;
  std::size_t n_bytes_ = 0;
  std::size_t n_unprintable_ = 0;
};

}  // namespace viscard
