#include "io/pictures/section_picture.h"

#include "io/pictures/colour_scale.h"
#include "io/pictures/picture_numbers.h"
#include "io/plots/plot_svg.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kSectionWidth_px = 560.0;
constexpr double kHeight_px = 560.0;
constexpr double kLeft_px = 30.0, kRight_px = 130.0, kTop_px = 50.0, kBottom_px = 40.0;
constexpr double kShortestBar_px = 150.0, kLongestBar_px = 0.6 * kHeight_px;
// Largest displacement drawn: of the height, and of the pillar's radius where it does not swing.
constexpr double kSwing = 0.15, kBulge = 0.4;

// A corner of a quadrilateral as drawn: in the plane of the section, m, and its value.
struct Corner {
  double x_m, z_m, value;
};

struct Shown {
  std::string title, unit;
  bool is_signed = false;
  std::vector<std::array<Corner, 4>> quads;
  std::string note;
};

double largest_drawn_m(const SectionGrid& grid) {
  const double length_m = *std::max_element(grid.z_m.begin(), grid.z_m.end());
  double radius_m = 0.0;
  for (std::size_t i = 0; i < grid.x_m.size(); ++i) {
    if (grid.z_m[i] > 0.0) radius_m = std::max(radius_m, grid.x_m[i]);
  }
  const double widest_m = *std::max_element(grid.x_m.begin(), grid.x_m.end());
  // If the drawing is this much wider than high, the film bends rather than the pillar.
  constexpr double kDisc = 4.0;
  if (widest_m > kDisc * length_m) return kSwing * 0.5 * widest_m;
  const double swing_m = kSwing * length_m;
  return grid.harmonic == 1 ? swing_m : std::min(swing_m, kBulge * radius_m);
}

// Three digits without an exponent.
std::string factor_text(double factor) {
  const double rounded = leading_number(fmt::format("{:.2e}", factor));
  return factor < 1000.0 ? fmt::format("{:.3g}", factor) : fmt::format("{:.0f}", rounded);
}

// "static_stress_zz_Pa" -> "static stress zz"; the unit stands at the bar.
std::string title_of(std::string name, const std::string& unit) {
  if (unit != "1" && name.ends_with("_" + unit)) name.resize(name.size() - unit.size() - 1);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// Both halves of the section, moved by factor times the displacement (if it is one).
Shown shown_of(const SectionGrid& grid, const SectionField& field) {
  const std::string name = field.unit == "1" ? field.name : grid.name + "_" + field.name;
  Shown shown{title_of(name, field.unit), field.unit, !field.is_vector, {}, {}};
  double largest = 0.0;
  for (std::size_t i = 0; i < field.value.size(); ++i) {
    const auto u = displacement_at(grid, field, i, 0.0);
    largest = std::max(largest, std::hypot(u[0], u[1], u[2]));
  }
  const double factor = field.is_vector && largest > 0.0 ? largest_drawn_m(grid) / largest : 0.0;
  if (field.is_vector) {
    shown.note = field.unit == "1" ? "largest displacement is 1"
                                   : "displacement drawn " + factor_text(factor) + " times";
  }
  const bool is_of_film = field.name == "potential_V";
  for (std::size_t q = 0; q < grid.quads.size(); ++q) {
    if (is_of_film && !grid.is_film[q]) continue;
    for (const double theta : {0.0, std::numbers::pi}) {
      std::array<Corner, 4> corners{};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto p = static_cast<std::size_t>(grid.quads[q][k]);
        const double side = theta == 0.0 ? 1.0 : -1.0;
        corners[k] = {side * grid.x_m[p], grid.z_m[p], 0.0};
        if (!field.is_vector) {
          corners[k].value = scalar_at(grid, field, p, theta);
          continue;
        }
        const auto u = displacement_at(grid, field, p, theta);
        corners[k].x_m += factor * u[0];
        corners[k].z_m += factor * u[2];
        corners[k].value = std::hypot(u[0], u[1], u[2]);
      }
      shown.quads.push_back(corners);
    }
  }
  return shown;
}

struct Range {
  double low = 0.0, high = 0.0;
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

// The rim of the bond has infinite stress: colours span all but the outermost hundredth of values.
Range range_of(const Shown& shown) {
  std::vector<double> values;
  for (const auto& quad : shown.quads) {
    for (const Corner& corner : quad) values.push_back(corner.value);
  }
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  if (!shown.is_signed) return {0.0, values.back()};
  const double size = std::max(std::abs(values[values.size() / 100]),
                               std::abs(values[values.size() - 1 - values.size() / 100]));
  return {-size, size};
}

std::string scale_bar(const Range& range, const Shown& shown, double length_px) {
  const PrefixedUnit unit =
      prefixed_unit(shown.unit, std::max(std::abs(range.low), std::abs(range.high)));
  std::vector<ColourTick> ticks;
  for (const double tick : round_ticks(unit.per_si * range.low, unit.per_si * range.high)) {
    ticks.push_back({range.share(tick / unit.per_si), fmt::format("{:.6g}", tick)});
  }
  const double bar_px = kSectionWidth_px - kRight_px + 30.0;
  return colour_bar(bar_px, kTop_px, length_px, shown.is_signed, ticks) +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", bar_px, kTop_px - 12.0,
                     unit.text);
}

// The round length (1, 2 or 5 times a power of ten) that is a sixth to a third of the width as drawn.
std::string length_bar(double scale_px_m, double width_m, double bottom_px) {
  const double decade = std::pow(10.0, std::floor(std::log10(width_m / 3.0)));
  double length_m = decade;
  for (const double digit : {2.0, 5.0}) {
    if (digit * decade <= width_m / 3.0) length_m = digit * decade;
  }
  const double right_px = kSectionWidth_px - 24.0, left_px = right_px - scale_px_m * length_m;
  return fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}v6h{2:.1f}v-6\" fill=\"none\" stroke=\"#444\"/>\n"
      "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\" fill=\"#444\">{5}</text>\n",
      left_px, bottom_px - 10.0, scale_px_m * length_m, right_px, bottom_px - 14.0,
      in_unit(length_m, "m", 3));
}

std::string svg_of(const Shown& shown) {
  double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_z = HUGE_VAL, high_z = -HUGE_VAL;
  for (const auto& quad : shown.quads) {
    for (const Corner& c : quad) {
      low_x = std::min(low_x, c.x_m);
      high_x = std::max(high_x, c.x_m);
      low_z = std::min(low_z, c.z_m);
      high_z = std::max(high_z, c.z_m);
    }
  }
  const double scale = std::min((kSectionWidth_px - kLeft_px - kRight_px) / (high_x - low_x),
                                (kHeight_px - kTop_px - kBottom_px) / (high_z - low_z));
  const double left =
      kLeft_px + 0.5 * (kSectionWidth_px - kLeft_px - kRight_px - scale * (high_x - low_x));
  const double body_px = scale * (high_z - low_z);
  const double bar_px = std::clamp(body_px, kShortestBar_px, kLongestBar_px);
  const double height_px = kTop_px + std::max(body_px, bar_px) + kBottom_px;
  const Range range = range_of(shown);
  std::string body;
  for (const auto& quad : shown.quads) {
    double mean = 0.0;
    std::string points;
    for (const Corner& c : quad) {
      mean += 0.25 * c.value;
      points += fmt::format("{:.1f},{:.1f} ", left + scale * (c.x_m - low_x),
                            height_px - kBottom_px - scale * (c.z_m - low_z));
    }
    const std::string ink = colour_of(range.share(mean), shown.is_signed);
    body += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"0.6\"/>\n",
                        points, ink, ink);
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" role=\"img\">\n"
      "<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"12\" y=\"24\" font-size=\"15\">{2}</text>\n{3}{4}"
      "<text x=\"12\" y=\"{5:.0f}\" fill=\"#444\">{6}</text>\n</svg>\n",
      kSectionWidth_px, height_px, escaped_markup(shown.title), body,
      scale_bar(range, shown, bar_px) + length_bar(scale, high_x - low_x, height_px),
      height_px - 14.0, escaped_markup(shown.note));
}

}  // namespace

std::array<double, 3> displacement_at(const SectionGrid& grid, const SectionField& field,
                                      std::size_t point, double theta) {
  const auto& [r, t, z] = field.value[point];
  const double m = grid.harmonic;
  const double radial = r * std::cos(m * theta);
  const double around = grid.harmonic == 0 ? t : t * std::sin(m * theta);
  return {radial * std::cos(theta) - around * std::sin(theta),
          radial * std::sin(theta) + around * std::cos(theta), z * std::cos(m * theta)};
}

double scalar_at(const SectionGrid& grid, const SectionField& field, std::size_t point,
                 double theta) {
  return field.value[point][0] * std::cos(grid.harmonic * theta);
}

std::map<std::string, std::string> captions_from_answer(const SceneAnswer& answer) {
  std::map<std::string, std::string> captions;
  std::map<std::string, int> number;
  for (const SceneMode& mode : answer.modes) {
    captions[mode.family + "_" + std::to_string(++number[mode.family])] =
        in_unit_with_error(mode.frequency_Hz, mode.error_estimate, "Hz");
  }
  for (const SceneResult& result : answer.results) {
    if (result.name != "buckling_pressure") continue;
    captions["buckling_shape"] =
        in_unit_with_error(result.value, result.error_estimate, result.unit);
  }
  return captions;
}

std::vector<std::pair<std::string, std::string>> pictures_from_grid(
    const SectionGrid& grid, const std::map<std::string, std::string>& captions,
    const std::string& scene) {
  std::vector<std::pair<std::string, std::string>> pictures;
  for (const SectionField& field : grid.fields) {
    const bool is_numbered = field.unit == "1";  // a mode, named after its family already
    Shown shown = shown_of(grid, field);
    if (const auto caption = captions.find(field.name); caption != captions.end()) {
      shown.title += ": " + caption->second;
    }
    if (!scene.empty()) shown.title += " (" + scene + ")";
    pictures.emplace_back(is_numbered ? field.name : grid.name + "_" + field.name, svg_of(shown));
  }
  return pictures;
}

}  // namespace viscard
