#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace viscard {

// A stream for a terminal: it hands on what is printed into it, with control characters as \x1b, so that no name of a
// file, header or cell moves the cursor, colours or clears. Line feeds and tabs stay. What the program itself says to
// the terminal goes through as AsItIs.
struct AsItIs;
class PrintableStream : public std::ostream {
 public:
  // sink must outlive it. is_buffered: as std::cout; otherwise all is handed on at once, as std::cerr does.
  explicit PrintableStream(std::ostream& sink, bool is_buffered = false);

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::ostream& sink) : sink_(sink) {}
    void print_as_it_is(const std::string& text);

   protected:
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int_type overflow(int_type c) override;
    int sync() override;

   private:
    std::ostream& sink_;
  };
  friend std::ostream& operator<<(std::ostream& out, const AsItIs& trusted);

  Buffer buffer_;
};

// Text of the program's own that may hold codes for the terminal.
struct AsItIs {
  std::string text;
};
std::ostream& operator<<(std::ostream& out, const AsItIs& trusted);

// Back to the begin of the line, and clears it.
inline constexpr const char* kEraseLine = "\r\033[K";

}  // namespace viscard
