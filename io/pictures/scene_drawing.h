#pragma once

#include "models/pillar/body/piezo_static.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// A section, or a view from above, to scale in SVG, and the parts that drawings share. Lengths in m (up
// is z, with z = 0 on the film, or y), placed in pixels.
class SceneDrawing {
 public:
  // What lies between these bounds is drawn as large as the page allows, at most `width_px` wide.
  SceneDrawing(double left_m, double right_m, double low_m, double high_m, double width_px);

  double x(double m) const { return left_px_ + (m - left_m_) * scale_; }
  double y(double m) const { return top_px_ + (high_m_ - m) * scale_; }
  double width_px() const { return width_px_; }
  double height_px() const { return height_px_; }

  void box(double from_m, double to_m, double low_m, double high_m, const char* style);
  void outline(const std::vector<std::pair<double, double>>& corners_m, const char* style);
  void disc(double x_m, double y_m, double radius_m, const char* style);
  void arrow(double x1_px, double y1_px, double x2_px, double y2_px, bool is_double);
  void line(double x1_px, double y1_px, double x2_px, double y2_px, const char* style);
  void text(double x_px, double y_px, const std::string& words, const char* anchor = "start");
  // Both ends marked; the words above it.
  void length_mark(double from_m, double to_m, double y_px, const std::string& words);

  // What lies above a surface z(x) and between two heights, where the surface is below the upper one.
  void rigid(double from_m, double to_m, double low_m, double high_m,
             const std::function<double(double)>& surface_m);
  void film(double from_m, double to_m, double thickness_m, bool is_held = true);
  void held(double from_m, double to_m, double z_m);
  // Over what stands on it: a band within the film along one of its faces.
  void electrode(double from_m, double to_m, double thickness_m, FilmFace face);
  // Seen from above, as large as the page has room for beside a section.
  void quarters(double x_px, double y_px);
  void ground(double from_m, double to_m, double thickness_m, FilmFace face);
  // On the top of a pillar, toward it or sideways.
  void load_arrows(double middle_m, double half_m, double top_m, bool is_sideways);
  void base_arrow(double middle_m, double low_m, bool is_sideways);
  void legend(const std::string& words);

  std::string document(const std::string& title) const;

 private:
  double left_m_, high_m_, scale_ = 1.0;
  double left_px_ = 0.0, top_px_ = 0.0, width_px_, height_px_ = 0.0;
  std::string body_;
};

}  // namespace viscard
