#include "io/scene_picture.h"

#include "io/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kWidth_px = 640.0;
constexpr double kHeight_px = 480.0;
constexpr double kMargin_px = 70.0;

// Metres to pixels, z up, the axis in the middle.
class Drawing {
 public:
  explicit Drawing(const Scene& scene) {
    const PillarGeometry& g = scene.geometry;
    const double half_m = g.film ? g.film->radius_m : g.diameter_m;
    const double film_m = g.film ? g.film->thickness_m : 0.1 * g.diameter_m;
    scale_ = std::min((kWidth_px - 2.0 * kMargin_px) / (2.0 * half_m),
                      (kHeight_px - 2.0 * kMargin_px) / (g.length_m + film_m));
    base_px_ = kHeight_px - kMargin_px - film_m * scale_;
  }
  double x(double m) const { return 0.5 * kWidth_px + m * scale_; }
  double y(double m) const { return base_px_ - m * scale_; }

  void box(double half_m, double low_m, double high_m, const char* style) {
    body_ +=
        fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" {}/>)"
                    "\n",
                    x(-half_m), y(high_m), 2.0 * half_m * scale_, (high_m - low_m) * scale_, style);
  }
  void line(double x1, double y1, double x2, double y2, const char* style) {
    body_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" {}/>)"
                         "\n",
                         x1, y1, x2, y2, style);
  }
  void text(double x_px, double y_px, const std::string& words, const char* anchor = "start") {
    body_ += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)"
                         "\n",
                         x_px, y_px, anchor, escaped_markup(words));
  }
  const std::string& body() const { return body_; }

 private:
  double scale_ = 1.0, base_px_ = 0.0;
  std::string body_;
};

std::string micrometres(double m) {
  return fmt::format("{:.4g} um", 1e6 * m);
}

void draw_held(Drawing& d, double half_m, double z_m) {
  const char* ink = R"(stroke="#444" stroke-width="1")";
  const double from = d.x(-half_m);
  const double to = d.x(half_m);
  d.line(from, d.y(z_m), to, d.y(z_m), R"(stroke="#444" stroke-width="2")");
  for (double x = from; x <= to; x += 10.0) d.line(x, d.y(z_m), x - 6.0, d.y(z_m) + 8.0, ink);
}

void draw_film(Drawing& d, const Scene& scene) {
  const FilmGeometry& film = *scene.geometry.film;
  d.box(film.radius_m, -film.thickness_m, 0.0, R"(fill="#e6c88a" stroke="#7a5c1e")");
  d.text(d.x(film.radius_m) + 8.0, d.y(-0.5 * film.thickness_m) + 4.0,
         "t " + micrometres(film.thickness_m));
  draw_held(d, film.radius_m, -film.thickness_m);
  d.text(d.x(0.0), d.y(-film.thickness_m) + 28.0, "film radius " + micrometres(film.radius_m),
         "middle");
  if (!scene.electrodes) return;
  const bool top_grounded = scene.electrodes->grounded == FilmFace::kTop;
  const double face_m = top_grounded ? -film.thickness_m : 0.0;
  const double ground_m = top_grounded ? 0.0 : -film.thickness_m;
  const double R = scene.electrodes->electrode_radius_m;
  d.line(d.x(-film.radius_m), d.y(ground_m), d.x(film.radius_m), d.y(ground_m),
         R"(stroke="#000" stroke-width="2" stroke-dasharray="5 3")");
  if (R > 0.0) {
    d.line(d.x(-R), d.y(face_m), d.x(R), d.y(face_m), R"(stroke="#d55e00" stroke-width="4")");
  }
  d.text(12.0, kHeight_px - 12.0,
         (R > 0.0 ? "orange: electrode, radius " + micrometres(R) : "charge-free face, read") +
             "; dashed: ground");
}

void draw_load(Drawing& d, const Scene& scene) {
  const bool is_pressed = scene.pressure_Pa != 0.0 || !scene.history.empty();
  if (!is_pressed) return;
  const double R = 0.5 * scene.geometry.diameter_m;
  const double top = d.y(scene.geometry.length_m);
  const char* ink = R"(stroke="#0072b2" stroke-width="2")";
  for (const double x_m : {-0.8 * R, -0.4 * R, 0.0, 0.4 * R, 0.8 * R}) {
    const double x = d.x(x_m);
    d.line(x, top - 28.0, x, top - 3.0, ink);
    d.line(x - 4.0, top - 10.0, x, top - 3.0, ink);
    d.line(x + 4.0, top - 10.0, x, top - 3.0, ink);
  }
  const std::string words = scene.pressure_Pa != 0.0 ? fmt::format("{:.4g} Pa", scene.pressure_Pa)
                                                     : std::string("a history in time");
  d.text(d.x(0.0), top - 36.0, words, "middle");
}

}  // namespace

std::string svg_from_scene(const Scene& scene, const std::string& title) {
  const PillarGeometry& g = scene.geometry;
  Drawing d(scene);
  if (g.film) {
    draw_film(d, scene);
  } else {
    draw_held(d, g.diameter_m, 0.0);
  }
  d.box(0.5 * g.diameter_m, 0.0, g.length_m, R"(fill="#bcd4e6" stroke="#2b5d7d")");
  d.line(d.x(0.0), d.y(g.length_m), d.x(0.0), d.y(0.0),
         R"(stroke="#2b5d7d" stroke-dasharray="8 3 2 3")");
  d.text(d.x(0.5 * g.diameter_m) + 8.0, d.y(0.5 * g.length_m), "l " + micrometres(g.length_m));
  d.text(d.x(0.5 * g.diameter_m) + 8.0, d.y(0.5 * g.length_m) + 18.0,
         "d " + micrometres(g.diameter_m));
  draw_load(d, scene);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" )"
      R"(viewBox="0 0 {0:.0f} {1:.0f}" font-family="sans-serif" font-size="13" role="img">)"
      "\n<title>{2}</title>\n"
      R"(<rect width="100%" height="100%" fill="#fff"/>)"
      "\n<text x=\"12\" y=\"20\">{2}</text>\n{3}</svg>\n",
      kWidth_px, kHeight_px, escaped_markup(title), d.body());
}

}  // namespace viscard
