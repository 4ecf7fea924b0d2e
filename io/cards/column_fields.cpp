#include "io/cards/column_fields.h"

#include "io/basics/number_text.h"
#include "io/cards/card_lines.h"

#include <fmt/format.h>

#include <utility>

namespace viscard {

std::vector<std::string> columns(const std::string& line, std::size_t width) {
  if (line.find(',') != std::string::npos) return cells(line, ',');
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin < line.size(); begin += width) {
    out.emplace_back(trimmed(std::string_view(line).substr(begin, width)));
  }
  return out;
}

std::string right(const std::string& text, int width) {
  return fmt::format("{:>{}}", text, width);
}

std::string real(double value, int width) {
  return right(nearest_number(value, width - 1), width);
}

std::string node_rows(int id_width, int width) {
  std::string out;
  for (int node = 1; node <= 8; ++node) {
    out += right(std::to_string(node), id_width);
    for (const int x : kCubeCorners[node - 1]) out += right(x == 0 ? "0.0" : "1.0", width);
    out += "\n";
  }
  return out;
}

std::string face_nodes(int face) {
  std::string out;
  for (const int node : kFaceNodes[face]) out += right(std::to_string(node), 10);
  return out + "\n";
}

std::string ramp_rows(const DeckInput& input) {
  const double top = input.pull();
  std::string out;
  for (const auto& [time, value] :
       {std::pair{0.0, 0.0}, std::pair{input.ramp(), top}, std::pair{2.0 * input.end(), top}}) {
    out += real(time, 20) + real(value, 20) + "\n";
  }
  return out;
}

}  // namespace viscard
