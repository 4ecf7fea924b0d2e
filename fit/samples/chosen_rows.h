#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace viscard {

// Rows begin to end - 1 of a record.
struct RowRange {
  std::size_t begin = 0, end = 0;
};

// The holds of a record: stretches of at least ten rows in which depth or strain moves at less than
// a fifth of its mean speed, away from its lowest place (out of contact). Each range begins with the
// ramp that leads to the hold.
std::vector<RowRange> holds_of(std::span<const double> time_s, std::span<const double> input);

// Time from row `first` to row `last` without the stretches of at least ten rows in which depth or
// strain rests: of several ramps with holds between them, the time of the ramps.
double moving_s(std::span<const double> time_s, std::span<const double> input, std::size_t first,
                std::size_t last);

// The part that a fit of one ramp describes: the rows up to the end of the longest hold.
RowRange up_to_longest_hold(std::span<const double> time_s, std::span<const double> input);

// Without a depth: the rows from the largest value on, where relaxation begins.
RowRange from_largest(std::span<const double> values);

// One past the last row after `peak` before the value falls faster than any relaxation does, as it
// does if the punch is lifted; the number of rows if it does not.
std::size_t end_of_relaxation(std::span<const double> time_s, std::span<const double> values,
                              std::size_t peak);

// The last row before `peak` at which the value has not yet risen by a twentieth: there the loading
// begins. Nothing if the record begins later than that.
std::optional<std::size_t> begin_of_rise(std::span<const double> values, std::size_t peak);

}  // namespace viscard
