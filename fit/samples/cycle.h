#pragma once

#include <optional>
#include <span>

namespace viscard {

// A periodic disturbance of a record: the room's temperature, mains hum, a pump.
struct Cycle {
  double frequency_Hz = 0.0;
  double cosine = 0.0, sine = 0.0;  // amplitudes at t = 0, in the unit of the values
  double amplitude() const;         // of both together, in that unit
  double at(double time_s) const;   // its value at a time, in that unit
};

// The cycle of a record whose even sampling shows at least two and a half periods, beside any smooth
// curve in log time (exponentials at three times in two decades with coefficients of either sign, and a straight
// line). The frequency with the largest reduction of the sum of squares (least-squares spectrum; Lomb,
// Astrophys. Space Sci. 39 (1976) 447). It is a cycle if it takes a tenth of what the smooth curve leaves,
// and ten times as much as the next frequency once it is subtracted: slow noise has no single line.
// Times ascend. Nothing for fewer than 100 rows or uneven sampling.
std::optional<Cycle> find_cycle(std::span<const double> time_s, std::span<const double> values);

}  // namespace viscard
