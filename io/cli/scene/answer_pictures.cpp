#include "io/cli/scene/answer_pictures.h"

#include "io/report/report_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

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

// A panel without series, and what values are multiplied by on its axes.
struct EmptyPanel {
  PlotPanel panel;
  double x_per_si = 1.0, y_per_si = 1.0;

  PlotSeries line(const SceneCurve& curve) const {
    PlotSeries out;
    out.x = times(curve.x, x_per_si);
    out.y = times(curve.value, y_per_si);
    return out;
  }
};

EmptyPanel axes_of(const SceneCurve& curve) {
  const Abscissa x = abscissa_of(curve);
  const bool is_frequency = x.unit == "Hz";
  const bool is_size = curve.name.ends_with("_magnitude") || curve.name.ends_with("_spectrum");
  const bool is_log = is_size && spans_decades(curve.value);
  // Frequencies stay in Hz and logarithmic sizes in the base unit; the rest get a prefix.
  const ShownUnit x_unit = is_frequency ? ShownUnit{1.0, "Hz"} : shown_unit(x.unit, curve.x);
  const ShownUnit y_unit =
      is_log ? ShownUnit{1.0, curve.unit} : unit_of_curve(curve.unit, curve.value);
  EmptyPanel out{.panel = {}, .x_per_si = x_unit.per_si, .y_per_si = y_unit.per_si};
  // Waves are shown over their logarithm; times and places start at, or are on both sides of, 0.
  out.panel.x = {.label = x.name + " (" + x_unit.text + ")",
                 .is_log = (is_frequency || x.name == "wavelength") && spans_decades(curve.x)};
  out.panel.y = {.label = label_of(curve, y_unit.text), .is_log = is_log};
  // What lies further below the peak is rounding.
  constexpr double kSeenShare = 1e-7;
  const double least = kSeenShare * largest_size(curve.value);
  const bool goes_below = std::any_of(curve.value.begin(), curve.value.end(),
                                      [&](double value) { return std::abs(value) < least; });
  if (is_log && goes_below) out.panel.y.min = std::pow(10.0, std::floor(std::log10(least)));
  return out;
}

PlotPanel panel_of(const SceneCurve& curve) {
  EmptyPanel axes = axes_of(curve);
  PlotSeries line = axes.line(curve);
  if (curve.error.size() == curve.value.size() && !axes.panel.y.is_log) {
    PlotSeries band{.mark = Mark::kBand, .label = "estimated error", .x = line.x};
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      const double half = curve.error[i] * axes.y_per_si;
      band.y_low.push_back(line.y[i] - half);
      band.y_high.push_back(line.y[i] + half);
    }
    band.ink = Ink::kSky;
    axes.panel.series.push_back(std::move(band));
  }
  axes.panel.series.push_back(std::move(line));
  return std::move(axes.panel);
}

// Two curves on common axes; the second one is dashed. has_dots: where their points are few.
PlotPanel panel_of_both(const SceneCurve& here, const SceneCurve& other, const ComparedNames& names,
                        bool has_dots) {
  SceneCurve all = here;
  all.x.insert(all.x.end(), other.x.begin(), other.x.end());
  all.value.insert(all.value.end(), other.value.begin(), other.value.end());
  EmptyPanel axes = axes_of(all);
  for (const auto& [curve, name, index] :
       {std::tuple(&here, &names.here, 0), std::tuple(&other, &names.other, 1)}) {
    PlotSeries line = axes.line(*curve);
    line.label = *name;
    line.ink = ink_of_series(static_cast<std::size_t>(index));
    line.pattern = index;
    PlotSeries dots = line;
    dots.mark = Mark::kPoints;
    dots.label.clear();
    axes.panel.series.push_back(std::move(line));
    if (has_dots) axes.panel.series.push_back(std::move(dots));
  }
  return std::move(axes.panel);
}

// A profile as a curve over x.
SceneCurve curve_of(const VoltageProfile& profile) {
  return {.name = profile.name,
          .unit = "V",
          .x = profile.x_m,
          .value = profile.value_V,
          .x_name = "x_m",
          .error = {},
          .allowed = {}};
}

// One part of a complex amplitude: its magnitude and phase say as much.
bool is_part(const std::string& curve) {
  return curve.ends_with("_real") || curve.ends_with("_imaginary") || curve.ends_with("_phase");
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

// "reading_3_4"
bool is_of_one_pillar(const std::string& curve) {
  const std::size_t column = curve.rfind('_');
  const std::size_t row =
      column == std::string::npos || column == 0 ? column : curve.rfind('_', column - 1);
  if (row == std::string::npos || column - row < 2 || column + 1 >= curve.size()) return false;
  return curve.find_first_not_of("0123456789_", row) == std::string::npos;
}

}  // namespace

std::vector<double> unwrapped(std::vector<double> phase_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (std::size_t i = 1; i < phase_rad.size(); ++i) {
    phase_rad[i] -= kTurn * std::round((phase_rad[i] - phase_rad[i - 1]) / kTurn);
  }
  return phase_rad;
}

Pictures pictures_of(const SceneAnswer& answer) {
  Pictures pictures;
  // Of many pillars the tables hold each curve; touch.svg shows the largest of them.
  constexpr std::size_t kMostOfPillars = 16;
  std::size_t n_of_pillars = 0;
  for (const SceneCurve& curve : answer.curves)
    n_of_pillars += is_of_one_pillar(curve.name) ? 1 : 0;
  for (const SceneCurve& curve : answer.curves) {
    if (is_part(curve.name) || curve.x.size() < 2) continue;
    if (n_of_pillars > kMostOfPillars && is_of_one_pillar(curve.name)) continue;
    Plot plot;
    plot.title = label_of(curve, curve.unit);
    plot.description = plot.title + " against " + curve.x_name;
    plot.panels.push_back(panel_of(curve));
    const std::string stem = curve.name.substr(0, curve.name.rfind('_'));
    const SceneCurve* phase = find(answer, stem + "_phase");
    if (phase != nullptr && curve.name.ends_with("_magnitude")) {
      plot.panels.front().shares_x_with_below = true;
      SceneCurve steady = *phase;
      steady.value = unwrapped(steady.value);
      plot.panels.push_back(panel_of(steady));
      plot.height_px = 560;
    }
    if (!draw(curve.name, plot, "curve", pictures)) return {};
  }
  draw_touch(answer, pictures);
  return pictures;
}

Pictures pictures_of_compared(const SceneAnswer& here, const SceneAnswer& other,
                              const ComparedAnswers& compared, const ComparedNames& names) {
  Pictures pictures;
  const auto add = [&](const SceneCurve& one, const SceneCurve& two) {
    Plot plot{.title = label_of(one, one.unit), .panels = {}};
    plot.description = plot.title + " of " + names.here + " and of " + names.other;
    plot.panels.push_back(panel_of_both(one, two, names, one.x_name == "x_m"));
    if (!spans_decades({largest_size(one.value), largest_size(two.value)}))
      return draw("compared_" + one.name, plot, "compared", pictures);
    // A common axis would show the smaller one as a line at 0.
    plot.panels = {panel_of(one), panel_of(two)};
    plot.panels[0].title = names.here;
    plot.panels[1].title = names.other;
    plot.height_px = 640;
    return draw("compared_" + one.name, plot, "compared", pictures);
  };
  for (const SceneCurve& curve : here.curves) {
    const SceneCurve* beside = find(other, curve.name);
    if (beside == nullptr || is_part(curve.name) || curve.x.size() < 2 || beside->x.size() < 2)
      continue;
    if (beside->x_name == curve.x_name && !add(curve, *beside)) return {};
  }
  for (const ComparedProfile& profile : compared.profiles) {
    if (!add(curve_of(profile.here), curve_of(profile.other))) return {};
  }
  return pictures;
}

}  // namespace viscard
