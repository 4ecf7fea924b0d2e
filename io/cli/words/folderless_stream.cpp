#include "io/cli/words/folderless_stream.h"

#include "io/basics/written_path.h"

#include <cstddef>

namespace viscard {

FolderlessStream::FolderlessStream(std::ostream& sink) : std::ostream(nullptr), buffer_(sink) {
  rdbuf(&buffer_);
}

FolderlessStream::~FolderlessStream() {
  buffer_.finish();
}

void FolderlessStream::Buffer::finish() {
  sink_ << written_text(line_);
  line_.clear();
}

std::streamsize FolderlessStream::Buffer::xsputn(const char* text, std::streamsize size) {
  line_.append(text, static_cast<std::size_t>(size));
  const std::size_t end = line_.rfind('\n');
  if (end == std::string::npos) return size;
  sink_ << written_text(line_.substr(0, end + 1));
  line_.erase(0, end + 1);
  return sink_ ? size : 0;
}

FolderlessStream::Buffer::int_type FolderlessStream::Buffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char byte = traits_type::to_char_type(c);
  return xsputn(&byte, 1) == 1 ? c : traits_type::eof();
}

// A question that a person answers on the same line is flushed; it ends behind a word, as a folder does.
int FolderlessStream::Buffer::sync() {
  finish();
  return sink_.flush() ? 0 : -1;
}

}  // namespace viscard
