#include "io/tables/clock_times.h"

#include "io/tables/csv_dialect.h"
#include "io/tables/csv_header.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace viscard {
namespace {

constexpr double kDay_s = 86400.0, kHour_s = 3600.0, kMinute_s = 60.0;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Takes up to `most` digits from the begin of the text.
std::optional<int> take_number(std::string_view& text, std::size_t most) {
  std::size_t n = 0;
  int value = 0;
  while (n < text.size() && n < most && is_digit(text[n])) value = 10 * value + (text[n++] - '0');
  if (n == 0) return std::nullopt;
  text.remove_prefix(n);
  return value;
}

bool take_mark(std::string_view& text, char mark) {
  if (text.empty() || text.front() != mark) return false;
  text.remove_prefix(1);
  return true;
}

// Days since 1970-01-01; nothing if the text does not begin with a date.
std::optional<double> take_date(std::string_view& text, DateOrder order) {
  std::string_view rest = text;
  const auto first = take_number(rest, 4);
  if (!first || rest.empty()) return std::nullopt;
  const char mark = rest.front();
  if (mark != '-' && mark != '/' && mark != '.') return std::nullopt;
  rest.remove_prefix(1);
  const auto second = take_number(rest, 2);
  if (!second || !take_mark(rest, mark)) return std::nullopt;
  const auto third = take_number(rest, 4);
  if (!third) return std::nullopt;
  const bool begins_with_year = *first > 31;
  int year = begins_with_year ? *first : *third, month = *second;
  int day = begins_with_year ? *third : *first;
  if (year < 100) year += 2000;
  if (!begins_with_year && order == DateOrder::kMonthFirst) std::swap(month, day);
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  if (!take_mark(rest, 'T') && !take_mark(rest, ' ') && !take_mark(rest, 't')) return std::nullopt;
  text = trimmed(rest);
  return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

// "Z", "+02:00": the same for all rows, so it does not matter.
bool is_zone(std::string_view text) {
  if (text.empty() || text == "Z" || text == "UTC") return true;
  if (text.front() != '+' && text.front() != '-') return false;
  return std::all_of(text.begin() + 1, text.end(), [](char c) { return is_digit(c) || c == ':'; });
}

// The name without a pattern in brackets: "Time (hh:mm:ss)".
void drop_pattern(CsvColumn& column) {
  const std::size_t open = column.name.find_last_of("([");
  if (open == std::string::npos || open == 0) return;
  const std::string inside = column.name.substr(open);
  if (inside.find_first_not_of("()[]hHmMsSyYdD:.,-/ ") != std::string::npos) return;
  column.name = trimmed(column.name.substr(0, open));
}

bool has_hours_and_minutes(const std::string& header) {
  const std::string text = lower_case(header);
  return text.find("hh:mm") != std::string::npos || text.find("h:m") != std::string::npos;
}

// The times of all cells, NaN of gaps; empty if one is no time.
std::vector<ClockTime> times_of(const std::vector<std::string>& cells, DateOrder order) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  std::vector<ClockTime> times;
  for (const std::string& cell : cells) {
    const auto time =
        is_gap(cell) ? std::optional(ClockTime{kGap, 0.0, false, 0}) : clock_time_from(cell, order);
    if (!time) return {};
    times.push_back(*time);
  }
  return times;
}

double span_s(const std::vector<ClockTime>& times) {
  double low_s = std::numeric_limits<double>::infinity(), high_s = -low_s;
  for (const ClockTime& time : times) {
    if (std::isnan(time.seconds)) continue;
    low_s = std::min(low_s, time.seconds);
    high_s = std::max(high_s, time.seconds);
  }
  return high_s - low_s;
}

// In the order of dates that all rows can have and, of two, that in which the record is shorter: with the other
// one each new day begins another month.
std::vector<ClockTime> times_of(const CsvColumn& column, CsvTable& table) {
  std::vector<ClockTime> times = times_of(column.text, DateOrder::kDayFirst);
  std::vector<ClockTime> other = times_of(column.text, DateOrder::kMonthFirst);
  const bool is_month_first = times.empty() || (!other.empty() && span_s(other) < span_s(times));
  if (!other.empty() && is_month_first) {
    times = std::move(other);
    table.notes.push_back("the dates of '" + column.header + "' were read with the month first");
  }
  return times;
}

// Days of a spreadsheet become seconds.
void read_serial_days(CsvColumn& column, CsvTable& table) {
  constexpr double kFrom = 36526.0, kTo = 73050.0;  // 2000 to 2099
  constexpr double kLongest = 60.0, kShortest_s = 1e-4, kClock_s = 1e-4;
  constexpr std::size_t kFewest = 4;
  std::vector<double>& values = column.values;
  if (!column.unit.empty() || values.size() < kFewest) return;
  const bool is_in_range = values.front() >= kFrom && values.back() <= kTo &&
                           values.back() - values.front() < kLongest &&
                           std::is_sorted(values.begin(), values.end());
  if (!is_in_range ||
      std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }))
    return;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  if (!(step > 0.0) || step >= kShortest_s || values.front() == std::floor(values.front())) return;
  const double first = values.front();
  for (double& value : values) value = kClock_s * std::round(kDay_s * (value - first) / kClock_s);
  column.zero_unsure_s = 0.5 * kDay_s * step;
  for (double& value : values) value += column.zero_unsure_s;
  column.unit = "s";
  table.notes.push_back(
      "'" + column.header +
      "' holds the days of a spreadsheet and became seconds; they begin half a step after t = 0; "
      "--time-zero S sets another begin");
}

void read_column(CsvColumn& column, CsvTable& table) {
  std::vector<ClockTime> times = times_of(column, table);
  const double gap = std::numeric_limits<double>::quiet_NaN();
  bool has_date = false, has_one = false;
  for (const ClockTime& time : times) {
    has_date = has_date || time.has_date;
    has_one = has_one || time.n_fields > 0;
  }
  if (!has_one) return;
  const double per_field = has_hours_and_minutes(column.header) ? kMinute_s : 1.0;
  double days = 0.0, last_s = gap, high_s = gap;
  std::optional<std::size_t> first;  // the earliest row
  for (std::size_t i = 0; i < times.size(); ++i) {
    double seconds = times[i].seconds;
    if (times[i].n_fields == 2) seconds *= per_field;
    if (!has_date && seconds + days < last_s - 0.5 * kDay_s) days += kDay_s;
    times[i].seconds = seconds += days;
    if (times[i].n_fields == 2) times[i].fraction *= per_field;
    column.values[i] = seconds + times[i].fraction;
    if (std::isnan(seconds)) continue;
    last_s = seconds;
    if (!first || column.values[i] < column.values[*first]) first = i;
    high_s = std::fmax(high_s, column.values[i]);
  }
  const double low_s = column.values[*first];
  if (has_date || low_s > high_s - low_s) {
    // Whole seconds apart: a date has no more than 1e-7 s left of a double.
    constexpr double kClock_s = 1e-9;
    double step_s = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double since_s =
          (times[i].seconds - times[*first].seconds) + (times[i].fraction - times[*first].fraction);
      column.values[i] = kClock_s * std::round(since_s / kClock_s);
      if (column.values[i] > 0.0) step_s = std::fmin(step_s, column.values[i]);
    }
    if (std::isfinite(step_s)) {
      for (double& value : column.values) value += 0.5 * step_s;
      column.zero_unsure_s = 0.5 * step_s;
    }
    table.notes.push_back("the clock times of '" + column.header +
                          "' begin half a step after t = 0; --time-zero S sets another begin");
  }
  const auto bad = std::find_if(column.values.begin(), column.values.end(),
                                [](double value) { return std::isnan(value); });
  column.first_bad_line = bad == column.values.end()
                              ? 0
                              : table.lines[static_cast<std::size_t>(bad - column.values.begin())];
  column.first_bad_cell.clear();
  column.text.clear();
  column.unit = "s";
  drop_pattern(column);
}

}  // namespace

std::optional<ClockTime> clock_time_from(std::string_view cell, DateOrder order) {
  ClockTime time;
  std::string_view text = trimmed(cell);
  if (const auto days = take_date(text, order)) {
    time.has_date = true;
    time.seconds = kDay_s * *days;
  }
  double fields[3] = {0.0, 0.0, 0.0}, fraction = 0.0;
  for (; time.n_fields < 3; ++time.n_fields) {
    if (time.n_fields > 0 && !take_mark(text, ':')) break;
    const auto number = take_number(text, time.n_fields == 0 ? 6 : 2);
    if (!number) return std::nullopt;
    fields[time.n_fields] = *number;
  }
  if (time.n_fields < 2) return std::nullopt;
  if (!text.empty() && (text.front() == '.' || text.front() == ',')) {
    text.remove_prefix(1);
    std::string decimals = "0.";
    for (; !text.empty() && is_digit(text.front()); text.remove_prefix(1)) decimals += text.front();
    if (decimals.size() == 2) return std::nullopt;
    fraction = number_from_cell(decimals, {}).value_or(0.0);
  }
  text = trimmed(text);
  const bool is_late = text == "PM" || text == "pm", is_early = text == "AM" || text == "am";
  if (is_late && fields[0] < 12.0) fields[0] += 12.0;
  if (is_early && fields[0] == 12.0) fields[0] = 0.0;
  if (!is_late && !is_early && !is_zone(text)) return std::nullopt;
  const bool has_hours = time.n_fields == 3 || time.has_date;
  const double first = has_hours ? kHour_s : kMinute_s;
  const double second = has_hours ? kMinute_s : 1.0;
  if (fields[1] >= 60.0 || fields[2] >= 60.0) return std::nullopt;
  time.seconds += first * fields[0] + second * fields[1] + fields[2];
  time.fraction = fraction;
  if (time.has_date) time.n_fields = 3;
  return time;
}

void read_clock_times(CsvTable& table) {
  for (CsvColumn& column : table.columns) {
    column.text.empty() ? read_serial_days(column, table) : read_column(column, table);
  }
}

}  // namespace viscard
