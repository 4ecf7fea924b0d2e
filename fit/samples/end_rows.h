#pragma once

#include "fit/samples/clean_data.h"

#include <span>

namespace viscard {

enum class StepRecord { kRelaxation, kCreep };

// What the rows beside the first or the last row say about it.
struct EndRow {
  bool is_wrong = false;
  double time_s = 0.0, value = 0.0;
  double expected = 0.0;  // from the four rows beside it
};

// The ends of a record of a step have one neighbour only, so that isolated_spikes() cannot judge
// them. A relaxation decreases and is convex (the negative of a creep compliance is as well), so the
// mean of the next rows and their straight line are bounds of a first value from below. A first row
// below one of them by more than eight standard deviations (third differences of up to 30 rows) and 2 % is
// wrong; a first row above them may be a fast term. The compliance of a creep record may also not be
// zero, unless the next rows come from zero. A last row may not leave the previous ones on either
// side. A row whose neighbour is wrong as well is not judged: that may be a slow step. Nothing is
// wrong in records of fewer than ten rows.
EndRow first_row(std::span<const double> time_s, std::span<const double> value, StepRecord record);
EndRow last_row(std::span<const double> time_s, std::span<const double> value, StepRecord record);

struct EndRows {
  EndRow first, last;
};

// Drops the ends of a cleaned record (time, value) that are wrong, and returns both.
EndRows drop_end_rows(CleanViews& clean, StepRecord record);

}  // namespace viscard
