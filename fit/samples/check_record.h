#pragma once

#include "fit/samples/clean_data.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// What a record is: a modulus or force after a step, a creep compliance, or an answer (force, stress)
// beside its measured cause (depth, strain).
enum class RecordKind { kRelaxation, kCreep, kHistory };

// One thing that is wrong with a record, named with rows (from 1, in the order of the table) and times.
struct RecordFault {
  std::string flag;  // as in FitResult::flags
  std::string text;
};

// What the checks found, left out and changed. Times in s.
struct RecordNotes {
  std::vector<RecordFault> faults;
  // Rows left out by reason (fit/intervals/left_out.h).
  std::vector<std::pair<const char*, std::size_t>> left_out;
  // Time of the first row that is in the load, also if it was left out.
  std::optional<double> first_s;
  // The load rose between these times of the table; t = 0 is now in the middle.
  std::optional<std::pair<double, double>> rise_s;
  // The clock of the table began long before the record. t = 0 is now half a step before the first row.
  std::optional<double> clock_step_s;
  // The record begins many steps after t = 0 and does not contain its loading: the clock may have begun
  // earlier than the load. If it is later than its own length, t = 0 is now half a step before the first row.
  std::optional<double> late_s;
  double late_step_s = 0.0;
  bool counts_from_first = false;
};

// A record ready for a fit: columns of time, answer and (kHistory) cause. Rows are finite, in order of
// time, and without those that are recognised as wrong:
//   - single time stamps far from those of the neighbouring rows
//   - rows before the load, if the load then comes within three rows
//   - zeros or another constant that the rows on both sides do not lead to, inside or at the end
//   - readings at the end of a converter's range, where the next rows lead above it
//   - a display that stands still although the rows beside it scatter
// Throws std::runtime_error if the time begins anew and both records differ, and what CleanViews does.
struct CheckedRecord {
  CheckedRecord(const std::vector<std::span<const double>>& columns, std::size_t least,
                RecordKind kind);

  RecordNotes notes;
  CleanViews clean;
};

// The checks themselves. wrong_stamps() works on rows in the order of the table and returns rows of it,
// ascending; check_values() drops rows of a record in order of time.
std::vector<std::size_t> wrong_stamps(const std::vector<std::span<const double>>& columns,
                                      RecordKind kind, RecordNotes& notes);
void check_values(RecordKind kind, CleanViews& clean, RecordNotes& notes);
// Where t = 0 is; for records that begin under load. A record that begins later than this share of its length counts
// from its first row.
void check_clock(CleanViews& clean, RecordNotes& notes, double latest_share = 1.0);

// t = 0 half a step before the first row of a record that begins late.
void count_from_first(CleanViews& clean, RecordNotes& notes);

// "row 12 (t = 1.2 s)", "rows 701 to 720 (t = 70.1 to 72 s)". rows: ascending, from 0, of the table; time_s:
// of the same rows.
std::string rows_text(const std::vector<std::size_t>& rows, const std::vector<double>& time_s);

}  // namespace viscard
