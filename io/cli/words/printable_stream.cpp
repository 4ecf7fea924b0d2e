#include "io/cli/words/printable_stream.h"

#include "io/basics/words.h"

#include <cstddef>
#include <string_view>

namespace viscard {

PrintableStream::PrintableStream(std::ostream& sink, bool is_buffered)
    : std::ostream(nullptr), buffer_(sink) {
  rdbuf(&buffer_);
  if (!is_buffered) setf(std::ios::unitbuf);
}

void PrintableStream::Buffer::print_as_it_is(const std::string& text) {
  sink_ << text;
}

std::streamsize PrintableStream::Buffer::xsputn(const char* text, std::streamsize size) {
  sink_ << with_shown_controls(std::string_view(text, static_cast<std::size_t>(size)));
  return sink_ ? size : 0;
}

// A single byte may be part of a character, which only the whole text shows.
PrintableStream::Buffer::int_type PrintableStream::Buffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char byte = traits_type::to_char_type(c);
  const bool is_part = (static_cast<unsigned char>(byte) & 0x80U) != 0;
  if (is_part) {
    sink_.put(byte);
  } else {
    sink_ << with_shown_controls(std::string_view(&byte, 1));
  }
  return sink_ ? c : traits_type::eof();
}

int PrintableStream::Buffer::sync() {
  return sink_.flush() ? 0 : -1;
}

std::ostream& operator<<(std::ostream& out, const AsItIs& trusted) {
  auto* const printable = dynamic_cast<PrintableStream::Buffer*>(out.rdbuf());
  if (printable == nullptr) return out << trusted.text;
  printable->print_as_it_is(trusted.text);
  return out;
}

}  // namespace viscard
