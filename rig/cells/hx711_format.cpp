#include "rig/cells/hx711_format.h"

#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kFewestLines = 6;
constexpr std::size_t kMostLines = 16;
constexpr double kLargest_V = 100.0;
constexpr double kMost = 0.8;        // of the steps of a clock; the others are resets and faults
constexpr double kNotGrowing = 0.4;  // of the steps of a number that is no clock, at least
constexpr std::size_t kFewestNotGrowing = 3;
constexpr double kMostRepeats = 0.7;  // of the steps: each line twice makes half of them 0
constexpr double kTickUnits_s[] = {1e-6, 1e-3};
constexpr Hx711Format kTickFormats[] = {Hx711Format::kMicrosCounts, Hx711Format::kMillisCounts};

// Statistics of a window of lines, read with and without a clock.
struct Window {
  std::size_t n_lines = 0;
  std::vector<double> steps;  // of the clock, modulo 2^32
  std::size_t n_timed = 0;
  bool is_plain = true;  // all lines are numbers without a clock
  bool is_integer = true;
  bool has_unit = false;
  std::vector<double> values;
  double arrival_step_s = 0.0;
};

// Steps of a 32-bit counter: a wrap is a small step forward, a reset usually a large one backward.
double counter_step(double from, double to) {
  return std::remainder(to - from, 4294967296.0);
}

Window window_of(const std::deque<ReceivedLine>& lines) {
  Window window;
  window.n_lines = lines.size();
  std::optional<double> ticks_before;
  for (const ReceivedLine& line : lines) {
    if (const auto timed = parse_hx711_line(line.text, true)) {
      if (ticks_before) window.steps.push_back(counter_step(*ticks_before, *timed->ticks));
      ticks_before = timed->ticks;
      ++window.n_timed;
    }
    const auto plain = parse_hx711_line(line.text, false);
    window.is_plain = window.is_plain && plain.has_value();
    window.is_integer = window.is_integer && plain && plain->is_integer;
    window.has_unit = window.has_unit || (plain && !plain->unit.empty());
    if (plain && plain->value) window.values.push_back(*plain->value);
  }
  if (lines.size() > 1) {
    window.arrival_step_s =
        (lines.back().time_s - lines.front().time_s) / static_cast<double>(lines.size() - 1);
  }
  return window;
}

// True if most of the steps are within a factor of the expected one.
bool most_are_about(const std::vector<double>& steps, double expected, double factor) {
  const auto n_good = std::count_if(steps.begin(), steps.end(), [&](double step) {
    return step * factor > expected && step < factor * expected;
  });
  return static_cast<double>(n_good) >= kMost * static_cast<double>(steps.size());
}

std::size_t number_of(const std::vector<double>& steps, bool (*is_one)(double)) {
  return static_cast<std::size_t>(std::count_if(steps.begin(), steps.end(), is_one));
}

// A line that was sent twice has one time.
std::vector<double> without_repeats(std::vector<double> steps) {
  steps.erase(std::remove(steps.begin(), steps.end(), 0.0), steps.end());
  return steps;
}

std::optional<Hx711Format> clock_format(const Window& window, double rate_Hz) {
  const std::vector<double> steps = without_repeats(window.steps);
  if (steps.size() + 1 < kFewestLines) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    if (most_are_about(steps, 1.0 / (kTickUnits_s[i] * rate_Hz), 10.0 / 3.0)) {
      return kTickFormats[i];
    }
  }
  if (window.n_lines < kMostLines) return std::nullopt;
  // If the expected rate is wrong, the steps are nevertheless even, and as long as those of the
  // arrivals.
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  if (!most_are_about(steps, median, 2.0)) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    const double step_s = median * kTickUnits_s[i];
    if (most_are_about({step_s}, window.arrival_step_s, 5.0)) return kTickFormats[i];
  }
  return std::nullopt;
}

// False while a part of the lines may begin with a clock.
bool is_surely_no_clock(const Window& window) {
  if (window.n_timed == 0) return true;
  if (window.n_lines >= kMostLines && 4 * window.n_timed < window.n_lines) return true;
  const std::size_t n_zero = number_of(window.steps, [](double step) { return step == 0.0; });
  const std::size_t n = n_zero + number_of(window.steps, [](double step) { return step < 0.0; });
  const auto most_repeats =
      static_cast<std::size_t>(kMostRepeats * static_cast<double>(window.steps.size()));
  if (window.n_lines < kMostLines && n == n_zero && n <= most_repeats) return false;
  return n >= kFewestNotGrowing &&
         static_cast<double>(n) >= kNotGrowing * static_cast<double>(window.steps.size());
}

bool is_fraction(double value) {
  return value != std::floor(value);
}
bool is_large(double value) {
  return std::abs(value) > kLargest_V;
}

// Counts printed as floating-point numbers, such as a mean "20386.0": no amplifier of a load cell
// gives 100 V, and noise never makes whole volts.
bool are_counts(const std::vector<double>& values) {
  const bool is_constant =
      std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
  return std::any_of(values.begin(), values.end(), is_large) ||
         (!is_constant && std::none_of(values.begin(), values.end(), is_fraction));
}

std::optional<Hx711Format> format_of(const Window& window, double rate_Hz) {
  if (4 * window.n_timed >= 3 * window.n_lines) {
    if (const auto format = clock_format(window, rate_Hz)) return format;
  }
  if (!window.is_plain || !is_surely_no_clock(window)) return std::nullopt;
  return window.is_integer || are_counts(window.values) ? Hx711Format::kCounts
                                                        : Hx711Format::kVolts;
}

}  // namespace

std::optional<LineColumns> declared_columns(const LoadCellConfig& config) {
  if (hx711_format_from_word(config.line_format)) return std::nullopt;
  return line_columns_from_word(config.line_format);
}

Hx711Format declared_hx711_format(const LoadCellConfig& config) {
  const auto format = hx711_format_from_word(config.line_format);
  if (const auto columns = declared_columns(config)) return columns->format;
  if (!format) {
    throw RigError(
        "load cell line_format '" + config.line_format +
        "' is unknown; choose auto, counts, micros,counts, millis,counts or volts, or name "
        "the columns, such as -,counts");
  }
  return *format;
}

std::optional<Hx711Format> learnt_hx711_format(const std::deque<ReceivedLine>& lines,
                                               double rate_Hz) {
  return format_of(window_of(lines), rate_Hz);
}

Hx711Learner::Hx711Learner(const LoadCellConfig& config)
    : declared_(declared_hx711_format(config)),
      has_unit_(!config.unit.empty()),
      rate_Hz_(config.expected_rate_Hz) {}

std::optional<Hx711Format> Hx711Learner::take(const ReceivedLine& line) {
  lines_.push_back(line);
  if (lines_.size() > kMostLines) lines_.pop_front();
  if (lines_.size() < kFewestLines) return std::nullopt;
  const bool is_full = lines_.size() == kMostLines;
  const auto learnt = learnt_hx711_format(lines_, rate_Hz_);
  if (declared_ == Hx711Format::kAuto) return learnt;
  if (learnt && contradicts_declared(*learnt)) {
    if (!is_full) return std::nullopt;
    const std::string right = std::string("line_format = \"") + word_of(*learnt) + "\"";
    throw RigError(std::string("line_format = \"") + word_of(declared_) +
                   "\" under [load_cell] of the rig file cannot be right: lines such as '" +
                   shown_bytes(line.text) + "' are " + word_of(*learnt) + ". Set " + right);
  }
  if (!has_declared_shape()) return std::nullopt;
  if (!learnt && !is_full && window_of(lines_).n_timed > 0) return std::nullopt;
  return declared_;
}

bool Hx711Learner::has_declared_shape() const {
  return std::all_of(lines_.end() - kFewestLines, lines_.end(), [&](const ReceivedLine& line) {
    return parse_hx711_line(line.text, has_clock(declared_)).has_value();
  });
}

// Weights carry a unit and may look like volts or like counts.
bool Hx711Learner::contradicts_declared(Hx711Format learnt) const {
  if (learnt == declared_) return false;
  if (has_clock(learnt) || has_clock(declared_)) return true;
  const Window window = window_of(lines_);
  if (has_unit_ || window.has_unit) return false;
  return std::any_of(window.values.begin(), window.values.end(),
                     declared_ == Hx711Format::kVolts ? is_large : is_fraction);
}

const std::string& Hx711Learner::newest_text() const {
  static const std::string kNone;
  return lines_.empty() ? kNone : lines_.back().text;
}

}  // namespace viscard
