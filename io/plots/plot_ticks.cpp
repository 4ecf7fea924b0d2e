#include "io/plots/plot_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kMostTicks = 10.0;
constexpr double kDigit_px = 6.7;  // width of a digit of the 12 px font
constexpr double kGap_px = 17.0;   // from the end of a number to the next
constexpr double kLeastLabel_px = 64.0;
constexpr double kLabelHeight_px = 18.0;
constexpr int kUsualDigits = 6, kMostDigits = 15;
constexpr std::size_t kPowerCharacters = 5;  // "10^{-12}" is drawn with a small exponent

// 1, 2 or 5 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1.0 - 1e-9)) return digit * power;
  }
  return 10.0 * power;
}

// The digits that tell neighbours on an axis of these numbers apart.
int digits_of(const AxisSpan& shown, double step) {
  const double largest = std::max(std::abs(shown.low), std::abs(shown.high));
  const double places = std::floor(std::log10(largest)) - std::floor(std::log10(step));
  return std::clamp(1 + static_cast<int>(places), kUsualDigits, kMostDigits);
}

// As gnuplot's %h: 2e-05 is drawn as 2 x 10^-5.
std::size_t characters_of(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  const std::size_t e = text.find('e');
  return e == std::string::npos ? text.size() : e + kPowerCharacters;
}

std::size_t longest(const AxisSpan& shown, double step, int digits) {
  std::size_t characters = 1;
  const double first = std::ceil(shown.low / step - 1e-6);
  const int n = static_cast<int>((shown.high - shown.low) / step + 1e-6);
  for (int i = 0; i <= n; ++i) {
    characters = std::max(characters, characters_of((first + i) * step, digits));
  }
  return characters;
}

AxisTicks ticks_of_log(const AxisSpan& span, bool has_powers) {
  if (has_powers) return {span, 0.0, "10^{%L}", kPowerCharacters};
  return {span, 0.0, "%h",
          std::max(characters_of(std::pow(10.0, std::ceil(std::log10(span.low))), kUsualDigits),
                   characters_of(std::pow(10.0, std::floor(std::log10(span.high))), kUsualDigits))};
}

}  // namespace

AxisTicks ticks_of(const PlotAxis& axis, const AxisSpan& span, double length_px, bool is_along,
                   bool has_powers) {
  if (span.is_log) return ticks_of_log(span, has_powers);
  const double fine = round_step((span.high - span.low) / kMostTicks);
  AxisTicks ticks{span, fine, "%h", 0};
  const auto is_given = [&](double end) { return axis.min == end || axis.max == end; };
  if (!is_given(span.low)) ticks.shown.low = fine * std::floor(span.low / fine + 1e-9);
  if (!is_given(span.high)) ticks.shown.high = fine * std::ceil(span.high / fine - 1e-9);
  const double length = ticks.shown.high - ticks.shown.low;
  const auto digits = [&] { return digits_of(ticks.shown, ticks.step); };
  const auto characters = [&] { return longest(ticks.shown, ticks.step, digits()); };
  const double own_px = kDigit_px * static_cast<double>(characters()) + kGap_px;
  const double label_px = is_along ? std::max(own_px, kLeastLabel_px) : kLabelHeight_px;
  const double room = std::max(length_px / label_px, 2.0);
  // Numbers at a wider step are at most as long.
  if (room < std::min(kMostTicks, length / fine)) ticks.step = round_step(length / room);
  ticks.characters = characters();
  if (digits() > kUsualDigits) ticks.format = fmt::format("%.{}h", digits());
  return ticks;
}

}  // namespace viscard
