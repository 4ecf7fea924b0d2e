// The lines of a stream do not depend on how it is cut into reads, no line is longer than allowed,
// and nothing grows without end. The first byte is the seed of the cuts.
#include "rig/lines/line_splitter.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

std::vector<std::string> lines_of(viscard::LineSplitter& splitter) {
  std::vector<std::string> lines;
  while (auto line = splitter.next()) lines.push_back(line->text);
  return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  viscard::LineSplitter whole(64), pieces(64);
  whole.feed(bytes, 0.0);
  std::uint32_t random = data[0] + 1u;
  for (std::size_t at = 0; at < bytes.size();) {
    random = random * 1664525u + 1013904223u;
    const std::size_t n = 1 + (random >> 24) % 9;
    pieces.feed(std::string_view(bytes).substr(at, n), 0.0);
    at += n;
  }
  const std::vector<std::string> first = lines_of(whole), second = lines_of(pieces);
  if (first != second || whole.n_overlong() != pieces.n_overlong()) std::abort();
  for (const std::string& line : first) {
    if (line.size() > 64 || line.find_first_of("\r\n") != std::string::npos) std::abort();
  }
  return 0;
}
