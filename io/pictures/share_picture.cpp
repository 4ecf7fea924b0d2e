#include "io/pictures/share_picture.h"

#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace viscard {
namespace {

// Okabe & Ito, Color Universal Design (2008), then lighter ones; the list begins anew after its end.
constexpr std::array<const char*, 10> kPartColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                   "#e69f00", "#56b4e9", "#333333", "#8fb8d8",
                                                   "#e8a87c", "#7fc8b0"};
constexpr const char* kRestColour = "#cccccc";
constexpr double kRow = 26.0, kBar = 360.0, kTop = 34.0, kCharacter = 7.2;

double width_of(const std::string& text) {
  const auto n_letters =
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });  // UTF-8
  return kCharacter * static_cast<double>(n_letters);
}

const char* colour_of_part(std::size_t part) {
  return kPartColours[part % kPartColours.size()];
}

std::string box(double x, double y, double width, double height, const char* colour) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
      width, height, colour);
}

std::string words_at(double x, double y, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, y, escaped_markup(text));
}

std::string one_bar(const ShareBar& bar, double left, double y) {
  std::string svg = words_at(8.0, y + 14.0, bar.name);
  double x = left;
  for (std::size_t i = 0; i < bar.shares.size(); ++i) {
    const double width = kBar * std::clamp(bar.shares[i], 0.0, 1.0);
    svg += box(x, y, width, 18.0, colour_of_part(i));
    x += width;
  }
  if (x < left + kBar) svg += box(x, y, left + kBar - x, 18.0, kRestColour);
  return svg + words_at(left + kBar + 8.0, y + 14.0, bar.text);
}

}  // namespace

std::string svg_from_shares(const std::vector<std::string>& parts, const std::string& rest,
                            const std::vector<ShareBar>& bars, const std::string& title) {
  double names = 60.0, texts = 60.0;
  for (const ShareBar& bar : bars) {
    names = std::max(names, width_of(bar.name));
    texts = std::max(texts, width_of(bar.text));
  }
  const double left = names + 20.0;
  double y = kTop;
  std::string body = words_at(8.0, 20.0, title);
  for (const ShareBar& bar : bars) {
    body += one_bar(bar, left, y);
    y += kRow;
  }
  y += 8.0;
  double widest = left + kBar + texts + 20.0;
  for (std::size_t i = 0; i <= parts.size(); ++i) {
    const std::string& name = i < parts.size() ? parts[i] : rest;
    if (name.empty()) continue;
    body += box(left, y, 14.0, 14.0, i < parts.size() ? colour_of_part(i) : kRestColour);
    body += words_at(left + 20.0, y + 12.0, name);
    widest = std::max(widest, left + 40.0 + width_of(name));
    y += 20.0;
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" "
             "role=\"img\"><title>{2}</title>\n",
             widest, y + 8.0, escaped_markup(title)) +
         body + "</svg>\n";
}

}  // namespace viscard
