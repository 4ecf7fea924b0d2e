#include "fit/samples/check_record.h"

#include "fit/samples/jumped_rows.h"
#include "fit/samples/reading_noise.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kFewestChecked = 10;
constexpr double kSureDeviations = 8.0;  // of the noise: never by chance, not in a million rows

using EqualRun = RowRun;  // of one value

// Runs of at least two equal values, and single zeros.
std::vector<EqualRun> runs_of_equal(std::span<const double> values) {
  std::vector<EqualRun> runs;
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    if (end - begin > 1 || values[begin] == 0.0) runs.push_back({begin, end});
    begin = end;
  }
  return runs;
}

std::vector<std::size_t> rows_in(const std::vector<EqualRun>& runs) {
  std::vector<std::size_t> rows;
  for (const EqualRun& run : runs) {
    for (std::size_t i = run.begin; i < run.end; ++i) rows.push_back(i);
  }
  return rows;
}

double extent_of_values(std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

// Rows before the load, of a record of a step: rows beside which the first loaded row is twenty times as
// large, which it reaches within three rows, in larger steps than those that follow.
struct BeforeLoad {
  std::size_t n_rows = 0;                // unloaded or partly loaded
  double quiet_s = 0.0, loaded_s = 0.0;  // time of the last unloaded and of the first loaded row
};

BeforeLoad before_load(std::span<const double> time_s, std::span<const double> value) {
  constexpr double kTimes = 20.0, kSharp = 3.0;
  constexpr std::size_t kFewestQuiet = 2, kLongestRise = 3, kAfter = 12;
  double largest = std::abs(value[0]);
  std::size_t rise = 1;  // first row that is not quiet
  // A first reading may lie next to zero by chance.
  constexpr double kOfAll = 0.01;
  const double least = kOfAll * *std::max_element(value.begin(), value.end());
  const auto is_loaded = [&](std::size_t i) {
    return value[i] > least && value[i] >= kTimes * largest;
  };
  while (rise < value.size() && !is_loaded(rise)) {
    largest = std::max(largest, std::abs(value[rise]));
    ++rise;
  }
  if (rise < kFewestQuiet || rise + kAfter > value.size()) return {};
  // The first row from which the values do not rise on as they did.
  std::size_t loaded = rise;
  while (loaded < rise + kLongestRise &&
         value[loaded + 1] - value[loaded] > (value[loaded] - value[rise - 1]) / kSharp) {
    ++loaded;
  }
  if (loaded == rise + kLongestRise) return {};
  const double jump = value[loaded] - value[rise - 1];
  std::vector<double> steps;
  for (std::size_t i = loaded + 1; i < loaded + kAfter && i < value.size(); ++i) {
    if (!is_loaded(i)) return {};
    steps.push_back(std::abs(value[i] - value[i - 1]));
  }
  if (jump < kSharp * *std::max_element(steps.begin(), steps.end())) return {};
  return {loaded, time_s[rise - 1], time_s[loaded]};
}

// Judges runs of one value in one column: values that the rows on both sides do not lead to.
class Dropouts {
 public:
  // other: the cause of the values (or what they cause); empty for a record of a step.
  Dropouts(RecordKind kind, std::span<const double> value, std::span<const double> other)
      : kind_(kind), value_(value), other_(other) {
    least_ = kind == RecordKind::kHistory ? 0.1 * extent_of_values(value) : 0.0;
    if (!other.empty()) other_range_ = extent_of_values(other);
  }

  // before_row: the last row before the run that is none of a dropout.
  bool is_dropout(const EqualRun& run, std::size_t before_row) const {
    if (run.begin == 0) return false;
    const bool is_end = run.end == value_.size();
    constexpr std::size_t kFewestAtEnd = 2, kFewestOther = 3;
    if (is_end && run.length() < (is_zero(run) ? kFewestAtEnd : kFewestOther)) return false;
    const double before = value_[before_row] - at(run);
    const double after = is_end ? before : value_[run.end] - at(run);
    if (!(before * after > 0.0)) return false;
    const double gap = std::min(std::abs(before), std::abs(after));
    const double size = std::max({std::abs(value_[before_row]), std::abs(at(run)),
                                  is_end ? 0.0 : std::abs(value_[run.end])});
    constexpr double kShare = 0.05;
    if (gap < std::max(kShare * size, least_)) return false;
    if (!(gap > kSureDeviations * noise_beside(value_, run.begin, run.end))) return false;
    // The way of the values up to the run, and from its end on, is slower than the jump.
    if (!is_sharp(before, run.begin, -1) || (!is_end && !is_sharp(after, run.end - 1, 1))) {
      return false;
    }
    if (kind_ != RecordKind::kHistory) return true;
    return other_rests(run) || all_drops(run);
  }

  // The other column goes on as before at both edges of the run.
  bool other_rests(const RowRun& run) const {
    constexpr double kShare = 0.05, kTimes = 3.0;
    if (other_.empty()) return true;
    const auto step = [&](std::size_t i) {  // into row i
      return i > 0 && i < other_.size() ? std::abs(other_[i] - other_[i - 1]) : 0.0;
    };
    const auto is_calm = [&](std::size_t i) {
      return step(i) <=
             std::max(kShare * other_range_, kTimes * std::min(step(i - 1), step(i + 1)));
    };
    return is_calm(run.begin) && (run.end == value_.size() || is_calm(run.end));
  }

 private:
  double at(const EqualRun& run) const { return value_[run.begin]; }
  bool is_zero(const EqualRun& run) const { return at(run) == 0.0; }

  // Steps of two rows beyond an edge of the run, away from it.
  bool is_sharp(double gap, std::size_t edge, int way) const {
    // Inside a record of a step the run cannot be true, however steep the curve is there.
    const bool is_inside = way > 0 || edge + 1 < value_.size();
    const double times = kind_ == RecordKind::kHistory ? 3.0 : 2.0;
    const auto i = static_cast<std::ptrdiff_t>(edge) + way;
    const auto far = i + way;
    const auto n = static_cast<std::ptrdiff_t>(value_.size());
    if (far < 0 || far >= n) return true;
    if (kind_ == RecordKind::kRelaxation && is_inside) return true;
    const double step = value_[static_cast<std::size_t>(far)] - value_[static_cast<std::size_t>(i)];
    return std::abs(gap) > times * std::abs(step);
  }

  // Both columns fall to a constant at once, and return to where they were: the logger lost the rows.
  bool all_drops(const EqualRun& run) const {
    constexpr std::size_t kShort = 3;
    constexpr double kShort_share = 0.02, kBack = 0.02, kAnswerBack = 0.05;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (other_[i] != other_[run.begin]) return false;
    }
    if (!is_zero(run) || other_[run.begin] != 0.0) return false;
    if (run.end == value_.size()) return true;
    const auto longest =
        static_cast<std::size_t>(kShort_share * static_cast<double>(value_.size()));
    // Within a share, or as far as the column would have gone on meanwhile.
    constexpr double kWay = 1.5;
    const auto rows = static_cast<double>(run.length() + 1);
    const auto is_back = [&](std::span<const double> column, double share) {
      const double before = column[run.begin - 1], after = column[run.end];
      const double step = run.begin > 1 ? std::abs(before - column[run.begin - 2]) : 0.0;
      return std::abs(after - before) <=
             std::max(share * std::max(std::abs(before), std::abs(after)), kWay * rows * step);
    };
    return run.length() <= std::max(kShort, longest) && is_back(other_, kBack) &&
           is_back(value_, kAnswerBack);
  }

  RecordKind kind_;
  std::span<const double> value_, other_;
  double least_ = 0.0, other_range_ = 0.0;
};

std::vector<EqualRun> dropouts(RecordKind kind, std::span<const double> value,
                               std::span<const double> other, const std::vector<EqualRun>& runs) {
  const Dropouts judge(kind, value, other);
  std::vector<EqualRun> found;
  for (const EqualRun& run : runs) {
    const bool follows = !found.empty() && found.back().end == run.begin && found.back().begin > 0;
    const std::size_t before_row =
        follows ? found.back().begin - 1 : std::max<std::size_t>(run.begin, 1) - 1;
    if (judge.is_dropout(run, before_row)) found.push_back(run);
  }
  return found;
}

// The smallest difference of two of up to 60 values beside the run: the step of the display.
double resolution_beside(std::span<const double> values, const EqualRun& run) {
  constexpr std::size_t kBeside = 30;
  std::vector<double> near;
  for (std::size_t i = run.begin > kBeside ? run.begin - kBeside : 0; i < run.begin; ++i) {
    near.push_back(values[i]);
  }
  for (std::size_t i = run.end; i < std::min(values.size(), run.end + kBeside); ++i) {
    near.push_back(values[i]);
  }
  std::sort(near.begin(), near.end());
  double least = 0.0;
  for (std::size_t i = 1; i < near.size(); ++i) {
    const double step = near[i] - near[i - 1];
    if (step > 0.0 && (least == 0.0 || step < least)) least = step;
  }
  return least;
}

// Runs of a display that stands still: the rows beside scatter by several steps of the display, so that
// so many equal readings are no chance. A display that repeats every reading is not one that stands still.
// Without the first reading of each run, which is one.
std::vector<EqualRun> stuck_runs(std::span<const double> values,
                                 const std::vector<EqualRun>& runs) {
  constexpr std::size_t kShortest = 10, kMostRuns = 50;
  constexpr double kMostEqual = 0.3, kScatter = 2.0, kSure = 14.0;  // exp(-14): one in a million
  std::vector<EqualRun> longs;
  double n_equal = 0.0, n_in_long = 0.0;
  for (const EqualRun& run : runs) {
    const auto n_pairs = static_cast<double>(run.length() - 1);
    n_equal += n_pairs;
    if (run.length() < kShortest) continue;
    longs.push_back(run);
    n_in_long += n_pairs;
  }
  const auto n = static_cast<double>(values.size());
  if (longs.empty() || longs.size() > kMostRuns) return {};
  const double by_chance = (n_equal - n_in_long + 1.0) / std::max(1.0, n - n_in_long);
  constexpr std::size_t kSeveral = 5;
  const bool repeats = longs.size() >= kSeveral && n_in_long > 0.5 * n;
  if (by_chance > kMostEqual || repeats) return {};
  std::vector<EqualRun> stuck;
  for (const EqualRun& run : longs) {
    if (values[run.begin] == 0.0) continue;  // a force out of contact
    const double sigma = noise_beside(values, run.begin, run.end);
    const double step = resolution_beside(values, run);
    if (!(sigma > kScatter * step)) continue;
    // Two readings are equal with a probability of step/(2 sqrt(pi) sigma).
    const double chance = std::max(by_chance, step / (3.545 * sigma));
    const auto length = static_cast<double>(run.length());
    if (length * -std::log(chance) < std::log(n) + kSure) continue;
    stuck.push_back({run.begin + 1, run.end});
  }
  return stuck;
}

// Which of them: those at the end of the range to which the test leads (a relaxation below what the instrument
// shows, a creep above it), with their first reading, or those inside the range. At the other end they are a
// force out of contact, or rows of saturated_runs().
enum class Stuck { kClipped, kInside };
std::vector<std::size_t> stuck_rows(Stuck which, RecordKind kind, std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  std::vector<EqualRun> chosen;
  for (EqualRun run : stuck_runs(values, runs_of_equal(values))) {
    const bool is_low = values[run.begin] == *low, is_high = values[run.begin] == *high;
    const bool is_clipped =
        (kind == RecordKind::kRelaxation && is_low) || (kind == RecordKind::kCreep && is_high);
    if (which == Stuck::kClipped ? !is_clipped : (is_low || is_high)) continue;
    if (is_clipped) --run.begin;
    chosen.push_back(run);
  }
  return rows_in(chosen);
}

// Runs at the largest value of a record of a step, above which the next rows lead back.
std::vector<EqualRun> saturated_runs(std::span<const double> values,
                                     const std::vector<EqualRun>& runs) {
  constexpr std::size_t kShortest = 3, kMostRows = 50;
  const double top = *std::max_element(values.begin(), values.end());
  std::vector<EqualRun> saturated;
  for (const EqualRun& run : runs) {
    if (values[run.begin] != top || run.length() < kShortest || top <= 0.0) continue;
    const std::size_t n = std::min({run.length(), kMostRows, values.size() - run.end});
    if (n < kShortest) continue;
    // A straight line through as many rows as the run has, at the middle of the run. A relaxation is
    // convex, so the line is below it.
    const auto count = static_cast<double>(n);
    double mean = 0.0, product = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double at = static_cast<double>(k) - 0.5 * (count - 1.0);
      mean += values[run.end + k] / count;
      product += at * values[run.end + k];
    }
    const double slope = product / (count * (count * count - 1.0) / 12.0);
    const double line = mean - slope * 0.5 * (count + static_cast<double>(run.length()));
    const double sigma = noise_beside(values, run.begin, run.end);
    const double step = resolution_beside(values, run);
    constexpr double kSure = 4.0;
    // Variance of the line one length before its rows: 1/n + 12/n (for n rows), about 13/n.
    const double margin = kSure * sigma * std::sqrt(13.0 / count) + 2.0 * step;
    if (line - top > margin) saturated.push_back(run);
  }
  return saturated;
}

// Leaves rows out and names them.
class Findings {
 public:
  Findings(CleanViews& clean, RecordNotes& notes) : clean_(clean), notes_(notes) {}

  void drop(const char* reason, const std::string& flag, const std::vector<std::size_t>& rows,
            const std::string& why) {
    if (rows.empty()) return;
    std::vector<std::size_t> origins;
    std::vector<double> time_s;
    for (const std::size_t i : rows) {
      origins.push_back(clean_.origin(i));
      time_s.push_back(clean_.column(0)[i]);
    }
    notes_.faults.push_back(
        {flag,
         rows_text(origins, time_s) + (rows.size() == 1 ? " was" : " were") + " left out: " + why});
    notes_.left_out.emplace_back(reason, rows.size());
    clean_.drop(rows);
  }

 private:
  CleanViews& clean_;
  RecordNotes& notes_;
};

std::string dropout_text(std::span<const double> values, const std::vector<EqualRun>& runs) {
  const double value = values[runs.front().begin];
  const bool is_one = runs.size() == 1 && runs.front().length() == 1;
  const bool is_end = runs.size() == 1 && runs.front().end == values.size();
  return std::string(is_one ? "it stands at " : "they stand at ") + text_of(value) +
         (is_end ? ", to which the rows before do not lead"
                 : ", to which the rows before and after do not lead") +
         " (a logger that lost readings, or went on after the test)";
}

}  // namespace

void check_values(RecordKind kind, CleanViews& clean, RecordNotes& notes) {
  if (clean.column(1).size() < kFewestChecked) return;
  const bool is_history = kind == RecordKind::kHistory;
  const auto other = [&](std::size_t i) {
    return is_history ? clean.column(i) : std::span<const double>{};
  };
  Findings findings(clean, notes);
  const auto value = [&] { return clean.column(1); };
  const std::vector<EqualRun> lost = dropouts(kind, value(), other(2), runs_of_equal(value()));
  if (!lost.empty()) {
    findings.drop("dropout", "dropouts-left-out", rows_in(lost), dropout_text(value(), lost));
  }
  const Dropouts beside(kind, value(), other(2));
  // Where the depth or the strain goes back, or is that out of contact, the value has a reason to change.
  const auto goes_back = [&](const RowRun& run) {
    if (!is_history) return false;
    const auto cause = other(2);
    const double before = cause[run.begin - 1], sign = before > 0.0 ? 1.0 : -1.0;
    const double at = value()[run.begin - 1];
    const bool is_loaded = before * at > 0.0 && std::abs(before) > 0.1 * extent_of_values(cause) &&
                           std::abs(at) > 0.1 * extent_of_values(value());
    if (!is_loaded) return true;
    return std::any_of(cause.begin() + static_cast<std::ptrdiff_t>(run.begin),
                       cause.begin() + static_cast<std::ptrdiff_t>(run.end),
                       [&](double one) { return sign * one < 0.9 * sign * before; });
  };
  const auto rests = [&](const RowRun& run) { return beside.other_rests(run) && !goes_back(run); };
  const std::vector<RowRun> jumped = jumped_blocks(value(), rests);
  const std::optional<std::size_t> lost_at = lost_from(value(), rests);
  const std::string from = lost_at ? text_of(value()[*lost_at - 1], 3) : "";
  std::vector<std::size_t> gone = rows_in(jumped);
  if (lost_at) {
    std::erase_if(gone, [&](std::size_t i) { return i >= *lost_at; });
    for (std::size_t i = *lost_at; i < value().size(); ++i) gone.push_back(i);
  }
  findings.drop(
      "dropout", "dropouts-left-out", gone,
      jumped.empty()
          ? "from there on the value lies about zero, to which it falls from " + from +
                " within one row: the load or the contact was lost"
          : std::string("they jump away from the rows before and after, and back, within one row") +
                (lost_at ? "; at the end the load is lost" : "") +
                " (a loose plug, or an overflow)");
  if (is_history) {
    const std::vector<EqualRun> lost_cause =
        dropouts(kind, other(2), value(), runs_of_equal(other(2)));
    if (!lost_cause.empty()) {
      findings.drop("depth_spike", "dropouts-left-out", rows_in(lost_cause),
                    "the column of depth or strain: " + dropout_text(other(2), lost_cause));
    }
  } else {
    const BeforeLoad before = before_load(clean.column(0), value());
    // Rows before t = 0 are left out as such.
    const bool is_known = before.quiet_s < 0.0 && before.loaded_s >= 0.0;
    notes.first_s = clean.column(0)[is_known ? 0 : before.n_rows];
    if (before.n_rows > 0 && !is_known) {
      std::vector<std::size_t> rows(before.n_rows);
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
      findings.drop(
          "before_load", "before-load-left-out", rows,
          "they are before the load, which shows from t = " + text_of(before.loaded_s) + " s on");
      const bool has_zero = before.quiet_s <= 0.0 && before.loaded_s >= 0.0;
      if (!has_zero) notes.rise_s = {before.quiet_s, before.loaded_s};
    }
  }
  if (kind == RecordKind::kRelaxation) {
    findings.drop("saturated", "saturated",
                  rows_in(saturated_runs(value(), runs_of_equal(value()))),
                  "they stand exactly at the largest value, above which the next rows lead: the "
                  "instrument reached the end of its range");
  }
  findings.drop("saturated", "saturated", stuck_rows(Stuck::kClipped, kind, value()),
                std::string("they stand exactly at the ") +
                    (kind == RecordKind::kCreep ? "largest" : "smallest") +
                    " value, although the rows beside them scatter: the instrument reached the end "
                    "of its range");
  findings.drop("stuck", "stuck-left-out", stuck_rows(Stuck::kInside, kind, value()),
                "they repeat the reading before them exactly, although the rows beside them "
                "scatter: the instrument or its logger stood still");
  if (!notes.rise_s) return;
  const double zero_s = 0.5 * (notes.rise_s->first + notes.rise_s->second);
  const auto time_s = clean.column(0);
  std::vector<double> shifted(time_s.begin(), time_s.end());
  for (double& t : shifted) t -= zero_s;
  clean.set_times(std::move(shifted));
}

CheckedRecord::CheckedRecord(const std::vector<std::span<const double>>& columns, std::size_t least,
                             RecordKind kind)
    : clean(columns, least, wrong_stamps(columns, kind, notes)) {
  check_values(kind, clean, notes);
}

}  // namespace viscard
