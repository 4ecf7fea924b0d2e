#include "io/cli/scene/answer_pictures.h"

#include "io/report/report_numbers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

bool spans_decades(const std::vector<double>& values) {
  double low = HUGE_VAL;
  double high = 0.0;
  for (const double value : values) {
    if (value != 0.0) low = std::min(low, std::abs(value));
    high = std::max(high, std::abs(value));
  }
  return high > 30.0 * low;
}

bool draw(const std::string& name, const Plot& plot, const char* id, Pictures& pictures) {
  try {
    pictures.emplace_back(name, svg_from_plot(plot, id));
  } catch (const std::runtime_error&) {
    return false;
  }
  return true;
}

namespace {

// "electrode_voltage_magnitude" -> "electrode voltage magnitude (V)"
std::string label_of(const SceneCurve& curve, const std::string& unit) {
  std::string text = curve.name;
  std::replace(text.begin(), text.end(), '_', ' ');
  return curve.unit == "1" ? text : text + " (" + unit + ")";
}

std::vector<double> times(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

// The abscissa of a curve: "wavelength_m" is "wavelength" in m.
struct Abscissa {
  std::string name, unit;
};
Abscissa abscissa_of(const SceneCurve& curve) {
  const std::size_t end = curve.x_name.rfind('_');
  return {curve.x_name.substr(0, end), curve.x_name.substr(end + 1)};
}

// A length that is zero everywhere is no reason for an axis of metres.
ShownUnit unit_of_curve(const std::string& unit, const std::vector<double>& values) {
  return unit == "m" && largest_size(values) == 0.0 ? ShownUnit{1e6, "µm"}
                                                    : shown_unit(unit, values);
}

PlotPanel panel_of(const SceneCurve& curve) {
  const Abscissa x = abscissa_of(curve);
  const bool is_frequency = x.unit == "Hz";
  const bool is_size = curve.name.ends_with("_magnitude") || curve.name.ends_with("_spectrum");
  const bool is_log = is_size && spans_decades(curve.value);
  // Frequencies stay in Hz and logarithmic sizes in the base unit; the rest get a prefix.
  const ShownUnit x_unit = is_frequency ? ShownUnit{1.0, "Hz"} : shown_unit(x.unit, curve.x);
  const ShownUnit y_unit =
      is_log ? ShownUnit{1.0, curve.unit} : unit_of_curve(curve.unit, curve.value);
  PlotPanel panel;
  // Waves are shown over their logarithm; times and places start at, or are on both sides of, 0.
  panel.x = {.label = x.name + " (" + x_unit.text + ")",
             .is_log = (is_frequency || x.name == "wavelength") && spans_decades(curve.x)};
  panel.y = {.label = label_of(curve, y_unit.text), .is_log = is_log};
  PlotSeries line;
  line.x = times(curve.x, x_unit.per_si);
  line.y = times(curve.value, y_unit.per_si);
  if (curve.error.size() == curve.value.size() && !is_log) {
    PlotSeries band{.mark = Mark::kBand, .label = "estimated error", .x = line.x};
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      const double half = curve.error[i] * y_unit.per_si;
      band.y_low.push_back(line.y[i] - half);
      band.y_high.push_back(line.y[i] + half);
    }
    band.ink = Ink::kSky;
    panel.series.push_back(std::move(band));
  }
  panel.series.push_back(std::move(line));
  return panel;
}

const SceneCurve* find(const SceneAnswer& answer, const std::string& name) {
  for (const SceneCurve& curve : answer.curves) {
    if (curve.name == name) return &curve;
  }
  return nullptr;
}

// A shape on an array in time: its depth and force, how many pillars it touches, and what electrodes read,
// one above the other.
void draw_touch(const SceneAnswer& answer, Pictures& pictures) {
  Plot plot;
  plot.title = "the touch in time";
  PlotPanel read;
  std::vector<double> all_V;
  for (const SceneCurve& curve : answer.curves) {
    if (curve.x_name != "time_s") return;
    const bool is_of_shape =
        curve.name == "depth" || curve.name == "contact_force" || curve.name == "contacts";
    PlotPanel panel = panel_of(curve);
    if (is_of_shape) {
      panel.shares_x_with_below = true;
      plot.panels.push_back(std::move(panel));
      continue;
    }
    if (curve.unit != "V") continue;
    const std::size_t index = read.series.size();
    PlotSeries line = std::move(panel.series.back());
    if (index == 0) read.x = panel.x;
    line.y = curve.value;
    all_V.insert(all_V.end(), curve.value.begin(), curve.value.end());
    line.label = curve.name;
    std::replace(line.label.begin(), line.label.end(), '_', ' ');
    line.ink = ink_of_series(index);
    line.pattern = static_cast<int>(index);
    read.series.push_back(std::move(line));
  }
  if (plot.panels.empty() || read.series.empty()) return;
  const ShownUnit unit = shown_unit("V", all_V);
  read.y = {.label = "voltage (" + unit.text + ")"};
  for (PlotSeries& line : read.series) line.y = times(std::move(line.y), unit.per_si);
  read.height_share = 1.5;
  plot.panels.push_back(std::move(read));
  plot.description = "depth and force of the shape and voltages against time";
  plot.height_px = 220 * static_cast<int>(plot.panels.size());
  draw("touch", plot, "touch", pictures);
}

}  // namespace

Pictures pictures_of(const SceneAnswer& answer) {
  Pictures pictures;
  for (const SceneCurve& curve : answer.curves) {
    const bool is_part = curve.name.ends_with("_real") || curve.name.ends_with("_imaginary") ||
                         curve.name.ends_with("_phase");
    if (is_part || curve.x.size() < 2) continue;
    Plot plot;
    plot.title = label_of(curve, curve.unit);
    plot.description = plot.title + " against " + curve.x_name;
    plot.panels.push_back(panel_of(curve));
    const std::string stem = curve.name.substr(0, curve.name.rfind('_'));
    const SceneCurve* phase = find(answer, stem + "_phase");
    if (phase != nullptr && curve.name.ends_with("_magnitude")) {
      plot.panels.front().shares_x_with_below = true;
      plot.panels.push_back(panel_of(*phase));
      plot.height_px = 560;
    }
    if (!draw(curve.name, plot, "curve", pictures)) return {};
  }
  draw_touch(answer, pictures);
  return pictures;
}

}  // namespace viscard
