#include "io/basics/units.h"

#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"

#include <locale.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

// UDUNITS keeps its parser and its error handler in globals, and reads reals with strtod.
class UnitsGuard {
 public:
  UnitsGuard() : lock_(mutex()), before_(uselocale(c_locale())) {}
  ~UnitsGuard() { uselocale(before_); }
  UnitsGuard(const UnitsGuard&) = delete;
  UnitsGuard& operator=(const UnitsGuard&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex the_mutex;
    return the_mutex;
  }
  static locale_t c_locale() {
    static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
    return locale;
  }
  std::lock_guard<std::mutex> lock_;
  locale_t before_;
};

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

// UDUNITS ends the process if memory ends within it.
constexpr std::size_t kDatabase_B = std::size_t{4} << 20;
constexpr std::size_t kParse_B = std::size_t{64} << 10;

// The database, read once (about 5 ms) for the first unit. Call it while holding a UnitsGuard.
ut_system* unit_system() {
  using System = std::unique_ptr<ut_system, decltype(&ut_free_system)>;
  static const System system = [] {
    require_spare_memory(kDatabase_B);
    ut_set_error_message_handler(&ut_ignore);
    errno = 0;
    System read(ut_read_xml(nullptr), &ut_free_system);
    if (read) return read;
    const bool is_missing = errno == 0 || errno == ENOENT;
    const std::string reason = is_missing ? "" : std::string(" (") + std::strerror(errno) + ")";
    throw std::runtime_error("the UDUNITS database cannot be read" + reason +
                             (is_missing || errno == EACCES
                                  ? "; install the package libudunits2-data (or set "
                                    "UDUNITS2_XML_PATH to its udunits2.xml)"
                                  : "; the machine, and not the file, stands in the way: close "
                                    "other programs or raise the limit, and try again"));
  }();
  return system.get();
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Words that UDUNITS does not know: some count something, so they have no dimension; some instruments write
// units in capitals (by the SI, MM would be a million metres).
std::string with_known_words(std::string_view text, bool is_temperature) {
  struct Word {
    std::string_view word, meaning;
  };
  constexpr std::array<Word, 28> kWords{
      {{"step", "1"},  {"steps", "1"},      {"sample", "1"}, {"samples", "1"},      {"sps", "s-1"},
       {"SPS", "s-1"}, {"counts", "count"}, {"secs", "s"},   {"deg", "arc_degree"}, {"dyn", "dyne"},
       {"SEC", "s"},   {"Sec", "s"},        {"Secs", "s"},   {"msec", "ms"},        {"mins", "min"},
       {"MIN", "min"}, {"PSI", "psi"},      {"Psi", "psi"},  {"KSI", "ksi"},        {"MPA", "MPa"},
       {"KPA", "kPa"}, {"KPa", "kPa"},      {"GPA", "GPa"},  {"IN", "in"},          {"MM", "mm"},
       {"LBF", "lbf"}, {"HZ", "Hz"},        {"KN", "kN"}}};
  constexpr std::array<Word, 39> kLocal{{{"µε", "1e-6"},
                                         {"με", "1e-6"},
                                         {"µstrain", "1e-6"},
                                         {"ustrain", "1e-6"},
                                         {"microstrain", "1e-6"},
                                         {"ue", "1e-6"},
                                         {"秒", "s"},
                                         {"毫秒", "ms"},
                                         {"分钟", "min"},
                                         {"牛", "N"},
                                         {"牛顿", "N"},
                                         {"毫牛", "mN"},
                                         {"千牛", "kN"},
                                         {"毫米", "mm"},
                                         {"微米", "um"},
                                         {"帕", "Pa"},
                                         {"千帕", "kPa"},
                                         {"兆帕", "MPa"},
                                         {"赫兹", "Hz"},
                                         {"弧度/秒", "rad/s"},
                                         {"摄氏度", "degC"},
                                         {"分", "min"},
                                         {"ニュートン", "N"},
                                         {"с", "s"},
                                         {"сек", "s"},
                                         {"мс", "ms"},
                                         {"мин", "min"},
                                         {"Н", "N"},
                                         {"мН", "mN"},
                                         {"кН", "kN"},
                                         {"м", "m"},
                                         {"мм", "mm"},
                                         {"мкм", "um"},
                                         {"Па", "Pa"},
                                         {"кПа", "kPa"},
                                         {"МПа", "MPa"},
                                         {"ГПа", "GPa"},
                                         {"Гц", "Hz"},
                                         {"рад/с", "rad/s"}}};
  if (is_temperature && (text == "C" || text == "°C")) return "degC";
  for (const Word& local : kLocal) {
    if (text == local.word) return std::string(local.meaning);
  }
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_letter(text[end])) ++end;
    if (end == i) {
      out += text[i++];
      continue;
    }
    const std::string_view word = text.substr(i, end - i);
    const auto* known = std::find_if(kWords.begin(), kWords.end(),
                                     [&](const Word& entry) { return entry.word == word; });
    out += known == kWords.end() ? word : known->meaning;
    i = end;
  }
  return out;
}

bool is_no_unit(std::string_view text) {
  return text.empty() || text == "-" || text == "1";
}

Unit parse(std::string_view text, bool is_temperature) {
  if (text.find('\0') != std::string_view::npos || text.size() > 100) return {nullptr, &ut_free};
  const std::string words = with_known_words(text, is_temperature);
  require_spare_memory(kParse_B);
  return {ut_parse(unit_system(), words.c_str(), UT_UTF8), &ut_free};
}

bool has_angle(const ut_unit* unit) {
  std::array<char, 256> text{};
  const int size = ut_format(unit, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
  return size > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

// Returns the scale, or nothing if the text is not a unit or measures another quantity.
std::optional<UnitScale> try_scale(std::string_view unit_text, std::string_view si_unit) {
  const UnitsGuard guard;
  const bool is_temperature = si_unit == "degC" || si_unit == "K";
  const Unit from = parse(is_no_unit(unit_text) ? "1" : unit_text, is_temperature);
  const Unit to = parse(is_no_unit(si_unit) ? "1" : si_unit, is_temperature);
  if (!from || !to || ut_are_convertible(from.get(), to.get()) == 0) return std::nullopt;
  const Converter converter(ut_get_converter(from.get(), to.get()), &cv_free);
  if (!converter) return std::nullopt;
  const double at_0 = cv_convert_double(converter.get(), 0.0);
  const double at_1 = cv_convert_double(converter.get(), 1.0);
  const double at_2 = cv_convert_double(converter.get(), 2.0);
  UnitScale scale{at_1 - at_0, at_0};
  // Reciprocal and logarithmic units have no scale.
  const bool is_straight = std::abs(at_2 - at_1 - scale.factor) <= 1e-9 * std::abs(scale.factor);
  if (!is_straight || !std::isfinite(scale.factor) || scale.factor == 0.0) return std::nullopt;
  if (si_unit == "Hz" && has_angle(from.get())) scale.factor /= 2.0 * std::numbers::pi;
  return scale;
}

const char* example_of(std::string_view si_unit) {
  struct Example {
    std::string_view unit;
    const char* text;
  };
  static constexpr std::array<Example, 16> kExamples{{{"m", "\"40 um\""},
                                                      {"s", "\"250 ms\""},
                                                      {"Pa", "\"1.8 MPa\""},
                                                      {"N", "\"250 gf\""},
                                                      {"V", "\"1.2 uV\""},
                                                      {"V/N", "\"0.7255 V/N\""},
                                                      {"N/m", "\"10 N/mm\""},
                                                      {"m/s", "\"0.5 mm/s\""},
                                                      {"m/s2", "\"200 mm/s2\""},
                                                      {"kg/m3", "\"965 kg/m3\""},
                                                      {"Hz", "\"80 Hz\""},
                                                      {"degC", "\"23 degC\""},
                                                      {"K", "\"296 K\""},
                                                      {"1/m", "\"3200 steps/mm\""},
                                                      {"1/s", "\"1e-6 1/s\""},
                                                      {"1", "0.05 or \"5 %\""}}};
  for (const Example& example : kExamples) {
    if (example.unit == si_unit) return example.text;
  }
  return nullptr;
}

// own_example: of the quantity; null or empty: there is none.
[[noreturn]] void fail(std::string_view text, std::string_view si_unit, const std::string& why,
                       const char* own_example = nullptr) {
  std::string message = "'" + std::string(text) + "' " + why;
  if (own_example != nullptr && *own_example != '\0') {
    const bool has_blank = std::string_view(own_example).find(' ') != std::string_view::npos;
    const char* const quote = has_blank ? "\"" : "";
    message += std::string("; write it like ") + quote + own_example + quote;
  } else if (const char* example = example_of(is_no_unit(si_unit) ? "1" : si_unit)) {
    message += "; write it like " + std::string(example);
  }
  throw std::invalid_argument(message);
}

std::string unit_name(std::string_view si_unit) {
  return is_no_unit(si_unit) ? "a plain number" : "a unit of " + std::string(si_unit);
}

// Returns n if factor = 10^n within rounding.
std::optional<int> power_of_ten(double factor) {
  const double exponent = std::round(std::log10(std::abs(factor)));
  if (!(std::abs(exponent) < 30.0)) return std::nullopt;
  const bool is_power = std::abs(factor / std::pow(10.0, exponent) - 1.0) < 1e-12;
  return is_power ? std::optional<int>(static_cast<int>(exponent)) : std::nullopt;
}

// Shifts the decimal point in the text: 0.13 * 1e-3 may differ from 0.13e-3 in the last bit.
double scaled(std::string_view digits, double value, const UnitScale& scale) {
  const auto shift = power_of_ten(scale.factor);
  if (!shift || scale.offset != 0.0) return value * scale.factor + scale.offset;
  int exponent = *shift;
  const std::size_t e = digits.find_first_of("eE");
  if (e != std::string_view::npos) {
    int written = 0;
    const std::size_t first = e + (digits[e + 1] == '+' ? 2 : 1);
    std::from_chars(digits.data() + first, digits.data() + digits.size(), written);
    exponent += written;
  }
  const std::string shifted = std::string(digits.substr(0, e)) + "e" + std::to_string(exponent);
  double out = 0.0;
  std::from_chars(shifted.data(), shifted.data() + shifted.size(), out);
  return out;
}

}  // namespace

std::string_view unit_in_right_case(std::string_view unit_text, const char* si_unit) {
  static constexpr std::array<std::string_view, 22> kCommon{
      "MPa", "kPa", "GPa", "Pa", "N", "mN", "uN",  "nN", "kN", "m",  "mm",
      "um",  "nm",  "s",   "ms", "h", "Hz", "kHz", "V",  "mV", "kg", "psi"};
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  const std::string_view unit = trimmed(unit_text);
  for (const std::string_view common : kCommon) {
    const bool is_same = std::equal(unit.begin(), unit.end(), common.begin(), common.end(),
                                    [&](char a, char b) { return lower(a) == lower(b); });
    if (is_same && is_unit_of(common, si_unit)) return common;
  }
  return {};
}

namespace {

UnitScale scale_or_fail(std::string_view unit, const char* si_unit, const char* example) {
  if (const auto scale = try_scale(unit, si_unit)) return *scale;
  const std::string_view meant = unit_in_right_case(unit, si_unit);
  std::string why = is_unit(unit)
                        ? "is not "
                        : "is not a known unit (capitals matter" +
                              (meant.empty() ? "" : ": " + std::string(meant)) + "); expected ";
  why += unit_name(si_unit);
  if (std::string_view(si_unit) == "N" && try_scale(unit, "kg")) {
    why += " (for the weight of a mass write gf or kgf)";
  }
  fail(unit, si_unit, why, example);
}

}  // namespace

UnitScale scale_to_si(std::string_view unit_text, const char* si_unit) {
  return scale_or_fail(trimmed(unit_text), si_unit, nullptr);
}

bool is_unit_of(std::string_view unit_text, const char* si_unit) {
  return try_scale(trimmed(unit_text), si_unit).has_value();
}

bool is_unit(std::string_view unit_text) {
  const std::string_view unit = trimmed(unit_text);
  if (is_no_unit(unit)) return true;
  const UnitsGuard guard;
  return parse(unit, true) != nullptr;
}

double si_from_text(std::string_view text, const char* si_unit, const char* example) {
  const std::string_view all = trimmed(text);
  std::string_view digits = all;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument) {
    fail(text, si_unit,
         is_no_unit(si_unit)
             ? "does not begin with a number; expected a plain number"
             : "does not begin with a number; expected a number and " + unit_name(si_unit),
         example);
  }
  if (error != std::errc() || !std::isfinite(value))
    fail(text, si_unit, "is not a finite number", example);
  const std::string_view unit =
      trimmed({end, static_cast<std::size_t>(digits.data() + digits.size() - end)});
  if (unit.empty()) return value;
  if (unit.front() == ',')
    fail(text, si_unit, "has a comma; the decimal sign here is a point", example);
  const std::string_view number(digits.data(), static_cast<std::size_t>(end - digits.data()));
  return scaled(number, value, scale_or_fail(unit, si_unit, example));
}

}  // namespace viscard
