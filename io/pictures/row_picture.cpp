#include "io/pictures/row_picture.h"

#include "io/pictures/picture_numbers.h"
#include "io/pictures/scene_drawing.h"
#include "io/pictures/shown_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace viscard {
namespace {

constexpr int kMostOfCluster = 8;

// Largest motion drawn. Sideways, neighbours in opposite phase should not overlap.
double drawn_m(const ArrayGeometry& g, bool is_lateral) {
  constexpr double kMost = 0.15, kLeast = 0.06;  // of the length
  const double room_m = is_lateral ? 0.45 * g.spacing_m : 0.4 * g.diameter_m;
  return std::clamp(g.count > 1 || !is_lateral ? room_m : kMost * g.length_m, kLeast * g.length_m,
                    kMost * g.length_m);
}

// The outline of a pillar around its middle, moved by factor times its motion (x, z in turn).
std::vector<std::pair<double, double>> moved_outline(const RowShapes& shapes, const RowShape& shape,
                                                     Eigen::Index pillar, double middle_m,
                                                     double factor_m) {
  std::vector<std::pair<double, double>> corners;
  for (std::size_t k = 0; k < shapes.outline_m.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    const auto [x_m, z_m] = shapes.outline_m[k];
    corners.emplace_back(middle_m + x_m + factor_m * shape.outline(row, pillar),
                         z_m + factor_m * shape.outline(row + 1, pillar));
  }
  return corners;
}

std::string signed_share(double share) {
  const std::string text = fmt::format("{:+.2f}", share);
  return text == "+0.00" || text == "-0.00" ? "0" : with_minus(text);
}

// How far the frequencies of a cluster lie apart, which may be less than their errors.
std::string spread_of(const RowShapes& shapes, const std::vector<SceneMode>& modes,
                      const RowShape& shape) {
  double low_Hz = HUGE_VAL, high_Hz = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const RowShape& one = shapes.modes[i];
    if (one.family != shape.family || one.cluster != shape.cluster) continue;
    low_Hz = std::min(low_Hz, modes[i].frequency_Hz);
    high_Hz = std::max(high_Hz, modes[i].frequency_Hz);
    ++count;
  }
  if (count < 2) return "";
  if (!shapes.are_coupled) {
    return "; what couples the pillars is left out: any mixture of modes of one frequency is a "
           "mode too";
  }
  return fmt::format("; the {} modes of this cluster lie within {}", count,
                     in_unit(high_Hz - low_Hz, "Hz", 2));
}

std::string svg_of_mode(const RowShapes& shapes, const RowShape& shape, const std::string& title,
                        const std::string& spread) {
  const ArrayGeometry& g = shapes.geometry;
  const ShownRow row = shown_row(g);
  const bool is_lateral = shape.family == "lateral";
  const double most_m = drawn_m(g, is_lateral);
  SceneDrawing d(row.left_m, row.right_m, -g.film_thickness_m,
                 g.length_m + (is_lateral ? 0.0 : most_m), kRowWidth_px);
  d.film(row.left_m, row.right_m, g.film_thickness_m);
  for (const auto& [number, middle_m] : row.pillars) {
    d.box(middle_m - 0.5 * g.diameter_m, middle_m + 0.5 * g.diameter_m, 0.0, g.length_m,
          R"(fill="none" stroke="#a9bfd0" stroke-dasharray="4 3")");
  }
  for (const auto& [number, middle_m] : row.pillars) {
    const Eigen::Index pillar = number - 1;
    d.outline(moved_outline(shapes, shape, pillar, middle_m, most_m),
              R"(fill="#bcd4e6" fill-opacity="0.7" stroke="#2b5d7d")");
    const double below_px = d.y(-g.film_thickness_m);
    d.text(d.x(middle_m), below_px + 24.0, std::to_string(number), "middle");
    d.text(d.x(middle_m), below_px + 42.0, signed_share(shape.top[pillar]), "middle");
  }
  if (row.is_cut) {
    d.text(d.x(row.cut_m), d.y(0.5 * g.length_m), fmt::format("... {} ...", g.count), "middle");
  }
  d.text(12.0, 40.0, "dashed: at rest; the motion is exaggerated" + spread);
  d.legend(fmt::format("below each pillar: motion of its top {}, the largest is 1",
                       is_lateral ? "to the right" : "upward"));
  return d.document(title);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> pictures_from_shapes(
    const RowShapes& shapes, const std::vector<SceneMode>& modes, const std::string& scene) {
  std::vector<std::pair<std::string, std::string>> pictures;
  std::map<std::string, int> number, of_cluster;
  if (shapes.modes.size() != modes.size()) return pictures;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const RowShape& shape = shapes.modes[i];
    const std::string name = fmt::format("{}_{}", shape.family, ++number[shape.family]);
    if (++of_cluster[fmt::format("{} {}", shape.family, shape.cluster)] > kMostOfCluster) continue;
    std::string title = fmt::format(
        "{} mode {}, of the pillar's mode {}: {}", shape.family, number[shape.family],
        shape.cluster, in_unit_with_error(modes[i].frequency_Hz, modes[i].error_estimate, "Hz"));
    if (!scene.empty()) title += " (" + scene + ")";
    pictures.emplace_back(name, svg_of_mode(shapes, shape, title, spread_of(shapes, modes, shape)));
  }
  return pictures;
}

}  // namespace viscard
