#include "io/pictures/colour_scale.h"

#include "io/pictures/picture_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {

// Anchors of viridis: Smith & van der Walt (2015); of the other: Moreland, ISVC (2009) 92.
std::string colour_of(double share, bool is_signed) {
  static const std::vector<std::array<double, 3>> kSize = {
      {68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  static const std::vector<std::array<double, 3>> kSigned = {
      {59, 76, 192}, {141, 176, 254}, {221, 221, 221}, {244, 152, 122}, {180, 4, 38}};
  const auto& anchors = is_signed ? kSigned : kSize;
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
  const double t = at - static_cast<double>(i);
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = static_cast<int>(std::lround(anchors[i][c] * (1.0 - t) + anchors[i + 1][c] * t));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string colour_bar(double x_px, double top_px, double height_px, bool is_signed,
                       const std::vector<ColourTick>& ticks) {
  std::string text;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    text += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"16\" height=\"{:.1f}\" fill=\"{}\"/>\n", x_px,
        top_px + height_px * (1.0 - (i + 1.0) / kSteps), height_px / kSteps + 0.5,
        colour_of((i + 0.5) / kSteps, is_signed));
  }
  for (const ColourTick& tick : ticks) {
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x_px + 22.0,
                        top_px + height_px * (1.0 - tick.share) + 4.0, with_minus(tick.text));
  }
  return text;
}

std::vector<double> round_ticks(double low, double high) {
  if (!(high > low)) return {low};
  const double rough = (high - low) / 4.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = (rough >= 5.0 * decade ? 5.0 : rough >= 2.0 * decade ? 2.0 : 1.0) * decade;
  std::vector<double> ticks;
  const double slack = 1e-9;  // ends that are round themselves belong to the ticks
  for (double n = std::ceil(low / step - slack); n <= high / step + slack; ++n) {
    ticks.push_back(n == 0.0 ? 0.0 : n * step);
  }
  return ticks;
}

}  // namespace viscard
