#include "io/cli/answer_pictures.h"

#include "io/plot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// "electrode_voltage_magnitude" -> "electrode voltage magnitude (V)"
std::string label_of(const SceneCurve& curve) {
  std::string text = curve.name;
  std::replace(text.begin(), text.end(), '_', ' ');
  return curve.unit == "1" ? text : text + " (" + curve.unit + ")";
}

bool spans_decades(const std::vector<double>& values) {
  double low = HUGE_VAL;
  double high = 0.0;
  for (const double value : values) {
    if (value > 0.0) low = std::min(low, value);
    high = std::max(high, value);
  }
  return high > 30.0 * low;
}

PlotPanel panel_of(const SceneCurve& curve) {
  const bool in_time = curve.x_name == "time_s";
  const bool is_size = curve.name.ends_with("_magnitude") || curve.name.ends_with("_spectrum");
  PlotPanel panel;
  panel.x = {.label = in_time ? "time (s)" : "frequency (Hz)",
             .is_log = !in_time && spans_decades(curve.x)};
  panel.y = {.label = label_of(curve), .is_log = is_size && spans_decades(curve.value)};
  PlotSeries line;
  line.x = curve.x;
  line.y = curve.value;
  if (curve.error.size() == curve.value.size()) {
    PlotSeries band{.mark = Mark::kBand, .label = "estimated error", .x = curve.x};
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      band.y_low.push_back(curve.value[i] - curve.error[i]);
      band.y_high.push_back(curve.value[i] + curve.error[i]);
    }
    band.ink = Ink::kSky;
    if (!panel.y.is_log) panel.series.push_back(std::move(band));
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

}  // namespace

std::vector<std::pair<std::string, std::string>> pictures_of(const SceneAnswer& answer) {
  std::vector<std::pair<std::string, std::string>> pictures;
  for (const SceneCurve& curve : answer.curves) {
    const bool is_part = curve.name.ends_with("_real") || curve.name.ends_with("_imaginary") ||
                         curve.name.ends_with("_phase");
    if (is_part || curve.x.size() < 2) continue;
    Plot plot;
    plot.title = label_of(curve);
    plot.description = label_of(curve) + " against " + curve.x_name;
    plot.panels.push_back(panel_of(curve));
    const std::string stem = curve.name.substr(0, curve.name.rfind('_'));
    const SceneCurve* phase = find(answer, stem + "_phase");
    if (phase != nullptr && curve.name.ends_with("_magnitude")) {
      plot.panels.front().shares_x_with_below = true;
      plot.panels.push_back(panel_of(*phase));
      plot.height_px = 560;
    }
    try {
      pictures.emplace_back(curve.name, svg_from_plot(plot, "curve"));
    } catch (const std::runtime_error&) {
      return {};  // no gnuplot
    }
  }
  return pictures;
}

}  // namespace viscard
