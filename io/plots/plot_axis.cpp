#include "io/plots/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr double kMargin = 0.04;
constexpr double kSlack = 1.25;  // labels may stand this much closer for a rounder step
constexpr const char* kMinus = "−";

std::string superscript(int exponent) {
  static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

std::string with_true_minus(const std::string& text) {
  return text.front() == '-' ? kMinus + text.substr(1) : text;
}

// 1, 2 or 5 times a power of ten, not much below `step`.
double round_step(double step) {
  const double decade = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (step <= kSlack * factor * decade) return factor * decade;
  }
  return 10.0 * decade;
}

// One number of decimals for the whole axis, so that labels line up.
std::string step_label(double value, double step) {
  if (std::abs(value) < 1e-6 * step) return "0";
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  if (decimals > 5 || std::abs(value) >= 1e6) return readable_number(value, 6);
  return with_true_minus(fmt::format("{:.{}f}", value, decimals));
}

std::vector<Tick> linear_ticks(double min, double max, int n_labels) {
  const double step = round_step((max - min) / std::max(1, n_labels));
  std::vector<Tick> ticks;
  for (double k = std::ceil(min / step - 1e-9); k * step <= max + 1e-9 * step; k += 1.0) {
    ticks.push_back({k * step, step_label(k * step, step)});
  }
  return ticks;
}

std::string decade_label(int exponent, bool is_plain) {
  if (is_plain) return fmt::format("{:g}", std::pow(10.0, exponent));
  return "10" + superscript(exponent);
}

std::vector<Tick> decade_ticks(double min, double max, int n_labels) {
  const int first = static_cast<int>(std::floor(std::log10(min)));
  const int last = static_cast<int>(std::ceil(std::log10(max)));
  const double decades = std::log10(max / min);
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / std::max(1, n_labels))));
  const bool is_plain = std::ceil(std::log10(min)) >= -3.0 && std::floor(std::log10(max)) <= 4.0;
  const bool labels_parts = decades <= 1.5 && n_labels >= 4;
  std::vector<Tick> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int part = 1; part <= (stride > 1 || decades > 12 ? 1 : 9); ++part) {
      const double value = part * std::pow(10.0, exponent);
      if (value < min * (1.0 - 1e-9) || value > max * (1.0 + 1e-9)) continue;
      std::string label;
      if (part == 1 && exponent % stride == 0) label = decade_label(exponent, is_plain);
      if (labels_parts && (part == 2 || part == 5)) label = readable_number(value, 2);
      ticks.push_back({value, label});
    }
  }
  return ticks;
}

bool can_show(const PlotAxis& axis, double value) {
  return std::isfinite(value) && !(axis.is_log && value <= 0.0);
}

void widen_if_empty(AxisRange& range) {
  if (range.max > range.min) return;
  if (range.is_log) {
    range.min /= 2.0;
    range.max *= 2.0;
    return;
  }
  const double half = range.min == 0.0 ? 1.0 : 0.05 * std::abs(range.min);
  range.min -= half;
  range.max += half;
}

}  // namespace

AxisRange axis_range(const PlotAxis& axis, const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!can_show(axis, value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) {
    low = axis.is_log ? 1.0 : 0.0;
    high = axis.is_log ? 10.0 : 1.0;
  }
  AxisRange range{low, high, axis.is_log};
  widen_if_empty(range);
  if (axis.is_log) {
    const double factor = std::pow(range.max / range.min, kMargin);
    range.min /= factor;
    range.max *= factor;
  } else {
    const double margin = kMargin * (range.max - range.min);
    range.min -= margin;
    range.max += margin;
  }
  if (axis.min && can_show(axis, *axis.min)) range.min = *axis.min;
  if (axis.max && can_show(axis, *axis.max)) range.max = *axis.max;
  if (range.min > range.max) std::swap(range.min, range.max);
  widen_if_empty(range);
  return range;
}

double axis_fraction(const AxisRange& range, double value) {
  if (!range.is_log) return (value - range.min) / (range.max - range.min);
  if (!(value > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / range.min) / std::log(range.max / range.min);
}

std::vector<Tick> axis_ticks(const AxisRange& range, int length_px, int px_per_label) {
  const int n_labels = std::max(3, length_px / px_per_label);
  if (range.is_log && range.max / range.min > 3.0) {
    return decade_ticks(range.min, range.max, n_labels);
  }
  return linear_ticks(range.min, range.max, n_labels);
}

std::string readable_number(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (exponent >= -4 && exponent < 6) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    // %g turns to exponents once the digits do not reach the point: 1.8e+05
    if (text.find('e') != std::string::npos) text = fmt::format("{:.0f}", std::stod(text));
    return with_true_minus(text);
  }
  std::string text = fmt::format("{:.{}e}", value, std::max(0, digits - 1));
  const std::size_t e = text.find('e');
  exponent = std::stoi(text.substr(e + 1));
  std::string mantissa = text.substr(0, e);
  if (mantissa.find('.') != std::string::npos) {
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  if (mantissa == "1") return "10" + superscript(exponent);
  return with_true_minus(mantissa) + "×10" + superscript(exponent);
}

}  // namespace viscard
