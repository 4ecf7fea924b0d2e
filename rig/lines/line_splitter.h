#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

struct ReceivedLine {
  std::string text;     // without its terminator
  double time_s = 0.0;  // rig time at which its last byte can have arrived at the latest; never
                        // before that of the line before
};

// Cuts a byte stream into lines ended by CR, LF, CRLF or LFCR, however reads split it. A line
// longer than max_length is dropped up to its terminator and counted, so that a stream without any
// cannot fill the memory. Empty lines are kept (GRBL answers them); the second character of a pair
// makes none.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_length = 256) : max_length_(max_length) {}

  // byte_s is the time one byte takes on the wire (10/baud; 0 for none): bytes of one read share a
  // stamp, and a line with n bytes behind it must have been complete n byte times before.
  void feed(std::string_view bytes, double time_s, double byte_s = 0.0);
  std::optional<ReceivedLine> next();

  // Drops the line begun and what is queued: after opening, the first line may be half a line.
  void clear();

  std::size_t n_overlong() const { return n_overlong_; }
  std::size_t n_bytes() const { return n_bytes_; }
  // Share of the bytes that no text protocol sends: many of them mean a wrong baud rate.
  double unprintable_fraction() const;

 private:
  void end_line(double time_s);

  std::size_t max_length_;
  std::string begun_;
  bool is_overlong_ = false;
  char last_terminator_ = '\0';  // if the byte before was one, which
  std::deque<ReceivedLine> lines_;
  double last_line_s_ = -1e300;
  std::size_t n_overlong_ = 0;
  std::size_t n_bytes_ = 0;
  std::size_t n_unprintable_ = 0;
};

}  // namespace viscard
