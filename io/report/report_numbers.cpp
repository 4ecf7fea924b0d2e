#include "io/report/report_numbers.h"

#include "io/basics/words.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

constexpr int kDigitsAlone = 4;

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

struct Prefix {
  double factor;
  const char* text;
};
constexpr std::array<Prefix, 7> kPrefixes{
    {{1e-9, "n"}, {1e-6, "µ"}, {1e-3, "m"}, {1.0, ""}, {1e3, "k"}, {1e6, "M"}, {1e9, "G"}}};

const Prefix& prefix_for(double magnitude) {
  const Prefix* chosen = &kPrefixes.front();
  for (const Prefix& prefix : kPrefixes) {
    if (magnitude >= 0.99999 * prefix.factor) chosen = &prefix;
  }
  return *chosen;
}

std::string with_true_minus(const std::string& text) {
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

// The decimals that show two digits of the half-width, negative if those digits are before the
// point; -100 without an interval.
int decimals_of(const Interval& interval) {
  const double half = 0.5 * (interval.high - interval.low);
  if (!(half > 0.0) || !std::isfinite(half)) return -100;
  return 1 - static_cast<int>(std::floor(std::log10(half) + 1e-9));
}

std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) return "unbounded";
  if (decimals == -100) return readable_number(value, kDigitsAlone);
  if (decimals > 9 || std::abs(value) >= 1e7) {
    const int before =
        value == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
    return readable_number(value, std::clamp(before + decimals, 1, 12));
  }
  const std::string text = fmt::format("{:.{}f}", value, std::max(0, decimals));
  return with_true_minus(text);
}

}  // namespace

std::string readable_number(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (exponent >= -4 && exponent < 6) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    // %g writes 1.8e+05 when there are fewer digits than places before the point.
    if (text.find('e') != std::string::npos) text = fmt::format("{:.0f}", leading_number(text));
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

ShownUnit shown_unit(const std::string& base, const std::vector<double>& values_SI) {
  const double largest = largest_magnitude(values_SI);
  if (base == "1/Pa") {
    if (largest == 0.0) return {1.0, base};
    const Prefix& prefix = prefix_for(1.0 / largest);
    return {prefix.factor, "1/" + std::string(prefix.text) + "Pa"};
  }
  const bool takes_prefix = base == "Pa" || base == "N" || base == "N/m" || base == "V" ||
                            base == "V/m" || base == "V/Pa" || base == "m" || base == "s";
  if (!takes_prefix || largest == 0.0) return {1.0, base};
  const Prefix& prefix = prefix_for(largest);
  if (prefix.factor > 1.0 && (base == "s" || base == "m")) return {1.0, base};
  return {1.0 / prefix.factor, prefix.text + base};
}

std::string number_text(double value, const Interval* interval) {
  if (!std::isfinite(value)) return "–";
  if (interval == nullptr) return readable_number(value, kDigitsAlone);
  return fixed_text(value, decimals_of(*interval));
}

std::string interval_text(const Interval& interval) {
  const int decimals = decimals_of(interval);
  return "[" + fixed_text(interval.low, decimals) + ", " + fixed_text(interval.high, decimals) +
         "]";
}

std::string number_html(double value_SI, double per_si, const Interval* interval_SI) {
  if (!std::isfinite(value_SI)) return "–";
  Interval shown;
  if (interval_SI != nullptr) shown = {interval_SI->low * per_si, interval_SI->high * per_si};
  const std::string text =
      number_text(value_SI * per_si, interval_SI != nullptr ? &shown : nullptr);
  return fmt::format("<data value=\"{:.15g}\">{}</data>", value_SI, text);
}

std::string interval_html(const Interval& interval_SI, double per_si) {
  const bool has_low = std::isfinite(interval_SI.low), has_high = std::isfinite(interval_SI.high);
  const bool is_unset = interval_SI.low == 0.0 && interval_SI.high == 0.0;
  if ((!has_low && !has_high) || is_unset) return "";
  return "<span class=\"ci\">" +
         interval_text({interval_SI.low * per_si, interval_SI.high * per_si}) + "</span>";
}

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values);
  for (double& value : out) value *= factor;
  return out;
}

}  // namespace viscard
