// Time stamps of a record: single ones that are wrong, records appended to each other, clocks that began
// before the load.
#include "fit/samples/check_record.h"
#include "fit/samples/median.h"
#include "fit/samples/reading_noise.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace viscard {
namespace {

constexpr std::size_t kFewestStamps = 10;
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

std::string stamp_text(double time_s) {
  constexpr double kLong = 1e5;  // seconds of a clock need more digits
  return text_of(time_s, std::abs(time_s) >= kLong ? 12 : 6);
}

// Positions of a longest non-decreasing subsequence (patience sorting; Fredman, Discrete Math. 11
// (1975) 29).
std::vector<char> in_longest_order(const std::vector<double>& time_s) {
  std::vector<std::size_t> ends, before(time_s.size());
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const auto place = std::upper_bound(ends.begin(), ends.end(), time_s[i],
                                        [&](double t, std::size_t end) { return t < time_s[end]; });
    before[i] = place == ends.begin() ? i : *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
    } else {
      *place = i;
    }
  }
  std::vector<char> is_in(time_s.size(), 0);
  for (std::size_t i = ends.back();; i = before[i]) {
    is_in[i] = 1;
    if (before[i] == i) break;
  }
  return is_in;
}

// Rows whose stamp is outside those of the rows before and after by many steps; empty if more than one
// in a hundred rows is out of order.
std::vector<std::size_t> far_stamps(const std::vector<double>& time_s) {
  constexpr double kFar = 5.0;         // distances of the two neighbours
  constexpr std::size_t kOneIn = 100;  // rows
  const std::vector<char> is_in = in_longest_order(time_s);
  const auto n_out = static_cast<std::size_t>(std::count(is_in.begin(), is_in.end(), 0));
  if (n_out == 0 || n_out > std::max<std::size_t>(1, time_s.size() / kOneIn)) return {};
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (is_in[i]) continue;
    // Two rows in order on either side; at an end of the record, two of the only side.
    std::vector<double> before, after;
    for (std::size_t k = i; k-- > 0 && before.size() < 2;) {
      if (is_in[k]) before.push_back(time_s[k]);
    }
    for (std::size_t k = i + 1; k < time_s.size() && after.size() < 2; ++k) {
      if (is_in[k]) after.push_back(time_s[k]);
    }
    const double low = before.empty() ? kNoTime : before[0];
    const double high = after.empty() ? kNoTime : after[0];
    const double step_s = !before.empty() && !after.empty() ? high - low
                          : before.size() == 2              ? before[0] - before[1]
                          : after.size() == 2               ? after[1] - after[0]
                                                            : 0.0;
    double off_s = 0.0;
    if (!after.empty()) off_s = std::max(off_s, time_s[i] - high);
    if (!before.empty()) off_s = std::max(off_s, low - time_s[i]);
    if (off_s > kFar * step_s) far.push_back(i);
  }
  return far;
}

// A last row that is many steps after the row before it. Steps of sampling in log time grow evenly.
bool is_last_far(const std::vector<double>& time_s) {
  constexpr double kFar = 20.0;
  constexpr std::size_t kLook = 20;
  const std::size_t n = time_s.size();
  if (n < kLook + 2) return false;
  double longest_s = 0.0;
  for (std::size_t i = n - 1 - kLook; i < n - 1; ++i) {
    longest_s = std::max(longest_s, time_s[i] - time_s[i - 1]);
  }
  return longest_s > 0.0 && time_s[n - 1] - time_s[n - 2] > kFar * longest_s;
}

// Rows begin to end - 1 whose time does not go back.
struct TimeRun {
  std::size_t begin = 0, end = 0;
};

std::vector<TimeRun> time_runs(const std::vector<double>& time_s) {
  std::vector<TimeRun> runs{{0, 1}};
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] < time_s[i - 1]) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

// How far run b lies from run a at the same times: median of the differences over that of the values.
// Nothing without at least three common times.
struct RunDifference {
  double relative = 0.0, over_noise = 0.0;
};
std::optional<RunDifference> difference_of(const std::vector<double>& time_s,
                                           const std::vector<double>& value, const TimeRun& a,
                                           const TimeRun& b) {
  constexpr std::size_t kFewest = 3, kEnough = 500;
  std::vector<double> apart, size;
  const auto first = time_s.begin() + static_cast<std::ptrdiff_t>(a.begin);
  const auto last = time_s.begin() + static_cast<std::ptrdiff_t>(a.end);
  const std::size_t stride = 1 + (b.end - b.begin) / kEnough;
  for (std::size_t i = b.begin; i < b.end; i += stride) {
    if (time_s[i] < *first || time_s[i] > *(last - 1)) continue;
    const auto next = std::lower_bound(first, last, time_s[i]);
    const auto k = static_cast<std::size_t>(next - time_s.begin());
    double there = value[k];
    if (k > a.begin && time_s[k] > time_s[k - 1]) {
      const double share = (time_s[i] - time_s[k - 1]) / (time_s[k] - time_s[k - 1]);
      there = value[k - 1] + share * (value[k] - value[k - 1]);
    }
    apart.push_back(std::abs(value[i] - there));
    size.push_back(std::max(std::abs(value[i]), std::abs(there)));
  }
  if (apart.size() < kFewest) return std::nullopt;
  const double typical = median(size);
  const std::span<const double> all(value);
  const double noise =
      std::max(reading_noise(all.subspan(a.begin, a.end - a.begin)).sigma(typical),
               reading_noise(all.subspan(b.begin, b.end - b.begin)).sigma(typical));
  const double middle = median(std::move(apart));
  return RunDifference{typical > 0.0 ? middle / typical : 0.0,
                       noise > 0.0 ? middle / noise : 1e300};
}

// Refuses records that differ, and reports those that agree.
void check_runs(const std::vector<std::size_t>& rows, const std::vector<double>& time_s,
                const std::vector<double>& value, RecordNotes& notes) {
  constexpr std::size_t kShort = 5, kMostRuns = 50;
  constexpr double kMostRows = 0.9, kSameBegin = 0.02;
  // Rows of a master curve that were shifted beforehand overlap, and differ by some per cent.
  constexpr double kAnotherAnew = 0.01, kAnotherLater = 0.25, kDeviations = 4.0;
  std::vector<TimeRun> runs = time_runs(time_s);
  std::erase_if(runs, [&](const TimeRun& run) { return run.end - run.begin < kShort; });
  if (runs.size() < 2 || runs.size() > kMostRuns) return;
  std::size_t n_rows = 0;
  for (const TimeRun& run : runs) n_rows += run.end - run.begin;
  if (static_cast<double>(n_rows) < kMostRows * static_cast<double>(time_s.size())) return;
  const auto begin_s = [&](const TimeRun& run) { return time_s[run.begin]; };
  const auto end_s = [&](const TimeRun& run) { return time_s[run.end - 1]; };
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const TimeRun &a = runs[k - 1], &b = runs[k];
    const auto apart = difference_of(time_s, value, a, b);
    if (!apart) continue;
    const double span_s = std::min(end_s(a) - begin_s(a), end_s(b) - begin_s(b));
    const bool is_anew = std::abs(begin_s(b) - begin_s(a)) <= kSameBegin * span_s;
    const double least = is_anew ? kAnotherAnew : kAnotherLater;
    const std::string where = "the time goes back at row " + std::to_string(rows[b.begin] + 1) +
                              ", from " + stamp_text(end_s(a)) + " to " + stamp_text(begin_s(b)) +
                              " s";
    if (apart->relative > least && apart->over_noise > kDeviations) {
      throw std::runtime_error(
          "the table holds " + counted(runs.size(), "record") + " of different values: " + where +
          ", and the readings at the same times differ by " + text_of(100.0 * apart->relative, 2) +
          " %. Save rows " + std::to_string(rows[b.begin] + 1) + " to " +
          std::to_string(rows[b.end - 1] + 1) + " as a file of their own, and fit each record");
    }
    if (is_anew) {
      notes.faults.push_back(
          {"records-appended", "the table holds more than one record: " + where +
                                   ", and the readings at the same times agree within " +
                                   text_of(100.0 * apart->relative, 2) +
                                   " %. They are fitted as one"});
      return;
    }
  }
}

// Steps of the first rows.
double first_step_s(std::span<const double> time_s) {
  constexpr std::size_t kLook = 10;
  return usual_step_s(time_s.first(std::min(kLook + 1, time_s.size())));
}

// True if the steps grow with the time, as in sampling in log time.
bool is_log_sampled(std::span<const double> time_s) {
  constexpr double kFactor = 4.0, kShare = 0.5;
  const double to_s = std::min(time_s.back(), kFactor * time_s.front());
  const auto end = static_cast<std::size_t>(std::upper_bound(time_s.begin(), time_s.end(), to_s) -
                                            time_s.begin());
  if (end < 4) return true;  // few rows in these times, so the steps are long
  const std::size_t look = std::min<std::size_t>(10, end / 2);
  const auto first = time_s.first(look + 1), last = time_s.subspan(end - look - 1, look + 1);
  const double grown = (last.front() + last.back()) / (first.front() + first.back());
  return usual_step_s(last) > usual_step_s(first) * (1.0 + kShare * (grown - 1.0));
}

// True if sampling in log time began at another instant than t = 0: its steps grow with the time since then, and the
// line of the steps over the time is zero there.
bool is_log_from_later(std::span<const double> time_s) {
  constexpr double kFactor = 4.0, kLater = 0.3;
  constexpr std::size_t kFewest = 8;
  const double to_s = std::min(time_s.back(), kFactor * time_s.front());
  std::size_t n = 0;
  double mean_s = 0.0, mean_step_s = 0.0;
  for (; n + 1 < time_s.size() && time_s[n + 1] <= to_s; ++n) {
    mean_s += time_s[n];
    mean_step_s += time_s[n + 1] - time_s[n];
  }
  if (n < kFewest) return false;
  mean_s /= static_cast<double>(n);
  mean_step_s /= static_cast<double>(n);
  double square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    square += (time_s[i] - mean_s) * (time_s[i] - mean_s);
    product += (time_s[i] - mean_s) * (time_s[i + 1] - time_s[i] - mean_step_s);
  }
  if (!(square > 0.0) || !(product > 0.0)) return false;
  return mean_s - mean_step_s * square / product > kLater * time_s.front();
}

void set_time_zero(double zero_s, CleanViews& clean) {
  const auto time_s = clean.column(0);
  std::vector<double> shifted(time_s.begin(), time_s.end());
  for (double& t : shifted) t -= zero_s;
  clean.set_times(std::move(shifted));
}

}  // namespace

std::string rows_text(const std::vector<std::size_t>& rows, const std::vector<double>& time_s) {
  constexpr std::size_t kMostNamed = 3;
  std::string text;
  std::size_t n_blocks = 0;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t end = i + 1;
    while (end < rows.size() && rows[end] == rows[end - 1] + 1) ++end;
    if (++n_blocks <= kMostNamed) {
      const bool is_one = end == i + 1;
      text += (text.empty() ? "" : ", ") + std::string(is_one ? "row " : "rows ") +
              std::to_string(rows[i] + 1);
      if (!is_one) text += " to " + std::to_string(rows[end - 1] + 1);
      text += " (t = " + stamp_text(time_s[i]);
      if (!is_one) text += " to " + stamp_text(time_s[end - 1]);
      text += " s)";
    }
    i = end;
  }
  if (n_blocks > kMostNamed)
    text += " and " + std::to_string(n_blocks - kMostNamed) + " more places";
  return text;
}

std::vector<std::size_t> wrong_stamps(const std::vector<std::span<const double>>& columns,
                                      RecordKind /*kind*/, RecordNotes& notes) {
  const std::span<const double> all_s = columns.at(0);
  const std::size_t n = all_s.size();
  if (n < kFewestStamps) return {};
  for (const auto& column : columns) {
    if (column.size() != n) return {};  // CleanViews refuses this
  }
  const bool is_finite = std::all_of(columns.begin(), columns.end(), all_finite);
  const StepRange steps = is_finite ? step_range(all_s) : StepRange{-1.0, 0.0};
  if (steps.shortest >= 0.0) {  // nothing is out of order; only the last stamp may be far
    constexpr std::size_t kEnd = 64;
    const auto end = all_s.last(std::min(kEnd, n));
    const std::vector<double> end_s(end.begin(), end.end());
    if (!is_last_far(end_s)) return {};
    notes.left_out.emplace_back("stamp", 1);
    notes.faults.push_back(
        {"stamps-left-out", rows_text({n - 1}, {all_s[n - 1]}) + " was left out: its time is " +
                                text_of(end_s.back() - *(end_s.end() - 2), 3) +
                                " s after that of the row before, far from the other steps. If the "
                                "stamp is right, fit more than one reading there"});
    return {n - 1};
  }
  std::vector<std::size_t> rows;
  std::vector<double> time_s, value;
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_usable = std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
      return std::isfinite(column[i]);
    });
    if (!is_usable) continue;
    rows.push_back(i);
    time_s.push_back(all_s[i]);
    value.push_back(columns.at(1)[i]);
  }
  if (rows.size() < kFewestStamps) return {};
  std::vector<std::size_t> far = far_stamps(time_s);
  if (far.empty() && is_last_far(time_s)) far = {rows.size() - 1};
  if (far.empty()) {
    check_runs(rows, time_s, value, notes);
    return {};
  }
  std::vector<std::size_t> wrong;
  std::vector<double> wrong_s;
  for (const std::size_t i : far) {
    wrong.push_back(rows[i]);
    wrong_s.push_back(time_s[i]);
  }
  notes.left_out.emplace_back("stamp", wrong.size());
  notes.faults.push_back(
      {"stamps-left-out",
       rows_text(wrong, wrong_s) +
           (wrong.size() == 1 ? " was left out: its time is" : " were left out: their times are") +
           " far from those of the rows before and after"});
  return wrong;
}

void check_clock(CleanViews& clean, RecordNotes& notes, double latest_share) {
  // Seconds of a computer's clock (since 1970, 1904 or its start), or any time so long before the
  // record that relaxation since then would not show in it.
  constexpr double kEpoch_s = 1e8, kTimesLength = 1000.0, kLonger = 10.0, kManySteps = 5.0;
  const std::span<const double> time_s = clean.column(0);
  if (time_s.size() < kFewestStamps || notes.rise_s) return;
  // Rows of the begin that were left out do not make a record late. Those before t = 0 are left out
  // before this.
  const double first_s = std::max(0.0, notes.first_s.value_or(time_s.front()));
  const double length_s = time_s.back() - first_s;
  const double step_s = first_step_s(time_s);
  if (!(first_s > 0.0) || !(length_s > 0.0) || !(step_s > 0.0)) return;
  const bool is_clock =
      first_s >= kTimesLength * length_s || (first_s >= kEpoch_s && first_s > kLonger * length_s);
  if (is_clock) {
    notes.faults.push_back(
        {"clock-offset", "the times are those of a clock that began long before the record (" +
                             stamp_text(first_s) + " s at the first row, for a record of " +
                             text_of(length_s, 4) + " s): t = 0 is now half a step (" +
                             text_of(0.5 * step_s, 3) +
                             " s) before the first row. --time-zero sets the time of the load"});
    notes.clock_step_s = step_s;
    set_time_zero(first_s - 0.5 * step_s, clean);
    return;
  }
  if (first_s < kManySteps * step_s) return;
  if (is_log_sampled(time_s) && !is_log_from_later(time_s)) return;
  notes.late_s = first_s;
  notes.late_step_s = step_s;
  if (first_s >= latest_share * length_s) count_from_first(clean, notes);
}

void count_from_first(CleanViews& clean, RecordNotes& notes) {
  notes.counts_from_first = true;
  set_time_zero(*notes.late_s - 0.5 * notes.late_step_s, clean);
}

}  // namespace viscard
