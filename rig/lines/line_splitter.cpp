#include "rig/lines/line_splitter.h"

#include <algorithm>
#include <utility>

namespace viscard {

void LineSplitter::feed(std::string_view bytes, double time_s, double byte_s) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    ++n_bytes_;
    const bool is_terminator = c == '\r' || c == '\n';
    if (!is_terminator) {
      const auto code = static_cast<unsigned char>(c);
      if ((code < 0x20 && c != '\t') || code >= 0x7f) ++n_unprintable_;
      last_terminator_ = '\0';
      if (begun_.size() < max_length_) {
        begun_ += c;
      } else {
        is_overlong_ = true;
      }
      continue;
    }
    // CRLF and LFCR end one line; CRCR and LFLF end two.
    if (last_terminator_ != '\0' && last_terminator_ != c) {
      last_terminator_ = '\0';
      continue;
    }
    last_terminator_ = c;
    end_line(time_s - byte_s * static_cast<double>(bytes.size() - 1 - i));
  }
}

void LineSplitter::end_line(double time_s) {
  // Bytes that arrived faster than the wire carries them (from a pseudo-terminal or an adapter's
  // buffer) would otherwise seem older than bytes read before them.
  last_line_s_ = std::max(last_line_s_, time_s);
  if (is_overlong_) {
    ++n_overlong_;
  } else {
    lines_.push_back({std::move(begun_), last_line_s_});
  }
  begun_.clear();
  is_overlong_ = false;
}

std::optional<ReceivedLine> LineSplitter::next() {
  if (lines_.empty()) return std::nullopt;
  ReceivedLine line = std::move(lines_.front());
  lines_.pop_front();
  return line;
}

double LineSplitter::unprintable_fraction() const {
  return n_bytes_ == 0 ? 0.0 : static_cast<double>(n_unprintable_) / static_cast<double>(n_bytes_);
}

std::string shown_bytes(std::string_view bytes, std::size_t most) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const char c : bytes.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_printable = (byte >= 0x20 && byte < 0x7f) || c == '\t';
    out += is_printable ? std::string(1, c)
                        : std::string("\\x") + kDigits[byte >> 4] + kDigits[byte & 15];
  }
  return out;
}

}  // namespace viscard
