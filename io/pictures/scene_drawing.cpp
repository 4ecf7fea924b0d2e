#include "io/pictures/scene_drawing.h"

#include "io/pictures/picture_numbers.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kSide_px = 84.0;  // room for words left and right
constexpr double kAbove_px = 96.0;
constexpr double kBelow_px = 84.0;
constexpr double kTallest_px = 420.0;
constexpr double kElectrode_px = 5.0;
constexpr int kOutlinePoints = 160;

}  // namespace

SceneDrawing::SceneDrawing(double left_m, double right_m, double low_m, double high_m,
                           double width_px)
    : left_m_(left_m), high_m_(high_m), top_px_(kAbove_px), width_px_(width_px) {
  const double room_px = width_px - 2.0 * kSide_px;
  scale_ = std::min(room_px / (right_m - left_m), kTallest_px / (high_m - low_m));
  left_px_ = kSide_px + 0.5 * (room_px - (right_m - left_m) * scale_);
  height_px_ = kAbove_px + (high_m - low_m) * scale_ + kBelow_px;
}

void SceneDrawing::box(double from_m, double to_m, double low_m, double high_m, const char* style) {
  body_ +=
      fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" {}/>)"
                  "\n",
                  x(from_m), y(high_m), (to_m - from_m) * scale_, (high_m - low_m) * scale_, style);
}

void SceneDrawing::outline(const std::vector<std::pair<double, double>>& corners_m,
                           const char* style) {
  body_ += "<polygon points=\"";
  for (const auto& [x_m, z_m] : corners_m) body_ += fmt::format("{:.1f},{:.1f} ", x(x_m), y(z_m));
  body_ += fmt::format("\" {}/>\n", style);
}

void SceneDrawing::disc(double x_m, double y_m, double radius_m, const char* style) {
  body_ += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.2f}" {}/>)"
                       "\n",
                       x(x_m), y(y_m), radius_m * scale_, style);
}

void SceneDrawing::line(double x1_px, double y1_px, double x2_px, double y2_px, const char* style) {
  body_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" {}/>)"
                       "\n",
                       x1_px, y1_px, x2_px, y2_px, style);
}

void SceneDrawing::text(double x_px, double y_px, const std::string& words, const char* anchor) {
  body_ += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)"
                       "\n",
                       x_px, y_px, anchor, escaped_markup(words));
}

void SceneDrawing::length_mark(double from_m, double to_m, double y_px, const std::string& words) {
  const char* ink = R"(stroke="#444" stroke-width="1")";
  line(x(from_m), y_px, x(to_m), y_px, ink);
  for (const double end_px : {x(from_m), x(to_m)}) {
    line(end_px, y_px - 4.0, end_px, y_px + 4.0, ink);
  }
  text(0.5 * (x(from_m) + x(to_m)), y_px - 6.0, words, "middle");
}

void SceneDrawing::held(double from_m, double to_m, double z_m) {
  const char* ink = R"(stroke="#444" stroke-width="1")";
  line(x(from_m), y(z_m), x(to_m), y(z_m), R"(stroke="#444" stroke-width="2")");
  for (double at_px = x(from_m); at_px <= x(to_m); at_px += 10.0) {
    line(at_px, y(z_m), at_px - 6.0, y(z_m) + 8.0, ink);
  }
}

void SceneDrawing::rigid(double from_m, double to_m, double low_m, double high_m,
                         const std::function<double(double)>& surface_m) {
  std::vector<std::pair<double, double>> corners;
  const auto close = [&] {
    if (corners.size() > 1) {
      corners.emplace_back(corners.back().first, high_m);
      corners.emplace_back(corners.front().first, high_m);
      outline(corners, R"(fill="#8a8f94" fill-opacity="0.8" stroke="#404448")");
    }
    corners.clear();
  };
  for (int i = 0; i <= kOutlinePoints; ++i) {
    const double x_m = from_m + (to_m - from_m) * i / kOutlinePoints;
    const double z_m = surface_m(x_m);
    if (z_m < high_m) {
      corners.emplace_back(x_m, std::max(z_m, low_m));
    } else {
      close();
    }
  }
  close();
}

void SceneDrawing::film(double from_m, double to_m, double thickness_m, bool is_held) {
  box(from_m, to_m, -thickness_m, 0.0, R"(fill="#e6c88a" stroke="#7a5c1e")");
  if (is_held) held(from_m, to_m, -thickness_m);
  text(x(to_m) + 8.0, y(-0.5 * thickness_m) + 4.0, "t " + in_unit(thickness_m, "m"));
}

void SceneDrawing::electrode(double from_m, double to_m, double thickness_m, FilmFace face) {
  const double high_m = std::min(kElectrode_px / scale_, 0.5 * thickness_m);
  const double low_m = face == FilmFace::kTop ? -high_m : -thickness_m;
  box(from_m, to_m, low_m, low_m + high_m, R"(fill="#d55e00")");
}

void SceneDrawing::quarters(double x_px, double y_px) {
  constexpr double kRadius_px = 22.0;
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"#d55e00\"/>\n",
                       x_px, y_px, kRadius_px);
  const char* const gap = R"(stroke="#fff" stroke-width="3")";
  line(x_px - kRadius_px, y_px, x_px + kRadius_px, y_px, gap);
  line(x_px, y_px - kRadius_px, x_px, y_px + kRadius_px, gap);
  text(x_px, y_px + kRadius_px + 18.0, "from above", "middle");
}

void SceneDrawing::ground(double from_m, double to_m, double thickness_m, FilmFace face) {
  const double z_m = face == FilmFace::kTop ? 0.0 : -thickness_m;
  line(x(from_m), y(z_m), x(to_m), y(z_m),
       R"(stroke="#000" stroke-width="3" stroke-dasharray="7 4")");
}

void SceneDrawing::arrow(double x1_px, double y1_px, double x2_px, double y2_px, bool is_double) {
  const char* ink = R"(stroke="#0072b2" stroke-width="2")";
  line(x1_px, y1_px, x2_px, y2_px, ink);
  const double length_px = std::hypot(x2_px - x1_px, y2_px - y1_px);
  const double ux = (x2_px - x1_px) / length_px, uy = (y2_px - y1_px) / length_px;
  const auto head = [&](double at_x, double at_y, double back) {
    for (const double side : {-4.0, 4.0}) {
      line(at_x - 7.0 * back * ux - side * uy, at_y - 7.0 * back * uy + side * ux, at_x, at_y, ink);
    }
  };
  head(x2_px, y2_px, 1.0);
  if (is_double) head(x1_px, y1_px, -1.0);
}

void SceneDrawing::load_arrows(double middle_m, double half_m, double top_m, bool is_sideways) {
  const double top_px = y(top_m);
  if (is_sideways) {
    arrow(x(middle_m - half_m), top_px - 8.0, x(middle_m + half_m), top_px - 8.0, false);
    return;
  }
  const bool is_narrow = 2.0 * half_m * scale_ < 40.0;
  for (const double share : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
    if (is_narrow && share != 0.0) continue;
    const double at_px = x(middle_m + share * half_m);
    arrow(at_px, top_px - 28.0, at_px, top_px - 3.0, false);
  }
}

void SceneDrawing::base_arrow(double middle_m, double low_m, bool is_sideways) {
  const double at_px = x(middle_m), low_px = y(low_m);
  if (is_sideways) {
    arrow(at_px - 40.0, low_px + 20.0, at_px + 40.0, low_px + 20.0, true);
  } else {
    arrow(at_px, low_px + 12.0, at_px, low_px + 44.0, true);
  }
}

void SceneDrawing::legend(const std::string& words) {
  text(12.0, height_px_ - 12.0, words);
}

std::string SceneDrawing::document(const std::string& title) const {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" )"
      R"(viewBox="0 0 {0:.0f} {1:.0f}" font-family="sans-serif" font-size="13" role="img">)"
      "\n<title>{2}</title>\n"
      R"(<rect width="100%" height="100%" fill="#fff"/>)"
      "\n<text x=\"12\" y=\"20\">{2}</text>\n{3}</svg>\n",
      width_px_, height_px_, escaped_markup(title), body_);
}

}  // namespace viscard
