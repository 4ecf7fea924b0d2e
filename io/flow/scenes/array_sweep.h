#pragma once

#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace viscard {

// The answer at one point of a sweep.
struct SweepRow {
  std::vector<SceneResult> results;  // those that are wanted, without the point's label
  int unknowns = 0;
  int degree = 0, layers = 0;  // of the mesh that met the tolerance
};

// What is done with the points of a sweep while it runs.
struct SweepListener {
  // Called with the number of a point and its answer as it ends, one at a time; may be empty.
  std::function<void(std::size_t, const SweepRow&)> keep;
  // Called with the fraction done and the point's label; may be empty.
  std::function<void(double, const std::string&)> progress;
};

// Solves the points that `rows` lacks on all cores and adds them. The answer is that of all rows,
// whoever solved them; it holds each effect as it is at the point where leaving it out costs most.
SceneAnswer solve_sweep(const SceneFile& file, std::map<std::size_t, SweepRow>& rows,
                        const SweepListener& listener);

// One answer of the whole sweep: every result as "name at label", and, with a limit, for each
// combination of the other parameters the first spacing whose deviation lies below it:
// "first_spacing at diameter 40 um" (none, no result). Its error reaches to the spacings that lie
// above and below the limit for certain. Where the deviation exceeds the limit again at a larger
// spacing, because it changes its sign, a note says so, and "settled_spacing" is the one from which
// on it stays below.
SceneAnswer joined(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                   const std::map<std::size_t, SweepRow>& rows);

// Columns diameter_m, spacing_m, thickness_m, then value and error estimate of each result.
std::string csv_from_sweep(const std::vector<SweepPoint>& points,
                           const std::map<std::size_t, SweepRow>& rows, const std::string& command);

}  // namespace viscard
