#include "io/pictures/map_picture.h"

#include "io/pictures/colour_scale.h"
#include "io/pictures/force_arrows.h"
#include "io/pictures/picture_numbers.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace viscard {
namespace {

constexpr double kMapWidth_px = 640.0, kMapHeight_px = 620.0;
constexpr double kMapLeft_px = 52.0, kMapRight_px = 130.0, kAboveMap_px = 58.0, kBelowMap_px = 78.0;
constexpr int kMostDiscs = 20;  // rows and columns
constexpr int kColours = 129;   // of cells, which are drawn colour by colour; odd: zero has its own

// The values that the ends of the bar stand for.
struct MapRange {
  double low = 0.0, high = 0.0;  // low at the bottom of the bar
  bool is_signed = false;
  double share(double value) const { return high != low ? (value - low) / (high - low) : 0.5; }
};
MapRange map_range_of(const SceneMap& map) {
  const auto [low, high] = std::minmax_element(map.value.begin(), map.value.end());
  MapRange range{*low, *high};
  // Both signs have colours of their own unless one of them is next to nothing.
  constexpr double kNothing = 1e-3;
  const double size = largest_size(map.value);
  range.is_signed = *low<-kNothing * size&& * high> kNothing * size;
  if (range.is_signed) range.low = -size, range.high = size;
  // The lightest colour is that of the largest size, of either sign.
  if (!range.is_signed && *high < kNothing * size) std::swap(range.low, range.high);
  return range;
}

// The array with the film near its pillars: a wide film would leave them no room.
SceneArray near_pillars(SceneArray array) {
  constexpr double kMargin = 0.25;  // of the array's width
  double left_m = HUGE_VAL, right_m = -HUGE_VAL, low_m = HUGE_VAL, high_m = -HUGE_VAL;
  for (const ScenePillar& one : array.pillars) {
    left_m = std::min(left_m, one.x_m - 0.5 * one.diameter_m);
    right_m = std::max(right_m, one.x_m + 0.5 * one.diameter_m);
    low_m = std::min(low_m, one.y_m - 0.5 * one.diameter_m);
    high_m = std::max(high_m, one.y_m + 0.5 * one.diameter_m);
  }
  const double margin_m = std::max(kMargin * std::max(right_m - left_m, high_m - low_m),
                                   2.0 * std::max(array.cell_x_m, array.cell_y_m));
  array.left_m = std::max(array.left_m, left_m - margin_m);
  array.right_m = std::min(array.right_m, right_m + margin_m);
  array.low_m = std::max(array.low_m, low_m - margin_m);
  array.high_m = std::min(array.high_m, high_m + margin_m);
  return array;
}

class MapDrawing {
 public:
  MapDrawing(const SceneArray& whole, const SceneMap& map)
      : array_(near_pillars(whole)),
        is_cut_(array_.left_m > whole.left_m || array_.low_m > whole.low_m),
        map_(map),
        range_(map_range_of(map)),
        value_of_(whole.pillars.size(), -1) {
    for (std::size_t at = 0; at < map.pillar.size(); ++at) {
      value_of_[map.pillar[at]] = static_cast<int>(at);
    }
    const double room_x = kMapWidth_px - kMapLeft_px - kMapRight_px;
    const double room_y = kMapHeight_px - kAboveMap_px - kBelowMap_px;
    scale_ = std::min(room_x / (array_.right_m - array_.left_m),
                      room_y / (array_.high_m - array_.low_m));
    left_px_ = kMapLeft_px + 0.5 * (room_x - scale_ * (array_.right_m - array_.left_m));
  }

  // The shear of the pillars, over the map.
  void set_arrows(const SceneMap& along_x, const SceneMap& along_y) {
    const int most = std::max(array_.rows, array_.columns);
    per_block_ = is_grid() ? (most + kMostDiscs - 1) / kMostDiscs : 1;
    arrows_ = force_arrows(array_, along_x, along_y, per_block_);
  }

  std::string document(const std::string& title) {
    body_ += fmt::format(
        R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="#f4efe4" stroke="#7a5c1e"/>)"
        "\n",
        x(array_.left_m), y(array_.high_m), scale_ * (array_.right_m - array_.left_m),
        scale_ * (array_.high_m - array_.low_m));
    is_grid() ? draw_cells() : draw_discs();
    draw_arrows();
    draw_numbers();
    draw_bar();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" "
        "role=\"img\">\n<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<text x=\"12\" y=\"24\" font-size=\"15\">{2}</text>\n{3}"
        "<text x=\"12\" y=\"{4:.0f}\" fill=\"#444\">{5}</text>\n</svg>\n",
        kMapWidth_px, kMapHeight_px, escaped_markup(title), body_, kMapHeight_px - 12.0, legend());
  }

 private:
  double x(double m) const { return left_px_ + scale_ * (m - array_.left_m); }
  double y(double m) const { return kAboveMap_px + scale_ * (array_.high_m - m); }
  // Lists of places have one column; only lattices fill their cells.
  bool is_grid() const {
    return array_.columns > 1 && std::max(array_.rows, array_.columns) > kMostDiscs;
  }
  // NaN for a pillar that the map has no value of.
  double value(std::size_t pillar) const {
    return value_of_[pillar] < 0 ? NAN : map_.value[static_cast<std::size_t>(value_of_[pillar])];
  }

  void draw_discs() {
    for (std::size_t i = 0; i < array_.pillars.size(); ++i) {
      const ScenePillar& one = array_.pillars[i];
      const bool has_value = value_of_[i] >= 0;
      const std::string fill =
          has_value ? colour_of(range_.share(value(i)), range_.is_signed) : "none";
      has_hollow_ = has_hollow_ || !has_value;
      const bool is_marked = one.is_loaded() && !all_loaded();
      body_ += fmt::format(
          R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.2f}" fill="{}" stroke="{}" stroke-width="{}"/>)"
          "\n",
          x(one.x_m), y(one.y_m), 0.5 * scale_ * one.diameter_m, fill, is_marked ? "#000" : "#888",
          is_marked ? 2.0 : 0.6);
    }
  }

  // Cells of one colour are one path, and neighbours in a row one rectangle.
  void draw_cells() {
    std::map<int, std::string> path_of_colour;
    for (std::size_t i = 0; i < array_.pillars.size();) {
      const int colour = colour_number(i);
      std::size_t end = i + 1;
      while (end < array_.pillars.size() && continues_row(end) && colour_number(end) == colour)
        ++end;
      path_of_colour[colour] += cell_path(i, end - 1);
      i = end;
    }
    for (const auto& [colour, path] : path_of_colour) {
      const std::string fill =
          colour < 0 ? "#fff" : colour_of((colour + 0.5) / kColours, range_.is_signed);
      has_hollow_ = has_hollow_ || colour < 0;
      body_ +=
          fmt::format("<path shape-rendering=\"crispEdges\" fill=\"{}\" d=\"{}\"/>\n", fill, path);
    }
    if (all_loaded()) return;
    std::string rims;
    for (std::size_t i = 0; i < array_.pillars.size(); ++i) {
      if (array_.pillars[i].is_loaded()) rims += cell_path(i, i);
    }
    if (rims.empty()) return;
    body_ +=
        fmt::format("<path fill=\"none\" stroke=\"#000\" stroke-width=\"1\" d=\"{}\"/>\n", rims);
  }
  int colour_number(std::size_t pillar) const {
    if (value_of_[pillar] < 0) return -1;
    return std::min(kColours - 1, static_cast<int>(range_.share(value(pillar)) * kColours));
  }
  bool continues_row(std::size_t i) const {
    const ScenePillar &one = array_.pillars[i], &before = array_.pillars[i - 1];
    return one.row == before.row && one.column == before.column + 1;
  }
  std::string cell_path(std::size_t first, std::size_t last) const {
    const ScenePillar &from = array_.pillars[first], &to = array_.pillars[last];
    return fmt::format("M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z", x(from.x_m - 0.5 * array_.cell_x_m),
                       y(from.y_m + 0.5 * array_.cell_y_m),
                       scale_ * (to.x_m - from.x_m + array_.cell_x_m), scale_ * array_.cell_y_m,
                       -scale_ * (to.x_m - from.x_m + array_.cell_x_m));
  }

  bool all_loaded() const {
    return std::all_of(array_.pillars.begin(), array_.pillars.end(),
                       [](const ScenePillar& one) { return one.is_loaded(); });
  }

  // The longest is as long as a pitch of the arrows.
  void draw_arrows() {
    for (const ForceArrow& one : arrows_) {
      largest_N_ = std::max(largest_N_, std::hypot(one.force_x_N, one.force_y_N));
    }
    if (largest_N_ == 0.0) return;
    const double cell_m = std::min(array_.cell_x_m, array_.cell_y_m);
    const double px_N = 0.95 * scale_ * cell_m * per_block_ / largest_N_;
    for (const ForceArrow& one : arrows_) {
      const double dx = px_N * one.force_x_N, dy = -px_N * one.force_y_N;
      const double length = std::hypot(dx, dy), head = std::min(0.4 * length, 7.0);
      if (length < 1.0) continue;
      const double ux = dx / length, uy = dy / length;
      const double x0 = x(one.x_m) - 0.5 * dx, y0 = y(one.y_m) - 0.5 * dy;
      const double x1 = x0 + dx, y1 = y0 + dy;
      const std::string path =
          fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}", x0,
                      y0, x1, y1, x1 - head * (ux - 0.5 * uy), y1 - head * (uy + 0.5 * ux), x1, y1,
                      x1 - head * (ux + 0.5 * uy), y1 - head * (uy - 0.5 * ux));
      body_ += fmt::format(
          "<path fill=\"none\" stroke=\"#fff\" stroke-width=\"3.6\" d=\"{0}\"/>"
          "<path fill=\"none\" stroke=\"#000\" stroke-width=\"1.6\" d=\"{0}\"/>\n",
          path);
    }
  }

  // Rows on the left and columns below, at most a dozen numbers each.
  void draw_numbers() {
    if (array_.columns < 2) return;
    std::map<int, double> rows, columns;
    for (const ScenePillar& one : array_.pillars) {
      rows.emplace(one.row, one.y_m);
      columns.emplace(one.column, one.x_m);
    }
    const auto is_shown = [](int number, int count) {
      const int step = count <= 12 ? 1 : count <= 20 ? 2 : count <= 60 ? 5 : count <= 120 ? 10 : 50;
      return number == 1 || number == count || (number % step == 0 && count - number >= step / 2);
    };
    for (const auto& [row, y_m] : rows) {
      if (!is_shown(row, array_.rows)) continue;
      body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                           x(array_.left_m) - 6.0, y(y_m) + 4.0, row);
    }
    const double below_px = y(array_.low_m) + 16.0;
    for (const auto& [column, x_m] : columns) {
      if (!is_shown(column, array_.columns)) continue;
      body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                           x(x_m), below_px, column);
    }
    body_ +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">column (x)</text>\n",
                    0.5 * (x(array_.left_m) + x(array_.right_m)), below_px + 18.0);
    body_ += fmt::format(
        "<text x=\"16\" y=\"{0:.1f}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {0:.1f})\">"
        "row (y)</text>\n",
        0.5 * (y(array_.low_m) + y(array_.high_m)));
  }

  void draw_bar() {
    const PrefixedUnit unit = prefixed_unit(map_.unit, largest_size(map_.value));
    std::vector<ColourTick> ticks;
    for (const double tick : round_ticks(unit.per_si * std::min(range_.low, range_.high),
                                         unit.per_si * std::max(range_.low, range_.high))) {
      ticks.push_back({range_.share(tick / unit.per_si), fmt::format("{:.6g}", tick)});
    }
    const double bar_px = kMapWidth_px - kMapRight_px + 40.0;
    body_ += colour_bar(bar_px, kAboveMap_px, 0.6 * kMapHeight_px, range_.is_signed, ticks);
    body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", bar_px, kAboveMap_px - 12.0,
                         unit.text);
  }

  std::string legend() const {
    std::string words = is_grid() ? "one cell for each pillar" : "discs: pillars to scale";
    if (!all_loaded()) words += "; dark rim: loaded";
    if (largest_N_ > 0.0) {
      words += fmt::format(
          "; arrows: shear{}, the longest {}",
          per_block_ > 1 ? fmt::format(" (means of {0} x {0} pillars)", per_block_) : "",
          in_unit(largest_N_, "N", 3));
    }
    if (is_cut_) words += "; the film is wider";
    if (has_hollow_) words += "; empty: no value";
    return words;
  }

  SceneArray array_;
  bool is_cut_ = false;  // the film is wider than what is drawn
  const SceneMap& map_;
  MapRange range_;
  std::vector<int> value_of_;  // by pillar; -1: none
  double scale_ = 1.0, left_px_ = 0.0;
  bool has_hollow_ = false;
  std::vector<ForceArrow> arrows_;
  int per_block_ = 1;  // rows and columns of pillars that an arrow stands for
  double largest_N_ = 0.0;
  std::string body_;
};

}  // namespace

std::string svg_from_map(const SceneArray& array, const SceneMap& map, const std::string& title) {
  return MapDrawing(array, map).document(title);
}

std::string svg_from_forces(const SceneArray& array, const ForceMaps& forces,
                            const std::string& title) {
  MapDrawing drawing(array, forces.normal);
  drawing.set_arrows(forces.along_x, forces.along_y);
  return drawing.document(title);
}

}  // namespace viscard
