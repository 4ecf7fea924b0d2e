#include "fit/intervals/flags.h"
#include "fit/intervals/time_rounding.h"
#include "fit/samples/chosen_rows.h"
#include "io/flow/fit_table.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

// Time and, if the table has one, the controlled quantity, in order of time.
struct SortedRows {
  std::vector<std::size_t> rows;  // of the table
  std::vector<double> time_s, input, value;
};

SortedRows sorted_rows(const CsvTable& table, const FitRequest& request) {
  const auto column = [&](const char* name) {
    return find_column(table, name, request.columns) ? column_SI(table, name, request.columns)
                                                     : std::vector<double>();
  };
  SortedRows course;
  std::vector<double> time_s = column_SI(table, "time_s", request.columns);
  course.rows.resize(time_s.size());
  std::iota(course.rows.begin(), course.rows.end(), std::size_t{0});
  std::stable_sort(course.rows.begin(), course.rows.end(),
                   [&](std::size_t a, std::size_t b) { return time_s[a] < time_s[b]; });
  const auto sorted = [&](const std::vector<double>& values) {
    std::vector<double> out;
    for (const std::size_t row : course.rows) out.push_back(values[row]);
    return out;
  };
  course.time_s = sorted(time_s);
  for (double& time : course.time_s) time -= request.time_zero_s.value_or(0.0);
  for (const char* name : {"depth_m", "strain"}) {
    if (const auto values = column(name); course.input.empty() && !values.empty()) {
      course.input = sorted(values);
    }
  }
  for (const char* name : {"modulus_Pa", "stress_Pa", "force_N"}) {
    if (const auto values = column(name); course.value.empty() && !values.empty()) {
      course.value = sorted(values);
    }
  }
  return course;
}

RowRange hold_of(const SortedRows& course, int number) {
  if (course.input.empty()) {
    throw std::runtime_error(
        "--hold finds holds in depth_m or strain, and the table has neither; choose the part with "
        "--from and --to");
  }
  const std::vector<RowRange> holds = holds_of(course.time_s, course.input);
  if (static_cast<std::size_t>(number) > holds.size()) {
    std::string found;
    for (const RowRange& hold : holds) {
      found += (found.empty() ? ": " : ", ") + text_of(course.time_s[hold.begin]) + " to " +
               text_of(course.time_s[hold.end - 1]) + " s";
    }
    throw std::runtime_error("--hold " + std::to_string(number) + ", but the record has " +
                             counted(holds.size(), "hold") + found);
  }
  return holds[static_cast<std::size_t>(number) - 1];
}

RowRange cropped(const SortedRows& course) {
  if (!course.input.empty()) return up_to_longest_hold(course.time_s, course.input);
  if (!course.value.empty()) {
    RowRange part = from_largest(course.value);
    part.end = end_of_relaxation(course.time_s, course.value, part.begin);
    return part;
  }
  throw std::runtime_error("--crop auto needs depth_m, strain, modulus_Pa, stress_Pa or force_N");
}

// When the load rose, if --crop auto begins at its largest value and no time of the step was given.
std::optional<Interval> rise_of(const SortedRows& course, const FitRequest& request) {
  if (!request.crop || !course.input.empty() || course.value.empty()) return std::nullopt;
  if (request.time_zero_s || request.from_s) return std::nullopt;
  const std::size_t peak = from_largest(course.value).begin;
  const std::optional<std::size_t> begin = begin_of_rise(course.value, peak);
  if (!begin || !(course.time_s[peak] > course.time_s[*begin])) return std::nullopt;
  return Interval{course.time_s[*begin], course.time_s[peak]};
}

// Whether depth or strain was away from its lowest place before the row, and is there.
void note_history(const std::vector<double>& input, std::size_t first, ChosenPart& part) {
  if (input.empty()) return;
  constexpr double kLow = 0.1;  // of the range
  const auto [low, high] = std::minmax_element(input.begin(), input.end());
  const double least = *low + kLow * (*high - *low);
  const auto is_up = [&](double value) { return value > least; };
  part.was_loaded =
      std::any_of(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(first), is_up);
  part.is_loaded = part.was_loaded && is_up(input[first]);
}

}  // namespace

ChosenPart choose_part(CsvTable& table, const FitRequest& request) {
  if (!request.from_s && !request.to_s && request.hold == 0 && !request.crop) return {};
  const SortedRows course = sorted_rows(table, request);
  const std::size_t n = course.rows.size();
  RowRange part{0, n};
  if (request.hold > 0) part = hold_of(course, request.hold);
  if (request.crop) part = cropped(course);
  constexpr double kForever = std::numeric_limits<double>::infinity();
  const double from_s = request.from_s.value_or(-kForever), to_s = request.to_s.value_or(kForever);
  std::vector<std::size_t> rows;
  double first_s = kForever, last_s = -kForever;
  std::size_t first = part.end;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const double t = course.time_s[i];
    if (t < from_s || t > to_s) continue;
    rows.push_back(course.rows[i]);
    first = std::min(first, i);
    first_s = std::min(first_s, t);
    last_s = std::max(last_s, t);
  }
  constexpr std::size_t kLeast = 4;  // what any fit needs
  const bool is_cut = request.from_s || request.to_s;
  if (rows.empty() || (is_cut && rows.size() < kLeast)) {
    throw std::runtime_error(counted(rows.size(), "row") +
                             " between --from and --to, and a fit needs at least 4; the "
                             "record covers " +
                             text_of(course.time_s.front()) + " to " +
                             text_of(course.time_s.back()) + " s");
  }
  const std::optional<Interval> rise_s = rise_of(course, request);
  std::sort(rows.begin(), rows.end());
  table = chosen_rows(table, rows);
  ChosenPart chosen{counted(rows.size(), "row") + " of " + std::to_string(n) +
                    ", t = " + text_of(first_s) + " to " + text_of(last_s) + " s"};
  chosen.rise_s = rise_s;
  note_history(course.input, first, chosen);
  return chosen;
}

FitRequest with_zero_in(const Interval& rise_s, FitRequest request) {
  request.time_zero_s = 0.5 * (rise_s.low + rise_s.high);
  return request;
}

void flag_history(const ChosenPart& part, FitResult& result) {
  if (part.rise_s) report_rise(part.rise_s->low, part.rise_s->high, result);
  if (!part.was_loaded) return;
  const std::string before =
      "the specimen was loaded before the chosen part, which does not contain that: ";
  if (!part.is_loaded) {
    result.flags.push_back({"history-left-out", 0,
                            before + "what had not recovered by then is not in the fit. Without "
                                     "--hold, --from and --to the whole record is fitted"});
    return;
  }
  add_defect(result, "history-missing",
             before +
                 "it is still loaded where the part begins, and what relaxes from before "
                 "counts as relaxation of this part. Fit the whole record, or from its first "
                 "loading on");
}

}  // namespace viscard
