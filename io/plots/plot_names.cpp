#include "io/plots/plot_names.h"

#include "io/basics/words.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kNameCharacter_px = 5.4;  // mean width of a character of the 9 px font
constexpr double kNameHeight_px = 11.0;
constexpr double kDot_px = 6.0;  // half the width of a large dot, with a gap

struct Box {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
};

// Where a dot stands in the panel, in px from its lower left corner.
struct Dot {
  double x_px = 0.0, y_px = 0.0;
};

// Boxes of a name around its dot, the best place first.
std::array<Box, 4> places_around(const Dot& dot, double length_px) {
  const auto box = [&](double left, double middle) {
    return Box{left, left + length_px, middle - 0.5 * kNameHeight_px,
               middle + 0.5 * kNameHeight_px};
  };
  const double beside = kDot_px + 1.0;
  const double over = kDot_px + 0.5 * kNameHeight_px;
  return {box(dot.x_px + beside, dot.y_px), box(dot.x_px - beside - length_px, dot.y_px),
          box(dot.x_px - 0.5 * length_px, dot.y_px + over),
          box(dot.x_px - 0.5 * length_px, dot.y_px - over)};
}

// A panel's dots in px, and the boxes that nothing may cover.
class NamePlacer {
 public:
  NamePlacer(const PanelSpans& spans, double width_px, double height_px)
      : spans_(spans), width_px_(width_px), height_px_(height_px) {}

  bool shows(const PlotSeries& series, std::size_t i) const {
    return can_show(spans_.x, series.x[i]) && can_show(spans_.y, series.y[i]);
  }
  void keep_dots_free(const PlotSeries& series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!shows(series, i)) continue;
      const Dot at = dot_of(series, i);
      taken_.push_back(
          {at.x_px - kDot_px, at.x_px + kDot_px, at.y_px - kDot_px, at.y_px + kDot_px});
    }
  }
  std::optional<PlacedName> place(const PlotSeries& series, std::size_t i) {
    const Dot dot = dot_of(series, i);
    const double length_px =
        kNameCharacter_px * static_cast<double>(length_in_characters(series.names[i]));
    for (const Box& box : places_around(dot, length_px)) {
      if (!is_free(box)) continue;
      taken_.push_back(box);
      return PlacedName{series.names[i],
                        series.x[i],
                        series.y[i],
                        box.left - dot.x_px,
                        0.5 * (box.bottom + box.top) - dot.y_px,
                        series.ink};
    }
    return std::nullopt;
  }

 private:
  Dot dot_of(const PlotSeries& series, std::size_t i) const {
    return {fraction_of(spans_.x, series.x[i]) * width_px_,
            fraction_of(spans_.y, series.y[i]) * height_px_};
  }
  bool is_free(const Box& box) const {
    return box.left >= 0.0 && box.right <= width_px_ && box.bottom >= 0.0 &&
           box.top <= height_px_ && std::none_of(taken_.begin(), taken_.end(), [&](const Box& one) {
             return box.overlaps(one);
           });
  }

  const PanelSpans& spans_;
  double width_px_, height_px_;
  std::vector<Box> taken_;
};

}  // namespace

std::vector<PlacedName> placed_names(const PlotPanel& panel, const PanelSpans& spans,
                                     double width_px, double height_px) {
  NamePlacer placer(spans, width_px, height_px);
  for (const PlotSeries& series : panel.series) {
    if (series.mark == Mark::kPoints) placer.keep_dots_free(series);
  }
  std::vector<PlacedName> placed;
  for (const PlotSeries& series : panel.series) {
    for (std::size_t i = 0; i < series.names.size(); ++i) {
      if (series.names[i].empty() || !placer.shows(series, i)) continue;
      if (auto name = placer.place(series, i)) placed.push_back(std::move(*name));
    }
  }
  return placed;
}

}  // namespace viscard
